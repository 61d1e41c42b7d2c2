"""Boundary layers of a thread: at clamps, and where it approaches the critical line away from a towed body."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial
from math import acos

import numpy as np

from hydroelastic.modal.thread.asymptotics import NoAsymptoticError
from hydroelastic.modal.thread.clamp_layer import ClampLayer
from hydroelastic.modal.thread.critical import critical_direction, towed_body_exponent
from hydroelastic.modal.thread.estimate import (
    Found,
    Inapplicable,
    ValueEstimate,
    estimate_or_reason,
    require,
    require_bare_thread,
)
from hydroelastic.physics.arrays import FloatArray
from hydroelastic.physics.stream import UniformStream
from hydroelastic.physics.thread import Thread

_CLAMP, _TOWED = "layer at the clamp {end}", "approach to the critical line"
NEAR_CRITICAL = 0.05
"""Largest angle to the critical line at which a thread is near it, rad."""


def clamp_estimates(thread: Thread, end_forces: Callable[[], FloatArray]) -> Iterator[Found]:
    """Yield the bending moment at each clamp, or why there is no estimate.

    Args:
        thread: in space, SI units.
        end_forces: contact forces at A and B of the thread without bending stiffness, N, shape (2, 3); raises
            `NoAsymptoticError` if there are none. Called if there is a clamp.
    """
    clamped = [number for number, end in enumerate(thread.ends) if end.clamp is not None]
    if not clamped:
        return
    try:
        forces = end_forces()
    except NoAsymptoticError as error:
        yield from (Inapplicable(_CLAMP.format(end="AB"[number]), str(error)) for number in clamped)
        return
    for number in clamped:
        yield estimate_or_reason(_CLAMP.format(end="AB"[number]), partial(_clamp, thread, number, forces[number]))


def _clamp(thread: Thread, number: int, force: FloatArray) -> ValueEstimate:
    clamp, tension = thread.ends[number].clamp, float(np.linalg.norm(force))
    assert clamp is not None
    require(tension > 0.0, "without bending there is no tension at the clamp")
    cosine = float(clamp @ force) / (float(np.linalg.norm(clamp)) * tension)
    layer = ClampLayer(
        flexural_rigidity=thread.flexural_rigidity,
        tension=tension,
        angle=acos(min(1.0, max(-1.0, cosine))),
        length=thread.length,
    )
    return ValueEstimate(
        name=_CLAMP.format(end="AB"[number]),
        order=0,
        parameter="√(EI/T)/L",
        small=layer.small,
        quantity="moment at B" if number else "moment at A",
        label=f"moment at {'AB'[number]}, N·m",
        values=np.array([layer.moment]),
        truncation=np.array([layer.small * layer.moment]),
    )


def towed_estimates(thread: Thread) -> Iterator[Found]:
    """Yield the exponent with which a thread in a uniform stream approaches its critical line, or why there is none."""
    yield estimate_or_reason(_TOWED, partial(_towed, thread))


def _towed(thread: Thread) -> ValueEstimate:
    a, b = thread.ends
    require(a.is_fixed and b.is_free, "A is not fixed, or B not free")
    require_bare_thread(thread, stretch=False)
    require(bool(np.any(b.load.force_at(np.zeros(3), thread.stream))), "no force and no body pulls at the end")
    stream, load = thread.stream, thread.distributed_load
    require(isinstance(stream, UniformStream), "there is no uniform stream")
    assert isinstance(stream, UniformStream)
    require(load.viscous_drag == 0.0, "the drag is not quadratic")
    require(thread.weight != 0.0, "without weight the critical line is level")
    speed = float(np.linalg.norm(stream.velocity))
    exponent = towed_body_exponent(thread.weight, load.normal_drag * speed**2, load.tangential_drag * speed**2)
    critical_direction(load, np.zeros(3))

    return ValueEstimate(
        name=_TOWED,
        order=0,
        parameter="angle to the critical line",
        small=NEAR_CRITICAL,
        quantity="exponent of the approach",
        label="exponent k of angle ∝ Tᵏ",
        values=np.array([exponent]),
        truncation=np.array([NEAR_CRITICAL * abs(exponent)]),
    )
