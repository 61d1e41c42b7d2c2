"""Element size wanted at a point: that of the sources of fineness, growing with the distance from each."""

from __future__ import annotations

from dataclasses import dataclass
from math import hypot

import numpy as np
from numpy.typing import NDArray

from hydroelastic.meshes.outline import Point, as_points


@dataclass(frozen=True, kw_only=True)
class Segments:
    """Straight sources with a size each.

    Attributes:
        starts: shape (n, 2).
        ends: shape (n, 2).
        sizes: shape (n,).
    """

    starts: NDArray[np.float64]
    ends: NDArray[np.float64]
    sizes: NDArray[np.float64]

    @staticmethod
    def joined(parts: list[Segments]) -> Segments:
        """All segments of several sets."""
        return Segments(
            starts=np.vstack([np.zeros((0, 2)), *(part.starts for part in parts)]),
            ends=np.vstack([np.zeros((0, 2)), *(part.ends for part in parts)]),
            sizes=np.concatenate([np.zeros(0), *(part.sizes for part in parts)]),
        )


class SizeField:
    """h(x) = min(bulk size, h_i + growth · max(|x − source i| − r_i, 0)) over all sources i.

    Straight curves have r_i = 0, rings are a point with r_i = h_i their outermost radius.
    """

    def __init__(
        self,
        *,
        bulk_size: float,
        growth: float,
        straight: Segments,
        rings: list[tuple[float, float, float]],
        curved: Segments,
    ) -> None:
        """Collect the sources.

        Args:
            bulk_size: largest element anywhere.
            growth: increase of the size per unit of distance from a source.
            straight: few long segments.
            rings: centre x, centre y, radius.
            curved: many short segments.
        """
        self._bulk_size = bulk_size
        self._growth = growth
        self._rings = rings
        self._straight = [
            _frame(start, end, float(size))
            for start, end, size in zip(
                as_points(straight.starts), as_points(straight.ends), straight.sizes, strict=True
            )
        ]
        self._starts = curved.starts
        self._edges = curved.ends - curved.starts
        self._squares = (self._edges**2).sum(axis=1)
        self._sizes = curved.sizes

    def __call__(self, x: float, y: float) -> float:
        """Element size at a point."""
        size, growth = self._bulk_size, self._growth
        for along_x, along_y, first, last, offset, size_there in self._straight:
            along = x * along_x + y * along_y
            across = y * along_x - x * along_y - offset
            size = min(size, size_there + growth * hypot(max(first - along, 0.0, along - last), across))
        for centre_x, centre_y, radius in self._rings:
            size = min(size, radius + growth * max(hypot(x - centre_x, y - centre_y) - radius, 0.0))
        if len(self._sizes):
            size = min(size, float(np.min(self._sizes + growth * self._distances(x, y))))
        return size

    def along(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """Element size at points of shape (n, 2)."""
        return np.array([self(x, y) for x, y in as_points(points)])

    def _distances(self, x: float, y: float) -> NDArray[np.float64]:
        away = np.array([x, y]) - self._starts
        part = np.clip((away * self._edges).sum(axis=1) / self._squares, 0.0, 1.0)
        away -= part[:, None] * self._edges
        distances: NDArray[np.float64] = np.hypot(away[:, 0], away[:, 1])
        return distances


def _frame(start: Point, end: Point, size: float) -> tuple[float, float, float, float, float, float]:
    """A segment in its own directions: unit vector along it, its ends along it, its offset across, its size."""
    length = hypot(end[0] - start[0], end[1] - start[1])
    along_x, along_y = (end[0] - start[0]) / length, (end[1] - start[1]) / length
    first = start[0] * along_x + start[1] * along_y
    last = end[0] * along_x + end[1] * along_y
    return along_x, along_y, first, last, start[1] * along_x - start[0] * along_y, size
