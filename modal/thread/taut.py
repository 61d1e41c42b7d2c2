"""A nearly straight thread between two fixed points."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike
from scipy.optimize import brentq

from hydroelastic.modal.thread.shape import NoTensionError, ThreadShape


def taut_tension(length: float, chord: float, normal_load: float, axial_rigidity: float = math.inf) -> float:
    """Return T of (T/EA + δ) T² = (|Pq| c)²/24, δ = L/c − 1: the leading order as the sag |Pq| c/(8T) tends to 0.

    Args:
        length: L, unstretched, m; shorter than the chord if the thread stretches.
        chord: c, m.
        normal_load: |Pq|, the load across the chord, N/m.
        axial_rigidity: EA, N; infinite if the thread does not stretch.
    """
    for name, value in (("length", length), ("chord", chord)):
        if not (math.isfinite(value) and value > 0):
            raise ValueError(f"{name} is {value}: it must be finite and positive")
    if not (math.isfinite(normal_load) and normal_load >= 0):
        raise ValueError(f"normal_load is {normal_load}: it must be finite and not negative")
    if not axial_rigidity > 0:
        raise ValueError(f"axial_rigidity is {axial_rigidity}: it must be positive, infinite without stretch")
    slack, sag = (length - chord) / chord, (normal_load * chord) ** 2 / 24
    if sag == 0 and slack >= 0:
        raise NoTensionError("a thread that is not stretched, without load across its chord, has no tension")
    if math.isinf(axial_rigidity):
        if slack <= 0:
            raise NoTensionError(
                "a thread that does not stretch and is not longer than its chord has no tension of its own"
            )
        return math.sqrt(sag / slack)
    stretched = max(-slack, 0.0) * axial_rigidity
    if sag == 0:
        return stretched
    high = stretched + math.cbrt(sag * axial_rigidity)
    return float(brentq(lambda t: (t / axial_rigidity + slack) * t * t - sag, stretched, 1.01 * high, xtol=1e-300))


def taut_thread(
    a: ArrayLike, b: ArrayLike, length: float, load_vector: ArrayLike, axial_rigidity: float, s: ArrayLike
) -> ThreadShape:
    """Return a nearly straight thread under a constant load: a parabola about the chord, T as `taut_tension`.

    Args:
        a: position of end A, m, shape (3,).
        b: position of end B, m.
        length: L, unstretched, m.
        load_vector: q, N/m, shape (3,).
        axial_rigidity: EA, N; infinite if the thread does not stretch.
        s: places along the thread, m, shape (n,).

    Returns:
        Positions and contact forces at s.
    """
    begin, places = np.asarray(a, dtype=float), np.asarray(s, dtype=float)
    chord, load = np.asarray(b, dtype=float) - begin, np.asarray(load_vector, dtype=float)
    distance = float(np.linalg.norm(chord))
    if distance == 0:
        raise ValueError("b is a: the ends must be apart")
    direction = chord / distance
    across = load - (load @ direction) * direction
    tension = taut_tension(length, distance, float(np.linalg.norm(across)), axial_rigidity)
    part = places / length
    bulge = np.outer(0.5 * distance**2 * part * (1 - part) / tension, across)
    return ThreadShape(
        s=places,
        positions=begin + np.outer(part, chord) + bulge,
        forces=tension * direction + np.outer(0.5 * length - places, load),
    )
