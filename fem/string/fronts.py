"""Errors of a smoothed motion of the string next to its wave fronts.

A break of the motion starts a front that both ends reflect: it passes a point at the travel time s from the lower end
at S − s, S + s, 3S − s … with S the travel time along the whole string. Its height changes like
(T m)^{−1/4}, and decays with the resistance.
"""

from __future__ import annotations

from math import sqrt

import numpy as np
from numpy.typing import NDArray

from hydroelastic.fem.string.end_motion import EndMotion, after, jumps
from hydroelastic.fem.string.smoothed_motion import SmoothedMotion
from hydroelastic.physics.string import HangingString

# Largest error of a smoothed step, and of its first three integrals, in units of 1, 1/ω₀, 1/ω₀², 1/ω₀³: from 5 to 11
# digits 0.50, 0.33, 0.13 to 0.14 and 0.12 to 0.15 within 3/ω₀ of the middle, and farther away all below 0.3/(ω₀t).
_LARGEST = (0.51, 0.35, 0.15, 0.16)
_RINGING = 0.3
# Part of 1/ω₀ over which the third derivative is looked at.
_CLOSE = 1e-4


def front_errors(
    string: HangingString,
    motion: EndMotion,
    smoothed: SmoothedMotion,
    positions: NDArray[np.float64],
    times: NDArray[np.float64],
) -> NDArray[np.float64]:
    """Return error bounds of the values next to fronts.

    The difference of two smoothings does not show the error everywhere: in the middle of a step both have the mean of
    its sides, and the ripples beside it pass through zero.
    """
    whole, travel = string.travel_time, string.travel_times(positions)
    bottom, slope = string.tension
    root = np.sqrt(bottom + slope * positions)
    # At the lower end the tension may vanish: the height is that at the width of the front.
    blunt = np.maximum(root, abs(slope) / sqrt(string.inertia) / smoothed.middle)
    height = np.sqrt(max(sqrt(bottom + slope * string.length), float(blunt.max())) / blunt)[:, None]
    errors = np.zeros((len(positions), len(times)))
    for start in motion.breaks:
        jumped = (*jumps(motion, start), *_bends(motion, start, _CLOSE / smoothed.middle))
        since = times - start
        away = _nearest_passage(whole, travel, since)
        decay = np.exp(-string.smallest_damping * np.maximum(since, 0.0) - 0.5 * (away / smoothed.width) ** 2)
        ringing = _RINGING / np.maximum(smoothed.middle * away, 1e-3)
        for order, (jump, largest) in enumerate(zip(jumped, _LARGEST, strict=True)):
            errors += abs(jump) / smoothed.middle**order * np.minimum(largest, ringing) * height * decay
    return errors


def _nearest_passage(whole: float, travel: NDArray[np.float64], since: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the time to the nearest passage of the front that started at zero, s, shape (positions, times)."""
    period = 2.0 * whole
    nearest = np.full((len(travel), len(since)), np.inf)
    for first in (whole - travel, whole + travel):
        rounds = np.maximum(np.round((since - first[:, None]) / period), 0.0)
        nearest = np.minimum(nearest, np.abs(since - first[:, None] - rounds * period))
    return nearest


def _bends(motion: EndMotion, time: float, near: float) -> tuple[float, float]:
    first = after(motion.curvature, time)
    later = (float(np.asarray(motion.curvature(time + near))) - first) / near
    if time <= motion.breaks[0]:
        return first, later
    before = float(np.asarray(motion.curvature(np.nextafter(time, -np.inf))))
    earlier = (before - float(np.asarray(motion.curvature(time - near)))) / near
    return first - before, later - earlier
