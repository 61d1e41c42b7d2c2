"""Grading of meshes: geometric rings of triangles around each tip, growing elements elsewhere.

ψ behaves like r ln r at the end of a body (r^{1/2} where ψ = 0 on the water). Rings whose radii shrink by a constant
ratio towards the tip, with a high polynomial degree, give exponential convergence in spite of it.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import pi

import numpy as np
from numpy.typing import NDArray

from hydroelastic.meshes.geometry import TankGeometry
from hydroelastic.meshes.rings import ring_radii, ring_triangles

# A half disc is cut into three sectors of 60 degrees: the innermost triangles are equilateral.
_SECTORS = 3


@dataclass(frozen=True, kw_only=True)
class Grading:
    """Element sizes of a tank mesh, in the unit of length of the geometry."""

    # largest element on each segment of the top, from left to right, set by the shortest wave of the requested modes
    # there
    surface_sizes: tuple[float, ...]
    bulk_size: float  # largest element anywhere
    growth: float = 0.7  # increase of the element size per unit of distance from the surface, or from a tip
    tip_size: float | None = None  # radius of the innermost ring around a tip; ``None`` gives no rings (a uniform mesh)
    ring_ratio: float = 0.3  # ratio of the radii of successive rings


@dataclass(frozen=True, kw_only=True)
class TipRings:
    """Rings of triangles around one tip."""

    centre: float  # abscissa of the tip, in the unit of the mesh
    # radii from the innermost to the outermost ring, in the unit of the mesh, shape (rings,)
    radii: NDArray[np.float64]
    # directions of the nodes of a ring, rad, shape (nodes,), from the +x side (0) clockwise through the liquid to -x
    # (π)
    angles: NDArray[np.float64]

    def nodes(self) -> NDArray[np.float64]:
        """Coordinates, shape (1 + rings·nodes per ring, 2): the tip, then ring after ring from the inside."""
        x = self.centre + np.outer(self.radii, np.cos(self.angles)).ravel()
        y = -np.outer(self.radii, np.sin(self.angles))
        y[:, np.isin(self.angles, (0.0, pi))] = 0.0
        return np.vstack([[self.centre, 0.0], np.column_stack([x, y.ravel()])])

    def triangles(self) -> NDArray[np.int64]:
        """Indices into `nodes`, shape (triangles, 3)."""
        return ring_triangles(len(self.radii), len(self.angles))


def tip_rings(geometry: TankGeometry, grading: Grading) -> tuple[TipRings, ...]:
    """Rings around every tip of the geometry; the outermost radius is at most 0.45 of the distance to the next tip or
    wall."""
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
        radii = ring_radii(grading.tip_size, outer, grading.ring_ratio)
        if tip == 0.0:
            first, last, sectors = 0.0, pi / 2, 2
        elif tip == geometry.length:
            first, last, sectors = pi / 2, pi, 2
        else:
            first, last, sectors = 0.0, pi, _SECTORS
        angles: NDArray[np.float64] = np.linspace(first, last, sectors + 1, dtype=np.float64)
        rings.append(TipRings(centre=tip, radii=radii, angles=angles))
    return tuple(rings)
