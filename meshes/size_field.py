"""Element size wanted at a point: that of the sources of fineness, growing with the distance from each."""

from __future__ import annotations

from dataclasses import dataclass
from math import hypot

import numpy as np
from numpy.typing import NDArray

from hydroelastic.meshes.outline import Curve, Point, as_points


@dataclass(frozen=True, kw_only=True)
class Discs:
    """Round sources: within a disc elements have its size.

    Attributes:
        centres: shape (n, 2).
        radii: shape (n,).
        sizes: shape (n,).
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
        self._growth = growth
        self._rings = rings
        self._straight = [_frame(curve.start, curve.end, curve.size) for curve in straight]
        # gmsh asks for one point after the other, thousands of times: complex numbers take the fewest steps.
        self._centres = bends.centres @ [1.0, 1.0j]
        self._sizes = bends.sizes
        self._offsets = bends.sizes - growth * bends.radii

    def __call__(self, x: float, y: float) -> float:
        """Element size at a point."""
        size, growth = self._bulk_size, self._growth
        for along_x, along_y, first, last, offset, size_there in self._straight:
            along = x * along_x + y * along_y
            across = y * along_x - x * along_y - offset
            size = min(size, size_there + growth * hypot(max(first - along, 0.0, along - last), across))
        for (centre_x, centre_y), radius in self._rings:
            size = min(size, radius + growth * max(hypot(x - centre_x, y - centre_y) - radius, 0.0))
        if len(self._sizes):
            sizes = np.maximum(self._sizes, self._offsets + growth * np.abs(self._centres - complex(x, y)))
            size = min(size, float(sizes.min()))
        return size

    def along(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """Element size at points of shape (n, 2)."""
        return np.array([self(x, y) for x, y in as_points(points)])


def _frame(start: Point, end: Point, size: float) -> tuple[float, float, float, float, float, float]:
    """A segment in its own directions: unit vector along it, its ends along it, its offset across, its size."""
    length = hypot(end[0] - start[0], end[1] - start[1])
    along_x, along_y = (end[0] - start[0]) / length, (end[1] - start[1]) / length
    first = start[0] * along_x + start[1] * along_y
    last = end[0] * along_x + end[1] * along_y
    return along_x, along_y, first, last, start[1] * along_x - start[0] * along_y, size
