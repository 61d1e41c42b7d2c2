"""The critical line of a thread, along which the load of a stream is tangential."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike
from scipy.optimize import brentq

from hydroelastic.modal.thread.shape import NoAsymptoticError, NoTensionError, ThreadShape
from hydroelastic.physics.arrays import FloatArray
from hydroelastic.physics.stream import UniformStream
from hydroelastic.physics.thread_load import UP, ThreadLoad

_DIRECTIONS = 361


def critical_direction(load: ThreadLoad, point: ArrayLike) -> tuple[FloatArray, float]:
    """Return the direction τ in which the load is tangential, P q = 0, and pulls away from the thread, q·τ > 0.

    It is the direction of a free tail. The load is that at ``point``; τ lies in the plane of stream and vertical.

    Args:
        load: q.
        point: position, m, shape (3,).

    Returns:
        τ, shape (3,), and q·τ, N/m.
    """
    place = np.asarray(point, dtype=float)[None, :]
    stream = np.zeros(3) if load.stream is None else load.stream.velocity_at(place)[0]
    level = np.hypot(stream[0], stream[1])
    along = np.array([stream[0], stream[1], 0.0]) / level if level > 0 else np.array([1.0, 0.0, 0.0])

    def tangents(angles: FloatArray) -> FloatArray:
        return np.outer(np.cos(angles), along) + np.outer(np.sin(angles), UP)

    def normal_load(angles: FloatArray) -> FloatArray:
        tau = tangents(angles)
        normals = np.outer(-np.sin(angles), along) + np.outer(np.cos(angles), UP)
        return np.asarray(np.sum(load.load(np.repeat(place, len(tau), axis=0), tau) * normals, axis=1))

    # A direction and its opposite have the same load: half a turn is enough.
    angles = np.linspace(-np.pi / 2, np.pi / 2, _DIRECTIONS)
    values = normal_load(angles)
    values[np.abs(values) < 1e-15 * np.abs(values).max()] = 0.0
    roots = list(angles[values == 0])
    for index in np.flatnonzero(values[1:] * values[:-1] < 0):
        roots.append(brentq(lambda f: normal_load(np.array([f]))[0], angles[index], angles[index + 1], xtol=1e-15))
    tau = tangents(np.array(roots))
    pulls = np.sum(load.load(np.repeat(place, len(tau), axis=0), tau) * tau, axis=1)
    if not np.abs(pulls).max(initial=0.0) > 0:
        raise NoTensionError("nothing pulls at the free tail: there is no weight, and no friction along the stream")
    strongest = int(np.argmax(np.abs(pulls)))
    return tau[strongest] * np.sign(pulls[strongest]), float(abs(pulls[strongest]))


def critical_line(load: ThreadLoad, length: float, s: ArrayLike, start: ArrayLike = (0.0, 0.0, 0.0)) -> ThreadShape:
    """Return the straight thread with a free tail in a uniform stream, T = (q·τ)(L − s): exact.

    Args:
        load: q, of a uniform stream or none.
        length: L, m.
        s: places, m, shape (n,).
        start: position of A, m.
    """
    if load.stream is not None and not isinstance(load.stream, UniformStream):
        raise NoAsymptoticError("the line of a free tail is straight in a uniform stream only")
    direction, pull = critical_direction(load, start)
    places = np.asarray(s, dtype=float)
    return ThreadShape(
        s=places,
        positions=np.asarray(start, dtype=float) + np.outer(places, direction),
        forces=np.outer(pull * (length - places), direction),
    )
