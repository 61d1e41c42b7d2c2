"""The field solution of a hanging string: polynomials on elements of equal travel time, collocation in time."""

from __future__ import annotations

import numpy as np
from mpi4py import MPI

from hydroelastic.fem.modes import EigenSolverError
from hydroelastic.fem.stopwatch import Report, Stopwatch
from hydroelastic.fem.string.damped_modes import damped_modes
from hydroelastic.fem.string.model import StringModel
from hydroelastic.fem.string.solution import string_solution
from hydroelastic.scenes.errors import UnsolvedError
from hydroelastic.scenes.models.string import StringScene
from hydroelastic.scenes.string.fronts import BESIDE, front_distance, travel_times
from hydroelastic.scenes.string.motion import end_motion
from hydroelastic.scenes.string.results import StringMotions, StringSolution

# Of the tolerance: the largest displacement is known after the solution only, the largest f before.
_SHARE = 0.5
_SAMPLES = 400
# Beyond these the last digits, or a front, are not worth minutes.
_MOST_UNKNOWNS = 5_000
_STEPS_PER_TRAVEL_TIME = 3_500


def solve_string_field(scene: StringScene, comm: MPI.Comm, report: Report = lambda _message: None) -> StringSolution:
    """Solve for free motions and the response, to the scene's tolerance away from fronts (collective).

    Args:
        scene: the scene.
        comm: MPI communicator.
        report: told what is being done.

    Raises:
        UnsolvedError: if the eigen-solver fails.
    """
    watch = Stopwatch()
    model, motion = field_string(scene), end_motion(scene)
    positions, times = np.array(scene.positions), np.array(scene.times)
    report("free motions")
    with watch.stage("modes"):
        motions = _free_motions(scene, comm, model, positions)
    report("response")
    distance = front_distance(scene.string, positions, times)
    judged = distance >= BESIDE["field"]
    # Between the times of the output f may be larger than at any of them.
    sampled = np.concatenate([times, np.linspace(0.0, times[-1], _SAMPLES)])
    largest = float(np.abs(motion.value(sampled)).max())
    solution = string_solution(
        comm,
        model,
        motion,
        positions,
        times,
        tolerance=_SHARE * scene.accuracy.tolerance * (largest or 1.0),
        judged=judged if judged.any() else None,
        most_unknowns=_MOST_UNKNOWNS,
        most_steps=int(_STEPS_PER_TRAVEL_TIME * (1.0 + times[-1] / scene.string.travel_time)),
    )
    # Nothing moves before the first front; the field has ripples of the size of the tolerance there.
    arrival = scene.string.travel_time - travel_times(scene.string, positions)
    still = times < arrival[:, None]
    return StringSolution(
        scene=scene,
        displacement=np.where(still, 0.0, solution.values),
        absolute_error=np.where(still, 0.0, solution.errors),
        motions=motions,
        size={
            "cells": solution.sizes.elements,
            "degree": solution.sizes.degree,
            "dofs": solution.sizes.unknowns,
            "steps": solution.sizes.steps,
        },
        seconds={**watch.seconds, **solution.seconds},
    )


def field_string(scene: StringScene) -> StringModel:
    """Return the string of a scene for the field solution."""
    string = scene.string
    return StringModel(
        length=string.length,
        linear_density=string.linear_density,
        gravity=string.gravity,
        resistance=(string.resistance.bottom, string.resistance.top),
        tip_mass=string.tip_mass,
        added_mass=string.added_mass,
        displaced_mass=string.displaced_mass,
        tip_displaced_mass=string.tip_displaced_mass,
    )


def _free_motions(scene: StringScene, comm: MPI.Comm, model: StringModel, positions: np.ndarray) -> StringMotions:
    try:
        found = damped_modes(comm, model, scene.accuracy.modes, positions)
    except EigenSolverError as error:
        raise UnsolvedError(f"the eigen-solver failed: {error}") from error
    shapes = found.shapes.real
    largest = np.abs(shapes).max(axis=1, keepdims=True)
    return StringMotions(
        roots=found.roots,
        errors=found.errors,
        shapes=shapes / np.where(largest > 0.0, largest, 1.0),
    )
