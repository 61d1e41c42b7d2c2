"""Eigenvalues and special functions that NumPy gives, beside SciPy's."""

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.linalg import eigh
from scipy.special import betainc

from hydroelastic.modal.beam.surface_operator import GRADING, _incomplete_beta
from hydroelastic.modal.beam.tone_pencil import pencil_modes


def _pencil(size: int) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    generator = np.random.default_rng(size)
    one, other = generator.standard_normal((2, size, size))
    return one + one.T, other @ other.T + size * np.eye(size)


@pytest.mark.parametrize("size", [1, 3, 40])
def test_modes_of_a_pencil_are_those_of_scipy(size: int) -> None:
    matrix, positive = _pencil(size)
    eigenvalues, vectors = pencil_modes(matrix, positive)
    # Both are backward stable: multiples of eps, by the size and the condition of B, below 10 here.
    rounding = 100.0 * size * np.finfo(float).eps
    np.testing.assert_allclose(eigenvalues, eigh(matrix, positive, eigvals_only=True), rtol=rounding, atol=rounding)
    np.testing.assert_allclose(vectors.T @ positive @ vectors, np.eye(size), atol=rounding)
    np.testing.assert_allclose(vectors.T @ matrix @ vectors, np.diag(eigenvalues), atol=10.0 * rounding)


def test_the_grading_of_nodes_is_the_incomplete_beta_function() -> None:
    # Down to u^12 of the first node; a sum of positive terms keeps a few eps.
    u = np.concatenate([np.geomspace(1e-8, 0.4, 60), np.linspace(0.4, 1.0, 60)])
    np.testing.assert_allclose(_incomplete_beta(u), betainc(GRADING, GRADING, u), rtol=1e-14)
