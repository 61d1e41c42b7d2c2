"""Initial meshes of a thread: fine where its direction changes within a short length."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from hydroelastic.fem.thread.equilibrium import Start, in_space
from hydroelastic.physics.thread import Thread

# Elements of a thread without layers.
_ELEMENTS = 16
# Largest turn of the direction on an element, rad.
_TURN = 0.3
# At a light end the direction changes within T/|q|: the first element is this part of it.
_END_PART = 0.05
# Of the length: no element is made shorter than this at once.
_SHORTEST = 1e-7
# Number of places on each element at which a start is evaluated.
_PLACES = 5


def initial_nodes(model: Thread, start: Start) -> NDArray[np.float64]:
    """Nodes of an initial mesh: point loads, graded layers at ends and loads, short elements where the start bends.

    A light end, of tension T under a load q per length, has a layer of thickness T/|q|; a thread that bends has one of
    thickness √(EI/T) where it is clamped, hinged or loaded. Elements grow with their distance from there.
    """
    length = model.length
    fixed = np.array([0.0, *sorted(model.loads), length])
    layers = [(float(s), max(_layer(model, start, float(s)), _SHORTEST * length)) for s in fixed]
    nodes = [0.0]
    for first, last in pairwise(fixed):
        count = max(int(np.ceil(_ELEMENTS * (last - first) / length - 1e-9)), 1)
        for part in pairwise(np.linspace(first, last, count + 1)):
            nodes += _halved(start, layers, float(part[0]), float(part[1]))
    return np.array(nodes)


def _halved(start: Start, layers: list[tuple[float, float]], first: float, last: float) -> list[float]:
    size = min(thickness + max(first - s, s - last, 0.0) for s, thickness in layers)
    if last - first <= size * (1.0 + 1e-9) and _turn(start, first, last) <= _TURN:
        return [last]
    if last - first < 2.0 * _SHORTEST * layers[-1][0]:
        return [last]
    middle = 0.5 * (first + last)
    return [*_halved(start, layers, first, middle), *_halved(start, layers, middle, last)]


def _turn(start: Start, first: float, last: float) -> float:
    chords = np.diff(start.position(_places(first, last)), axis=0)
    units = chords / np.maximum(np.linalg.norm(chords, axis=1, keepdims=True), 1e-300)
    # The middles of the first and of the last chord are not the ends of the element.
    return float(np.sum(np.linalg.norm(np.diff(units, axis=0), axis=1))) * (_PLACES - 1) / (_PLACES - 2)


def _layer(model: Thread, start: Start, s: float) -> float:
    tension = float(np.abs(start.force(np.array([s]))[0]))
    if model.bends:
        largest = max(tension, float(np.max(np.abs(start.force(_places(0.0, model.length))))) * 1e-3)
        return float(np.sqrt(model.flexural_rigidity / largest)) if largest > 0.0 else model.length
    load = abs(model.weight)
    if model.stream is not None:
        speed = float(np.linalg.norm(model.stream.velocity_at(in_space(start.position(np.array([s]))))))
        load += (model.normal_drag * speed + model.viscous_drag) * speed
    # A tail without any force is regular.
    if load == 0.0 or tension < 1e-9 * load * model.length:
        return model.length
    return _END_PART * tension / load


def _places(first: float, last: float) -> NDArray[np.float64]:
    return np.asarray(np.linspace(first, last, _PLACES), dtype=np.float64)
