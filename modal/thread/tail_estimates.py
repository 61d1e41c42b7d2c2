"""A thread with a free tail without force: on the critical line in a uniform stream, near it in a sheared one."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import partial

import numpy as np

from hydroelastic.modal.thread.critical import (
    NearlyCriticalTail,
    critical_direction,
    critical_line,
    nearly_critical_tail,
)
from hydroelastic.modal.thread.estimate import Found, ShapeEstimate, estimate_or_reason, require
from hydroelastic.modal.thread.pulled import LEVELS, PulledThread, of_length, pulled_thread, shape_at
from hydroelastic.modal.thread.shape import ThreadShape
from hydroelastic.physics.arrays import FloatArray
from hydroelastic.physics.stream import ShearedStream
from hydroelastic.physics.thread import Thread

_LINE, _NEARLY = "critical line of a free tail", "nearly critical line of a free tail"


def tail_estimates(thread: Thread, places: FloatArray) -> Iterator[Found]:
    """Yield estimates of the shape of a thread with a free tail, or why there are none.

    Args:
        thread: in space, SI units.
        places: arc lengths at which shapes are wanted, m.
    """
    yield estimate_or_reason(_LINE, partial(_critical, thread, places))
    yield estimate_or_reason(_NEARLY, partial(_nearly_critical, thread, places))


def _tailed(thread: Thread, places: FloatArray) -> PulledThread:
    pulled = pulled_thread(thread, places)
    require(not np.any(pulled.force(pulled.start)), "a force or a body pulls at the tail")
    return pulled


def _critical(thread: Thread, places: FloatArray) -> ShapeEstimate:
    pulled = _tailed(thread, places)
    shape = critical_line(thread.distributed_load, thread.length, pulled.places, pulled.start)
    return ShapeEstimate(name=_LINE, order=None, shape=pulled.shape(shape))


@dataclass(frozen=True)
class _Tail:
    """A tail whose held end is at a height above it, or below it if the thread is buoyant.

    Attributes:
        heights: from the tail, m, shape (n,).
        solution: at these heights.
    """

    heights: FloatArray
    solution: NearlyCriticalTail

    @property
    def length(self) -> float:
        """Of the thread, m."""
        return float(self.solution.lengths[-1])


def _nearly_critical(thread: Thread, places: FloatArray) -> ShapeEstimate:
    pulled, load, stream = _tailed(thread, places), thread.distributed_load, thread.stream
    require(isinstance(stream, ShearedStream), "the stream is not sheared linearly")
    assert isinstance(stream, ShearedStream)
    require(load.viscous_drag == 0.0, "the drag is not quadratic")
    velocity, gradient = np.array(stream.velocity), np.array(stream.gradient)
    along = velocity / np.linalg.norm(velocity) if velocity.any() else gradient / np.linalg.norm(gradient)
    require(not np.cross(along, gradient).any(), "the stream turns with the height")
    down = 1.0 if thread.weight > 0.0 else -1.0

    def tail(height: float) -> _Tail:
        speed = float(stream.profile([pulled.start[2] - down * height])[0] @ along)
        require(speed > 0.0, "the stream changes its direction")
        heights = np.linspace(0.0, height, LEVELS)
        changes = [down * float(gradient @ along) / speed]
        normal, tangential = (drag * speed**2 for drag in (load.normal_drag, load.tangential_drag))
        return _Tail(heights, nearly_critical_tail(thread.weight, normal, tangential, changes, heights))

    direction, _ = critical_direction(load, pulled.start)
    found = of_length(tail, thread.length, thread.length * abs(float(direction[2])))
    solution = found.solution
    return ShapeEstimate(
        name=_NEARLY,
        order=1,
        parameter="change of the stream along the thread, of it",
        small=solution.small,
        shape=pulled.shape(shape_at(_shape(found, pulled.start, along, down), pulled.places)),
        position_truncation=solution.angle_truncation * thread.length,
        force_truncation=solution.small**2 * float(solution.tensions.max()),
    )


def _shape(tail: _Tail, start: FloatArray, along: FloatArray, down: float) -> ThreadShape:
    """The shape from the held end."""
    solution, under = tail.solution, np.array([0.0, 0.0, -down])
    ways = np.outer(np.cos(solution.angles), along) + np.outer(np.sin(solution.angles), under)
    across, depths = solution.across[-1] - solution.across, tail.heights[-1] - tail.heights
    return ThreadShape(
        s=(tail.length - solution.lengths)[::-1],
        positions=(start + np.outer(across, along) + np.outer(depths, under))[::-1],
        forces=(solution.tensions[:, None] * ways)[::-1],
    )
