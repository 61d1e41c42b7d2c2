"""A planar domain as plain geometry: named curves, regions bounded by them, points towards which it is graded."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from math import inf
from typing import Any

import numpy as np
from numpy.typing import NDArray

Point = tuple[float, float]
Path = Callable[[NDArray[np.floating[Any]]], NDArray[np.floating[Any]]]

# Largest deviation of a path from its stated ends, relative to its extent; its nodes there are the ends.
_PATH_ROUNDING = 1e-9
# Points on a curved piece for measures that need no accuracy: orientation of loops, distances between curves.
_COARSE = 65


@dataclass(frozen=True, kw_only=True)
class Curve:
    """A directed smooth piece between two points."""

    name: str  # physical name of its facets; empty for an inner line without a group
    start: Point  # first point
    end: Point  # last point, another than the first
    # points, shape (n, 2), at parameters 0 … 1, shape (n,), from the start to the end; ``None`` is straight
    path: Path | None = None
    size: float = inf  # largest element on the curve; elements grow with the distance from it. Infinite sets no limit.
    cut: bool = False  # whether the regions on both sides have nodes of their own on it

    def at(self, parameters: NDArray[np.float64]) -> NDArray[np.float64]:
        """Points at parameters 0 … 1, shape (n, 2); the ends are exact."""
        start, end = np.array(self.start), np.array(self.end)
        if self.path is None:
            points = start + parameters[:, None] * (end - start)
        else:
            points = np.array(self.path(parameters), dtype=np.float64)
        points[parameters == 0.0] = start
        points[parameters == 1.0] = end
        return points

    def polyline(self) -> NDArray[np.float64]:
        """A few points on the curve, shape (n, 2): the two ends of a straight one."""
        if self.path is None:
            return np.array([self.start, self.end], dtype=np.float64)
        return self.at(np.linspace(0.0, 1.0, _COARSE, dtype=np.float64))


@dataclass(frozen=True, kw_only=True)
class Region:
    """A part of the domain: its cells have one physical name, which several regions may share."""

    name: str  # physical name of the cells
    # its boundary counterclockwise, as (index of a curve, whether it is passed from its start to its end)
    loop: tuple[tuple[int, bool], ...]


@dataclass(frozen=True, kw_only=True)
class GradedPoint:
    """A point towards which the mesh is graded by rings of triangles."""

    point: Point  # an end of curves
    inner: float  # radius that the innermost ring shall not exceed; infinite for a single ring
    # radius of the outermost ring; the mesh takes a smaller one where curves bend, have a size or are near
    outer: float


@dataclass(frozen=True, kw_only=True)
class Chords:
    """Straight pieces of curves, for measures that need no accuracy."""

    starts: NDArray[np.float64]  # first points (x, y) in the unit of the outline, shape (n, 2)
    ends: NDArray[np.float64]  # last points in the unit of the outline, shape (n, 2)
    curves: NDArray[np.int64]  # index of the curve that each is a piece of, shape (n,)


@dataclass(frozen=True, kw_only=True)
class Outline:
    """Curves, the regions between them and the graded points.

    Raises:
        ValueError: if a loop is not closed, turns clockwise or passes a curve twice; if a curve bounds no region or
            more than two, or two on the same side; if a boundary curve has no name; if a path misses its ends; if a
            corner is no end of a curve.
    """

    curves: tuple[Curve, ...]
    regions: tuple[Region, ...]
    graded_points: tuple[GradedPoint, ...] = ()

    def __post_init__(self) -> None:
        for number, curve in enumerate(self.curves):
            _check_curve(number, curve)
        for region in self.regions:
            self._check_loop(region)
        passes = Counter(piece for region in self.regions for piece in region.loop)
        for number, curve in enumerate(self.curves):
            sides = passes[number, True], passes[number, False]
            if max(sides) > 1:
                raise ValueError(f"curve {number} ({curve.name!r}) bounds two regions on the same side")
            if sum(sides) == 0:
                raise ValueError(f"curve {number} ({curve.name!r}) bounds no region")
            if not curve.name and (curve.cut or sum(sides) == 1):
                raise ValueError(f"curve {number} has no name but lies on the boundary or is cut open")
        ends = {end for curve in self.curves for end in (curve.start, curve.end)}
        for graded in self.graded_points:
            if graded.point not in ends:
                raise ValueError(f"the corner at {graded.point} is not an end of a curve")
            if not (graded.inner > 0.0 and graded.outer > 0.0):
                raise ValueError(f"the corner at {graded.point} needs rings of positive radii")
        if len({graded.point for graded in self.graded_points}) < len(self.graded_points):
            raise ValueError("two corners are at the same point")

    def curves_at(self, point: Point) -> tuple[int, ...]:
        """Indices of the curves that begin or end at a point."""
        return self._curves_at.get(point, ())

    @cached_property
    def _curves_at(self) -> dict[Point, tuple[int, ...]]:
        meeting: dict[Point, tuple[int, ...]] = {}
        for number, curve in enumerate(self.curves):
            for point in (curve.start, curve.end):
                meeting[point] = (*meeting.get(point, ()), number)
        return meeting

    @cached_property
    def chords(self) -> Chords:
        """The polylines of all curves as one set of straight pieces."""
        polylines = [curve.polyline() for curve in self.curves]
        return Chords(
            starts=np.vstack([polyline[:-1] for polyline in polylines]),
            ends=np.vstack([polyline[1:] for polyline in polylines]),
            curves=np.repeat(np.arange(len(polylines)), [len(polyline) - 1 for polyline in polylines]),
        )

    def _check_loop(self, region: Region) -> None:
        numbers = [number for number, _ in region.loop]
        if len(set(numbers)) < len(numbers):
            raise ValueError(f"the loop of region {region.name!r} passes a curve twice")
        points = []
        for (number, forward), (following, onwards) in zip(
            region.loop, (*region.loop[1:], *region.loop[:1]), strict=True
        ):
            curve, next_curve = self.curves[number], self.curves[following]
            end = curve.end if forward else curve.start
            if end != (next_curve.start if onwards else next_curve.end):
                raise ValueError(
                    f"the loop of region {region.name!r} is open between curves {number} ({curve.name!r}) "
                    f"and {following} ({next_curve.name!r})"
                )
            polyline = curve.polyline()
            points.append(polyline[:-1] if forward else polyline[:0:-1])
        if len(region.loop) == 0 or enclosed_area(np.vstack(points)) <= 0.0:
            raise ValueError(f"the loop of region {region.name!r} must turn counterclockwise")


def as_points(points: NDArray[np.float64]) -> list[Point]:
    """The rows of an array of shape (n, 2)."""
    rows: Any = points.tolist()
    return [(x, y) for x, y in rows]


def enclosed_area(points: NDArray[np.float64]) -> float:
    """Area, m², within a closed polygon of points, m, shape (n, 2); positive if it turns counterclockwise."""
    # Relative to one of its points, to avoid cancellation in polygons far from the origin.
    x, y = (points - points[0]).T
    return 0.5 * float(np.sum(x[:-1] * y[1:] - x[1:] * y[:-1]))


def _check_curve(number: int, curve: Curve) -> None:
    if curve.start == curve.end:
        raise ValueError(f"curve {number} ({curve.name!r}) ends where it starts: give it as two curves")
    if not curve.size > 0.0:
        raise ValueError(f"curve {number} ({curve.name!r}) needs elements of positive size")
    if curve.path is not None:
        points = np.array(curve.path(np.linspace(0.0, 1.0, _COARSE, dtype=np.float64)), dtype=np.float64)
        missed = np.abs(points[[0, -1]] - [curve.start, curve.end]).max()
        if points.shape != (_COARSE, 2) or not missed <= _PATH_ROUNDING * np.ptp(points, axis=0).max():
            raise ValueError(f"the path of curve {number} ({curve.name!r}) does not lead from its start to its end")
