"""Contours through points: straight sides, corners, and smooth splines between them."""

from __future__ import annotations

from itertools import pairwise
from math import inf, radians
from typing import Any

import numpy as np
from scipy.interpolate import CubicSpline

from hydroelastic.physics.contours import Arc, Array, Contour, Point, straight_arc

STRAIGHT = 1e-4
"""Where the line from point to point turns by a smaller angle, in radians, it goes straight on."""

MOST_BULGE = 0.12
"""How far a spline may leave the straight line between two points, as a part of their distance. A circle does so
with a turn of 54 degrees from point to point."""

MOST_UNEVEN = 4.0
"""Ratio of neighbouring steps from point to point that a spline may join: a much longer one is rather a straight side,
which the spline would bend."""

# Straight parts into which a smooth piece between two points is divided to test whether a contour crosses itself.
_PARTS = 4
# Points times sides whose distances are held at once.
_MOST_PAIRS = 1_000_000
# Areas below this part of the square of the contour's size are rounding.
_ROUND_OFF = 1e-12


def polygon_contour(vertices: tuple[Point, ...]) -> Contour:
    """Return the contour of a polygon, its vertices given in either sense."""
    corners = vertices if _doubled_area(np.array(vertices)) > 0.0 else vertices[::-1]
    return Contour(tuple(map(straight_arc, corners, (*corners[1:], corners[0]))))


def shortest_side(vertices: tuple[Point, ...]) -> tuple[float, float, int]:
    """Return the length of the shortest side of a polygon, the polygon's size, and the vertex where that side begins.

    The size is the larger of width and height.
    """
    points = np.array(vertices)
    lengths = np.hypot(*(np.roll(points, -1, axis=0) - points).T)
    number = int(np.argmin(lengths))
    return float(lengths[number]), float(np.ptp(points, axis=0).max()), number


def outline_contour(points: Array, corner_angle: float) -> Contour:
    """Return the closed contour through points.

    Where the line from point to point turns by more than the corner angle there is a corner. Three or more points in
    a line are a straight side, and so is what lies between two neighbouring corners. All else are cubic splines over
    the distance from point to point, which run into straight sides without a corner.

    Args:
        points: points (x, y), m, in either sense, shape (n, 2), no point twice.
        corner_angle: least change of direction at a corner, degrees.
    """
    points = points if _doubled_area(points) > 0.0 else points[::-1]
    # Edge n runs from point n to the next one; the turn at point n is that from the edge before to edge n.
    turns = np.abs(_turns(points))
    straight, corner = turns < STRAIGHT, turns > radians(corner_angle)
    flat = straight | np.roll(straight, -1) | (corner & np.roll(corner, -1))
    flat_before = np.roll(flat, 1)
    joints = np.flatnonzero(corner | (flat != flat_before) | (flat & ~straight))
    if not len(joints):
        return Contour((_spline(np.vstack([points, points[:1]]), "periodic"),))
    arcs = []
    for first, last in pairwise([*joints, joints[0] + len(points)]):
        piece = points.take(range(first, last + 1), axis=0, mode="wrap")
        if flat[first]:
            arcs.append(straight_arc(_point(piece[0]), _point(piece[-1])))
            continue
        end = last % len(points)
        before, after = points[first] - points[first - 1], points.take(last + 1, axis=0, mode="wrap") - points[end]
        arcs.append(
            _spline(
                piece,
                (
                    "not-a-knot" if corner[first] else (1, before / np.hypot(*before)),
                    "not-a-knot" if corner[end] else (1, after / np.hypot(*after)),
                ),
            )
        )
    return Contour(tuple(arcs))


def _doubled_area(points: Array) -> float:
    x, y = points.T
    return float(np.sum(x * np.roll(y, -1) - np.roll(x, -1) * y))


def _turns(points: Array) -> Array:
    """The angle at each point by which the closed line through the points turns anticlockwise."""
    edges = np.roll(points, -1, axis=0) - points
    return _angles(np.roll(edges, 1, axis=0), edges)


def _angles(before: Array, after: Array) -> Array:
    (x, y), (z, w) = before.T, after.T
    return np.arctan2(x * w - y * z, x * z + y * w)


def _point(values: Array) -> Point:
    return float(values[0]), float(values[1])


def _spline(points: Array, ends: Any) -> Arc:
    lengths = np.hypot(*np.diff(points, axis=0).T)
    reached = np.concatenate([[0.0], np.cumsum(lengths)])
    spline = CubicSpline(reached, points, bc_type=ends)
    slope = spline.derivative()
    _refuse_bad_points(points, lengths, spline)
    return Arc(
        curve=lambda t: spline(reached[-1] * t),
        velocity=lambda t: reached[-1] * slope(reached[-1] * t),
        start=_point(points[0]),
        end=_point(points[-1]),
        knots=tuple(float(s) for s in reached[1:-1] / reached[-1]),
    )


def _refuse_bad_points(points: Array, lengths: Array, spline: CubicSpline) -> None:
    between = "between the points ({:g}, {:g}) and ({:g}, {:g})"
    longer = lengths / np.minimum(np.append(lengths[1:], np.inf), np.insert(lengths[:-1], 0, np.inf))
    worst = int(np.argmax(longer))
    if longer[worst] > MOST_UNEVEN:
        where = between.format(*points[worst], *points[worst + 1])
        raise ValueError(f"the smooth curve has a step {longer[worst]:.3g} times as long as the next, {where}")
    along = np.diff(points, axis=0)
    for part in (0.25, 0.5, 0.75):
        x, y = (spline(spline.x[:-1] + part * lengths) - points[:-1]).T
        bulges = np.abs(along[:, 0] * y - along[:, 1] * x) / lengths**2
        worst = int(np.argmax(bulges))
        if bulges[worst] > MOST_BULGE:
            where = between.format(*points[worst], *points[worst + 1])
            raise ValueError(f"the smooth curve bulges by {bulges[worst] * lengths[worst]:.3g} m {where}")


def self_crossing(contour: Contour) -> Point | None:
    """Return a point where a contour crosses, touches or folds back on itself, or None; to the width of small parts."""
    starts = np.concatenate([_sampled(arc) for arc in contour.arcs])
    steps = np.roll(starts, -1, axis=0) - starts
    ends = starts + steps
    low, high = np.minimum(starts, ends), np.maximum(starts, ends)
    size = np.ptp(starts, axis=0).max()
    negligible, near = _ROUND_OFF * size * size, _ROUND_OFF * size
    folds = np.flatnonzero(np.abs(_turns(starts)) > np.pi - 1e-6)
    if len(folds):
        return _point(starts[folds[0]])
    for n in range(len(starts) - 2):
        # The last part is the neighbour of the first.
        others = slice(n + 2, len(starts) - 1 if n == 0 else len(starts))
        meet = (low[others] <= high[n] + near).all(axis=1) & (high[others] >= low[n] - near).all(axis=1)
        meet &= _on_both_sides(starts[n], steps[n], starts[others], ends[others], negligible)
        for other in n + 2 + np.flatnonzero(meet):
            if _on_both_sides(starts[other], steps[other], starts[n], ends[n], negligible):
                return _point(starts[other])
    return None


def closed_polyline(contour: Contour) -> Array:
    """Return points all around a contour, shape (n, 2); chords leave a half circle by 2e-5 of its radius."""
    return np.concatenate([_sampled(arc, 256) for arc in contour.arcs])


def gap_between(one: Array, other: Array) -> float:
    """Return the least distance, m, of two bodies inside closed polylines, shape (n, 2); 0 where they meet."""
    if _is_inside(one[0], other) or _is_inside(other[0], one):
        return 0.0
    steps = np.roll(other, -1, axis=0) - other
    for start, step in zip(one, np.roll(one, -1, axis=0) - one, strict=True):
        crossed = _cross(step, steps)
        places = np.flatnonzero(crossed)
        from_start = (other - start)[places]
        parts = np.array([_cross(from_start, steps[places]), _cross(from_start, step)]) / crossed[places]
        if ((parts >= 0.0) & (parts <= 1.0)).all(axis=0).any():
            return 0.0
    return min(distance_from(one, other), distance_from(other, one))


def distance_from(points: Array, corners: Array) -> float:
    """Return the least distance of points from the sides of a closed polyline."""
    sides = np.roll(corners, -1, axis=0) - corners
    squares = np.maximum((sides**2).sum(axis=1), np.finfo(float).tiny)
    nearest = inf
    for some in np.array_split(points, 1 + points.size * len(corners) // _MOST_PAIRS):
        away = some[:, None] - corners
        parts = np.clip((away * sides).sum(axis=2) / squares, 0.0, 1.0)
        nearest = min(nearest, float(np.linalg.norm(away - parts[..., None] * sides, axis=2).min()))
    return nearest


def _cross(one: Array, other: Array) -> Array:
    return np.asarray(one[..., 0] * other[..., 1] - one[..., 1] * other[..., 0])


def _is_inside(point: Array, polyline: Array) -> bool:
    """Whether a ray from a point to the right crosses a closed polyline an odd number of times."""
    start, end = polyline - point, np.roll(polyline, -1, axis=0) - point
    passes = (start[:, 1] > 0.0) != (end[:, 1] > 0.0)
    start, end = start[passes], end[passes]
    reached = start[:, 0] - start[:, 1] * (end - start)[:, 0] / (end - start)[:, 1]
    return bool(np.count_nonzero(reached > 0.0) % 2)


def _sampled(arc: Arc, least: int = 8 * _PARTS) -> Array:
    edges = np.array([0.0, *arc.knots, 1.0])
    parts = 1 if arc.straight else max(_PARTS, least // (len(edges) - 1))
    return arc.point(np.linspace(edges[:-1], edges[1:], parts, endpoint=False).T.ravel())


def _on_both_sides(start: Array, step: Array, one: Array, other: Array, negligible: float) -> Array:
    """Whether two points lie on different sides of the line through a part, or on it."""
    first = step[0] * (one[..., 1] - start[1]) - step[1] * (one[..., 0] - start[0])
    second = step[0] * (other[..., 1] - start[1]) - step[1] * (other[..., 0] - start[0])
    return ~(((first > negligible) & (second > negligible)) | ((first < -negligible) & (second < -negligible)))
