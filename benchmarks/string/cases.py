"""The hanging string of the benchmark: its motions, its points, its cases, and what is certain of them.

A string of 1 m and 1 kg/m with λ = 0.5 kg/(m·s); its upper end is moved. Compared are displacements at 41 heights and
121 times up to 3.2 travel times R, further than 5 % of R from a wave front, relative to the largest one.
"""

from __future__ import annotations

from functools import cache

import numpy as np

from hydroelastic.benchmarks.cases import Case
from hydroelastic.fem.string.solution import FIELD_FRONT_MARGIN
from hydroelastic.modal.string.response import string_response
from hydroelastic.physics.string import HangingString
from hydroelastic.scenes.models.string import StringScene
from hydroelastic.scenes.string.physics import end_motion

MOTIONS = ("smooth", "ramp", "sine", "step")
_GIVEN = {
    "smooth": {"kind": "smooth", "amplitude": 1.0, "rate": 4.0},
    "ramp": {"kind": "ramp", "speed": 1.0},
    "sine": {"kind": "sine", "amplitude": 1.0, "omega": 8.0},
    "step": {"kind": "step", "amplitude": 1.0},
}
_HEIGHTS, _TIMES, _TRAVEL_TIMES = 41, 121, 3.2

FIELD_TOLERANCES = (1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7)
SERIES_TOLERANCES = (1e-2, 1e-4, 1e-6, 1e-8, 1e-10)
TERMS = (4, 16, 64, 256, 1024, 4096)


def string_scene(motion: str, tolerance: float, method: str) -> StringScene:
    """Return the scene of a motion."""
    travel = HangingString(length=1.0, linear_density=1.0).travel_time
    return StringScene.model_validate(
        {
            "string": {"length": 1.0, "linear_density": 1.0, "resistance": 0.5},
            "motion": _GIVEN[motion],
            "output": {
                "positions": [(place / (_HEIGHTS - 1)) ** 2 for place in range(_HEIGHTS)],
                "times": [_TRAVEL_TIMES * travel * place / (_TIMES - 1) for place in range(_TIMES)],
            },
            "accuracy": {"tolerance": tolerance, "method": method},
        }
    )


@cache
def compared(motion: str) -> np.ndarray:
    """Return which points are compared, shape (heights, times)."""
    scene = string_scene(motion, 1e-6, "series")
    distance = scene.string.physical.front_distance(np.array(scene.positions), np.array(scene.times))
    return np.asarray(distance > FIELD_FRONT_MARGIN)


@cache
def exact(motion: str) -> np.ndarray:
    """Return the displacements by the series at its smallest tolerance.

    The tests of the series hold it against a Bromwich integral and 20-digit references: it is exact to 1e-12 here.
    """
    scene = string_scene(motion, 1e-6, "series")
    response = string_response(
        scene.string.physical, end_motion(scene), np.array(scene.positions), np.array(scene.times), tolerance=1e-15
    )
    return response.values[compared(motion)]


def string_error(motion: str, values: tuple[float, ...]) -> float:
    """Largest difference to the exact displacements, relative to the largest one."""
    reference = exact(motion)
    return float(np.abs(np.array(values) - reference).max() / np.abs(reference).max())


def string_cases(motion: str, *, quick: bool) -> tuple[Case, ...]:
    """All cases of a motion; a quick run takes every third."""
    step = 3 if quick else 1
    return (
        *(Case(code="string field", tank=motion, variant="certified", tolerance=t) for t in FIELD_TOLERANCES[::step]),
        *(Case(code="string series", tank=motion, variant="certified", tolerance=t) for t in SERIES_TOLERANCES[::step]),
        *(Case(code="string sum", tank=motion, variant="cut sharply", terms=terms) for terms in TERMS[::step]),
    )
