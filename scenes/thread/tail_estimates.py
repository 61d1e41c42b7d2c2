"""A thread with a free tail, on which nothing pulls: near the critical line, in a uniform stream on it."""

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
from hydroelastic.modal.thread.shape import ThreadShape
from hydroelastic.physics.arrays import FloatArray
from hydroelastic.physics.stream import ShearedStream
from hydroelastic.scenes.models.thread import ThreadScene
from hydroelastic.scenes.thread.estimate import Found, ShapeEstimate, attempted, require
from hydroelastic.scenes.thread.model import load_of, stream_of
from hydroelastic.scenes.thread.pulled import LEVELS, PulledThread, of_length, pulled_thread, shape_at
from hydroelastic.scenes.thread.starts import force_on

_LINE, _NEARLY = "critical line of a free tail", "nearly critical line of a free tail"


def tail_estimates(scene: ThreadScene) -> Iterator[Found]:
    """Yield what is known of the shape of a thread with a free tail, or why it is not."""
    yield attempted(_LINE, partial(_critical, scene))
    yield attempted(_NEARLY, partial(_nearly_critical, scene))


def _tailed(scene: ThreadScene) -> PulledThread:
    pulled = pulled_thread(scene)
    require(not np.any(force_on(scene, pulled.free)(pulled.start)), "a force or a body pulls at the tail")
    return pulled


def _critical(scene: ThreadScene) -> ShapeEstimate:
    pulled = _tailed(scene)
    shape = critical_line(load_of(scene), scene.thread.length, pulled.places, pulled.start)
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


def _nearly_critical(scene: ThreadScene) -> ShapeEstimate:
    pulled, load, stream = _tailed(scene), load_of(scene), stream_of(scene)
    require(isinstance(stream, ShearedStream), "the stream is not sheared linearly")
    assert isinstance(stream, ShearedStream)
    require(load.viscous_drag == 0.0, "the drag is not quadratic")
    velocity, gradient = np.array(stream.velocity), np.array(stream.gradient)
    along = velocity / np.linalg.norm(velocity) if velocity.any() else gradient / np.linalg.norm(gradient)
    require(not np.cross(along, gradient).any(), "the stream turns with the height")
    down = 1.0 if scene.weight > 0.0 else -1.0

    def tail(height: float) -> _Tail:
        speed = float(stream.profile([pulled.start[2] - down * height])[0] @ along)
        require(speed > 0.0, "the stream changes its direction")
        heights = np.linspace(0.0, height, LEVELS)
        changes = [down * float(gradient @ along) / speed]
        normal, tangential = (drag * speed**2 for drag in (load.normal_drag, load.tangential_drag))
        return _Tail(heights, nearly_critical_tail(scene.weight, normal, tangential, changes, heights))

    direction, _ = critical_direction(load, pulled.start)
    found = of_length(tail, scene.thread.length, scene.thread.length * abs(float(direction[2])))
    solution = found.solution
    return ShapeEstimate(
        name=_NEARLY,
        order=1,
        parameter="change of the stream along the thread, of it",
        small=solution.small,
        shape=pulled.shape(shape_at(_shape(found, pulled.start, along, down), pulled.places)),
        position_left_out=solution.angle_left_out * scene.thread.length,
        force_left_out=solution.small**2 * float(solution.tensions.max()),
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
