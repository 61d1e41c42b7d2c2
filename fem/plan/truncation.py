"""Energy of a plate in the polynomials that its basis leaves out."""

from __future__ import annotations

from math import ceil

import numpy as np
from numpy.typing import NDArray

from hydroelastic.fem.mode_set import Mode
from hydroelastic.fem.plan.plan_pencil import PlanPlate, Pressures
from hydroelastic.fem.surfaces import Body
from hydroelastic.physics.plate import Plate

# Slowest decay of the energy with two more polynomials along each side.
_SLOWEST = 0.6
# Least power of the number of polynomials with which the energy falls: at corners between a clamped and a free edge.
_SLOWEST_POWER = 2.0


def geometric_tail(last: NDArray[np.float64], before: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the remainder of a geometric series after its last term, of which none falls slower than some."""
    decay = np.minimum(last / np.maximum(before, np.finfo(float).tiny), _SLOWEST)
    tail: NDArray[np.float64] = last * decay / (1.0 - decay)
    return tail


def missing_after(last: NDArray[np.float64], before: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the energy that a basis lacks, from that in its last polynomials and in those before them.

    Where corners limit the decay, it is the remainder of the series. Where the polynomials just resolve a wave the
    energy falls at once, and with a few fewer of them the others take over nothing: it is no less than that of the last
    ones.
    """
    missing: NDArray[np.float64] = np.maximum(geometric_tail(last, before), last)
    return missing


def finer_count(polynomials: int) -> int:
    """Return the number of polynomials along each side in which the error of fewer is seen."""
    return ceil(1.25 * polynomials) + 1


def rectangle_energies(
    plate: Plate,
    shapes: NDArray[np.float64],
    finer: NDArray[np.float64],
    body: Body,
    amplitudes: NDArray[np.float64],
    eigenvalues: NDArray[np.float64],
    pressures: NDArray[np.float64],
) -> NDArray[np.float64]:
    """Estimate the energy by which λ falls in all polynomials, by the residual of modes in more of them.

    Shapes are given by their coefficients (shapes, m, n), those in more polynomials with their body.
    With W the dry shapes in more polynomials, and κ the stiffness of each, λ falls by Σ r²/κ, r = κ∫wW/∫W² − λ(m∫wW +
    ρ∫ψW), which is zero in the polynomials that are there. What is beyond these too follows from the slowest decay.
    """
    count = shapes.shape[1:]
    overlap = np.tensordot(shapes, finer[:, : count[0], : count[1]], ((1, 2), (1, 2)))
    elastic = body.bending_stiffness > 0.0
    stiffness = body.stiffness[elastic]
    per_area = stiffness / (finer[elastic] ** 2).sum(axis=(1, 2))
    inertia = per_area - plate.mass_per_area * eigenvalues[:, None]
    residual = inertia * (amplitudes @ overlap[:, elastic]) - eigenvalues[:, None] * pressures[:, elastic]
    beyond = 1.0 - (count[0] / finer.shape[1]) ** _SLOWEST_POWER
    energies: NDArray[np.float64] = (residual**2 / stiffness).sum(axis=1) / beyond
    return energies


def plate_errors(plates: tuple[PlanPlate, ...], modes: list[Mode], pressures_of: Pressures) -> NDArray[np.float64]:
    """Relative errors of ω by the shapes that plates lack, shape (modes,)."""
    values = np.array([mode.eigenvalue for mode in modes])
    errors, first = np.zeros(len(modes)), 0
    for plate in plates:
        last = first + plate.body.size
        # In some symmetries a rigid plate does not move.
        if last > first:
            amplitudes = np.array([mode.body_amplitudes[first:last] for mode in modes])
            errors += plate.missing_energy(amplitudes, values, pressures_of)
        first = last
    return 0.5 * errors / values
