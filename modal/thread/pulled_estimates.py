"""Shapes of a thread that is held at one end and pulled at the other, by asymptotic and exact solutions."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from functools import partial

import numpy as np

from hydroelastic.modal.thread.asymptotics import AsymptoticThread
from hydroelastic.modal.thread.drag_dominated import drag_dominated
from hydroelastic.modal.thread.estimate import (
    Found,
    ShapeEstimate,
    estimate_or_reason,
    require,
)
from hydroelastic.modal.thread.pulled import LEVELS, PulledThread, of_length, pulled_thread, shape_at
from hydroelastic.modal.thread.shape import ThreadShape
from hydroelastic.modal.thread.tension_at_height import ThreadAtHeight, tension_dominated_at_height
from hydroelastic.modal.thread.tension_dominated import tension_dominated
from hydroelastic.modal.thread.weightless import weightless_thread
from hydroelastic.physics.arrays import FloatArray
from hydroelastic.physics.stream import ShearedStream, Stream, TabulatedStream, VeeringStream
from hydroelastic.physics.thread import Thread

_NAMES = {
    "tension": "tension-dominated, order {order}",
    "height": "tension-dominated at the end's own depth, order 1",
    "drag": "drag-dominated, order {order}",
    "weightless": "weightless thread",
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
    if PulledThread.fits(thread) and PulledThread(thread, places).force_varies:
        yield estimate_or_reason(_NAMES["height"], partial(_at_height, thread, places))
    for order in (0, 1):
        yield estimate_or_reason(_NAMES["drag"].format(order=order), partial(_drag_dominated, thread, places, order))
    yield estimate_or_reason(_NAMES["weightless"], partial(_weightless, thread, places))


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


def _weightless(thread: Thread, places: FloatArray) -> ShapeEstimate:
    pulled = pulled_thread(thread, places)
    force = pulled.force(pulled.start)
    shape = weightless_thread(thread.distributed_load, thread.length, force, pulled.places, pulled.start)
    return ShapeEstimate(name=_NAMES["weightless"], order=None, shape=pulled.shape(shape))


def _at_height(thread: Thread, places: FloatArray) -> ShapeEstimate:
    """The thread from a given height of its end, with the height that gives its length."""
    pulled, length = pulled_thread(thread, places), thread.length
    force = pulled.force
    up = np.array([1.0, 1.0, np.sign(force(pulled.start)[2])])
    require(up[2] != 0.0, "no force pulls the end up or down")
    load = replace(
        thread.distributed_load, weight=up[2] * thread.weight, stream=_from(thread.stream, pulled.start[2], up[2])
    )

    def at(height: float) -> ThreadAtHeight:
        def end_force(place: FloatArray) -> FloatArray:
            return up * force(pulled.start + up * np.append(place, height))

        return tension_dominated_at_height(load, height, end_force, [0.0, height])

    found = of_length(at, length, length)
    return ShapeEstimate(
        name=_NAMES["height"],
        order=1,
        parameter=_TENSION,
        small=found.small,
        shape=pulled.shape(
            ThreadShape(
                s=np.array([0.0, length]), positions=pulled.start + up * found.positions, forces=up * found.forces
            )
        ),
        position_truncation=found.position_truncation,
        force_truncation=found.force_truncation,
    )


def _from(stream: Stream | None, level: float, up: float) -> Stream | None:
    """A stream by the height above a level, or by the depth below it."""
    if isinstance(stream, ShearedStream):
        x, y, z = (up * part for part in stream.gradient)
        return replace(stream, gradient=(x, y, z), level=up * (stream.level - level))
    if isinstance(stream, TabulatedStream):
        step = int(up)
        levels = tuple(up * (height - level) for height in stream.levels)[::step]
        return replace(stream, levels=levels, velocities=stream.velocities[::step])
    if isinstance(stream, VeeringStream):
        require(level == 0.0, "the stream turns, and the fixed end does not lie at z = 0")
        return replace(stream, rate=up * stream.rate)
    return stream
