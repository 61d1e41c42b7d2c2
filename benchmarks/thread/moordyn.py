"""The flexible threads on MoorDyn, lines of point masses in time.

What is used of MoorDyn: internal damping of half the critical one of a segment, as in MoorDyn's own test of the
jumper; Heun's method (`rk2`) with steps as long as axial waves let them be, the cheapest of its methods that was found
(`rk4` allows half as long steps again for twice the work; the implicit ones did not converge at longer steps). The top
of the jumper gets a new velocity in each step: fewer, of 0.01 s and more, leave 1 to 3 % of spurious internal damping.
A line at rest is MoorDyn's own initial condition, from a catenary, by its stationary solver or by motion with five
times the drag; the second is faster, and leaves some motion. In a stream, which that does not know, the line is
followed on until its end forces do not change any more. The chain that swings, which does not stretch, gets an
axial rigidity that grows with the square of the number of segments, so that stretch and segments leave errors of one
order.
"""

from __future__ import annotations

import contextlib
import struct
import tempfile
from collections.abc import Iterator
from dataclasses import dataclass, replace
from importlib.metadata import version
from math import ceil, pi, sqrt
from pathlib import Path
from typing import Any

import moordyn
import numpy as np

from hydroelastic.benchmarks.cases import Answer, Case
from hydroelastic.benchmarks.thread.cases import (
    CHAIN,
    JUMPER,
    LINES_AT_REST,
    PERIOD,
    SWING,
    SWING_TIMES,
    TENSION_TIMES,
    BenchmarkLine,
    tension_difference,
    top_displacement,
)

_DEPTH = 300.0
# Of the time in which an axial wave passes a segment.
_STEP = 0.7
_DAMPING = -0.5
# Of lines at rest: ICgenDynamic and threshIC. The first does not get better with a smaller threshold; of the second, a
# larger one stops at once (0.3 of the jumper's force), a smaller one changes nothing.
_STARTS = {"relaxed in motion": (1, 1e-4), "relaxed": (0, 1e-5)}
# Relative change of end forces in a second below which a line in a stream is at rest.
_STILL, _MOST_SECONDS = 1e-6, 300
# EA of the chain over the square of the number of segments, N, and the height it hangs from, m.
_STIFFNESS, _CHAIN_TOP = 1e3, -10.0


@dataclass(frozen=True, kw_only=True)
class _Input:
    """What an input file says.

    Attributes:
        line: diameter, mass by length, EA, Cd, Ca and Ct.
        points: kind, x, z, mass and volume of each end.
        length: m.
        segments: their number.
        step: s.
        density: kg/m³.
        gravity: m/s².
        currents: whether there is a file of them.
        start: how the initial condition is found: ICgenDynamic and threshIC.
    """

    line: tuple[float, float, float, float, float, float]
    points: tuple[tuple[str, float, float, float, float], tuple[str, float, float, float, float]]
    length: float
    segments: int
    step: float
    density: float
    gravity: float
    currents: bool = False
    start: tuple[int, float] = (0, 1e-3)

    @property
    def text(self) -> str:
        """The file; its heads are skipped by MoorDyn, but must be there."""
        diameter, mass, rigidity, normal, added, tangential = self.line
        points = [
            f"{number} {kind} {x!r} 0 {z!r} {weight!r} {volume!r} 0 0"
            for number, (kind, x, z, weight, volume) in enumerate(self.points, start=1)
        ]
        rows = [
            *("MoorDyn", "--- LINE TYPES ---", "Name Diam Mass EA BA EI Cd Ca CdAx CaAx", "(-)"),
            f"line {diameter!r} {mass!r} {rigidity!r} {_DAMPING} 0 {normal!r} {added!r} {tangential!r} 0",
            *("--- POINTS ---", "ID Type X Y Z Mass Volume CdA Ca", "(-)", *points),
            *("--- LINES ---", "ID LineType AttachA AttachB UnstrLen NumSegs Outputs", "(-)"),
            f"1 line 1 2 {self.length!r} {self.segments} -",
            *("--- OPTIONS ---", "0 writeLog", f"{self.step!r} dtM", "rk2 tScheme", f"{_DEPTH} WtrDpth"),
            *(f"{self.density!r} WtrDnsty", f"{self.gravity!r} g", f"{int(self.currents)} Currents"),
            *(f"{self.start[0]} ICgenDynamic", f"{self.start[1]!r} threshIC", "300 TmaxIC"),
            *("1 disableOutTime", "1 disableOutput", "--- need this line ---"),
        ]
        return "\n".join(rows) + "\n"


def versions() -> dict[str, str]:
    """What computes."""
    return {"MoorDyn": version("moordyn")}


def solve(case: Case) -> Answer:
    """Solve a case, from the input file to numbers."""
    if case.tank == SWING:
        return _swing(case.segments)
    if case.tank == JUMPER:
        return _jumper(case.segments)
    return _rest(LINES_AT_REST[case.tank], case.segments, _STARTS.get(case.variant, _Input.start))


@contextlib.contextmanager
def _system(given: _Input, currents: str = "") -> Iterator[tuple[Any, Path]]:
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "line.txt").write_text(given.text, encoding="utf-8")
        if currents:
            (folder / "current_profile.txt").write_text(currents, encoding="utf-8")
        system = moordyn.Create(str(folder / "line.txt"))
        moordyn.SetVerbosity(system, moordyn.LEVEL_NONE)
        try:
            yield system, folder
        finally:
            moordyn.Close(system)


def _input(line: BenchmarkLine, segments: int, *, top: str) -> _Input:
    size = line.length / segments
    return _Input(
        line=(line.diameter, line.mass, line.axial_rigidity, line.normal_drag, 1.0, line.tangential_drag),
        points=(("Fixed", *line.a, 0.0, 0.0), (top, *line.b, 0.0, 0.0)),
        length=line.length,
        segments=segments,
        step=_STEP * size / sqrt(line.axial_rigidity / line.mass),
        density=line.density,
        gravity=line.gravity,
        currents=line.stream != 0.0,
    )


def _rest(line: BenchmarkLine, segments: int, start: tuple[int, float]) -> Answer:
    currents = ""
    if line.stream:
        rows = [f"{z!r} {line.stream + line.shear * (z - line.a[1])!r} 0 0" for z in (-_DEPTH, 0.0)]
        currents = "\n".join(["currents", "steady", "z ux uy uz", *rows]) + "\n"
    given = replace(_input(line, segments, top="Fixed"), start=start)
    with _system(given, currents) as (system, _):
        moordyn.Init(system, [], [])
        thread = moordyn.GetLine(system, 1)
        forces, seconds = _end_forces(thread, segments), 0
        while currents and seconds < _MOST_SECONDS:
            moordyn.Step(system, [], [], float(seconds), 1.0)
            before, forces = forces, _end_forces(thread, segments)
            seconds += 1
            if np.abs(forces - before).max() <= _STILL * np.abs(forces).max():
                break
    note = f"followed for {seconds} s" if currents else ""
    return Answer(values=tuple(forces.ravel().tolist()), unknowns=2 * (segments - 1), note=note)


def _end_forces(thread: Any, segments: int) -> Any:
    """(x, z) of N at both ends: the net force of a line on its end nodes, as MoorDyn gives it."""
    ends = [moordyn.GetLineNodeForce(thread, node) for node in (0, segments)]
    return np.array(ends)[:, [0, 2]] * [[1.0], [-1.0]]


def _jumper(segments: int) -> Answer:
    line = LINES_AT_REST["jumper at rest"]
    given = _input(line, segments, top="Coupled")
    count = ceil(3.0 * PERIOD / given.step)
    length = 3.0 * PERIOD / count
    times, pulls = length * np.arange(1, count + 1), np.empty(count)
    with _system(given) as (system, _):
        moordyn.Init(system, [line.b[0], 0.0, line.b[1]], [0.0, 0.0, 0.0])
        thread, before = moordyn.GetLine(system, 1), 0.0
        for number, time in enumerate(times):
            after = top_displacement(float(time))
            place, speed = [line.b[0] + before, 0.0, line.b[1]], [(after - before) / length, 0.0, 0.0]
            moordyn.Step(system, place, speed, number * length, length)
            pulls[number] = np.linalg.norm(moordyn.GetLineNodeForce(thread, segments))
            before = after
    values = np.interp(TENSION_TIMES, times, pulls)
    return Answer(
        values=tuple(values.tolist()),
        unknowns=segments + 1,
        note=f"{count} steps, {tension_difference(values, 'MoorDyn'):.1e} from its own fine run",
    )


def _swing(segments: int) -> Answer:
    # As little water as can be, and a gravity by which the weight in it is that of the chain.
    density, diameter = 1.0, 0.01
    displaced = density * pi * diameter**2 / 4.0
    gravity = CHAIN.weight / (CHAIN.mass - displaced)
    rigidity = _STIFFNESS * segments**2
    step = _STEP * CHAIN.length / segments / sqrt(rigidity / CHAIN.mass)
    given = _Input(
        line=(
            *(diameter, CHAIN.mass, rigidity, 2.0 * CHAIN.normal_drag / (density * diameter)),
            *(CHAIN.added_mass / displaced, 2.0 * CHAIN.tangential_drag / (density * pi * diameter)),
        ),
        points=(
            ("Fixed", 0.0, _CHAIN_TOP, 0.0, 0.0),
            ("Free", 0.0, _CHAIN_TOP - CHAIN.length, CHAIN.tip_mass, _volume(density, gravity)),
        ),
        length=CHAIN.length,
        segments=segments,
        step=step,
        density=density,
        gravity=gravity,
    )
    places = []
    with _system(given) as (system, folder):
        moordyn.Init_NoIC(system, [], [])
        (folder / "state").write_bytes(_initial_state(segments))
        moordyn.LoadState(system, str(folder / "state"))
        body, time = moordyn.GetPoint(system, 2), 0.0
        for wanted in SWING_TIMES:
            moordyn.Step(system, [], [], time, wanted - time)
            places.append(moordyn.GetPointPos(body))
            time = wanted
    values = np.array(places)[:, [0, 2]] - [0.0, _CHAIN_TOP]
    return Answer(
        values=tuple(values.ravel().tolist()),
        unknowns=segments + 1,
        note=f"{ceil(time / step)} steps, EA {rigidity:.0e} N",
    )


def _volume(density: float, gravity: float) -> float:
    """Of the body, by which its weight in water is that of the case."""
    return (CHAIN.tip_mass - CHAIN.tip_weight / gravity) / density


def _initial_state(segments: int) -> bytes:
    """A state file: for each point, and for the line, how many nodes there are, and their places and velocities."""
    s = np.linspace(0.0, CHAIN.length, segments + 1, dtype=np.float64)
    nodes = np.zeros((segments + 1, 6))
    nodes[:, 2], nodes[:, 3] = _CHAIN_TOP - s, CHAIN.velocity(s)
    parts = [
        struct.pack("<QQ", len(rows), 6) + rows.astype("<f8").tobytes() for rows in (nodes[:1], nodes[-1:], nodes[1:-1])
    ]
    data = b"".join(parts)
    return b"MoorDyn" + struct.pack("<BBQQ", 2, 4, len(data) // 8 + 1, len(parts)) + data
