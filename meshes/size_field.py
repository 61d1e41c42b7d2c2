"""Element size wanted at a point: those of the sources, growing with the distance from each."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from math import hypot

import numpy as np
from numpy.typing import NDArray

from hydroelastic.meshes.nearest import FEW, Source, Sources
from hydroelastic.meshes.outline import Curve, Point, as_points

# Number of discs evaluated at once: NumPy takes about as long for one.
_TOGETHER = 64


@dataclass(frozen=True, kw_only=True)
class Discs:
    """Round sources: within a disc elements have its size.

    Attributes:
        centres: centres (x, y) in the unit of the outline, shape (n, 2).
        radii: radii in the unit of the outline, shape (n,).
        sizes: sizes of elements in the unit of the outline, shape (n,).
    """

    centres: NDArray[np.float64]
    radii: NDArray[np.float64]
    sizes: NDArray[np.float64]

    @staticmethod
    def joined(parts: list[Discs]) -> Discs:
        """All discs of several sets."""
        return Discs(
            centres=np.vstack([np.zeros((0, 2)), *(part.centres for part in parts)]),
            radii=np.concatenate([np.zeros(0), *(part.radii for part in parts)]),
            sizes=np.concatenate([np.zeros(0), *(part.sizes for part in parts)]),
        )

    def parts(self, number: int) -> Iterator[Discs]:
        """Sets of a number of discs, one after the other."""
        for first in range(0, len(self.sizes), number):
            some = slice(first, first + number)
            yield Discs(centres=self.centres[some], radii=self.radii[some], sizes=self.sizes[some])


class SizeField:
    """h(x) = min(bulk size, h_i + growth · max(|x − source i| − r_i, 0)) over all sources i.

    Sources are straight curves with a size (r_i = 0), the corners with their rings (r_i = h_i is the outermost radius)
    and short pieces of curved ones.
    """

    def __init__(
        self, *, bulk_size: float, growth: float, straight: list[Curve], rings: list[tuple[Point, float]], bends: Discs
    ) -> None:
        """Collect the sources.

        Args:
            bulk_size: largest element anywhere.
            growth: increase of the size per unit of distance from a source.
            straight: straight curves with a size.
            rings: corners and the radius of their outermost ring.
            bends: pieces of curved curves.
        """
        self._bulk_size = bulk_size
        sources = [_straight_source(curve, growth) for curve in straight]
        sources += [_ring_source(centre, radius, growth) for centre, radius in rings]
        sources += [_bent_source(part, growth) for part in bends.parts(_TOGETHER)]
        self._sources = Sources(sources=sources, growth=growth)
        # A few are evaluated faster than searched.
        self._few = [source.value for source in sources] if len(sources) <= FEW else None

    def __call__(self, x: float, y: float) -> float:
        """Element size at a point."""
        if self._few is None:
            return self._sources.least(x, y, self._bulk_size)
        found = self._bulk_size
        for value in self._few:
            size = value(x, y)
            if size < found:
                found = size
        return found

    def along(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """Element size at points of shape (n, 2)."""
        return np.array([self(x, y) for x, y in as_points(points)])


def _straight_source(curve: Curve, growth: float) -> Source:
    """A straight curve with a size, in coordinates along it and across."""
    (x, y), (end_x, end_y), size_there = curve.start, curve.end, curve.size
    length = hypot(end_x - x, end_y - y)
    along_x, along_y = (end_x - x) / length, (end_y - y) / length
    first = x * along_x + y * along_y
    last = end_x * along_x + end_y * along_y
    offset = y * along_x - x * along_y

    def size_at(x: float, y: float) -> float:
        along = x * along_x + y * along_y
        across = y * along_x - x * along_y - offset
        return size_there + growth * hypot(max(first - along, 0.0, along - last), across)

    box = (min(x, end_x), max(x, end_x), min(y, end_y), max(y, end_y))
    return Source(box=box, floor=size_there, value=size_at)


def _ring_source(centre: Point, radius: float, growth: float) -> Source:
    x_centre, y_centre = centre

    def size_at(x: float, y: float) -> float:
        return radius + growth * max(hypot(x - x_centre, y - y_centre) - radius, 0.0)

    box = (x_centre - radius, x_centre + radius, y_centre - radius, y_centre + radius)
    return Source(box=box, floor=radius, value=size_at)


def _bent_source(discs: Discs, growth: float) -> Source:
    """A set of discs evaluated at once."""
    # gmsh evaluates thousands of points one by one: complex numbers are fastest.
    centres = discs.centres @ [1.0, 1.0j]
    sizes, offsets = discs.sizes, discs.sizes - growth * discs.radii

    def size_at(x: float, y: float) -> float:
        return float(np.maximum(sizes, offsets + growth * np.abs(centres - complex(x, y))).min())

    (left, low), (right, high) = discs.centres.min(axis=0), discs.centres.max(axis=0)
    return Source(box=(left, right, low, high), floor=float(offsets.min()), value=size_at)
