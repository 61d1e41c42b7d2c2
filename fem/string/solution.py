"""Field solution of a hanging string: free motions, and the motion under a moving upper end."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from mpi4py import MPI
from numpy.typing import NDArray

from hydroelastic.fem.string.end_motion import EndMotion
from hydroelastic.fem.string.modes import damped_modes
from hydroelastic.fem.string.response import field_response
from hydroelastic.modal.string.solution import FreeMotions, StringSolution
from hydroelastic.physics.string import HangingString

FIELD_FRONT_MARGIN = 0.05
"""`StringSolution.front_margin` of a field solution."""

# Of the tolerance: the largest displacement is known after the solution only, the largest f before.
_SHARE = 0.5
_SAMPLES = 400
# Limits of the cost of the last digits, or of values next to a front.
_MOST_UNKNOWNS = 5_000
_STEPS_PER_TRAVEL_TIME = 3_500


def field_solution(
    comm: MPI.Comm,
    string: HangingString,
    motion: EndMotion,
    positions: NDArray[np.float64],
    times: NDArray[np.float64],
    *,
    tolerance: float,
    modes: int,
    report: Callable[[str], None] = lambda _message: None,
) -> StringSolution:
    """Solve for free motions and displacements, to the tolerance away from wave fronts (collective)."""
    report("free motions")
    free_motions = field_free_motions(comm, string, modes, positions)
    report("response")
    judged = string.front_distance(positions, times) >= FIELD_FRONT_MARGIN
    # Between the times of the output f may be larger than at any of them.
    sampled = np.concatenate([times, np.linspace(0.0, times[-1], _SAMPLES)])
    largest = float(np.abs(motion.value(sampled)).max())
    response = field_response(
        comm,
        string,
        motion,
        positions,
        times,
        tolerance=_SHARE * tolerance * (largest or 1.0),
        judged=judged if judged.any() else None,
        most_unknowns=_MOST_UNKNOWNS,
        most_steps=int(_STEPS_PER_TRAVEL_TIME * (1.0 + times[-1] / string.travel_time)),
    )
    # Nothing moves before the first front; the field has ripples of the size of the tolerance there.
    still = times < string.arrival_times(positions)[:, None]
    return StringSolution(
        string=string,
        positions=positions,
        times=times,
        displacement=np.where(still, 0.0, response.values),
        absolute_error=np.where(still, 0.0, response.errors),
        free_motions=free_motions,
        tolerance=tolerance,
        front_margin=FIELD_FRONT_MARGIN,
        size={
            "cells": response.sizes.elements,
            "degree": response.sizes.degree,
            "dofs": response.sizes.unknowns,
            "steps": response.sizes.steps,
        },
    )


def field_free_motions(
    comm: MPI.Comm, string: HangingString, count: int, positions: NDArray[np.float64]
) -> FreeMotions:
    """Return the free motions of smallest |p|, with the real parts of their shapes (collective)."""
    found = damped_modes(comm, string, count, positions)
    shapes = found.shapes.real
    largest = np.abs(shapes).max(axis=1, keepdims=True)
    return FreeMotions(roots=found.roots, errors=found.errors, shapes=shapes / np.where(largest > 0.0, largest, 1.0))
