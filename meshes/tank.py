"""Tank meshes: one liquid in a rectangle whose top is cut into pieces, as an outline."""

from __future__ import annotations

from math import inf

from hydroelastic.meshes.build import build_mesh
from hydroelastic.meshes.geometry import BOTTOM, LEFT_WALL, LIQUID, TankGeometry
from hydroelastic.meshes.grading import Grading, tip_rings
from hydroelastic.meshes.outline import Curve, GradedPoint, Outline, Region
from hydroelastic.meshes.tagged_mesh import TaggedMesh


def build_tank_mesh(geometry: TankGeometry, grading: Grading) -> TaggedMesh:
    """Triangulate a tank.

    The groups are `LIQUID` for the cells; `BOTTOM`, `LEFT_WALL`, `TankGeometry.right_end` and the names of the
    geometry's segments for the edges. Every joint of two segments is a node.
    """
    return build_mesh(
        tank_outline(geometry, grading),
        bulk_size=grading.bulk_size,
        growth=grading.growth,
        ring_ratio=grading.ring_ratio,
    )


def tank_outline(geometry: TankGeometry, grading: Grading) -> Outline:
    """The tank with its element sizes: the top from left to right, the walls and the bottom; rings at the tips."""
    length, depth = geometry.length, geometry.depth
    top = [
        Curve(name=segment.name, start=(segment.start, 0.0), end=(segment.end, 0.0), size=size)
        for segment, size in zip(geometry.segments, grading.surface_sizes, strict=True)
    ]
    walls = [
        Curve(name=LEFT_WALL, start=(0.0, -depth), end=(0.0, 0.0)),
        Curve(name=BOTTOM, start=(length, -depth), end=(0.0, -depth)),
        Curve(name=geometry.right_end, start=(length, 0.0), end=(length, -depth)),
    ]
    curves = (*top, *walls)
    left, bottom, right = range(len(top), len(curves))
    loop = tuple((number, False) for number in (left, bottom, right, *reversed(range(len(top)))))
    graded_points = (
        GradedPoint(point=(ring.centre, 0.0), inner=grading.tip_size or inf, outer=float(ring.radii[-1]))
        for ring in tip_rings(geometry, grading)
    )
    return Outline(curves=curves, regions=(Region(name=LIQUID, loop=loop),), graded_points=tuple(graded_points))
