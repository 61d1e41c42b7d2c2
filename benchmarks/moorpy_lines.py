"""Lines at rest on MoorPy, quasi-static mooring lines of catenaries.

Without a stream a line is one call of its `catenary`, whose tolerance is a displacement in metres. In a stream, which
is the same at all heights, MoorPy gives each line the mean drag along it as a load like a weight; several lines in a
row stand for one, and are brought to rest together until their end forces do not change any more. They begin where one
would be.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import moorpy
import numpy as np
from moorpy.Catenary import catenary

Array = Any
_DEPTH = 300.0


def line(given: Mapping[str, Any], catenaries: int = 0, tolerance: float = 0.0) -> tuple[Array, int]:
    """Return x + iz of the contact force at both ends, N, and the number of unknowns."""
    a, b = given["a"], given["b"]
    if catenaries:
        return _in_stream(given, catenaries)
    # The height of A above the bed, as a negative number, keeps the bed out of it.
    a_x, a_z, b_x, b_z, _ = catenary(
        *(b[0] - a[0], b[1] - a[1], given["length"], given["rigidity"], given["weight"]),
        CB=-(_DEPTH + a[1]),
        Tol=tolerance,
    )
    return np.array([a_x + 1j * a_z, -b_x - 1j * b_z]), 2


def _in_stream(given: Mapping[str, Any], count: int) -> tuple[Array, int]:
    start = np.linspace([given["a"][0], 0.0, given["a"][1]], [given["b"][0], 0.0, given["b"][1]], count + 1)
    if count > 1:
        single = _system(given, start[[0, -1]])
        _rest(single)
        start[1:-1] = single.lineList[0].getPosition(given["length"] * np.arange(1, count) / count).T
    return _rest(_system(given, start)), 2 * (count - 1)


def _system(given: Mapping[str, Any], places: Array) -> Any:
    system = moorpy.System(depth=_DEPTH, rho=given["density"], g=given["gravity"], current=[given["stream"], 0.0, 0.0])
    system.lineTypes["line"] = {
        "name": "line",
        **{"d_vol": given["diameter"], "m": given["mass"], "w": given["weight"], "EA": given["rigidity"]},
        **{"Cd": given["normal_drag"], "CdAx": given["tangential_drag"]},
    }
    count = len(places) - 1
    for number, place in enumerate(places):
        system.addPoint(1 if number in (0, count) else 0, place)
    for number in range(1, count + 1):
        system.addLine(given["length"] / count, "line", pointA=number, pointB=number + 1)
    system.initialize()
    return system


def _rest(system: Any) -> Array:
    before: Array = np.full(2, np.inf)
    for _ in range(100):
        system.solveEquilibrium(tol=1e-6)
        ends = np.array([system.lineList[0].fA[[0, 2]], -system.lineList[-1].fB[[0, 2]]])
        forces = ends[:, 0] + 1j * ends[:, 1]
        if np.abs(forces - before).max() <= 1e-9 * np.abs(forces).max():
            return forces
        before = forces
    raise RuntimeError("the drag still changes after 100 equilibria")
