"""Shapes of a thread between two fixed ends: catenaries, which are exact, and a nearly taut thread."""

from __future__ import annotations

from collections.abc import Iterator
from functools import partial
from math import inf

import numpy as np

from hydroelastic.modal.thread.catenary import catenary_between, elastic_catenary
from hydroelastic.modal.thread.shape import ThreadShape
from hydroelastic.modal.thread.taut import taut_thread
from hydroelastic.physics.arrays import FloatArray
from hydroelastic.physics.stream import UniformStream
from hydroelastic.scenes.models.thread import ThreadScene
from hydroelastic.scenes.models.thread_parts import FixedEnd
from hydroelastic.scenes.thread.estimate import Found, ShapeEstimate, attempted, places_of, require, require_bare_thread
from hydroelastic.scenes.thread.model import load_of, stream_of

_CATENARY, _TAUT = "catenary", "nearly taut thread"
# Above it the sag is not small: δ = L/c − 1 is 0.01 there.
_LARGEST = 0.5


def held_estimates(scene: ThreadScene) -> Iterator[Found]:
    """Yield what is known of the shape of a thread between fixed ends, or why it is not."""
    yield attempted(_CATENARY, partial(_catenary, scene))
    yield attempted(_TAUT, partial(_taut, scene))


def fixed_ends(scene: ThreadScene) -> tuple[FloatArray, FloatArray]:
    """Positions of A and B, m, of a thread between fixed ends.

    Raises:
        NoAsymptoticError: if an end is not fixed.
    """
    a, b = scene.ends.a, scene.ends.b
    require(isinstance(a, FixedEnd) and isinstance(b, FixedEnd), "not both ends are fixed")
    assert isinstance(a, FixedEnd)
    assert isinstance(b, FixedEnd)
    return np.array(a.position), np.array(b.position)


def is_dragged(scene: ThreadScene) -> bool:
    """Whether a stream drags at the thread."""
    return scene.streams and (scene.normal_drag + scene.tangential_drag + scene.thread.viscous_drag) > 0.0


def catenary_of(scene: ThreadScene, places: FloatArray) -> ThreadShape:
    """The catenary of a thread between fixed ends in a liquid at rest.

    Raises:
        NoAsymptoticError: if an end is not fixed, or a stream drags at the thread.
        NoTensionError: if it is slack.
    """
    a, b = fixed_ends(scene)
    require(not is_dragged(scene), "a stream drags at the thread")
    length, rigidity = scene.thread.length, scene.thread.axial_rigidity
    if rigidity is None:
        return catenary_between(a, b, length, [0.0, 0.0, -scene.weight], places)
    return elastic_catenary(a, b, length, scene.weight, rigidity, places)


def _catenary(scene: ThreadScene) -> ShapeEstimate:
    fixed_ends(scene)
    require_bare_thread(scene, stretch=True)
    return ShapeEstimate(name=_CATENARY, order=None, shape=catenary_of(scene, places_of(scene)))


def _taut(scene: ThreadScene) -> ShapeEstimate:
    """To leading order: the next one changes T by ε², as the first order of the slope leaves the length as it is."""
    a, b = fixed_ends(scene)
    require_bare_thread(scene, stretch=True)
    stream = stream_of(scene)
    require(stream is None or isinstance(stream, UniformStream), "the stream is not the same along the thread")
    chord, length, rigidity = b - a, scene.thread.length, scene.thread.axial_rigidity or inf
    distance = float(np.linalg.norm(chord))
    load = load_of(scene).load((a + b)[None] / 2.0, chord[None] / distance)[0]
    places = places_of(scene)
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
        position_left_out=slope * sag + tension / rigidity * sag,
        force_left_out=(slope**2 + tension / rigidity) * tension,
    )
