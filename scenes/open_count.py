"""How many resonances lie in a region, counted without looking for them: the argument principle.

The small matrix D(λ) = K − λ(M_b + H(λ)) of the bodies is singular at resonances, and has poles where the water
could oscillate by itself if the bodies were held. Around a region the phase of det D turns once for every resonance
within and back for every pole. H comes from solutions on the rim, on a reduced basis, and not from any eigenvector.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from hydroelastic.scenes.open_solver import OpenSolver

# Points on each side of the region at first, and most of them.
_FIRST, _MOST = 16, 256
# Largest turn of the phase between neighbouring points that leaves no doubt, radians.
_TURN = 1.0
# The winding number needs few digits of H; its error goes like the square of the residual.
_RESIDUAL = 1e-3


def zeros_in(solver: OpenSolver, boundary: Callable[[int], np.ndarray]) -> int | None:
    """Count resonances less the water's own in a region (collective).

    Args:
        solver: of the model.
        boundary: gives points around the region, counterclockwise, ω in rad/s, so many on each of its sides.

    Returns:
        The winding number of det D; ``None`` where its phase cannot be followed.
    """
    _prepare(solver, boundary(_FIRST))
    count = _FIRST
    while count <= _MOST:
        phases = np.array([_phase(solver, omega) for omega in boundary(count)])
        turns = np.angle(np.roll(phases, -1) / phases)
        if np.abs(turns).max() < _TURN:
            return round(float(turns.sum() / (2.0 * np.pi)))
        count *= 2
    return None


def _prepare(solver: OpenSolver, points: np.ndarray) -> None:
    """Solve on the rim wherever the basis is not good enough yet."""
    squares = [solver.model.squared_frequency(omega) for omega in points]
    solver.radiation(squares[0])
    while True:
        residuals = [solver.hydrodynamic(square)[1] for square in squares]
        worst = int(np.argmax(residuals))
        if residuals[worst] < _RESIDUAL:
            return
        solver.radiation(squares[worst])


def _phase(solver: OpenSolver, omega: complex) -> complex:
    """det D over its magnitude."""
    squared = solver.model.squared_frequency(omega)
    added, _ = solver.hydrodynamic(squared)
    dynamic = solver.model.stiffness - squared * (solver.model.mass + added)
    # Rows and columns of unlike motions are brought to one scale, which changes no phase.
    scale = 1.0 / np.sqrt(np.abs(np.diag(dynamic)))
    determinant = np.linalg.det(dynamic * scale * scale[:, None])
    return complex(determinant / abs(determinant))
