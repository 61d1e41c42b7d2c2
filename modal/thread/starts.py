"""Shapes from which Newton's method may start: threads without bending stiffness, by integration or as a catenary."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import partial
from typing import Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.optimize import brentq

from hydroelastic.modal.thread.catenary import catenary_between, elastic_catenary
from hydroelastic.modal.thread.library_warnings import suppressed_library_warnings
from hydroelastic.modal.thread.march import Force, MarchedThread, march_back, march_tail
from hydroelastic.modal.thread.shape import NoTensionError, ThreadShape
from hydroelastic.modal.thread.taut import taut_thread
from hydroelastic.physics.arrays import FloatArray
from hydroelastic.physics.thread import Thread, ThreadEnd

# Local error of the integration: a start need not be more accurate than the mesh.
_TOLERANCE = 1e-7
# A thread of length up to this many chords is nearly straight.
_TAUT = 1.02
# A total load below this part of the weight has no certain direction: its parts cancel.
_CANCELLED = 1e-6


_ForceAt = Callable[[FloatArray], FloatArray]


class _ShapeAt(Protocol):
    def __call__(self, s: ArrayLike, /) -> ThreadShape: ...


@dataclass(frozen=True)
class ThreadStart:
    """A shape of a thread to start from."""

    name: str  # of the method that found it
    shape: _ShapeAt  # positions and forces at arc lengths from end A, m

    def position(self, s: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return positions at s, m, shape (n, 3)."""
        return np.asarray(self.shape(s).positions, dtype=np.float64)

    def tension(self, s: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the tension at s, N, shape (n,)."""
        return np.asarray(self.shape(s).tensions, dtype=np.float64)


def thread_starts(thread: Thread, refused: list[str]) -> Iterator[ThreadStart]:
    """Yield starts, the most promising one first.

    Args:
        thread: in space, SI units, with a fixed end; its bending stiffness is neglected.
        refused: takes the reasons why other starts do not exist.
    """
    fixed = [end.is_fixed for end in thread.ends]
    finders: list[tuple[str, Callable[[], _ShapeAt]]]
    finders = list(_between(thread)) if all(fixed) else [("march", lambda: _marched(thread, reverse=not fixed[0]))]
    for name, find in finders:
        try:
            with suppressed_library_warnings():
                start = ThreadStart(name, find())
                # A catenary is found when a point of it is evaluated.
                start.position(np.zeros(1))
        except NoTensionError as error:
            refused.append(f"{name}: {error}")
        except (ValueError, ArithmeticError):
            refused.append(f"{name}: its equations have no finite solution that could be found")
        else:
            yield start


def _between(thread: Thread) -> Iterator[tuple[str, Callable[[], _ShapeAt]]]:
    """Shapes of a thread between fixed ends: taut, or a catenary under its weight and the stream across the chord."""
    a, b = (end.position for end in thread.ends)
    length, chord, rigidity = thread.length, float(np.linalg.norm(b - a)), thread.axial_rigidity
    weight = np.array([0.0, 0.0, -thread.weight])
    weight = weight + sum((body.dead_force for body in thread.loads.values()), np.zeros(3)) / length
    # Drag per length of a straight thread between the ends, at their middle.
    drag = replace(thread.distributed_load, weight=0.0)
    direction = (b - a) / max(chord, 1e-300)
    whole = weight + drag.load((a + b)[None] / 2.0, direction[None])[0]
    if length <= _TAUT * chord:
        yield "taut", lambda: lambda s: taut_thread(a, b, length, whole, rigidity, np.asarray(s))
    if length > chord:
        if np.linalg.norm(whole) > _CANCELLED * np.linalg.norm(weight):
            yield "catenary", lambda: lambda s: catenary_between(a, b, length, whole, np.asarray(s))
        yield "hanging catenary", lambda: _hanging(a, b, length, weight)
    elif np.isfinite(rigidity):
        yield (
            "stretched catenary",
            lambda: lambda s: elastic_catenary(a, b, length, thread.weight, rigidity, np.asarray(s)),
        )


def _hanging(a: FloatArray, b: FloatArray, length: float, weight: FloatArray) -> _ShapeAt:
    if not np.any(weight):
        raise NoTensionError("a slack thread without weight does not hang")
    return lambda s: catenary_between(a, b, length, weight, np.asarray(s))


def _marched(thread: Thread, *, reverse: bool) -> _ShapeAt:
    """The thread integrated from its free end to the fixed one; `reverse` if end A is the free one."""
    held, free = thread.ends[::-1] if reverse else thread.ends
    length, load = thread.length, thread.distributed_load
    options = {"axial_rigidity": thread.axial_rigidity, "start": held.position, "tolerance": _TOLERANCE}
    points: list[tuple[float, Force]] = [
        (length - s if reverse else s, partial(body.force_at, stream=thread.stream)) for s, body in thread.loads.items()
    ]
    force: _ForceAt = partial(free.load.force_at, stream=thread.stream)
    if not free.is_free:
        shape = _under_the_surface(thread, free, force, points, options).at
    elif np.any(force(held.position)):
        shape = march_back(load, length, force, point_forces=points, **options).at  # type: ignore[arg-type]
    else:
        shape = march_tail(load, length, **options).at  # type: ignore[arg-type]
    if not reverse:
        return shape

    def turned(s: ArrayLike) -> ThreadShape:
        places = np.asarray(s, dtype=float)
        found = shape(length - places)
        return ThreadShape(s=places, positions=found.positions, forces=-found.forces)

    return turned


def _under_the_surface(
    thread: Thread, end: ThreadEnd, force: _ForceAt, points: list[tuple[float, Force]], options: dict[str, object]
) -> MarchedThread:
    """The vertical force that keeps the end at its height, by integrations from it."""

    def march(lift: float) -> MarchedThread:
        def lifted(position: FloatArray) -> FloatArray:
            return force(position) + np.array([0.0, 0.0, lift])

        return march_back(thread.distributed_load, thread.length, lifted, point_forces=points, **options)  # type: ignore[arg-type]

    def height(lift: float) -> float:
        return float(march(lift).positions[-1, 2]) - float(end.position[2])

    size = abs(thread.weight) * thread.length + float(np.linalg.norm(force(np.zeros(3))))
    low, high = _bracket(height, size)
    return march(brentq(height, low, high, rtol=_TOLERANCE))


def _bracket(height: Callable[[float], float], size: float) -> tuple[float, float]:
    """Bracket of the vertical force with which the end is at its height, from large upward to large downward forces."""
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
