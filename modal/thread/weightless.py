"""A weightless thread without friction in a uniform stream: a catenary with its axis along the stream."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from hydroelastic.modal.thread.asymptotics import NoAsymptoticError
from hydroelastic.modal.thread.catenary import catenary_coordinates
from hydroelastic.modal.thread.shape import ThreadShape
from hydroelastic.physics.stream import UniformStream
from hydroelastic.physics.thread_load import ThreadLoad

# Components across the stream below this part of the end force are rounding.
_LEAST = 1e-14


def weightless_thread(
    load: ThreadLoad, length: float, end_force: ArrayLike, s: ArrayLike, start: ArrayLike = (0.0, 0.0, 0.0)
) -> ThreadShape:
    """Return the exact shape of a thread that is held at A and pulled at B.

    T = |F| everywhere, cot f = cot f_B + (Rₙ/T)(L − s) with f the angle to the stream; with c₀ = cot f_A:
    x = (T/Rₙ)(√(1 + c₀²) − √(1 + c²)) along the stream, (T/Rₙ)(asinh c₀ − asinh c) across it.

    Args:
        load: q, without weight, tangential or viscous drag, and of a uniform stream.
        length: L, m.
        end_force: F, N, shape (3,).
        s: places, m, shape (n,).
        start: position of A, m.

    Raises:
        NoAsymptoticError: if the load has other parts, or the force vanishes or points along the stream against it.
    """
    if load.weight or load.tangential_drag or load.viscous_drag or not isinstance(load.stream, UniformStream):
        raise NoAsymptoticError("the load must be normal quadratic drag of a uniform stream, and nothing else")
    force, places = np.asarray(end_force, dtype=float), np.asarray(s, dtype=float)
    stream, pull = np.asarray(load.stream.velocity), float(np.linalg.norm(force))
    if pull == 0:
        raise NoAsymptoticError("no force pulls at the end")
    speed = float(np.linalg.norm(stream))
    along = stream / speed if speed > 0 else force / pull
    aside = force - (force @ along) * along
    across = float(np.linalg.norm(aside))
    if across < _LEAST * pull:
        positions, tangents = np.outer(places, force / pull), np.tile(force / pull, (len(places), 1))
    else:
        # As a catenary whose load, Rₙ against the stream's axis, acts on the level force T.
        drag = load.normal_drag * speed**2
        beginning = -(pull * float(force @ along) / across + drag * length)
        sideways, upstream = catenary_coordinates(places, pull, beginning, drag, math.inf)
        positions = np.outer(-upstream, along) + np.outer(sideways, aside / across)
        cotangent = -(beginning + drag * places) / pull
        tangents = (np.outer(cotangent, along) + aside / across) / np.hypot(1, cotangent)[:, None]
    return ThreadShape(s=places, positions=np.asarray(start, dtype=float) + positions, forces=pull * tangents)
