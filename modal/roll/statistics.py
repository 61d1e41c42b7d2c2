"""Extremes and statistics of a roll motion over all times, not those of the output alone."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from hydroelastic.modal.bracketed_roots import bracketed_roots, sign_change_roots
from hydroelastic.modal.roll.knots import RollPath, roll_knots
from hydroelastic.physics.arrays import FloatArray

_KNOTS_PER_PERIOD = 12
# Of φ² over a quarter of a period, h = π/2: (2h)^17 8!^4/(17 · 16!^3) of its mean, 5e-15.
_CELLS_PER_PERIOD, _GAUSS_POINTS = 4, 8


@dataclass(frozen=True, kw_only=True, eq=False)
class RollStatistics:
    """Statistics of a motion between two times."""

    largest_time: float  # when |φ| is largest, s, the first and last time included
    largest_angle: float  # φ there, rad, with its sign
    # times between the first and the last at which the rate changes its sign, s, shape (extremes,)
    extreme_times: FloatArray
    extreme_angles: FloatArray  # φ there, rad, shape (extremes,)
    # times of the swings, s, shape (swings,). The zeros of φ cut the time into pieces; the swing of a piece is its
    # largest |φ|. One at the last time is left out, for it may still grow, and one at the first time unless that is t =
    # 0, as in a release. Where φ touches 0 without a change of sign nothing is cut.
    swing_times: FloatArray
    swing_angles: FloatArray  # φ there, rad, shape (swings,)
    root_mean_square: float  # √(∫φ² dt/duration), rad

    def swings_above(self, level: float) -> int:
        """Return how many swings have |φ| > level, rad: each piece between zeros of φ counts once, however often it
        comes back to the level."""
        if not level >= 0:
            raise ValueError(f"level is {level}; it must be 0 or more")
        return int(np.count_nonzero(np.abs(self.swing_angles) > level))

    @property
    def significant_angle(self) -> float:
        """Mean |φ| of the largest third of the swings, ⌊N/3⌋ of them but at least one, rad; 0 without swings."""
        sizes = np.sort(np.abs(self.swing_angles))[::-1]
        return float(sizes[: max(1, len(sizes) // 3)].mean()) if sizes.size else 0.0


def roll_statistics(path: RollPath, end: float, start: float = 0.0) -> RollStatistics:
    """Return the statistics of a motion from start to end.

    Extremes are roots of the rate, zeros those of the angle, both to rounding. They are looked for in steps of 1/12 of
    the shorter period, `roll_knots`. Where the rate has one sign at both ends of a step but comes nearer to 0 between,
    its own extreme is found first, so that a pair of extremes within a step is not missed.

    Args:
        path: the motion, of `roll_path` or `quadratic_roll_path`.
        end: last time, s.
        start: first time, s, from 0: a later one leaves out the beginning of the motion.
    """
    if not 0 <= start < end < math.inf:
        raise ValueError(f"start is {start} and end {end}; they must be finite, 0 ≤ start < end")
    knots = roll_knots(path.ship, path.train, start, end, _KNOTS_PER_PERIOD)
    extreme_times = _extreme_times(path, knots)
    times = np.concatenate([[start], extreme_times, [end]])
    angles = path.motion(times).angle
    largest = int(np.abs(angles).argmax())
    swings = _swings(path, np.union1d(knots, extreme_times), times, angles)
    return RollStatistics(
        largest_time=float(times[largest]),
        largest_angle=float(angles[largest]),
        extreme_times=extreme_times,
        extreme_angles=angles[1:-1],
        swing_times=times[swings],
        swing_angles=angles[swings],
        root_mean_square=_root_mean_square(path, start, end, extreme_times),
    )


def _extreme_times(path: RollPath, knots: FloatArray) -> FloatArray:
    motion = path.motion(knots)
    rate, acceleration = motion.rate, motion.acceleration
    sign = np.sign(rate)
    dips = (sign[:-1] == sign[1:]) & (sign[:-1] * acceleration[:-1] < 0) & (sign[1:] * acceleration[1:] > 0)
    turns = bracketed_roots(
        lambda times: path.motion(times).acceleration,
        knots[:-1][dips],
        knots[1:][dips],
        acceleration[:-1][dips],
        acceleration[1:][dips],
    )
    knots, order = np.unique(np.concatenate([knots, turns]), return_index=True)
    rate = np.concatenate([rate, path.motion(turns).rate])[order]
    return sign_change_roots(lambda times: path.motion(times).rate, knots, rate)


def _swings(path: RollPath, knots: FloatArray, times: FloatArray, angles: FloatArray) -> FloatArray:
    """Return at which of the times (first, extremes, last) the swings are."""
    zeros = sign_change_roots(lambda places: path.motion(places).angle, knots, path.motion(knots).angle)
    piece = np.searchsorted(zeros, times)
    order = np.lexsort((np.abs(angles), piece))
    last_of_piece = np.append(np.diff(piece[order]) > 0, True)
    largest = np.sort(order[last_of_piece])
    cut = (times[largest] == times[-1]) | ((times[largest] == times[0]) & (times[0] > 0))
    return largest[~cut & (angles[largest] != 0)]


def _root_mean_square(path: RollPath, start: float, end: float, extreme_times: FloatArray) -> float:
    # Quadratic damping turns its sign at the extremes, so that the motion is smooth between them only.
    edges = np.union1d(roll_knots(path.ship, path.train, start, end, _CELLS_PER_PERIOD), extreme_times)
    nodes, weights = np.polynomial.legendre.leggauss(_GAUSS_POINTS)
    half = np.diff(edges) / 2
    angle = path.motion(edges[:-1, None] + half[:, None] * (nodes + 1)).angle
    return math.sqrt(float(half @ (angle**2 @ weights)) / (end - start))
