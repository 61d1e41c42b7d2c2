"""Lines at rest, and the jumper that is moved, on MoorDyn: point masses in time.

What is used of MoorDyn: internal damping of half the critical one of a segment, as in MoorDyn's own test of the
jumper; Heun's method (`rk2`) with steps as long as axial waves let them be, the cheapest of its methods that was found
(`rk4` allows half as long steps again for twice the work; the implicit ones did not converge at longer steps). The top
of the jumper gets a new velocity in each step: fewer, of 0.01 s and more, leave 1 to 3 % of spurious internal damping.
A line at rest is MoorDyn's own initial condition, from a catenary, by its stationary solver or by motion with five
times the drag; the second is faster, and leaves some motion. In a stream, which that does not know, the line is
followed on until its end forces do not change any more.
"""

from __future__ import annotations

import contextlib
import tempfile
from collections.abc import Iterator, Mapping
from math import ceil, sin, sqrt, tau
from pathlib import Path
from typing import Any

import moordyn
import numpy as np

Array = Any
Line = Mapping[str, Any]


def line(given: Line, segments: int, in_motion: bool = False) -> tuple[Array, int, str]:
    """Return x + iz of the contact force at both ends, N, the number of unknowns, and for how long it was followed."""
    # ICgenDynamic and threshIC: the first does not get better with a smaller threshold; of the second, a larger one
    # stops at once (0.3 of the jumper's force), a smaller one changes nothing.
    start = (0, 1e-3) if given["stream"] else (1, 1e-4) if in_motion else (0, 1e-5)
    with _system(given, segments, "Fixed", start) as system:
        moordyn.Init(system, [], [])
        thread = moordyn.GetLine(system, 1)
        forces, seconds = _end_forces(thread, segments), 0
        while given["stream"] and seconds < 300:
            moordyn.Step(system, [], [], float(seconds), 1.0)
            before, forces = forces, _end_forces(thread, segments)
            seconds += 1
            if np.abs(forces - before).max() <= 1e-6 * np.abs(forces).max():
                break
    return forces, 2 * (segments - 1), f"followed for {seconds} s" if seconds else ""


def moved(given: Line, segments: int) -> tuple[Array, int, str]:
    """Return the top tension in the third period, N, the number of nodes, and of steps."""
    x, z = given["b"]
    count = ceil(3.0 * given["period"] / _step(given, segments))
    length = 3.0 * given["period"] / count
    times, pulls = length * np.arange(1, count + 1), np.empty(count)
    with _system(given, segments, "Coupled", (0, 1e-3)) as system:
        moordyn.Init(system, [x, 0.0, z], [0.0, 0.0, 0.0])
        thread, before = moordyn.GetLine(system, 1), 0.0
        for number, time in enumerate(times):
            part = min(time / given["period"], 1.0)
            ramp = part**3 * (10.0 + part * (6.0 * part - 15.0))
            after = ramp * given["amplitude"] * sin(tau * time / given["period"])
            speed = [(after - before) / length, 0.0, 0.0]
            moordyn.Step(system, [x + before, 0.0, z], speed, number * length, length)
            pulls[number] = np.linalg.norm(moordyn.GetLineNodeForce(thread, segments))
            before = after
    return np.interp(given["times"], times, pulls), segments + 1, f"{count} steps"


def _step(given: Line, segments: int) -> float:
    """0.7 of the time in which an axial wave passes a segment, s."""
    return 0.7 * given["length"] / segments / sqrt(given["rigidity"] / given["mass"])


def _end_forces(thread: Any, segments: int) -> Array:
    """The net force of a line on its end nodes, as MoorDyn gives it."""
    ends = np.array([moordyn.GetLineNodeForce(thread, node) for node in (0, segments)]) * [[1.0], [-1.0]]
    return ends[:, 0] + 1j * ends[:, 2]


@contextlib.contextmanager
def _system(given: Line, segments: int, top: str, start: tuple[int, float]) -> Iterator[Any]:
    (ax, az), (bx, bz) = given["a"], given["b"]
    kind = [given[key] for key in ("diameter", "mass", "rigidity")]
    # Heads are skipped by MoorDyn, but must be there.
    rows = [
        *("MoorDyn", "--- LINE TYPES ---", "Name Diam Mass EA BA EI Cd Ca CdAx CaAx", "(-)"),
        f"line {kind[0]} {kind[1]!r} {kind[2]} -0.5 0 {given['normal_drag']!r} 1.0 {given['tangential_drag']!r} 0",
        *("--- POINTS ---", "ID Type X Y Z Mass Volume CdA Ca", "(-)"),
        *(f"1 Fixed {ax} 0 {az} 0 0 0 0", f"2 {top} {bx} 0 {bz} 0 0 0 0"),
        *("--- LINES ---", "ID LineType AttachA AttachB UnstrLen NumSegs Outputs", "(-)"),
        f"1 line 1 2 {given['length']} {segments} -",
        *("--- OPTIONS ---", "0 writeLog", f"{_step(given, segments)!r} dtM", "rk2 tScheme", "300.0 WtrDpth"),
        *(f"{given['density']} WtrDnsty", f"{given['gravity']} g", f"{int(given['stream'] > 0.0)} Currents"),
        *(f"{start[0]} ICgenDynamic", f"{start[1]} threshIC", "300 TmaxIC"),
        *("1 disableOutTime", "1 disableOutput", "--- need this line ---"),
    ]
    with tempfile.TemporaryDirectory() as name:
        (Path(name) / "line.txt").write_text("\n".join(rows) + "\n", encoding="utf-8")
        if given["stream"]:
            speeds = [f"{z!r} {given['stream'] + given['shear'] * (z - az)!r} 0 0" for z in (-300.0, 0.0)]
            text = "\n".join(["currents", "steady", "z ux uy uz", *speeds]) + "\n"
            (Path(name) / "current_profile.txt").write_text(text, encoding="utf-8")
        system = moordyn.Create(str(Path(name) / "line.txt"))
        moordyn.SetVerbosity(system, moordyn.LEVEL_NONE)
        try:
            yield system
        finally:
            moordyn.Close(system)
