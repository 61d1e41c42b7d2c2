"""A roll motion in closed form or integrated, and times between which it has no unseen swings."""

from __future__ import annotations

import math
from typing import Protocol

import numpy as np
import numpy.typing as npt

from hydroelastic.modal.roll.motion import RollMotion
from hydroelastic.physics.arrays import FloatArray
from hydroelastic.physics.ship import Ship
from hydroelastic.physics.wave import WaveTrain

MOST_KNOTS = 20_000_000
"""Of `roll_knots`: beyond, arrays would no longer fit into memory."""


class RollPath(Protocol):
    """A whole motion: `LinearRollPath` or `QuadraticRollPath`."""

    @property
    def ship(self) -> Ship:
        """The ship, with its linear damping."""

    @property
    def train(self) -> WaveTrain:
        """The waves."""

    def motion(self, times: npt.ArrayLike) -> RollMotion:
        """Return angle, rate and acceleration at any times."""


def roll_knots(ship: Ship, train: WaveTrain, start: float, end: float, per_period: int) -> FloatArray:
    """Return times from start to end, among them those at which waves begin, at most a fraction of a period apart.

    The period is the shorter one of the wave and of the ship's free motion. Within half a period, a rate (or angle)
    that follows the closed form has three zeros at the most, for the operator (D² + ω²)(D² + 2nD + k²) is disconjugate
    there. Towards the beginning of a wave they halve their distance down to the time in which the faster free motion
    decays.

    Args:
        start: first time, s, from 0.
        end: last time, s.
        per_period: how many in each period, at least.
    """
    starts = train.starts
    edges = np.concatenate([[start], starts[(starts > start) & (starts < end)], [end]])
    lengths = np.diff(edges)
    number, _ = train.locate(edges[:-1])
    frequency = np.maximum(np.append(train.frequencies, 0.0)[number], ship.damped_frequency)
    counts = np.ceil(np.maximum(per_period * lengths * frequency / (2 * np.pi), per_period))
    if counts.sum() > MOST_KNOTS:
        raise ValueError(
            f"from {start} s to {end} s the ship and the waves oscillate too often: {counts.sum():.0f} times would be "
            f"looked at, {MOST_KNOTS} are allowed"
        )
    whole = counts.astype(int)
    index = np.arange(whole.sum()) - np.repeat(np.cumsum(whole) - whole, whole)
    inner = np.repeat(edges[:-1], whole) + index * np.repeat(lengths / counts, whole)
    cells = lengths / counts
    halvings = math.ceil(math.log2(max(float(cells.max()) * ship.fastest_decay, 1.0)))
    layers = edges[:-1, None] + cells[:, None] * 0.5 ** np.arange(1, halvings + 1)
    return np.unique(np.concatenate([inner, layers.ravel(), [end]]))
