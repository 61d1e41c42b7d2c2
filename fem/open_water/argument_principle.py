"""Number of resonances in a region by the argument principle, without searching for them.

The dynamic stiffness D(λ) = K − iωB − λ(M_b + H(λ)) of the bodies is singular at resonances, and has poles at the
resonances of the water around fixed bodies. Along the boundary of a region the argument of det D increases by 2π for
every zero within and decreases by 2π for every pole; the poles of H in `damped` are zeros of another determinant, which
is included as a factor. H comes from solutions on the boundary, on a reduced basis, and not from any eigenvector.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeAlias

import numpy as np

from hydroelastic.fem.open_water.basin import extent_of_bodies
from hydroelastic.fem.open_water.damped import DampedSolver
from hydroelastic.fem.open_water.solver import OpenSolver

Solver: TypeAlias = OpenSolver | DampedSolver

# Points on the boundary at which the residual of the basis is computed, of `damped` and else, and initial points of the
# phase; multiples of four. Between bodies 60 m apart 16 points leave zeros in the region wrong.
_JUDGED_DAMPED, _JUDGED, _FIRST = 16, 64, 64
# Number of times that the distance between points may be halved, and the change of phase above which it is, radians.
_HALVINGS = 14
_TURN = 1.0
# Change of 2k times the extent of the bodies between neighbouring points above which more points are needed, radians.
_UNRESOLVED = 2.0
# Largest distance between points over that from a zero or a pole.
_CLOSE = 0.7
# The winding number needs few digits of H; its error goes like the square of the residual.
_RESIDUAL = 1e-2


def zeros_in(solver: Solver, boundary: Callable[[np.ndarray], np.ndarray]) -> int | None:
    """Count the resonances in a region, less those of the water around fixed bodies (collective)."""
    _prepare(solver, boundary)
    # Near a zero or a pole of det D its phase turns fast.
    turning = np.zeros(0) if isinstance(solver, DampedSolver) else np.append(*solver.zeros_and_poles())
    places = 4.0 * np.arange(_FIRST) / _FIRST
    phases = _phases(solver, boundary(places))
    for _ in range(_HALVINGS):
        turns = np.angle(np.roll(phases, -1) / phases)
        far = np.flatnonzero((np.abs(turns) > _TURN) | _unresolved(solver, boundary(places), turning))
        if not len(far):
            return round(float(turns.sum() / (2.0 * np.pi)))
        added = 0.5 * (places + np.append(places[1:], 4.0))[far]
        phases = np.insert(phases, far + 1, _phases(solver, boundary(added)))
        places = np.insert(places, far + 1, added)
    return None


def _unresolved(solver: Solver, omegas: np.ndarray, turning: np.ndarray) -> np.ndarray:
    """Whether the phase may turn by more than is seen from each point to the next: beside zeros and poles, and as waves
    do that grow along bodies.

    H of `damped` has their squares. Thin floats may be many times as deep as the basin is long.
    """
    if isinstance(solver, OpenSolver):
        steps = np.abs(np.roll(omegas, -1) - omegas)
        distances = np.abs(omegas[:, None] - turning).min(axis=1, initial=np.inf)
        return np.asarray(steps > _CLOSE * np.minimum(distances, np.roll(distances, -1)))
    _, _, low, high = extent_of_bodies(solver.model.basin.tank)
    wavenumbers = np.array([solver.wavenumber(omega) for omega in omegas])
    changes = np.abs(np.roll(wavenumbers, -1) - wavenumbers)
    unresolved: np.ndarray = 2.0 * max(1.0, -low, high) * changes > _UNRESOLVED
    return unresolved


def _prepare(solver: Solver, boundary: Callable[[np.ndarray], np.ndarray]) -> None:
    """Extend the basis by solutions on the boundary until its residual is small enough there."""
    judged = _JUDGED_DAMPED if isinstance(solver, DampedSolver) else _JUDGED
    points = boundary(4.0 * np.arange(judged) / judged)
    squares = [solver.model.squared_frequency(omega) for omega in points]
    if not solver.basis_size:
        solver.radiation(squares[0])
    for _ in squares:
        residuals = [solver.hydrodynamic(square)[1] for square in squares]
        worst = int(np.argmax(residuals))
        if residuals[worst] < _RESIDUAL:
            return
        solver.radiation(squares[worst])


def _phases(solver: Solver, omegas: np.ndarray) -> np.ndarray:
    squares = np.array([solver.model.squared_frequency(omega) for omega in omegas])
    if isinstance(solver, OpenSolver):
        added, water = solver.hydrodynamics(squares), np.ones(len(squares))
    else:
        added, water = solver.continued(squares)
    restoring = np.array([solver.model.restoring(square) for square in squares])
    dynamics = restoring - squares[:, None, None] * (solver.model.mass + added)
    # Rows and columns of unlike motions are brought to one scale, which changes no phase.
    scales = 1.0 / np.sqrt(np.abs(np.einsum("nii->ni", dynamics)))
    determinants = np.linalg.det(dynamics * scales[:, None] * scales[:, :, None])
    phases: np.ndarray = determinants / np.abs(determinants) * water
    return phases
