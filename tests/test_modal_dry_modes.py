"""Dry free-free modes: roots, norm, ends and stability at high index."""

import numpy as np
import pytest
from numpy.polynomial.legendre import leggauss
from scipy.optimize import brentq

from hydroelastic.modal.beam.dry_modes import free_free_roots, free_free_shape, free_free_wavenumber

EPS = np.finfo(float).eps


def test_first_roots_match_the_textbook_values() -> None:
    # Tabulated to 16 digits (reference file, constants "kappa_l"): two units in the last place.
    expected = [4.730040744862704, 7.853204624095838, 10.99560783800167]
    np.testing.assert_allclose(free_free_roots(3), expected, rtol=4 * EPS)


def test_roots_match_a_bracketed_solver() -> None:
    # cos b − 1/cosh b has slope about 1 at its roots: a bracketed solver is good to a few eps·b.
    for number, root in enumerate(free_free_roots(40), start=1):
        bracket = (number + 0.5) * np.pi
        found = brentq(lambda b: np.cos(b) - 1 / np.cosh(b), bracket - 0.3, bracket + 0.3, xtol=1e-15, rtol=4 * EPS)
        assert root == pytest.approx(found, abs=8 * EPS * root)


def test_shapes_are_orthonormal() -> None:
    # 200 Gauss points integrate products of shapes up to wavenumber 2·97 exactly; rounding is about 200 eps.
    nodes, weights = leggauss(200)
    s, weights = (nodes + 1) / 2, weights / 2
    shapes = np.array([free_free_shape(index, s) for index in range(32)])
    np.testing.assert_allclose((shapes * weights) @ shapes.T, np.eye(32), atol=200 * EPS)


@pytest.mark.parametrize("index", [2, 3, 4, 37, 120, 499, 500])
def test_free_ends_and_sign(index: int) -> None:
    ends = np.array([0.0, 1.0])
    parity = 1.0 if index % 2 == 0 else -1.0
    scale = free_free_wavenumber(index)
    np.testing.assert_array_equal(free_free_shape(index, ends), [2.0, 2.0 * parity])
    for derivative in (2, 3):
        np.testing.assert_allclose(free_free_shape(index, ends, derivative), 0.0, atol=4 * EPS * scale**derivative)


@pytest.mark.parametrize("index", [2, 3, 37, 200, 500])
def test_high_indices_against_extended_precision(index: int) -> None:
    # Decaying form summed in 80-bit arithmetic; its own phase error is 1600 · 2^-64 ~ 1e-16.
    s = np.linspace(0, 1, 1001)
    wide = s.astype(np.longdouble)
    pi = np.longdouble("3.14159265358979323846264338327950288")
    number, parity = index - 1, 1 if index % 2 == 0 else -1
    b = (number + np.longdouble("0.5")) * pi
    for _ in range(40):
        b = (number + np.longdouble("0.5")) * pi + parity * np.arcsin(1 / np.cosh(b))
    ratio = parity * np.exp(-b)
    sigma = (1 - ratio) / (1 + ratio)
    for derivative in range(4):
        turn = derivative * pi / 2
        wave = np.cos(b * wide + turn) - sigma * np.sin(b * wide + turn)
        decaying = (parity * np.exp(-b * (1 - wide)) + (-1) ** derivative * np.exp(-b * wide)) / (1 + ratio)
        error = free_free_shape(index, s, derivative) / float(b) ** derivative - (wave + decaying)
        assert np.abs(error).max() < 4e-15


def test_derivatives_follow_from_the_values() -> None:
    # Fourth-order central differences with h = 1e-3: error b^5 h^4 / 30, here below 5e-9 · b^5.
    step = 1e-3
    s = np.linspace(0.1, 0.9, 17)
    for index in (1, 2, 5):
        bound = 1e-12 * (free_free_wavenumber(index) + 1) ** 7 + 1e-9
        for derivative in (1, 2, 3):
            low, high = (free_free_shape(index, s + k * step, derivative - 1) for k in (-1, 1))
            far_low, far_high = (free_free_shape(index, s + k * step, derivative - 1) for k in (-2, 2))
            slope = (8 * (high - low) - (far_high - far_low)) / (12 * step)
            np.testing.assert_allclose(free_free_shape(index, s, derivative), slope, atol=bound * 10)
