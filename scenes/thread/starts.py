"""Where Newton's method may begin: shapes of a thread that bends freely, by marching along it or by a catenary."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from math import inf
from typing import Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.optimize import brentq

from hydroelastic.modal.thread.catenary import catenary_between, elastic_catenary
from hydroelastic.modal.thread.march import Force, MarchedThread, march_back, march_tail
from hydroelastic.modal.thread.shape import NoTensionError, ThreadShape
from hydroelastic.modal.thread.taut import taut_thread
from hydroelastic.physics.arrays import FloatArray
from hydroelastic.scenes.models.thread import ThreadScene
from hydroelastic.scenes.models.thread_parts import CarriedBody, FixedEnd, SurfaceEnd
from hydroelastic.scenes.thread.model import body_drag, dead_force, load_of, stream_of
from hydroelastic.scenes.thread.quiet import libraries_silent

# Of each step of a march: a start need not be better than the mesh.
_TOLERANCE = 1e-7
# A thread of length up to this many chords is nearly straight.
_TAUT = 1.02
# Of a load beside its parts: below, they cancel and no direction is left.
_CANCELLED = 1e-6


class _ShapeAt(Protocol):
    def __call__(self, s: ArrayLike, /) -> ThreadShape: ...


@dataclass(frozen=True)
class ThreadStart:
    """A shape of a thread to begin with.

    Attributes:
        name: how it was found.
        shape: positions and forces at places from end A, m.
    """

    name: str
    shape: _ShapeAt

    def position(self, s: NDArray[np.float64]) -> NDArray[np.float64]:
        """Positions at s, m, shape (n, 3)."""
        return np.asarray(self.shape(s).positions, dtype=np.float64)

    def tension(self, s: NDArray[np.float64]) -> NDArray[np.float64]:
        """Tension at s, N, shape (n,)."""
        return np.asarray(self.shape(s).tensions, dtype=np.float64)


def thread_starts(scene: ThreadScene, refused: list[str]) -> Iterator[ThreadStart]:
    """Yield starts, the best one first.

    Args:
        scene: the scene.
        refused: takes the reasons why some are not there.
    """
    fixed = [isinstance(end, FixedEnd) for end in (scene.ends.a, scene.ends.b)]
    finders: list[tuple[str, Callable[[], _ShapeAt]]]
    if all(fixed):
        finders = [(name, find) for name, find in _between(scene)]
    else:
        finders = [("march", lambda: _marched(scene, reverse=not fixed[0]))]
    for name, find in finders:
        try:
            with libraries_silent():
                start = ThreadStart(name, find())
                # A catenary is found when it is asked for a point.
                start.position(np.zeros(1))
        except NoTensionError as error:
            refused.append(f"{name}: {error}")
        except (ValueError, ArithmeticError):
            refused.append(f"{name}: its equations have no finite solution that could be found")
        else:
            yield start


def _between(scene: ThreadScene) -> Iterator[tuple[str, Callable[[], _ShapeAt]]]:
    """Shapes of a thread between fixed ends: taut, or a catenary under its weight and the stream across the chord."""
    a, b = (np.array(end.position) for end in (scene.ends.a, scene.ends.b) if isinstance(end, FixedEnd))
    length, chord = scene.thread.length, float(np.linalg.norm(b - a))
    rigidity = scene.thread.axial_rigidity or inf
    weight = np.array([0.0, 0.0, -scene.weight - sum(load.weight for load in scene.load) / length])
    whole = weight + _drag_on_chord(scene, a, b)
    if length <= _TAUT * chord:
        yield "taut", lambda: lambda s: taut_thread(a, b, length, whole, rigidity, np.asarray(s))
    if length > chord:
        if np.linalg.norm(whole) > _CANCELLED * np.linalg.norm(weight):
            yield "catenary", lambda: lambda s: catenary_between(a, b, length, whole, np.asarray(s))
        yield "hanging catenary", lambda: _hanging(a, b, length, weight)
    elif rigidity < inf:
        yield (
            "stretched catenary",
            lambda: lambda s: elastic_catenary(a, b, length, scene.weight, rigidity, np.asarray(s)),
        )


def _hanging(a: FloatArray, b: FloatArray, length: float, weight: FloatArray) -> _ShapeAt:
    if not np.any(weight):
        raise NoTensionError("a slack thread without weight does not hang")
    return lambda s: catenary_between(a, b, length, weight, np.asarray(s))


def _drag_on_chord(scene: ThreadScene, a: FloatArray, b: FloatArray) -> FloatArray:
    """Drag by length of a straight thread between the ends, at their middle."""
    chord = b - a
    drag = replace(load_of(scene), weight=0.0)
    return drag.load((a + b)[None] / 2.0, (chord / max(float(np.linalg.norm(chord)), 1e-300))[None])[0]


def _marched(scene: ThreadScene, *, reverse: bool) -> _ShapeAt:
    """The thread integrated from its free end to the fixed one; `reverse` if end A is the free one."""
    held, free = (scene.ends.b, scene.ends.a) if reverse else (scene.ends.a, scene.ends.b)
    assert isinstance(held, FixedEnd)
    assert not isinstance(free, FixedEnd)
    length = scene.thread.length
    options = {
        "axial_rigidity": scene.thread.axial_rigidity or inf,
        "start": held.position,
        "tolerance": _TOLERANCE,
    }
    points = [(length - load.at if reverse else load.at, force_on(scene, load)) for load in scene.load]
    force: Callable[[FloatArray], FloatArray] = force_on(scene, free)
    if isinstance(free, SurfaceEnd):
        shape = _under_the_surface(scene, free, force, points, options).at
    elif np.any(force(np.array(held.position))):
        shape = march_back(load_of(scene), length, force, point_forces=points, **options).at  # type: ignore[arg-type]
    else:
        shape = march_tail(load_of(scene), length, **options).at  # type: ignore[arg-type]
    if not reverse:
        return shape

    def turned(s: ArrayLike) -> ThreadShape:
        places = np.asarray(s, dtype=float)
        found = shape(length - places)
        return ThreadShape(s=places, positions=found.positions, forces=-found.forces)

    return turned


def force_on(scene: ThreadScene, body: CarriedBody) -> Callable[[FloatArray], FloatArray]:
    """The force on a body by its place."""
    dead, drag, stream = dead_force(body), body_drag(scene, body), stream_of(scene)

    def force(position: FloatArray) -> FloatArray:
        if stream is None or drag == 0.0:
            return dead
        velocity = stream.velocity_at(np.asarray(position, dtype=float)[None])[0]
        return np.asarray(dead + drag * np.linalg.norm(velocity) * velocity)

    return force


def _under_the_surface(
    scene: ThreadScene,
    end: SurfaceEnd,
    force: Callable[[FloatArray], FloatArray],
    points: list[tuple[float, Callable[[FloatArray], FloatArray]]],
    options: dict[str, object],
) -> MarchedThread:
    """The vertical force that keeps the end at its height, by marches from it."""

    def march(lift: float) -> MarchedThread:
        def lifted(position: FloatArray) -> FloatArray:
            return force(position) + np.array([0.0, 0.0, lift])

        pull: Force = lifted
        return march_back(load_of(scene), scene.thread.length, pull, point_forces=points, **options)  # type: ignore[arg-type]

    def height(lift: float) -> float:
        return float(march(lift).positions[-1, 2]) - end.level

    low, high = _bracket(height, abs(scene.weight) * scene.thread.length + float(np.linalg.norm(force(np.zeros(3)))))
    return march(brentq(height, low, high, rtol=_TOLERANCE))


def _bracket(height: Callable[[float], float], size: float) -> tuple[float, float]:
    """Lifts between which the end passes its height, from upwards of the unit to downwards of it."""
    lifts = [
        sign * size * 4.0**power for sign, powers in ((1.0, range(6, -7, -1)), (-1.0, range(-6, 7))) for power in powers
    ]
    above: float | None = None
    for lift in lifts:
        try:
            passed = height(lift) > 0.0
        except NoTensionError:
            continue
        if passed:
            above = lift
        elif above is None:
            break
        else:
            return lift, above
    raise NoTensionError("no vertical force keeps the end at its height: the thread is too short to reach it, or slack")
