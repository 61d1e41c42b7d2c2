"""Reference cases of a flexible thread in a stream, by name, as what the code takes."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np

from hydroelastic.physics.stream import ShearedStream, Stream, UniformStream, VeeringStream
from hydroelastic.physics.thread_load import ThreadLoad

_FILE = Path(__file__).parents[1] / "reference" / "thread.json"
CASES: dict[str, dict[str, Any]] = {case["id"]: case for case in json.loads(_FILE.read_text(encoding="utf-8"))["cases"]}


def inputs(name: str) -> dict[str, Any]:
    """Return what is given of a case."""
    return dict(CASES[name]["inputs"])


def results(name: str) -> dict[str, Any]:
    """Return the values of a case."""
    return dict(CASES[name]["results"])


def tolerance(name: str) -> float:
    """Return the relative difference to which the values of a case are known: its digits, and one in the last."""
    return float(2 * 10.0 ** -CASES[name]["digits"])


def stream_of(name: str) -> Stream | None:
    """Return the stream of a case."""
    match inputs(name)["current"]:
        case {"type": "none"}:
            return None
        case {"type": "uniform", "U": velocity}:
            return UniformStream(velocity)
        case {"type": "linear", "U0": velocity, "G": gradient}:
            return ShearedStream(velocity, gradient)
        case {"type": "veer", "U": speed, "rate": rate}:
            return VeeringStream(speed, rate)
    raise AssertionError(name)


def load_of(name: str) -> ThreadLoad:
    """Return weight, drags and stream of a case."""
    given = inputs(name)
    return ThreadLoad(weight=given["w"], normal_drag=given["kn"], tangential_drag=given["kt"], stream=stream_of(name))


def worst_difference(name: str, **values: Any) -> float:
    """Return the largest difference of values from those of a case, relative to the norm of each."""
    known = results(name)
    worst = 0.0
    for key, value in values.items():
        size = float(np.linalg.norm(known[key]))
        worst = max(worst, float(np.linalg.norm(np.asarray(value) - known[key])) / (size or 1.0))
    return worst
