"""The liquid's field on a page: triangles to fill, lines of equal ψ, and ∇ψ on a regular grid."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

_ROUNDING = 1e-9


@dataclass(frozen=True, kw_only=True)
class LiquidField:
    """ψ, or ρψ of two liquids, and ∇ψ, linear on triangles in page coordinates.

    Attributes:
        points: pixels, shape (points, 2).
        triangles: shape (triangles, 3).
        potential: ψ, or ρψ, shape (points,).
        displacement: ∇ψ, shape (points, 2).
    """

    points: Array
    triangles: NDArray[np.integer]
    potential: Array
    displacement: Array


def between(field: LiquidField, low: float, high: float) -> LiquidField:
    """The triangles that lie between two page coordinates at least in part."""
    ordinates = field.points[field.triangles, 1]
    return _chosen(field, (ordinates.max(axis=1) > low) & (ordinates.min(axis=1) < high))


def steep(field: LiquidField, steepness: Array, least: float) -> LiquidField:
    """The triangles on which the steepness, shape (points,), exceeds a value somewhere."""
    return _chosen(field, steepness[field.triangles].max(axis=1) > least)


def _chosen(field: LiquidField, chosen: NDArray[np.bool_]) -> LiquidField:
    return replace(field, triangles=field.triangles[chosen])


def iso_lines(field: LiquidField, levels: Array) -> Array:
    """Strokes along the lines of equal ψ, shape (strokes, 2, 2)."""
    values = field.potential[field.triangles]
    higher = values[:, None, :] > levels[:, None]
    count = higher.sum(axis=2)
    triangle, level = np.nonzero((count == 1) | (count == 2))
    corners = higher[triangle, level]
    # A line separates one corner from the other two.
    alone = np.argmax(corners == (count[triangle, level] == 1)[:, None], axis=1)
    own = values[triangle, alone]
    start = field.points[field.triangles[triangle, alone]]
    ends = []
    for step in (1, 2):
        other = (alone + step) % 3
        share = (levels[level] - own) / (values[triangle, other] - own)
        ends.append(start + share[:, None] * (field.points[field.triangles[triangle, other]] - start))
    return np.stack(ends, axis=1)


def displacement_on_grid(field: LiquidField, x: Array, y: Array) -> tuple[Array, Array]:
    """∇ψ at the points of a regular grid that lie in the liquid.

    Args:
        field: the field.
        x: abscissae at equal steps, two or more.
        y: ordinates at equal steps, two or more.

    Returns:
        Points and ∇ψ there, both of shape (points, 2).
    """
    triangle, column, row = _candidates(field.points[field.triangles], x, y)
    a, b, c = np.moveaxis(field.points[field.triangles[triangle]], 1, 0)
    points = np.column_stack([x[column], y[row]])
    area = _cross(b - a, c - a)
    weights = np.column_stack([_cross(b - points, c - points), _cross(c - points, a - points)]) / area[:, None]
    weights = np.column_stack([weights, 1.0 - weights.sum(axis=1)])
    inside = weights.min(axis=1) >= -_ROUNDING
    values = np.einsum("pc,pcd->pd", weights, field.displacement[field.triangles[triangle]])
    # A point on an edge lies in two triangles.
    _, first = np.unique(row[inside] * len(x) + column[inside], return_index=True)
    return points[inside][first], values[inside][first]


def _candidates(corners: Array, x: Array, y: Array) -> tuple[Array, Array, Array]:
    """Triangles with the grid points in the rectangle around them: number of the triangle, column and row."""
    first, count = [], []
    for axis, grid in enumerate((x, y)):
        place = (corners[:, :, axis] - grid[0]) / (grid[1] - grid[0])
        low = np.clip(np.ceil(place.min(axis=1) - _ROUNDING), 0, len(grid)).astype(np.int64)
        high = np.clip(np.floor(place.max(axis=1) + _ROUNDING), -1, len(grid) - 1).astype(np.int64)
        first.append(low)
        count.append(np.maximum(high - low + 1, 0))
    total = count[0] * count[1]
    triangle = np.repeat(np.arange(len(corners)), total)
    within = np.arange(len(triangle)) - np.repeat(np.cumsum(total) - total, total)
    columns = count[0][triangle]
    return triangle, first[0][triangle] + within % columns, first[1][triangle] + within // columns


def _cross(a: Array, b: Array) -> Array:
    cross: Array = a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]
    return cross
