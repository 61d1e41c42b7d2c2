"""Shapes of a thread between two fixed ends: catenaries, which are exact, and a nearly taut thread."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from math import inf

import numpy as np

from hydroelastic.modal.thread.catenary import catenary_between, elastic_catenary
from hydroelastic.modal.thread.estimate import Found, ShapeEstimate, estimate_or_reason, require, require_bare_thread
from hydroelastic.modal.thread.shape import ThreadShape
from hydroelastic.modal.thread.taut import taut_thread
from hydroelastic.physics.arrays import FloatArray
from hydroelastic.physics.stream import UniformStream
from hydroelastic.physics.thread import Thread

_CATENARY, _TAUT = "catenary", "nearly taut thread"
# Largest small parameter: δ = L/c − 1 is 0.01 there.
_LARGEST = 0.5


def fixed_end_estimates(thread: Thread, places: FloatArray) -> Iterator[Found]:
    """Yield estimates of the shape of a thread between fixed ends, or why there are none.

    Args:
        thread: in space, SI units.
        places: arc lengths at which shapes are wanted, m.
    """
    yield estimate_or_reason(_CATENARY, partial(_catenary, thread, places))
    yield estimate_or_reason(_TAUT, partial(_taut, thread, places))


def fixed_ends(thread: Thread) -> tuple[FloatArray, FloatArray]:
    """Positions of A and B, m, of a thread between fixed ends.

    Raises:
        NoAsymptoticError: if an end is not fixed.
    """
    a, b = thread.ends
    require(a.is_fixed and b.is_fixed, "not both ends are fixed")
    return a.position, b.position


def catenary_of(thread: Thread, places: FloatArray) -> ThreadShape:
    """The catenary of a thread between fixed ends in a liquid at rest.

    Raises:
        NoAsymptoticError: if an end is not fixed, or a stream drags at the thread.
        NoTensionError: if it is slack.
    """
    a, b = fixed_ends(thread)
    require(thread.stream is None or not thread.has_line_drag, "a stream drags at the thread")
    length, rigidity = thread.length, thread.axial_rigidity
    if rigidity == inf:
        return catenary_between(a, b, length, [0.0, 0.0, -thread.weight], places)
    return elastic_catenary(a, b, length, thread.weight, rigidity, places)


def _catenary(thread: Thread, places: FloatArray) -> ShapeEstimate:
    fixed_ends(thread)
    require_bare_thread(thread, stretch=True)
    return ShapeEstimate(name=_CATENARY, order=None, shape=catenary_of(thread, places))


def _taut(thread: Thread, places: FloatArray) -> ShapeEstimate:
    """Leading order; the next one changes T by ε², since the first order of the slope does not change the length."""
    a, b = fixed_ends(thread)
    require_bare_thread(thread, stretch=True)
    stream = thread.stream
    require(stream is None or isinstance(stream, UniformStream), "the stream is not the same along the thread")
    chord, length, rigidity = b - a, thread.length, thread.axial_rigidity
    distance = float(np.linalg.norm(chord))
    load = thread.distributed_load.load((a + b)[None] / 2.0, chord[None] / distance)[0]
    shape = taut_thread(a, b, length, load, rigidity, places)
    tension = float(np.linalg.norm(taut_thread(a, b, length, load, rigidity, [0.5 * length]).forces))
    slope = float(np.linalg.norm(load)) * length / tension
    require(slope < _LARGEST, f"the load is {slope:.3g} of the tension: it must be below {_LARGEST}")
    sag = float(np.linalg.norm(load - (load @ chord) * chord / distance**2)) * distance**2 / (8.0 * tension)
    return ShapeEstimate(
        name=_TAUT,
        order=0,
        parameter="|q|L/T",
        small=slope,
        shape=shape,
        position_truncation=slope * sag + tension / rigidity * sag,
        force_truncation=(slope**2 + tension / rigidity) * tension,
    )
