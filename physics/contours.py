"""Closed contours of bodies: smooth arcs between corners, cut by a still level, with exact area integrals."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import pairwise
from math import atan2
from typing import Any, Literal, TypeAlias

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq

Array: TypeAlias = NDArray[np.floating[Any]]
Curve: TypeAlias = Callable[[Array], Array]
Point: TypeAlias = tuple[float, float]

AT_LEVEL = 1e-12
"""Points nearer to a level than this part of the contour's height lie on it."""

CORNER = 1e-6
"""A turn by a smaller angle, in radians, between two arcs is none."""

# Enough for the profiles' elementary functions to the last digits, and for any polynomial up to degree 79.
_GAUSS_POINTS, _GAUSS_WEIGHTS = np.polynomial.legendre.leggauss(40)
# Number of intervals of each smooth stretch in which turning points are sought.
_STEPS = 64


@dataclass(frozen=True, kw_only=True)
class Arc:
    """A smooth directed piece of a curve, x(t) with 0 ≤ t ≤ 1."""

    curve: Curve  # t of shape (n,) to points of shape (n, 2), smooth on the whole of [0, 1] but at the knots
    velocity: Curve  # t of shape (n,) to dx/dt of shape (n, 2)
    start: Point  # the exact point at t = 0, shared with the arc before
    end: Point  # the exact point at t = 1, shared with the arc after
    straight: bool = False  # whether it is a straight segment passed at constant speed
    knots: tuple[float, ...] = ()  # values of t between 0 and 1 where higher derivatives jump, as those of splines do

    def point(self, t: Array) -> Array:
        """Return the points at t of shape (n,), as an array of shape (n, 2); the ends are exact."""
        points = np.array(self.curve(t))
        points[t <= 0.0] = self.start
        points[t >= 1.0] = self.end
        return points

    def part(self, first: float, last: float, *, start: Point | None = None, end: Point | None = None) -> Arc:
        """Return the piece first ≤ t ≤ last as an arc of its own.

        Args:
            first: parameter t, 0 … 1, of its first point.
            last: parameter t of its last point.
            start: exact first point (x, y), m; by default that at ``first``.
            end: exact last point (x, y), m; by default that at ``last``.
        """
        one, other = ((float(x), float(y)) for x, y in self.point(np.array([first, last])))
        start, end = one if start is None else start, other if end is None else end
        if (first, last) == (0.0, 1.0):
            return replace(self, start=start, end=end)
        span = last - first
        return Arc(
            curve=lambda t: self.curve(first + span * t),
            velocity=lambda t: span * self.velocity(first + span * t),
            start=start,
            end=end,
            straight=self.straight,
            knots=tuple((knot - first) / span for knot in self.knots if first < knot < last),
        )

    def mapped(self, factor: float, shift: Point) -> Arc:
        """Return the arc at x ↦ factor x + shift, factor > 0."""
        (x, y), (z, w) = self.start, self.end
        return replace(
            self,
            curve=lambda t: factor * self.curve(t) + np.array(shift),
            velocity=lambda t: factor * self.velocity(t),
            start=(factor * x + shift[0], factor * y + shift[1]),
            end=(factor * z + shift[0], factor * w + shift[1]),
        )

    @cached_property
    def x_turns(self) -> tuple[float, ...]:
        """The t in 0 < t < 1 where x has a maximum or minimum, in order."""
        return self._turns(0)

    @cached_property
    def y_turns(self) -> tuple[float, ...]:
        """The t in 0 < t < 1 where y has a maximum or minimum, in order."""
        return self._turns(1)

    def _turns(self, axis: Literal[0, 1]) -> tuple[float, ...]:
        if self.straight:
            return ()
        edges = np.array([0.0, *self.knots, 1.0])
        t = np.unique(np.linspace(edges[:-1], edges[1:], _STEPS + 1))
        slope = self.velocity(t)[:, axis]
        between = [
            root(lambda at: self.velocity(np.array([at]))[0, axis], t[n], t[n + 1])
            for n in np.flatnonzero(slope[:-1] * slope[1:] < 0.0)
        ]
        # Where the slope vanishes without a change of sign, to stop there does no harm.
        at_samples = t[1:-1][slope[1:-1] == 0.0]
        return tuple(sorted(map(float, [*between, *at_samples])))

    def crossing(self, level: float, first: float, last: float, *, axis: Literal[0, 1] = 1) -> float:
        """Return the parameter t, 0 … 1, where y = level in m (x = level on axis 0), between two t on different
        sides."""
        return root(lambda t: self.curve(np.array([t]))[0, axis] - level, first, last)


def root(value: Callable[[float], float], first: float, last: float) -> float:
    """Return where a function of one variable changes its sign, to rounding of the interval."""
    # Next to a root at 0 the function's own rounding would keep a merely relative tolerance from being met.
    tolerance = 1e-17 * (last - first)

    return float(brentq(value, first, last, xtol=tolerance, rtol=4.0 * float(np.finfo(float).eps), maxiter=1000))


def bowl_arc(depth: float, radius: float) -> Arc:
    """Return the circle about x = 0 from (0, −depth) to (radius, 0): the section of a sphere, filled to that depth."""
    whole = 0.5 * (radius**2 + depth**2) / depth
    low, high = -0.5 * np.pi, np.arctan2(depth - whole, radius)

    def along(t: Array) -> tuple[Array, Array]:
        angle = low + (high - low) * t
        return np.cos(angle), np.sin(angle)

    def curve(t: Array) -> Array:
        cosine, sine = along(t)
        return np.column_stack([whole * cosine, whole * (1.0 + sine) - depth])

    def velocity(t: Array) -> Array:
        cosine, sine = along(t)
        return whole * (high - low) * np.column_stack([-sine, cosine])

    return Arc(curve=curve, velocity=velocity, start=(0.0, -depth), end=(radius, 0.0))


def straight_arc(start: Point, end: Point) -> Arc:
    """Return the segment between two points."""
    first, step = np.array(start), np.array(end) - np.array(start)
    return Arc(
        curve=lambda t: first + t[:, None] * step,
        velocity=lambda t: np.broadcast_to(step, (len(t), 2)),
        start=start,
        end=end,
        straight=True,
    )


POINTS = 201
"""Points along each piece of a sampled curve."""


def points_along(arcs: Iterable[Arc]) -> NDArray[np.float64]:
    """Return points along arcs that meet, shape (points, 2); the end of each is left out, it is where the next begins.

    A chain that is open lacks its last end.
    """
    even = np.linspace(0.0, 1.0, POINTS, dtype=np.float64)
    points = [arc.point(np.union1d(even, arc.knots)[:-1]) for arc in arcs]
    return np.asarray(np.concatenate(points), dtype=np.float64)


def turn_between(before: Arc, after: Arc) -> float:
    """Return the angle by which the direction turns anticlockwise from one arc to the next, in −π … π."""
    ux, uy = before.velocity(np.array([1.0]))[0]
    vx, vy = after.velocity(np.array([0.0]))[0]
    return atan2(ux * vy - uy * vx, ux * vx + uy * vy)


@dataclass(frozen=True, kw_only=True)
class AreaMoments:
    """Integrals over a plane region."""

    area: float  # ∫dA
    first: Point  # ∫x dA and ∫y dA
    second: Point  # ∫x² dA and ∫y² dA

    @property
    def centroid(self) -> Point:
        """The centre of the area."""
        return self.first[0] / self.area, self.first[1] / self.area

    @property
    def radius_of_gyration(self) -> float:
        """√(∫|x − centroid|² dA / A)."""
        x, y = self.centroid
        return float(np.sqrt(sum(self.second) / self.area - x * x - y * y))


@dataclass(frozen=True)
class Contour:
    """A closed contour that runs counterclockwise about a body: the end of each arc is the start of the next."""

    arcs: tuple[Arc, ...]  # the arcs in order; corners lie between arcs only

    def moved(self, shift: Point) -> Contour:
        """Return the contour displaced by a vector."""
        return Contour(tuple(arc.mapped(1.0, shift) for arc in self.arcs))

    def scaled(self, factor: float) -> Contour:
        """Return the contour at x ↦ factor x, factor > 0."""
        return Contour(tuple(arc.mapped(factor, (0.0, 0.0)) for arc in self.arcs))

    @cached_property
    def bounds(self) -> tuple[float, float, float, float]:
        """Smallest x, largest x, smallest y and largest y."""
        points = np.concatenate([arc.point(np.array([0.0, *arc.x_turns, *arc.y_turns])) for arc in self.arcs])
        (left, low), (right, high) = points.min(axis=0), points.max(axis=0)
        return float(left), float(right), float(low), float(high)

    @property
    def corners(self) -> tuple[Point, ...]:
        """The points between arcs where the direction jumps."""
        return tuple(
            after.start
            for before, after in zip((self.arcs[-1], *self.arcs), self.arcs, strict=False)
            if abs(turn_between(before, after)) > CORNER
        )

    def below(self, level: float) -> tuple[Arc, ...]:
        """Return the chain of arcs under a level, from the left contact point to the right one.

        The chain follows the contour counterclockwise; where the level cuts an arc, the arc is cut. Contact points
        have exactly y = level, also corners that lie within `AT_LEVEL` of it.
        """
        return self._chain(level, -1)

    def above(self, level: float) -> tuple[Arc, ...]:
        """Return the chain of arcs over a level, from the right contact point to the left one; see `below`."""
        return self._chain(level, 1)

    def _chain(self, level: float, side: Literal[-1, 1]) -> tuple[Arc, ...]:
        pieces = tuple(self._pieces(level))
        sides = [sign for sign, _ in pieces]
        if 0 in sides:
            raise ValueError("a side of the section lies along the still level")
        if len(set(sides)) == 1:
            raise ValueError(f"the section lies wholly {'above' if 1 in sides else 'below'} the still level")
        contacts = sum(1 for _, arc in pieces if arc.start[1] == level)
        if contacts != 2:
            raise ValueError(f"the still level meets the contour of the section in {contacts} points instead of two")
        begin = next(n for n, sign in enumerate(sides) if sign == side != sides[n - 1])
        return tuple(arc for sign, arc in pieces[begin:] + pieces[:begin] if sign == side)

    def _pieces(self, level: float) -> Iterator[tuple[int, Arc]]:
        """The contour in pieces that lie above (1), below (−1) or along (0) a level; contact points have y = level."""
        _, _, low, high = self.bounds
        near = AT_LEVEL * (high - low)
        for arc in self.arcs:
            yield from _by_side(arc, _stops(arc, level, near), level)

    def moments(self, level: float | None = None, *, side: Literal["below", "above"] = "below") -> AreaMoments:
        """Return the area integrals of the section, or of its part below or above a level.

        By Green's theorem, A = −∮y dx and so on, with Gauss quadrature on the arcs. With y counted from the level the
        closing lines along it add nothing, in however many points the level cuts the contour.

        Args:
            level: ordinate of the level; None takes the whole section.
            side: which part is meant.
        """
        return _moments(self.arcs, 0.0) if level is None else _moments(self.part_of(level, side), level)

    def part_of(self, level: float, side: Literal["below", "above"]) -> Iterator[Arc]:
        """The pieces of the contour on one side of a level, which may cut it in any number of points."""
        wanted = -1 if side == "below" else 1
        return (arc for sign, arc in self._pieces(level) if sign == wanted)

    def waterplane(self, left: float, right: float) -> tuple[float, float]:
        """Width of the waterplane between two contact points, and its second moment about its middle."""
        return right - left, (right - left) ** 3 / 12.0


_Stop: TypeAlias = tuple[float, Point]


def _stops(arc: Arc, level: float, near: float) -> list[_Stop]:
    """Both ends of an arc, the points where y turns and those where it crosses the level, in order."""

    def onto(x: float, y: float) -> Point:
        return (x, level) if abs(y - level) <= near else (x, y)

    turning = np.array(arc.y_turns)
    stops = [(0.0, onto(*arc.start)), (1.0, onto(*arc.end))]
    stops[1:1] = [(float(t), onto(float(x), float(y))) for t, (x, y) in zip(turning, arc.point(turning), strict=True)]
    found = [stops[0]]
    for (first, p), (last, q) in pairwise(stops):
        if (p[1] - level) * (q[1] - level) < 0.0:
            t = arc.crossing(level, first, last)
            found.append((t, (float(arc.curve(np.array([t]))[0, 0]), level)))
        found.append((last, q))
    return found


def _by_side(arc: Arc, stops: list[_Stop], level: float) -> Iterator[tuple[int, Arc]]:
    heights = [point[1] - level for _, point in stops]
    cuts = [0, *(n for n in range(1, len(stops) - 1) if heights[n] == 0.0), len(stops) - 1]
    for begin, end in pairwise(cuts):
        sign = int(np.sign(max(heights[begin : end + 1], key=abs)))
        (first, start), (last, stop) = stops[begin], stops[end]
        yield sign, arc.part(first, last, start=start, end=stop)


def arc_quadrature(arc: Arc) -> tuple[Array, Array, Array, Array]:
    """Gauss points x and y of an arc, and dx and dy with the weights, each of shape (points,)."""
    edges = np.array([0.0, *arc.knots, 1.0])
    half = 0.5 * np.diff(edges)[:, None]
    t = (edges[:-1, None] + half * (1.0 + _GAUSS_POINTS)).ravel()
    x, y = arc.curve(t).T
    dx, dy = (half * _GAUSS_WEIGHTS).ravel() * arc.velocity(t).T
    return x, y, dx, dy


def _moments(arcs: Iterable[Arc], level: float) -> AreaMoments:
    sums = np.zeros(5)
    for arc in arcs:
        x, y, dx, dy = arc_quadrature(arc)
        y = y - level
        sums += -(y @ dx), 0.5 * (x * x) @ dy, -0.5 * (y * y) @ dx, (x**3) @ dy / 3.0, -(y**3) @ dx / 3.0
    area, x1, y1, x2, y2 = map(float, sums)
    return AreaMoments(
        area=area,
        first=(x1, y1 + level * area),
        second=(x2, y2 + 2.0 * level * y1 + level * level * area),
    )
