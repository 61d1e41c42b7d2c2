"""The shape of a thread between two fixed ends: catenaries, which are exact."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from math import inf

from hydroelastic.modal.thread.catenary import catenary_between, elastic_catenary
from hydroelastic.modal.thread.estimate import Found, ShapeEstimate, estimate_or_reason, require, require_bare_thread
from hydroelastic.modal.thread.shape import ThreadShape
from hydroelastic.physics.arrays import FloatArray
from hydroelastic.physics.thread import Thread

_CATENARY = "catenary"


def fixed_end_estimates(thread: Thread, places: FloatArray) -> Iterator[Found]:
    """Yield estimates of the shape of a thread between fixed ends, or why there are none.

    Args:
        thread: in space, SI units.
        places: arc lengths at which shapes are wanted, m.
    """
    yield estimate_or_reason(_CATENARY, partial(_catenary, thread, places))


def fixed_ends(thread: Thread) -> tuple[FloatArray, FloatArray]:
    """Positions of A and B, m, of a thread between fixed ends."""
    a, b = thread.ends
    require(a.is_fixed and b.is_fixed, "not both ends are fixed")
    return a.position, b.position


def catenary_of(thread: Thread, places: FloatArray) -> ThreadShape:
    """The catenary of a thread between fixed ends in a liquid at rest."""
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
