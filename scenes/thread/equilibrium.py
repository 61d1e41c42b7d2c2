"""The equilibrium of a thread to a tolerance: one start after the other, until one leads to a thread under tension."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from math import dist

import numpy as np
from mpi4py import MPI
from numpy.typing import NDArray
from scipy.optimize import brentq

from hydroelastic.fem.thread.continuation import start_with_fading_rigidity
from hydroelastic.fem.thread.equilibrium import Start
from hydroelastic.fem.thread.newton import ThreadSolverError
from hydroelastic.fem.thread.refinement import ThreadSolution, solve_thread
from hydroelastic.scenes.errors import UnsolvedError
from hydroelastic.scenes.models.thread import ThreadScene
from hydroelastic.scenes.models.thread_parts import FixedEnd
from hydroelastic.scenes.thread.frame import Frame
from hydroelastic.scenes.thread.model import model_of
from hydroelastic.scenes.thread.on_mesh import solve_with_given_tension
from hydroelastic.scenes.thread.starts import ThreadStart, thread_starts

Array = NDArray[np.float64]

# A chord whose sine with the vertical is below this leaves no direction across it in which the thread would hang.
_ALONG = 1e-6
# Of positions, on the way to a start.
_DEGREE = 4


@dataclass(frozen=True, kw_only=True)
class FoundEquilibrium:
    """An equilibrium, and how it was come to.

    Attributes:
        solution: the field solution.
        start: the name of the start that led to it.
        failed: why those before it did not.
    """

    solution: ThreadSolution
    start: str
    failed: tuple[str, ...]


def find_equilibrium(comm: MPI.Comm, scene: ThreadScene, frame: Frame) -> FoundEquilibrium:
    """Solve a scene for its equilibrium.

    Args:
        comm: the processes.
        scene: the scene.
        frame: coordinates of the model.

    Returns:
        The equilibrium (collective).

    Raises:
        UnsolvedError: if no start leads to a thread under tension, with what was tried.
    """
    if scene.thread.tension is not None:
        return FoundEquilibrium(solution=solve_with_given_tension(comm, scene, frame), start="its tension", failed=())
    model = model_of(scene, frame)
    failed: list[str] = []
    for name, start in _starts(comm, scene, frame, failed):
        try:
            solution = solve_thread(comm, model, start, tolerance=scene.accuracy.tolerance)
        except ThreadSolverError as error:
            failed.append(f"from {name}: {error}")
            continue
        return FoundEquilibrium(solution=solution, start=name, failed=tuple(failed))
    raise UnsolvedError(f"no equilibrium under tension was found: {'; '.join(failed)}")


def _starts(comm: MPI.Comm, scene: ThreadScene, frame: Frame, failed: list[str]) -> Iterator[tuple[str, Start]]:
    """Shapes without bending, by which a slack thread may also be found as one that bends less and less; for a thread
    that bends a bow, and straight along a clamp or along the chord.
    """
    shapes = []
    for found in thread_starts(scene, failed):

        def position(s: Array, found: ThreadStart = found) -> Array:
            return frame.inside(found.position(s))

        shapes.append(Start(position=position, force=found.tension))
        yield found.name, shapes[-1]
    a, b, length = scene.ends.a, scene.ends.b, scene.thread.length
    bends = scene.thread.flexural_rigidity > 0.0
    if isinstance(a, FixedEnd) and isinstance(b, FixedEnd) and dist(a.position, b.position) < length:
        first, last = (frame.inside(np.array(end.position)) for end in (a, b))
        if bends:
            yield "a bow", _bow(first, last - first, length, scene.weight)
        elif shapes:
            name = "a thread that bends less and less"
            try:
                faded = start_with_fading_rigidity(comm, model_of(scene, frame), shapes[0], degree=_DEGREE)
            except ThreadSolverError as error:
                failed.append(f"{name}: {error}")
            else:
                yield name, faded
    if bends:
        yield "a straight thread", _straight(scene, frame)


def _bow(first: Array, chord: Array, length: float, weight: float) -> Start:
    """An arc of a circle between the ends, which hangs where that is possible; it needs no load across the chord."""
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


def _straight(scene: ThreadScene, frame: Frame) -> Start:
    a, b = scene.ends.a, scene.ends.b
    held, sign = (a, 1.0) if isinstance(a, FixedEnd) else (b, -1.0)
    assert isinstance(held, FixedEnd)
    begin = np.array(held.position)
    if isinstance(a, FixedEnd) and isinstance(b, FixedEnd):
        way = (np.array(b.position) - begin) / scene.thread.length
    elif held.clamp is not None:
        way = np.array(held.clamp) / np.linalg.norm(held.clamp)
    else:
        way = np.array([0.0, 0.0, -sign if scene.weight >= 0.0 else sign])
    first = begin if sign > 0.0 else begin - way * scene.thread.length

    def position(s: Array) -> Array:
        return frame.inside(first + np.outer(s, way))

    return Start(position=position, force=np.zeros_like)
