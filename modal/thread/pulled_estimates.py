"""Shapes of a thread that is held at one end and pulled at the other, by asymptotic and exact solutions."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from functools import partial

import numpy as np
from scipy.interpolate import CubicSpline
from scipy.optimize import root_scalar

from hydroelastic.modal.thread.critical import critical_line
from hydroelastic.modal.thread.drag_dominated import drag_dominated
from hydroelastic.modal.thread.estimate import (
    Found,
    ShapeEstimate,
    estimate_or_reason,
    require,
    require_bare_thread,
)
from hydroelastic.modal.thread.shape import AsymptoticThread, ThreadShape
from hydroelastic.modal.thread.tension_dominated import tension_dominated
from hydroelastic.physics.arrays import FloatArray
from hydroelastic.physics.stream import UniformStream
from hydroelastic.physics.thread import Thread, ThreadEnd

_NAMES = {
    "tension": "tension-dominated, order {order}",
    "drag": "drag-dominated, order {order}",
    "line": "critical line of a free tail",
}
_TENSION, _WEIGHT = "ε = ∫|q| ds/T", "change of angle and of ln T by the weight"

LEVELS = 513
"""Number of heights at which shapes are evaluated: the error of a cubic between them is 1e-9 of the length."""

# Tolerance of iterations, of the length.
_FOUND = 1e-12


def pulled_estimates(thread: Thread, places: FloatArray) -> Iterator[Found]:
    """Yield estimates of the shape of a thread with one fixed and one free end, or why there are none.

    The drag of a body at the end is that of the stream at its own depth, which is found with the shape.

    Args:
        thread: in space, SI units.
        places: arc lengths at which shapes are wanted, m.
    """
    for order in (0, 1, 2):
        yield estimate_or_reason(
            _NAMES["tension"].format(order=order), partial(_tension_dominated, thread, places, order)
        )
    for order in (0, 1):
        yield estimate_or_reason(_NAMES["drag"].format(order=order), partial(_drag_dominated, thread, places, order))
    yield estimate_or_reason(_NAMES["line"], partial(_critical_line, thread, places))


def _estimate(name: str, pulled: PulledThread, found: AsymptoticThread, parameter: str) -> ShapeEstimate:
    return ShapeEstimate(
        name=name,
        order=found.order,
        parameter=parameter,
        small=found.small,
        shape=pulled.shape(found.shape),
        position_truncation=found.position_truncation,
        force_truncation=found.force_truncation,
    )


def _tension_dominated(thread: Thread, places: FloatArray, order: int) -> ShapeEstimate:
    pulled, load = pulled_thread(thread, places, stretch=True), thread.distributed_load

    def find(force: FloatArray) -> AsymptoticThread:
        return tension_dominated(
            load,
            thread.length,
            force,
            pulled.places,
            order=order,
            axial_rigidity=thread.axial_rigidity,
            start=pulled.start,
        )

    name = _NAMES["tension"].format(order=order)
    return _estimate(name, pulled, pulled.consistent_with_end_force(find), _TENSION)


def _drag_dominated(thread: Thread, places: FloatArray, order: int) -> ShapeEstimate:
    pulled, load = pulled_thread(thread, places), thread.distributed_load

    def find(force: FloatArray) -> AsymptoticThread:
        found = drag_dominated(load, force, length=thread.length, order=order, count=LEVELS, start=pulled.start)
        return replace(found, shape=shape_at(found.shape, pulled.places))

    return _estimate(_NAMES["drag"].format(order=order), pulled, pulled.consistent_with_end_force(find), _WEIGHT)


def _critical_line(thread: Thread, places: FloatArray) -> ShapeEstimate:
    pulled = pulled_thread(thread, places)
    require(not np.any(pulled.force(pulled.start)), "a force or a body pulls at the tail")
    shape = critical_line(thread.distributed_load, thread.length, pulled.places, pulled.start)
    return ShapeEstimate(name=_NAMES["line"], order=None, shape=pulled.shape(shape))


@dataclass(frozen=True)
class PulledThread:
    """A thread with arc lengths from its fixed end."""

    thread: Thread  # in space, SI units, with one fixed and one free end
    positions_from_a: FloatArray  # where the shape is wanted, m from end A

    @staticmethod
    def fits(thread: Thread) -> bool:
        """Whether one end is fixed and the other one free."""
        a, b = thread.ends
        return (a.is_fixed and b.is_free) or (a.is_free and b.is_fixed)

    @property
    def reverse(self) -> bool:
        """Whether end A is the free one."""
        return self.thread.ends[0].is_free

    @property
    def start(self) -> FloatArray:
        """Position of the fixed end, m."""
        return self.thread.ends[1 if self.reverse else 0].position

    @property
    def free(self) -> ThreadEnd:
        """The free end."""
        return self.thread.ends[0 if self.reverse else 1]

    def force(self, position: FloatArray) -> FloatArray:
        """Return the force on the free end if it is at a position, N, shape (3,)."""
        return self.free.load.force_at(position, self.thread.stream)

    @property
    def force_varies(self) -> bool:
        """Whether the force at the end depends on where that is."""
        still = self.thread.stream is None or isinstance(self.thread.stream, UniformStream)
        return not still and self.free.load.drag > 0.0

    @property
    def places(self) -> FloatArray:
        """Where the shape is wanted, m from the fixed end."""
        places = self.positions_from_a
        return np.asarray(self.thread.length - places[::-1]) if self.reverse else places

    def shape(self, found: ThreadShape) -> ThreadShape:
        """The shape with arc lengths from end A."""
        if not self.reverse:
            return found
        places = self.thread.length - found.s[::-1]
        return ThreadShape(s=places, positions=found.positions[::-1], forces=-found.forces[::-1])

    def consistent_with_end_force(self, find: Callable[[FloatArray], AsymptoticThread]) -> AsymptoticThread:
        """The shape that is consistent with the force at the position of its end.

        Args:
            find: the shape by the force at the end.
        """
        level, first = float(self.start[2]), self.force(self.start)
        if not self.force_varies:
            return find(first)
        size = float(np.linalg.norm(first))
        require(size > 0.0, "no force pulls at the end")

        def at_height(height: float) -> AsymptoticThread:
            return find(self.force(np.array([0.0, 0.0, height])))

        def miss(height: float) -> float:
            return float(at_height(height).shape.positions[-1, 2]) - height

        length = self.thread.length
        guess = level + length * first[2] / size
        solved = root_scalar(miss, x0=guess, x1=guess - 0.01 * length, xtol=_FOUND * length, method="secant")
        require(solved.converged, "no end lies where it is pulled that way")
        return at_height(solved.root)


def pulled_thread(thread: Thread, places: FloatArray, *, stretch: bool = False) -> PulledThread:
    """Return a thread as pulled at its free end.

    Args:
        thread: in space, SI units.
        places: arc lengths at which shapes are wanted, m from end A.
        stretch: whether it may stretch.
    """
    require(PulledThread.fits(thread), "not one end is fixed and the other one free")
    require_bare_thread(thread, stretch=stretch)
    return PulledThread(thread, places)


def shape_at(shape: ThreadShape, places: FloatArray) -> ThreadShape:
    """Return a shape at other places, by cubics."""
    require(bool(np.all(np.diff(shape.s) > 0.0)), "weight would turn the thread back")
    both = CubicSpline(shape.s, np.hstack([shape.positions, shape.forces]))(places)
    return ThreadShape(s=places, positions=both[:, :3], forces=both[:, 3:])
