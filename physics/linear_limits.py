"""How far a float may move before its wetted surface is another than at rest, which linear theory takes it to be.

The still level through the middle of the waterplane, of half width b, meets the deck or the bottom of an upright
section at the angle φ and the heave h of

    tan φ = min(T, F) / b,    h = min(T, F),

with draught T and freeboard F; b is the outer radius of a ring. The freeboard is that of the shape: where only draught
and width are given, it is the mirror image of what is below the level. Angles are small up to π/6, where sin φ differs
from φ by 5 %. Source: Faltinsen 1990, chapter 3 (motions that are linear in the waves).
"""

from __future__ import annotations

from dataclasses import dataclass
from math import atan2, pi
from typing import Literal

from hydroelastic.physics.floats import RigidFloat

SMALL_ANGLE = pi / 6.0
"""Largest angle that is small, rad; also of bodies without draught."""


@dataclass(frozen=True, kw_only=True)
class LinearLimits:
    """Motions of a float up to which linear theory can hold."""

    heave: float  # the smaller of draught and freeboard, m
    reached: Literal["draught", "freeboard"]  # which of them that is
    # angle of roll or pitch at which its deck edge dips or its bottom emerges, rad; `SMALL_ANGLE` if that is smaller
    roll: float


def linear_limits(body: RigidFloat, *, is_revolved: bool) -> LinearLimits:
    """Return the limits of the motions of a float.

    Args:
        body: the float, in metres.
        is_revolved: whether it is a solid of revolution, or a ring, about x = 0.
    """
    level, (left, right) = body.hydrostatics.level, body.hydrostatics.waterplane
    _, _, low, high = body.hull.bounds
    depth = min(level - low, high - level)
    return LinearLimits(
        heave=depth,
        reached="draught" if level - low <= high - level else "freeboard",
        roll=min(atan2(depth, right if is_revolved else 0.5 * (right - left)), SMALL_ANGLE),
    )
