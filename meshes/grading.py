"""How fine the mesh is and where: geometric rings of triangles around each tip, growing elements elsewhere.

ψ behaves like r ln r at the end of a body (r^{1/2} where ψ = 0 on the water). Rings whose radii shrink by a constant
ratio towards the tip, with a high polynomial degree, give exponential convergence in spite of it.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import ceil, hypot, log, pi

import numpy as np
from numpy.typing import NDArray

from hydroelastic.meshes.geometry import TankGeometry

# A half disc is cut into three sectors of 60 degrees: the innermost triangles are equilateral.
_SECTORS = 3


@dataclass(frozen=True, kw_only=True)
class Grading:
    """Element sizes of a tank mesh, in the unit of length of the geometry.

    Attributes:
        surface_sizes: largest element on each segment of the top, from left to right, set by the shortest wave that the
            modes asked for carry there.
        bulk_size: largest element anywhere.
        growth: increase of the element size per unit of distance from the surface, or from a tip.
        tip_size: radius of the innermost ring around a tip; ``None`` gives no rings (a uniform mesh).
        ring_ratio: ratio of the radii of successive rings.
    """

    surface_sizes: tuple[float, ...]
    bulk_size: float
    growth: float = 0.7
    tip_size: float | None = None
    ring_ratio: float = 0.3


@dataclass(frozen=True, kw_only=True)
class TipRings:
    """Rings of triangles around one tip.

    Attributes:
        centre: abscissa of the tip.
        radii: from the innermost to the outermost ring.
        angles: directions of the nodes of a ring, from the +x side (0) clockwise through the liquid to -x (π).
    """

    centre: float
    radii: NDArray[np.float64]
    angles: NDArray[np.float64]

    def nodes(self) -> NDArray[np.float64]:
        """Coordinates, shape (1 + rings·nodes per ring, 2): the tip, then ring after ring from the inside."""
        x = self.centre + np.outer(self.radii, np.cos(self.angles)).ravel()
        y = -np.outer(self.radii, np.sin(self.angles))
        y[:, np.isin(self.angles, (0.0, pi))] = 0.0
        return np.vstack([[self.centre, 0.0], np.column_stack([x, y.ravel()])])

    def triangles(self) -> NDArray[np.int64]:
        """Indices into `nodes`, shape (triangles, 3)."""
        count = len(self.angles)
        ring = np.arange(count - 1)
        fan = np.column_stack([np.zeros_like(ring), 1 + ring, 2 + ring])
        blocks = [fan]
        for inner in range(1, 1 + count * (len(self.radii) - 1), count):
            outer = inner + count
            blocks.append(np.column_stack([inner + ring, outer + ring, outer + ring + 1]))
            blocks.append(np.column_stack([inner + ring, outer + ring + 1, inner + ring + 1]))
        return np.vstack(blocks)


def tip_rings(geometry: TankGeometry, grading: Grading) -> tuple[TipRings, ...]:
    """Rings around every tip of the geometry; the outermost reaches at most 0.45 of the way to what is next to it."""
    if grading.tip_size is None:
        return ()
    rings = []
    for tip in geometry.tips:
        others = [abs(tip - x) for x in (*geometry.tips, 0.0, geometry.length) if x != tip]
        beside = [
            size
            for segment, size in zip(geometry.segments, grading.surface_sizes, strict=True)
            if tip in (segment.start, segment.end)
        ]
        outer = min(0.45 * min(*others, geometry.depth), *beside)
        count = max(1, 1 + ceil(log(max(outer / grading.tip_size, 1.0)) / -log(grading.ring_ratio)))
        radii = outer * grading.ring_ratio ** np.arange(count - 1, -1, -1.0)
        if tip == 0.0:
            first, last, sectors = 0.0, pi / 2, 2
        elif tip == geometry.length:
            first, last, sectors = pi / 2, pi, 2
        else:
            first, last, sectors = 0.0, pi, _SECTORS
        angles: NDArray[np.float64] = np.linspace(first, last, sectors + 1, dtype=np.float64)
        rings.append(TipRings(centre=tip, radii=radii, angles=angles))
    return tuple(rings)


class SizeField:
    """Element size wanted at a point of the liquid outside the rings."""

    def __init__(self, geometry: TankGeometry, rings: tuple[TipRings, ...], grading: Grading) -> None:
        """Collect the pieces of the top and the rings that want small elements."""
        self._bulk_size = grading.bulk_size
        self._growth = grading.growth
        # Sources of fineness: pieces of the top, a tip's rings being a piece of length zero that ends at their radius.
        self._sources = [
            (segment.start, segment.end, 0.0, size)
            for segment, size in zip(geometry.segments, grading.surface_sizes, strict=True)
        ]
        self._sources += [(ring.centre, ring.centre, float(ring.radii[-1]), float(ring.radii[-1])) for ring in rings]

    def __call__(self, x: float, y: float) -> float:
        """Smallest of the bulk size and the sizes that grow with the distance from each piece of the top."""
        size = self._bulk_size
        for start, end, radius, size_there in self._sources:
            distance = hypot(max(start - x, 0.0, x - end), y)
            size = min(size, size_there + self._growth * max(distance - radius, 0.0))
        return size
