"""Number of resonances in a region by the argument principle, without searching for them.

The small matrix D(λ) = K − λ(M_b + H(λ)) of the bodies is singular at resonances, and has poles where the water
could oscillate by itself if the bodies were held. Around a region the phase of det D turns once for every resonance
within and back for every pole; poles of H in `damped` are zeros of another determinant, which makes up for them. H
comes from solutions on the rim, on a reduced basis, and not from any eigenvector.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeAlias

import numpy as np

from hydroelastic.fem.open_water.damped import DampedSolver
from hydroelastic.fem.open_water.solver import OpenSolver

Solver: TypeAlias = OpenSolver | DampedSolver

# Points on the rim where the basis is judged, and where the phase is first followed; a multiple of four.
_JUDGED, _FIRST = 16, 64
# So often the distance between points is halved where the phase turns by more than this, radians.
_HALVINGS = 8
_TURN = 1.0
_UNSEEN = 2.0
# The winding number needs few digits of H; its error goes like the square of the residual.
_RESIDUAL = 1e-2


def zeros_in(solver: Solver, rim: Callable[[np.ndarray], np.ndarray]) -> int | None:
    """Count resonances less the water's own in a region (collective).

    Args:
        solver: of the model.
        rim: gives ω in rad/s at places from 0 to 4 around the region, counterclockwise.

    Returns:
        The winding number of det D; ``None`` where its phase cannot be followed.
    """
    _prepare(solver, rim)
    places = 4.0 * np.arange(_FIRST) / _FIRST
    phases = _phases(solver, rim(places))
    for _ in range(_HALVINGS):
        turns = np.angle(np.roll(phases, -1) / phases)
        far = np.flatnonzero((np.abs(turns) > _TURN) | _unseen(solver, rim(places)))
        if not len(far):
            return round(float(turns.sum() / (2.0 * np.pi)))
        added = 0.5 * (places + np.append(places[1:], 4.0))[far]
        phases = np.insert(phases, far + 1, _phases(solver, rim(added)))
        places = np.insert(places, far + 1, added)
    return None


def _unseen(solver: Solver, omegas: np.ndarray) -> np.ndarray:
    """Whether the phase may turn by more than is seen from each point to the next, as waves do that grow along bodies.

    H of `damped` has their squares, and no body is longer than the basin.
    """
    if isinstance(solver, OpenSolver):
        return np.zeros(len(omegas), dtype=bool)
    wavenumbers = np.array([solver.wavenumber(omega) for omega in omegas])
    unseen: np.ndarray = 2.0 * np.abs(np.roll(wavenumbers, -1) - wavenumbers) > _UNSEEN
    return unseen


def _prepare(solver: Solver, rim: Callable[[np.ndarray], np.ndarray]) -> None:
    """Solve on a rim wherever the basis is not good enough yet."""
    points = rim(4.0 * np.arange(_JUDGED) / _JUDGED)
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
    """det D over its magnitude at some ω."""
    squares = np.array([solver.model.squared_frequency(omega) for omega in omegas])
    if isinstance(solver, OpenSolver):
        added, water = solver.hydrodynamics(squares), np.ones(len(squares))
    else:
        added, water = solver.continued(squares)
    dynamics = solver.model.stiffness - squares[:, None, None] * (solver.model.mass + added)
    # Rows and columns of unlike motions are brought to one scale, which changes no phase.
    scales = 1.0 / np.sqrt(np.abs(np.einsum("nii->ni", dynamics)))
    determinants = np.linalg.det(dynamics * scales[:, None] * scales[:, :, None])
    phases: np.ndarray = determinants / np.abs(determinants) * water
    return phases
