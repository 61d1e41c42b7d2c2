"""The flexible threads on MoorPy, quasi-static mooring lines of catenaries.

A line at rest is one call of its `catenary`, whose tolerance is a displacement in metres. In a stream, which is the
same at all heights, MoorPy gives each line the mean drag along it as a load like a weight; several lines in a row stand
for one, and are brought to rest together until their end forces do not change any more. They begin where one would be.
"""

from __future__ import annotations

from importlib.metadata import version

import moorpy
import numpy as np
from moorpy.Catenary import catenary
from numpy.typing import ArrayLike, NDArray

from hydroelastic.benchmarks.cases import Answer, Case
from hydroelastic.benchmarks.thread.cases import LINES_AT_REST, BenchmarkLine

_DEPTH = 300.0
# Of positions, m, and of end forces from one equilibrium to the next.
_TOLERANCE, _STILL = 1e-6, 1e-9
_MOST_ROUNDS = 100


def versions() -> dict[str, str]:
    """What computes."""
    return {"MoorPy": version("moorpy")}


def solve(case: Case) -> Answer:
    """Bring a line to rest."""
    line = LINES_AT_REST[case.tank]
    if case.variant == "catenaries":
        return _in_stream(line, case.segments)
    span, rise = line.b[0] - line.a[0], line.b[1] - line.a[1]
    # The height of A above the bed, as a negative number, keeps the bed out of it.
    a_x, a_z, b_x, b_z, _ = catenary(
        span, rise, line.length, line.axial_rigidity, line.weight, CB=-(_DEPTH + line.a[1]), Tol=case.tolerance
    )
    return Answer(values=(float(a_x), float(a_z), -float(b_x), -float(b_z)), unknowns=2)


def _in_stream(line: BenchmarkLine, count: int) -> Answer:
    start = np.linspace([line.a[0], 0.0, line.a[1]], [line.b[0], 0.0, line.b[1]], count + 1)
    if count > 1:
        single = _system(line, start[[0, -1]])
        _rest(single)
        places = line.length * np.arange(1, count) / count
        start[1:-1] = single.lineList[0].getPosition(places).T
    system = _system(line, start)
    forces, rounds = _rest(system)
    return Answer(
        values=(*forces[0].tolist(), *(-forces[1]).tolist()), unknowns=2 * (count - 1), note=f"{rounds} equilibria"
    )


def _system(line: BenchmarkLine, points: ArrayLike) -> moorpy.System:
    system = moorpy.System(depth=_DEPTH, rho=line.density, g=line.gravity, current=[line.stream, 0.0, 0.0])
    system.lineTypes["line"] = {
        "name": "line",
        "d_vol": line.diameter,
        "m": line.mass,
        "w": line.weight,
        "EA": line.axial_rigidity,
        "Cd": line.normal_drag,
        "CdAx": line.tangential_drag,
    }
    places = np.asarray(points)
    count = len(places) - 1
    for number, place in enumerate(places):
        system.addPoint(1 if number in (0, count) else 0, place)
    for number in range(1, count + 1):
        system.addLine(line.length / count, "line", pointA=number, pointB=number + 1)
    system.initialize()
    return system


def _rest(system: moorpy.System) -> tuple[NDArray[np.float64], int]:
    """End forces on the row of lines, (x, z) of N(0) and −N(L), and how many equilibria it took."""
    before: NDArray[np.float64] = np.full((2, 2), np.inf)
    for number in range(1, _MOST_ROUNDS + 1):
        system.solveEquilibrium(tol=_TOLERANCE)
        forces: NDArray[np.float64] = np.array([system.lineList[0].fA[[0, 2]], system.lineList[-1].fB[[0, 2]]])
        if np.abs(forces - before).max() <= _STILL * np.abs(forces).max():
            return forces, number
        before = forces
    raise RuntimeError(f"the drag still changes after {_MOST_ROUNDS} equilibria")
