"""Collocation at Gauss's points on systems of one and a few unknowns that are solved by hand."""

from __future__ import annotations

import numpy as np
import pytest
from mpi4py import MPI
from petsc4py import PETSc
from scipy.linalg import expm

from hydroelastic.fem.string.collocation import Collocation, gauss_rule


def dense(matrix: np.ndarray) -> PETSc.Mat:
    made = PETSc.Mat().createDense(matrix.shape, array=np.asfortranarray(matrix), comm=MPI.COMM_SELF).convert("aij")
    made.assemble()
    return made


@pytest.fixture
def matrices() -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    numbers = np.random.default_rng(7)
    mass, drag, stiffness = (part @ part.T for part in numbers.normal(size=(3, 4, 4)))
    return mass + np.eye(4), drag, stiffness + np.eye(4)


@pytest.mark.parametrize("stages", [1, 2, 3, 4, 5])
def test_a_step_without_loads_is_pade(stages: int) -> None:
    # Of w'' = −w the motion is turned by an angle whose approximant is of order twice the stages, with factor s!²/…
    stepper = Collocation(dense(np.eye(1)), dense(np.zeros((1, 1))), dense(np.eye(1)), stages)
    w, v = stepper.advance(np.array([1.0]), np.array([0.0]), 0.3, None)
    numerator = np.polynomial.Polynomial(_pade(stages))
    np.testing.assert_allclose(w[0] - 1j * v[0], numerator(0.3j) / numerator(-0.3j), atol=1e-14)
    assert np.all(gauss_rule(stages).eigenvalues.real > 0.0)


def _pade(stages: int) -> list[float]:
    """Coefficients of the numerator of the diagonal approximant of e^z."""
    coefficients = [1.0]
    for k in range(1, stages + 1):
        coefficients.append(coefficients[-1] * (stages - k + 1) / ((2 * stages - k + 1) * k))
    return coefficients


@pytest.mark.parametrize("stages", [2, 3, 4])
def test_order_with_loads(stages: int, matrices: tuple[np.ndarray, np.ndarray, np.ndarray]) -> None:
    mass, drag, stiffness = matrices
    load = np.array([1.0, -2.0, 0.5, 3.0])
    # F = load · e^{t/2} as one more unknown of a first-order system.
    inverse = np.linalg.inv(mass)
    system = np.zeros((9, 9))
    system[:4, 4:8] = np.eye(4)
    system[4:8, :4], system[4:8, 4:8], system[4:8, 8] = -inverse @ stiffness, -inverse @ drag, inverse @ load
    system[8, 8] = 0.5
    exact = (expm(2.0 * system) @ np.append(np.zeros(8), 1.0))[:4]
    counts = np.array([4, 6, 9, 13]) * (2 if stages == 2 else 1)
    errors = []
    for count in counts:
        stepper = Collocation(*map(dense, matrices), stages)
        w, v, step = np.zeros(4), np.zeros(4), 2.0 / count
        for number in range(count):
            times = step * (number + stepper.rule.nodes)
            w, v = stepper.advance(w, v, step, np.outer(np.exp(0.5 * times), load))
        errors.append(np.abs(w - exact).max())
        assert stepper.factorizations == len(stepper.rule.eigenvalues)
    assert -np.polyfit(np.log(counts), np.log(errors), 1)[0] == pytest.approx(2 * stages, abs=0.3)


def test_energy_is_kept_however_long_the_step(matrices: tuple[np.ndarray, np.ndarray, np.ndarray]) -> None:
    mass, drag, stiffness = matrices
    for resistance in (0.0 * drag, drag):
        stepper = Collocation(dense(mass), dense(resistance), dense(stiffness), 3)
        w, v = np.array([1.0, 0.0, -1.0, 2.0]), np.zeros(4)
        energies = [stepper.energy(w, v)]
        for _ in range(20):
            w, v = stepper.advance(w, v, 5.0, None)
            energies.append(stepper.energy(w, v))
        if resistance.any():
            assert np.all(np.diff(energies) < 0.0)
        else:
            np.testing.assert_allclose(energies, energies[0], rtol=1e-12)
