"""The closed form of a hanging string: a series of Bessel functions and damped oscillations."""

from __future__ import annotations

import numpy as np

from hydroelastic.fem.stopwatch import Stopwatch
from hydroelastic.modal.string.hanging_string import HangingString
from hydroelastic.modal.string.response import string_response
from hydroelastic.scenes.models.string import StringScene
from hydroelastic.scenes.string.motion import end_motion
from hydroelastic.scenes.string.results import StringMotions, StringSolution

# The series is summed closer than is asked, for it costs next to nothing.
_CLOSER = 0.01
_LEAST_TOLERANCE = 1e-13
_ROUNDINGS = 4.0


def closed_form(scene: StringScene) -> HangingString:
    """Return the string of a scene as one in vacuo: liquid that moves along and carries it changes g and α alone."""
    string = scene.string
    return HangingString(length=string.length, damping=string.damping, gravity=string.apparent_gravity)


def solve_series(scene: StringScene) -> StringSolution:
    """Sum the series of a scene.

    Args:
        scene: with a uniform resistance and nothing on the free end.
    """
    watch = Stopwatch()
    string, motion = closed_form(scene), end_motion(scene)
    tolerance = max(_CLOSER * scene.accuracy.tolerance, _LEAST_TOLERANCE)
    with watch.stage("solve"):
        response = string_response(
            string, motion, np.array(scene.positions), np.array(scene.times), tolerance=tolerance
        )
    with watch.stage("modes"):
        motions = free_motions(scene, string)
    return StringSolution(
        scene=scene,
        displacement=response.values,
        absolute_error=response.errors,
        motions=motions,
        size={"terms": response.terms},
        seconds=dict(watch.seconds),
    )


def free_motions(scene: StringScene, string: HangingString) -> StringMotions:
    """Return the free motions of smallest |p|: one for each mode that oscillates, two for an aperiodic one."""
    count = scene.accuracy.modes
    roots = string.roots(count)
    aperiodic = roots[:, 1].imag == 0.0
    numbers = np.concatenate([np.arange(1, count + 1), np.flatnonzero(aperiodic) + 1])
    found = np.concatenate([roots[:, 0], roots[aperiodic, 1]])
    order = np.argsort(np.abs(found), kind="stable")[:count]
    shapes = [string.mode_shape(int(number), np.array(scene.positions)) for number in numbers[order]]
    return StringMotions(
        roots=found[order],
        errors=_ROUNDINGS * np.finfo(float).eps * np.abs(found[order]),
        shapes=np.array(shapes),
    )
