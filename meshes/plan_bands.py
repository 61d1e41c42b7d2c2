"""Bands of layers around the walls and the outlines of plates on a plan, whole or cut by mirror planes."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from hydroelastic.meshes.plan_loops import Grading, Loop, Mirrors, kept_by

# Nodes this close to a mirror plane lie on it.
_ON_MIRROR = 1e-9


@dataclass(frozen=True, kw_only=True)
class Band:
    """Nodes around a loop or a part of it: rows of parallels, from the inside out."""

    loop: Loop
    places: NDArray[np.float64]  # of the columns
    distances: NDArray[np.float64]  # of the rows; one row, 0, of a wall
    first: int  # number of its first node; they are numbered row by row
    closed: bool  # whether it goes all around; else it ends at mirror planes
    inside: str  # name of the region on its inner side, "" where there is none
    outside: str  # name of the region on its outer side
    mirrors: Mirrors  # the mirror planes

    @property
    def size(self) -> int:
        """Number of nodes."""
        return len(self.places) * len(self.distances)

    def row(self, number: int) -> NDArray[np.int64]:
        """Return the nodes of a row, number −1 being the outermost."""
        number %= len(self.distances)
        return np.asarray(self.first + number * len(self.places) + np.arange(len(self.places)))

    @property
    def points(self) -> NDArray[np.float64]:
        """Its nodes, shape (nodes, 2); those at its ends lie on mirror planes exactly."""
        rows = np.array([self.loop.parallel(distance, self.places) for distance in self.distances])
        for axis, mirror in enumerate(self.mirrors):
            if mirror is not None and not self.closed:
                for column in (0, -1):
                    if abs(self.loop.parallel(0.0, self.places[[column]])[0, axis] - mirror) < _ON_MIRROR:
                        rows[:, column, axis] = mirror
        return rows.reshape(-1, 2)

    def cells(self) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
        """Return the triangles of its inner and of its outer half."""
        halves = []
        middle = (len(self.distances) - 1) // 2
        columns = len(self.places) - int(not self.closed)
        for rows in (range(middle), range(middle, len(self.distances) - 1)):
            cells: list[NDArray[np.int64]] = [np.empty((0, 3), dtype=np.int64)]
            for number in rows:
                low, high = self.row(number), self.row(number + 1)
                low_next, high_next = np.roll(low, -1)[:columns], np.roll(high, -1)[:columns]
                low, high = low[:columns], high[:columns]
                cells += [np.column_stack([low, low_next, high_next]), np.column_stack([low, high_next, high])]
            halves.append(np.concatenate(cells))
        return halves[0], halves[1]


def bands_around(
    loop: Loop,
    first: int,
    *,
    mirrors: Mirrors,
    size: float,
    steps: NDArray[np.float64],
    towards: Grading,
    reentrant: Grading,
    inside: str,
    outside: str,
) -> list[Band]:
    """Return the bands around the parts of a loop on this side of all mirror planes."""
    loop = loop.cut(mirrors)
    places = loop.places(size, towards, reentrant)
    kept = kept_by(mirrors, loop.parallel(0.0, places), _ON_MIRROR)
    distances = np.concatenate([-steps, [0.0], steps[::-1]])
    bands: list[Band] = []
    for columns, closed in _runs(kept):
        bands.append(
            Band(
                loop=loop,
                places=places[columns],
                distances=distances,
                first=first + sum(band.size for band in bands),
                closed=closed,
                inside=inside,
                outside=outside,
                mirrors=mirrors,
            )
        )
    return bands


def _runs(kept: NDArray[np.bool_]) -> list[tuple[NDArray[np.int64], bool]]:
    """Runs of two or more neighbours that are kept, around a circle, and whether it is the whole circle."""
    if kept.all():
        return [(np.arange(len(kept)), True)]
    if not kept.any():
        return []
    start = int(np.flatnonzero(~kept)[0])
    turned = np.roll(np.arange(len(kept)), -start)
    ends = np.flatnonzero(np.diff(np.concatenate([[0], kept[turned].astype(int), [0]])))
    return [(turned[low:high], False) for low, high in pairwise(ends) if kept[turned[low]] and high - low > 1]
