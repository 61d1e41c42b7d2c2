"""The eigen-solver that the peers and the lower bound share, and what they load the liquid with."""

from __future__ import annotations

import numpy as np
import pytest
import scipy.linalg

from hydroelastic.benchmarks.tank.dry_shapes import dry_shapes
from hydroelastic.benchmarks.tank.surface_modes import SurfaceProblem, lowest_eigenvalues
from hydroelastic.modal.beam.dry_modes import free_free_shape


@pytest.mark.parametrize("count", [1, 2, 3, 60])
def test_all_dry_shapes_at_once_are_the_shapes_one_by_one(count: int) -> None:
    s = np.linspace(0.0, 1.0, 60).reshape(3, -1)[:, ::-1]
    values = dry_shapes(count, s)
    assert values.shape == (count, *s.shape)
    for index in range(count):
        # The phase κs is rounded: κ eps, with κl up to 184 here.
        np.testing.assert_allclose(values[index], free_free_shape(index, s), rtol=0.0, atol=2e-13)


def definite(generator: np.random.Generator, values: np.ndarray) -> np.ndarray:
    """A matrix of given eigenvalues and random eigenvectors."""
    vectors, _ = np.linalg.qr(generator.standard_normal((len(values), len(values))))
    return (vectors * values) @ vectors.T


def dense_eigenvalues(stiffness: np.ndarray, kinetic: np.ndarray, volume: np.ndarray | None) -> np.ndarray:
    """Eigenvalues λ > 0 of K ζ = λ M ζ, on Vᵀζ = 0 where there is a constraint, by dense linear algebra."""
    space = np.eye(len(stiffness)) if volume is None else scipy.linalg.null_space(volume[None, :])
    values = scipy.linalg.eigh(space.T @ stiffness @ space, space.T @ kinetic @ space, eigvals_only=True)
    return values[values > 1e-9 * values.max()]


def problem_of(
    stiffness: np.ndarray, kinetic: np.ndarray, rigid: np.ndarray, volume: np.ndarray | None
) -> SurfaceProblem:
    definite_stiffness = stiffness.copy()
    definite_stiffness[rigid, rigid] = 1.0

    def lifted(force: np.ndarray) -> np.ndarray:
        vector = np.linalg.solve(definite_stiffness, force)
        vector[rigid] = 0.0
        return vector

    def respond(vector: np.ndarray, _weighed: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        momentum = kinetic @ vector
        return momentum[rigid], lifted(momentum)

    return SurfaceProblem(
        size=len(stiffness),
        free_rigid=rigid,
        weigh=lambda vector: stiffness @ vector,
        respond=respond,
        volume=volume,
        volume_response=lifted(np.zeros(len(stiffness)) if volume is None else volume),
    )


@pytest.mark.parametrize("rigid", [0, 1, 2])
@pytest.mark.parametrize("volume", ["none", "of all", "of what is stiff"])
def test_lanczos_finds_the_dense_eigenvalues(rigid: int, volume: str) -> None:
    generator = np.random.default_rng(1)
    size = 80
    # As of waves in a tank: λ grows like the number of the mode.
    stiffness, kinetic = np.zeros((size, size)), definite(generator, 1.0 / np.arange(1.0, size + 1.0))
    stiffness[rigid:, rigid:] = definite(generator, np.linspace(1.0, 1.2, size - rigid))
    displaced = None if volume == "none" else generator.standard_normal(size)
    if displaced is not None and volume == "of what is stiff":
        displaced[:rigid] = 0.0
    exact = dense_eigenvalues(stiffness, kinetic, displaced)
    found = lowest_eigenvalues(problem_of(stiffness, kinetic, np.arange(rigid), displaced), 10, tolerance=1e-12)
    # Asked for 1e-12 by the bound residual²/gap, which is an estimate: ten times that.
    np.testing.assert_allclose(found.eigenvalues, exact[:10], rtol=1e-11)
    assert found.solves < size


def test_a_close_pair_is_not_taken_for_one() -> None:
    values = np.array([1.0, 1.3, 1.7, 1.7 * (1.0 + 1e-5), 2.0, *np.linspace(2.5, 60.0, 195)])
    problem = problem_of(np.diag(values), np.eye(len(values)), np.arange(0), None)
    found = lowest_eigenvalues(problem, 3, tolerance=1e-11)
    np.testing.assert_allclose(found.eigenvalues, values[:3], rtol=1e-9)
    np.testing.assert_allclose(lowest_eigenvalues(problem, 4, tolerance=1e-11).eigenvalues, values[:4], rtol=1e-9)


def test_a_problem_smaller_than_asked_gives_all_that_it_has() -> None:
    problem = problem_of(np.diag([1.0, 2.0, 3.0]), np.eye(3), np.arange(0), None)
    np.testing.assert_allclose(lowest_eigenvalues(problem, 10).eigenvalues, [1.0, 2.0, 3.0], rtol=1e-12)
