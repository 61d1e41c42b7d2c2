"""Shapes of a thread that is held at one end and pulled at the other, by asymptotic and exact solutions."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from functools import partial

import numpy as np

from hydroelastic.modal.thread.asymptotics import AsymptoticThread
from hydroelastic.modal.thread.critical import critical_line
from hydroelastic.modal.thread.drag_dominated import drag_dominated
from hydroelastic.modal.thread.estimate import (
    Found,
    ShapeEstimate,
    estimate_or_reason,
    require,
)
from hydroelastic.modal.thread.pulled import LEVELS, PulledThread, pulled_thread, shape_at
from hydroelastic.modal.thread.tension_dominated import tension_dominated
from hydroelastic.physics.arrays import FloatArray
from hydroelastic.physics.thread import Thread

_NAMES = {
    "tension": "tension-dominated, order {order}",
    "drag": "drag-dominated, order {order}",
    "line": "critical line of a free tail",
}
_TENSION, _WEIGHT = "ε = ∫|q| ds/T", "change of angle and of ln T by the weight"


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
