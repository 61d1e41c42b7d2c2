"""Where fronts are on the string, and how large a softened one is off.

A break of the motion sets out along the string at once and is reflected at both ends: it passes a place s away from the
lower end, in time, at S − s, S + s, 3S − s … with S the travel time along the whole string. Its height changes like
(T m)^{−1/4}, and decays with the resistance.
"""

from __future__ import annotations

from math import sqrt

import numpy as np
from numpy.typing import NDArray

from hydroelastic.fem.string.end_motion import EndMotion, after, jumps
from hydroelastic.fem.string.soft_motion import SoftMotion
from hydroelastic.physics.string import HangingString

# Largest error of a softened step, and of its first three integrals, in units of 1, 1/ω₀, 1/ω₀², 1/ω₀³: from 5 to 11
# digits 0.50, 0.33, 0.13 to 0.14 and 0.12 to 0.15 within 3/ω₀ of the middle, and farther away all below 0.3/(ω₀t).
_LARGEST = (0.51, 0.35, 0.15, 0.16)
_RINGING = 0.3
# Part of 1/ω₀ over which the third derivative is looked at.
_CLOSE = 1e-4


def front_errors(
    string: HangingString,
    motion: EndMotion,
    soft: SoftMotion,
    positions: NDArray[np.float64],
    times: NDArray[np.float64],
) -> NDArray[np.float64]:
    """How far values next to a front may be off.

    To compare two softenings does not tell it everywhere: in the middle of a step both have the mean of both sides, and
    the ripples beside it pass through zero.

    Args:
        string: the string.
        motion: of its upper end.
        soft: the motion that the values follow.
        positions: x, m, shape (positions,).
        times: s, shape (times,).

    Returns:
        In metres, shape (positions, times).
    """
    whole, travel = string.travel_time, string.travel_times(positions)
    bottom, slope = string.tension
    root = np.sqrt(bottom + slope * positions)
    # At the lower end the tension may vanish: the height is that at the width of the front.
    blunt = np.maximum(root, abs(slope) / sqrt(string.inertia) / soft.middle)
    height = np.sqrt(max(sqrt(bottom + slope * string.length), float(blunt.max())) / blunt)[:, None]
    errors = np.zeros((len(positions), len(times)))
    for start in motion.breaks:
        jumped = (*jumps(motion, start), *_bends(motion, start, _CLOSE / soft.middle))
        since = times - start
        away = _nearest_passage(whole, travel, since)
        decay = np.exp(-string.smallest_damping * np.maximum(since, 0.0) - 0.5 * (away / soft.width) ** 2)
        ringing = _RINGING / np.maximum(soft.middle * away, 1e-3)
        for order, (jump, largest) in enumerate(zip(jumped, _LARGEST, strict=True)):
            errors += abs(jump) / soft.middle**order * np.minimum(largest, ringing) * height * decay
    return errors


def _nearest_passage(whole: float, travel: NDArray[np.float64], since: NDArray[np.float64]) -> NDArray[np.float64]:
    """Time to the passage next to a time, of the front that set out at zero, shape (positions, times)."""
    period = 2.0 * whole
    nearest = np.full((len(travel), len(since)), np.inf)
    for first in (whole - travel, whole + travel):
        rounds = np.maximum(np.round((since - first[:, None]) / period), 0.0)
        nearest = np.minimum(nearest, np.abs(since - first[:, None] - rounds * period))
    return nearest


def _bends(motion: EndMotion, time: float, near: float) -> tuple[float, float]:
    """By how much the second derivative of f jumps, and about how much the third does."""
    first = after(motion.curvature, time)
    later = (float(np.asarray(motion.curvature(time + near))) - first) / near
    if time <= motion.breaks[0]:
        return first, later
    before = float(np.asarray(motion.curvature(np.nextafter(time, -np.inf))))
    earlier = (before - float(np.asarray(motion.curvature(time - near)))) / near
    return first - before, later - earlier
