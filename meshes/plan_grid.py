"""Plans whose walls and plates are rectangles: a grid through all their edges, graded towards them, of triangles.

Lines reach from wall to wall, so that plates may touch walls or span the tank, and lie as close to each other as they
like. The layers of both directions meet at the corners of plates.
"""

from __future__ import annotations

from itertools import pairwise
from math import ceil

import numpy as np

from hydroelastic.meshes.plan_loops import RATIO, Mirrors, PlanRegion, PolygonLoop
from hydroelastic.meshes.tagged_mesh import TaggedMesh
from hydroelastic.physics.arrays import FloatArray

# Edges this close to each other or to a wall, in units of the tank, are on one line.
_SAME = 1e-9


def are_rectangles(wall: PlanRegion, plates: tuple[PlanRegion, ...]) -> bool:
    """Whether all loops are rectangles with sides along x and y."""
    loops = [loop for region in (wall, *plates) for loop in region.loops]
    return all(
        isinstance(loop, PolygonLoop)
        and len(loop.corners) == 4
        and bool(np.all((np.roll(loop.corners, -1, axis=0) == loop.corners).sum(axis=1) == 1))
        for loop in loops
    )


def grid_mesh(
    wall: PlanRegion,
    plates: tuple[PlanRegion, ...],
    *,
    size: float,
    layers: int,
    thickness: float,
    mirrors: Mirrors = (None, None),
) -> TaggedMesh:
    """Triangulate a plan of rectangles, or the part of it between its mirror planes."""
    (least, largest), *bounds = (_bounds(region) for region in (wall, *plates))
    lines = []
    for axis, mirror in enumerate(mirrors):
        start, end = least[axis] if mirror is None else mirror, largest[axis]
        edges = np.array([bound[axis] for pair in bounds for bound in pair])
        edges = edges[edges > start - _SAME]
        stops = np.unique(np.concatenate([[start, end], edges]))
        stops = np.concatenate([stops[:1], stops[1:][np.diff(stops) > _SAME]])
        stops[0], stops[-1] = start, end
        graded = np.abs(stops[:, None] - edges).min(axis=1, initial=np.inf) < _SAME
        lines.append(_graded_line(stops, graded, size, thickness, layers))
    points = np.stack(np.meshgrid(*lines, indexing="ij"), axis=-1)
    middles = 0.25 * (points[:-1, :-1] + points[1:, :-1] + points[1:, 1:] + points[:-1, 1:])
    tags = np.zeros(middles.shape[:2], dtype=np.int32)
    for number, (low, high) in enumerate(bounds, 1):
        tags[((middles > low) & (middles < high)).all(axis=2)] = number
    numbers = np.arange(tags.size + sum(points.shape[:2]) - 1).reshape(points.shape[:2])
    a, b, c, d = (part.ravel() for part in (numbers[:-1, :-1], numbers[1:, :-1], numbers[1:, 1:], numbers[:-1, 1:]))
    names = [wall.name, *(plate.name for plate in plates)]
    return TaggedMesh(
        points=points.reshape(-1, 2),
        cells=np.concatenate([np.column_stack([a, b, c]), np.column_stack([a, c, d])]),
        cell_tags=np.tile(tags.ravel(), 2),
        facets=np.empty((0, 2), dtype=np.int64),
        facet_tags=np.empty(0, dtype=np.int32),
        cell_names={name: number for number, name in enumerate(names) if (tags == number).any()},
        facet_names={},
    )


def _bounds(region: PlanRegion) -> tuple[FloatArray, FloatArray]:
    assert isinstance(region.outside, PolygonLoop)
    return region.outside.corners.min(axis=0), region.outside.corners.max(axis=0)


def _graded_line(stops: FloatArray, graded: np.ndarray, size: float, thickness: float, layers: int) -> FloatArray:
    """Nodes between stops, in layers beside those that are graded."""
    nodes = [stops]
    for (left, right), (from_left, from_right) in zip(pairwise(stops), pairwise(graded), strict=True):
        outermost = min(thickness, (right - left) / (1.0 + from_left + from_right))
        steps = outermost * RATIO ** np.arange(layers)
        low, high = left + from_left * outermost, right - from_right * outermost
        nodes.append(np.linspace(low, high, ceil((high - low) / size - 1e-9) + 1))
        nodes += [left + steps[1:]] * bool(from_left) + [right - steps[1:]] * bool(from_right)
    return np.unique(np.concatenate(nodes))
