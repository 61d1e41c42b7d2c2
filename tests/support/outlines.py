"""Outlines that several tests mesh: two liquids in a tank, with floats, slits and beams between them."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from math import cos, inf, pi, sin
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hydroelastic.meshes.geometry import BOTTOM, LEFT_WALL, LID, RIGHT_WALL, SYMMETRY_PLANE
from hydroelastic.meshes.outline import Curve, GradedPoint, Outline, Path, Point, Region

LOWER, UPPER = "lower", "upper"
INTERFACE, FLOAT = "interface", "float"


def arc(centre: Point, radius: float, first: float, last: float) -> Path:
    """Points on a circle from one angle to another."""

    def path(parameters: NDArray[np.float64]) -> NDArray[np.float64]:
        angles = first + (last - first) * parameters
        return np.column_stack([centre[0] + radius * np.cos(angles), centre[1] + radius * np.sin(angles)])

    return path


@dataclass(frozen=True, kw_only=True)
class Circle:
    """A circular float that meets the interface y = 0 at the contact angle, measured in the lower liquid."""

    centre: float = 0.5
    radius: float = 0.1
    contact_angle: float = pi / 2.0

    @property
    def half_arc(self) -> float:
        """Half the angle of the arc in the lower liquid, seen from the centre."""
        return pi - self.contact_angle

    @property
    def height(self) -> float:
        """Of the centre above the interface."""
        return self.radius * cos(self.half_arc)

    @property
    def contacts(self) -> tuple[Point, Point]:
        reach = self.radius * sin(self.half_arc)
        return (self.centre - reach, 0.0), (self.centre + reach, 0.0)

    @property
    def area(self) -> float:
        return pi * self.radius**2

    @property
    def immersed(self) -> float:
        """Area in the lower liquid: a segment of the circle."""
        return self.radius**2 * (self.half_arc - sin(self.half_arc) * cos(self.half_arc))

    def arcs(self) -> tuple[list[Curve], list[Curve]]:
        """The arcs below and above the interface, counterclockwise around the float."""
        left, right = self.contacts
        centre, lowest = (self.centre, self.height), -pi / 2.0
        below = arc(centre, self.radius, lowest - self.half_arc, lowest + self.half_arc)
        above = arc(centre, self.radius, lowest + self.half_arc, 1.5 * pi - self.half_arc)
        return [Curve(name=FLOAT, start=left, end=right, path=below)], [
            Curve(name=FLOAT, start=right, end=left, path=above)
        ]

    def left_arcs(self) -> tuple[list[Curve], list[Curve]]:
        """The left halves of the arcs, from and to the plane of symmetry."""
        left, _ = self.contacts
        centre, lowest = (self.centre, self.height), -pi / 2.0
        bottom, top = (self.centre, self.height - self.radius), (self.centre, self.height + self.radius)
        below = arc(centre, self.radius, lowest - self.half_arc, lowest)
        above = arc(centre, self.radius, pi / 2.0, 1.5 * pi - self.half_arc)
        return [Curve(name=FLOAT, start=left, end=bottom, path=below)], [
            Curve(name=FLOAT, start=top, end=left, path=above)
        ]


def polygon(below: list[Point], above: list[Point]) -> tuple[list[Curve], list[Curve]]:
    """Straight sides through points from the left to the right contact point, and from the right to the left one."""
    first, second = (
        [Curve(name=FLOAT, start=start, end=end) for start, end in pairwise(points)] for points in (below, above)
    )
    return first, second


def two_liquids(
    body: tuple[list[Curve], list[Curve]] = ((), ()),
    *,
    left: list[tuple[float, str]],
    right: list[tuple[float, str]] = (),
    depths: tuple[float, float] = (0.4, 0.3),
    size: float = 0.05,
    rings: tuple[Point, ...] = (),
    tip_size: float = 1e-6,
    half: bool = False,
) -> Outline:
    """A tank of length 1 with an interface y = 0, or its left half, and perhaps a body that the interface meets.

    Args:
        body: sides below and above the interface, counterclockwise around the body.
        left: pieces of the interface from x = 0 to the body as (end, name).
        right: pieces beyond the body.
        depths: of the lower and the upper liquid.
        size: of elements on the interface, and of the outermost rings.
        rings: corners.
        tip_size: of the innermost rings.
        half: whether the tank ends at x = 0.5, a plane of symmetry, to which the body leads.
    """
    below, above = (list(sides) for sides in body)
    lower_depth, upper_depth = depths
    length, far = (0.5, SYMMETRY_PLANE) if half else (1.0, RIGHT_WALL)

    def pieces(start: float, ends: list[tuple[float, str]]) -> list[Curve]:
        starts = [start, *(end for end, _ in ends)]
        return [
            Curve(name=name, start=(start, 0.0), end=(end, 0.0), size=size, cut=True)
            for start, (end, name) in zip(starts, ends, strict=False)
        ]

    before, beyond = pieces(0.0, left), pieces(below[-1].end[0] if below else 1.0, list(right))
    foot, head = (below[-1].end, above[0].start) if half and below else ((length, 0.0), (length, 0.0))
    walls_below = [
        Curve(name=LEFT_WALL, start=(0.0, 0.0), end=(0.0, -lower_depth)),
        Curve(name=BOTTOM, start=(0.0, -lower_depth), end=(length, -lower_depth)),
        Curve(name=far, start=(length, -lower_depth), end=foot),
    ]
    walls_above = [
        Curve(name=far, start=head, end=(length, upper_depth)),
        Curve(name=LID, start=(length, upper_depth), end=(0.0, upper_depth)),
        Curve(name=LEFT_WALL, start=(0.0, upper_depth), end=(0.0, 0.0)),
    ]
    curves = [*before, *below, *beyond, *walls_below, *above, *walls_above]
    number = {id(curve): index for index, curve in enumerate(curves)}

    def forward(some: list[Curve]) -> list[tuple[int, bool]]:
        return [(number[id(curve)], True) for curve in some]

    def backward(some: list[Curve]) -> list[tuple[int, bool]]:
        return [(number[id(curve)], False) for curve in reversed(some)]

    around_lower = (*forward(walls_below), *backward(beyond), *backward(below), *backward(before))
    around_upper = (*forward(before), *backward(above), *forward(beyond), *forward(walls_above))
    return Outline(
        curves=tuple(curves),
        regions=(Region(name=LOWER, loop=around_lower), Region(name=UPPER, loop=around_upper)),
        graded_points=tuple(GradedPoint(point=point, inner=tip_size, outer=size) for point in rings),
    )


def circle_tank(circle: Circle, *, half: bool = False, **given: Any) -> Outline:
    """Two liquids with a circular float, with rings at its contact points."""
    left, right = circle.contacts
    return two_liquids(
        circle.left_arcs() if half else circle.arcs(),
        left=[(left[0], INTERFACE)],
        right=[] if half else [(1.0, INTERFACE)],
        rings=(left,) if half else (left, right),
        half=half,
        **given,
    )


def thin_float_tank(
    *, height: float = 0.2, position: float = 0.4, size: float = 0.05, tip_size: float = 1e-6
) -> Outline:
    """Two liquids with a vertical slit -height < y < height, which the interface meets; depths 0.4 and 0.3."""
    x, low, high = position, -0.4, 0.3
    curves = (
        Curve(name=INTERFACE, start=(0.0, 0.0), end=(x, 0.0), size=size, cut=True),
        Curve(name=INTERFACE, start=(x, 0.0), end=(1.0, 0.0), size=size, cut=True),
        Curve(name="", start=(x, low), end=(x, -height)),
        Curve(name=FLOAT, start=(x, -height), end=(x, 0.0), cut=True),
        Curve(name=FLOAT, start=(x, 0.0), end=(x, height), cut=True),
        Curve(name="", start=(x, height), end=(x, high)),
        Curve(name=LEFT_WALL, start=(0.0, high), end=(0.0, 0.0)),
        Curve(name=LEFT_WALL, start=(0.0, 0.0), end=(0.0, low)),
        Curve(name=BOTTOM, start=(0.0, low), end=(x, low)),
        Curve(name=BOTTOM, start=(x, low), end=(1.0, low)),
        Curve(name=RIGHT_WALL, start=(1.0, low), end=(1.0, 0.0)),
        Curve(name=RIGHT_WALL, start=(1.0, 0.0), end=(1.0, high)),
        Curve(name=LID, start=(1.0, high), end=(x, high)),
        Curve(name=LID, start=(x, high), end=(0.0, high)),
    )
    regions = (
        Region(name=LOWER, loop=((7, True), (8, True), (2, True), (3, True), (0, False))),
        Region(name=LOWER, loop=((9, True), (10, True), (1, False), (3, False), (2, False))),
        Region(name=UPPER, loop=((0, True), (4, True), (5, True), (13, True), (6, True))),
        Region(name=UPPER, loop=((1, True), (11, True), (12, True), (5, False), (4, False))),
    )
    points = ((x, -height), (x, 0.0), (x, height))
    graded_points = tuple(GradedPoint(point=point, inner=tip_size, outer=size) for point in points)
    return Outline(curves=curves, regions=regions, graded_points=graded_points)


def surface_slit(*, low: float = -0.2, high: float = 0.0, rings: bool = True) -> Outline:
    """One liquid of depth 0.4 and length 1 with a vertical slit at x = 0.4, down from the surface or below it."""
    x, bottom, size = 0.4, -0.4, 0.05
    heights = [bottom, low, high] if high == 0.0 else [bottom, low, high, 0.0]
    line = [
        Curve(name=FLOAT if end == high else "", start=(x, start), end=(x, end), cut=end == high)
        for start, end in pairwise(heights)
    ]
    curves = (
        Curve(name="surface", start=(0.0, 0.0), end=(x, 0.0), size=size if rings else inf),
        Curve(name="surface", start=(x, 0.0), end=(1.0, 0.0), size=size if rings else inf),
        Curve(name=LEFT_WALL, start=(0.0, 0.0), end=(0.0, bottom)),
        Curve(name=BOTTOM, start=(0.0, bottom), end=(x, bottom)),
        Curve(name=BOTTOM, start=(x, bottom), end=(1.0, bottom)),
        Curve(name=RIGHT_WALL, start=(1.0, bottom), end=(1.0, 0.0)),
        *line,
    )
    up = tuple((6 + number, True) for number in range(len(line)))
    down = tuple((number, False) for number, _ in reversed(up))
    regions = (
        Region(name=LOWER, loop=((2, True), (3, True), *up, (0, False))),
        Region(name=LOWER, loop=((4, True), (5, True), (1, False), *down)),
    )
    points = ((x, low), (x, high)) if rings else ()
    graded_points = tuple(GradedPoint(point=point, inner=1e-6, outer=size) for point in points)
    return Outline(curves=curves, regions=regions, graded_points=graded_points)
