"""Sizes of cells in narrow gaps beside round columns, where larger curved cells would be inverted."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations

import numpy as np

from hydroelastic.physics.arrays import FloatArray
from hydroelastic.physics.level_tank import Box, Cylinder
from hydroelastic.physics.plate import Disc
from hydroelastic.physics.volume_tank import VolumeTank

# Part of the size at which the chord of a wall would meet the other one; measured: of 0.5 some cells are inverted.
_SAFE = 0.2
GROWTH = 2.0 * _SAFE
"""Growth of that size per distance s from the place, as the gap grows like s²/2r."""


def narrow_gaps(tank: VolumeTank) -> Iterator[tuple[FloatArray, float]]:
    """Yield the place in the plan, and the size of cells there, of gaps beside round columns.

    A chord of the length h is h²/8r from its arc, so that h = √(8 r gap) would reach the other wall.
    """
    discs = [one for one in tank.columns if isinstance(one, Disc)]
    for disc in discs:
        centre = np.array(disc.position)
        for place, gap in _beside_walls(tank, centre, disc.radius):
            yield place, _size(disc.radius, gap)
    for one, other in combinations(discs, 2):
        between = np.subtract(other.position, one.position)
        distance = float(np.linalg.norm(between))
        place = one.position + between * one.radius / distance
        yield place, _size(min(one.radius, other.radius), distance - one.radius - other.radius)


def _size(radius: float, gap: float) -> float:
    return _SAFE * float(np.sqrt(8.0 * radius * max(gap, 0.0)))


def _beside_walls(tank: VolumeTank, centre: FloatArray, radius: float) -> Iterator[tuple[FloatArray, float]]:
    if isinstance(tank.plan, Box):
        for axis, length in enumerate((tank.plan.length, tank.plan.width)):
            for wall in (0.0, length):
                place = centre.copy()
                place[axis] = wall
                yield place, abs(centre[axis] - wall) - radius
    elif isinstance(tank.plan, Cylinder):
        distance = float(np.linalg.norm(centre))
        if distance > 0.0:
            yield centre * tank.plan.radius / distance, tank.plan.radius - distance - radius
