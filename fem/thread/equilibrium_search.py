"""The equilibrium of a thread to a tolerance: starts are tried until one leads to a thread in tension."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from mpi4py import MPI
from numpy.typing import NDArray
from scipy.optimize import brentq

from hydroelastic.fem.thread.continuation import start_with_decreasing_rigidity
from hydroelastic.fem.thread.equilibrium import Start
from hydroelastic.fem.thread.frame import Frame
from hydroelastic.fem.thread.newton import ThreadSolverError
from hydroelastic.fem.thread.refinement import NoEquilibriumError, ThreadSolution, solve_thread
from hydroelastic.fem.thread.straight import solve_with_given_tension
from hydroelastic.modal.thread.starts import ThreadStart, thread_starts
from hydroelastic.physics.thread import Thread

Array = NDArray[np.float64]

# A chord whose sine with the vertical is below this leaves the plane of the sag undetermined.
_ALONG = 1e-6
# Degree of the positions of the start with decreasing rigidity.
_DEGREE = 4


@dataclass(frozen=True, kw_only=True)
class FoundEquilibrium:
    """An equilibrium and how it was found."""

    solution: ThreadSolution  # the field solution
    start: str  # name of the start that led to it
    failed: tuple[str, ...]  # why the starts before it failed


def find_equilibrium(comm: MPI.Comm, thread: Thread, frame: Frame, tolerance: float) -> FoundEquilibrium:
    """Solve for the equilibrium of a thread."""
    if thread.tension is not None:
        solution = solve_with_given_tension(comm, thread, frame)
        return FoundEquilibrium(solution=solution, start="its tension", failed=())
    model, failed = frame.thread_in_frame(thread), list[str]()
    for name, start in _starts(comm, thread, frame, failed):
        try:
            solution = solve_thread(comm, model, start, tolerance=tolerance)
        except ThreadSolverError as error:
            failed.append(f"from {name}: {error}")
            continue
        return FoundEquilibrium(solution=solution, start=name, failed=tuple(failed))
    raise NoEquilibriumError(f"no equilibrium under tension was found: {'; '.join(failed)}")


def _starts(comm: MPI.Comm, thread: Thread, frame: Frame, failed: list[str]) -> Iterator[tuple[str, Start]]:
    """Shapes without bending stiffness, from which a slack thread may also be found by decreasing the rigidity; for a
    thread with bending stiffness an arc, and straight along a clamp or along the chord.
    """
    shapes = []
    for found in thread_starts(thread, failed):

        def position(s: Array, found: ThreadStart = found) -> Array:
            return frame.to_frame(found.position(s))

        shapes.append(Start(position=position, force=found.tension))
        yield found.name, shapes[-1]
    a, b = thread.ends
    chord = b.position - a.position
    if a.is_fixed and b.is_fixed and np.linalg.norm(chord) < thread.length:
        if thread.bends:
            yield "a bow", _bow(frame.to_frame(a.position), frame.to_frame(chord), thread.length, thread.weight)
        elif shapes:
            name = "a thread that bends less and less"
            try:
                faded = start_with_decreasing_rigidity(comm, frame.thread_in_frame(thread), shapes[0], degree=_DEGREE)
            except ThreadSolverError as error:
                failed.append(f"{name}: {error}")
            else:
                yield name, faded
    if thread.bends:
        yield "a straight thread", _straight(thread, frame)


def _bow(first: Array, chord: Array, length: float, weight: float) -> Start:
    """A circular arc between the ends, hanging where possible; no load across the chord is needed."""
    size = float(np.linalg.norm(chord))
    along = chord / size if size > 0.0 else np.eye(len(chord))[0]
    down = np.zeros(len(chord))
    down[-1] = -1.0 if weight >= 0.0 else 1.0
    across = down - (down @ along) * along
    if np.linalg.norm(across) < _ALONG:
        across = np.eye(len(chord))[0]
    across /= np.linalg.norm(across)
    # Half the angle of the arc: sin x/x = c/L.
    half = float(brentq(lambda x: np.sinc(x / np.pi) - size / length, 1e-12, np.pi)) if size > 0.0 else np.pi
    radius = length / (2.0 * half)

    def position(s: Array) -> Array:
        angle = half * (2.0 * s / length - 1.0)
        height = radius * (np.cos(angle) - np.cos(half))
        return first + np.outer(0.5 * size + radius * np.sin(angle), along) + np.outer(height, across)

    def curvature(s: Array) -> Array:
        angle = half * (2.0 * s / length - 1.0)
        return -(np.outer(np.sin(angle), along) + np.outer(np.cos(angle), across)) / radius

    return Start(position=position, force=np.zeros_like, curvature=curvature)


def _straight(thread: Thread, frame: Frame) -> Start:
    a, b = thread.ends
    held, sign = (a, 1.0) if a.is_fixed else (b, -1.0)
    if a.is_fixed and b.is_fixed:
        way = (b.position - a.position) / thread.length
    elif held.clamp is not None:
        way = held.clamp
    else:
        way = np.array([0.0, 0.0, -sign if thread.weight >= 0.0 else sign])
    first = held.position if sign > 0.0 else held.position - way * thread.length

    def position(s: Array) -> Array:
        return frame.to_frame(first + np.outer(s, way))

    return Start(position=position, force=np.zeros_like)
