"""Shapes on a page of pixels as triangles whose edges fade out over one pixel.

A pixel on an edge then gets the share of the colour that the shape covers of it. The renderer need not draw the page
several times as large to smooth the edges, and the widths of lines do not depend on its driver.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Indices = NDArray[np.int64]

# Half the width over which an edge fades, in pixels.
_FADE = 0.5


@dataclass(frozen=True, kw_only=True)
class Shape:
    """Triangles with an opacity at each point.

    Attributes:
        points: page coordinates in pixels, shape (points, 2).
        triangles: shape (triangles, 3).
        opacity: 0…1, shape (points,); linear on each triangle.
    """

    points: Array
    triangles: Indices
    opacity: Array


def strokes(ends: Array, width: float, *, joined: bool = False) -> Shape:
    """Straight strokes.

    Args:
        ends: shape (strokes, 2, 2).
        width: in pixels; what is thinner than a pixel is drawn as wide as one.
        joined: whether strokes go on where others end, so that their ends must not fade.
    """
    ends = ends.reshape(-1, 2, 2)
    if joined:
        overlap = 0.25 * _unit(ends[:, 1] - ends[:, 0])
        ends = ends + np.stack([-overlap, overlap], axis=1)
    normals = _normals(ends[:, 1] - ends[:, 0])[:, None].repeat(2, axis=1)
    return _ribbons(ends, normals, width, fading_ends=not joined)


def ribbon(curve: Array, width: float) -> Shape:
    """A continuous curve of shape (points, 2) with a width in pixels and mitred corners, four points across each."""
    curve = curve[moves_on(curve)]
    if len(curve) < 2:
        return polygons(np.empty((0, 3, 2)))
    sides = _normals(np.diff(curve, axis=0))
    normals = _mitres(np.vstack([sides[:1], sides]), np.vstack([sides, sides[-1:]]))
    return _ribbons(curve[None], normals[None], width, fading_ends=True)


def moves_on(curve: Array) -> NDArray[np.bool_]:
    """Which points of a curve are apart from those before them."""
    steps = np.hypot(*np.diff(curve, axis=0).T)
    return np.concatenate([[True], steps > 1e-6])


def polygons(corners: Array) -> Shape:
    """Convex polygons with hard edges; corners of shape (polygons, corners, 2)."""
    count, sides = corners.shape[:2]
    fan = np.array([[0, i, i + 1] for i in range(1, sides - 1)])
    triangles = (sides * np.arange(count))[:, None, None] + fan
    return _shape(corners, triangles, np.ones((count, sides)))


def band(lower: Array, upper: Array) -> Shape:
    """The area between two curves with the same number of points (points, 2), with hard edges."""
    return polygons(np.stack([lower[:-1], lower[1:], upper[1:], upper[:-1]], axis=1))


def area(corners: Array) -> Shape:
    """The inside of a closed polygon, convex or not, of shape (corners, 2), with hard edges.

    It is cut into trapezoids at the height of each corner: between two such heights the edges do not end, and inside
    and outside take turns from edge to edge.
    """
    ends = np.roll(corners, -1, axis=0)
    heights = np.unique(corners[:, 1])
    lowest, highest = np.minimum(corners[:, 1], ends[:, 1]), np.maximum(corners[:, 1], ends[:, 1])
    strip, edge = np.nonzero((lowest <= heights[:-1, None]) & (highest >= heights[1:, None]))
    start, step = corners[edge], (ends - corners)[edge]
    sides = np.stack([heights[strip], heights[strip + 1]], axis=1)
    x = start[:, :1] + step[:, :1] * (sides - start[:, 1:]) / step[:, 1:]
    order = np.lexsort((x.mean(axis=1), strip))
    points = np.stack([x, sides], axis=2)[order].reshape(-1, 2, 2, 2)
    return polygons(np.stack([points[:, 0, 0], points[:, 1, 0], points[:, 1, 1], points[:, 0, 1]], axis=1))


def closed(corners: Array) -> Array:
    """The curve around a closed polygon; it goes on to the second corner, so that the first is one like the others."""
    return np.concatenate([corners, corners[:2]])


def arrows(centres: Array, vectors: Array, *, width: float) -> tuple[Shape, Shape]:
    """Shafts and heads of flat arrows with vectors in pixels centred at points (arrows, 2)."""
    length = np.hypot(*vectors.T)
    direction = vectors / np.maximum(length, 1e-12)[:, None]
    normal = np.column_stack([-direction[:, 1], direction[:, 0]])
    # Short arrows get a smaller head, so that they still look like arrows.
    head = np.minimum(4.5 * width, 0.5 * length)[:, None]
    tip, tail = centres + 0.5 * vectors, centres - 0.5 * vectors
    neck = tip - head * direction
    shafts = strokes(np.stack([tail, neck], axis=1), width)
    return shafts, _faded_triangles(np.stack([tip, neck + 0.42 * head * normal, neck - 0.42 * head * normal], axis=1))


def dashes(start: tuple[float, float], end: tuple[float, float], *, dash: float, gap: float) -> Array:
    """Strokes of a dashed straight line, shape (dashes, 2, 2)."""
    a, b = np.array(start), np.array(end)
    length = float(np.hypot(*(b - a)))
    begin = np.arange(0.0, length, dash + gap)
    finish = np.minimum(begin + dash, length)
    along = np.stack([begin, finish], axis=1) / max(length, 1e-12)
    return a + along[:, :, None] * (b - a)


def dashed(curve: Array, *, dash: float, gap: float) -> list[Array]:
    """Pieces of a curve of shape (points, 2), each of shape (points, 2)."""
    along = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(curve, axis=0).T))])
    begin = np.arange(0.0, along[-1], dash + gap)
    pieces = []
    for start, end in zip(begin, np.minimum(begin + dash, along[-1]), strict=True):
        at = np.concatenate([[start], along[(along > start) & (along < end)], [end]])
        pieces.append(np.column_stack([np.interp(at, along, channel) for channel in curve.T]))
    return pieces


def _ribbons(curves: Array, normals: Array, width: float, *, fading_ends: bool) -> Shape:
    """Ribbons around curves of shape (ribbons, points, 2), four points across: outside, inside, inside, outside."""
    half = 0.5 * max(width, 2.0 * _FADE)
    if fading_ends:
        curves, normals = _lengthened(curves), _repeated_ends(normals)
    along = np.ones(curves.shape[1])
    if fading_ends:
        along[[0, -1]] = 0.0
    across = np.array([-half - _FADE, -half + _FADE, half - _FADE, half + _FADE])
    points = curves[:, :, None] + across[:, None] * normals[:, :, None]
    opacity = np.minimum(along[:, None], [0.0, 1.0, 1.0, 0.0])
    count, length = points.shape[:2]
    place = 4 * np.arange(length - 1)[:, None] + np.arange(3)
    square = np.array([[0, 1, 5], [0, 5, 4]])
    each = place[:, :, None, None] + square
    triangles = (4 * length * np.arange(count))[:, None, None, None, None] + each
    return _shape(points, triangles, np.broadcast_to(opacity, (count, length, 4)))


def _lengthened(curves: Array) -> Array:
    """Curves whose first and last point are moved inwards by the fade, with further points as far outside."""
    first = _unit(curves[:, 1] - curves[:, 0])
    last = _unit(curves[:, -1] - curves[:, -2])
    inner = curves.copy()
    inner[:, 0] += _FADE * first
    inner[:, -1] -= _FADE * last
    outer_first, outer_last = curves[:, :1] - _FADE * first[:, None], curves[:, -1:] + _FADE * last[:, None]
    return np.concatenate([outer_first, inner, outer_last], axis=1)


def _repeated_ends(values: Array) -> Array:
    return np.concatenate([values[:, :1], values, values[:, -1:]], axis=1)


def _faded_triangles(corners: Array) -> Shape:
    """Triangles of shape (triangles, 3, 2) with fading edges: one about the incentre is smaller, one larger."""
    sides = np.linalg.norm(np.roll(corners, -2, axis=1) - np.roll(corners, -1, axis=1), axis=2)
    perimeter = np.maximum(sides.sum(axis=1), 1e-12)
    centre = np.einsum("ts,tsd->td", sides, corners) / perimeter[:, None]
    a, b = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    radius = np.maximum(np.abs(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]) / perimeter, 1e-12)
    arms = corners - centre[:, None]
    inner, outer = np.maximum(1.0 - _FADE / radius, 0.0), 1.0 + _FADE / radius
    points = np.concatenate([centre[:, None] + scale[:, None, None] * arms for scale in (inner, outer)], axis=1)
    faces = np.array([[0, 1, 2], [0, 3, 4], [0, 4, 1], [1, 4, 5], [1, 5, 2], [2, 5, 3], [2, 3, 0]])
    triangles = 6 * np.arange(len(corners))[:, None, None] + faces
    return _shape(points, triangles, np.broadcast_to([1.0, 1.0, 1.0, 0.0, 0.0, 0.0], points.shape[:2]))


def _shape(points: Array, triangles: Indices, opacity: Array) -> Shape:
    return Shape(points=points.reshape(-1, 2), triangles=triangles.reshape(-1, 3), opacity=opacity.reshape(-1))


def _unit(steps: Array) -> Array:
    unit: Array = steps / np.maximum(np.linalg.norm(steps, axis=-1), 1e-12)[..., None]
    return unit


def _normals(steps: Array) -> Array:
    return _unit(np.column_stack([-steps[:, 1], steps[:, 0]]))


def _mitres(before: Array, after: Array) -> Array:
    """Mitre of two unit normals; its length is bounded where the curve turns back."""
    mean = before + after
    length = np.maximum(np.hypot(*mean.T), 1e-12)
    mitre = np.minimum(2.0 / length, 1.5)
    return mean / length[:, None] * mitre[:, None]
