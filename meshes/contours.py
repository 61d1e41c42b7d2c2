"""Closed contours of bodies: smooth arcs between corners, cut by a still level, with exact area integrals."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import pairwise
from typing import Literal, TypeAlias

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq

Array: TypeAlias = NDArray[np.float64]
Curve: TypeAlias = Callable[[Array], Array]
Point: TypeAlias = tuple[float, float]

AT_LEVEL = 1e-12
"""Points nearer to a level than this part of the contour's height lie on it."""

_POINTS, _WEIGHTS = np.polynomial.legendre.leggauss(40)
# How many steps of each smooth stretch are looked at for turning points.
_STEPS = 64


@dataclass(frozen=True, kw_only=True)
class Arc:
    """A smooth directed piece of a curve, x(t) with 0 ≤ t ≤ 1.

    Attributes:
        curve: t of shape (n,) to points of shape (n, 2), smooth on the whole of [0, 1] but at the knots.
        velocity: t of shape (n,) to dx/dt of shape (n, 2).
        start: the exact point at t = 0, shared with the arc before.
        end: the exact point at t = 1, shared with the arc after.
        straight: whether it is a straight segment passed at constant speed.
        knots: values of t between 0 and 1 where higher derivatives jump, as those of splines do.
    """

    curve: Curve
    velocity: Curve
    start: Point
    end: Point
    straight: bool = False
    knots: tuple[float, ...] = ()

    def point(self, t: Array) -> Array:
        """Return the points at t of shape (n,), as an array of shape (n, 2); the ends are exact."""
        t = np.asarray(t, dtype=float)
        points = self.curve(t)
        points[t <= 0.0] = self.start
        points[t >= 1.0] = self.end
        return points

    def part(self, first: float, last: float, *, start: Point | None = None, end: Point | None = None) -> Arc:
        """Return the piece first ≤ t ≤ last as an arc of its own.

        Args:
            first: t where it begins.
            last: t where it ends.
            start: its exact first point, if that is known better than by t.
            end: its exact last point.
        """
        span = last - first
        ends = self.point(np.array([first, last]))
        return Arc(
            curve=lambda t: self.curve(first + span * t),
            velocity=lambda t: span * self.velocity(first + span * t),
            start=start if start is not None else _point(ends[0]),
            end=end if end is not None else _point(ends[1]),
            straight=self.straight,
            knots=tuple((knot - first) / span for knot in self.knots if first < knot < last),
        )

    def mapped(self, factor: float, shift: Point) -> Arc:
        """Return the arc at x ↦ factor x + shift, factor > 0."""
        offset = np.array(shift)
        return replace(
            self,
            curve=lambda t: factor * self.curve(t) + offset,
            velocity=lambda t: factor * self.velocity(t),
            start=_point(factor * np.array(self.start) + offset),
            end=_point(factor * np.array(self.end) + offset),
        )

    @property
    def stretches(self) -> tuple[tuple[float, float], ...]:
        """The intervals of t without a knot inside."""
        return tuple(pairwise((0.0, *self.knots, 1.0)))

    def turns(self, axis: Literal[0, 1]) -> tuple[float, ...]:
        """Return the t in 0 < t < 1 where a coordinate has a maximum or minimum, in order."""
        if self.straight:
            return ()
        found = []
        for first, last in self.stretches:
            t = np.linspace(first, last, _STEPS + 1)
            slope = self.velocity(t)[:, axis]
            for index in np.flatnonzero(slope[:-1] * slope[1:] < 0.0):
                found.append(self._root(lambda at: self.velocity(at)[:, axis], t[index], t[index + 1]))
            # A slope that vanishes at a sample may or may not change its sign there; to split there does no harm.
            found.extend(t[np.flatnonzero(slope == 0.0)])
        return tuple(sorted({float(t) for t in found if 0.0 < t < 1.0}))

    def crossing(self, level: float, first: float, last: float, *, axis: Literal[0, 1] = 1) -> float:
        """Return the t between two points on different sides of a level where y = level, or x = level for axis 0."""
        return self._root(lambda t: self.curve(t)[:, axis] - level, first, last)

    @staticmethod
    def _root(value: Callable[[Array], Array], first: float, last: float) -> float:
        return float(brentq(lambda t: value(np.array([t]))[0], first, last, xtol=1e-300, rtol=8.9e-16))


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


def _point(values: Array) -> Point:
    return float(values[0]), float(values[1])


@dataclass(frozen=True, kw_only=True)
class AreaMoments:
    """Integrals over a plane region.

    Attributes:
        area: ∫dA.
        first: ∫x dA and ∫y dA.
        second: ∫x² dA and ∫y² dA.
    """

    area: float
    first: Point
    second: Point

    @property
    def centroid(self) -> Point:
        """The centre of the area."""
        return self.first[0] / self.area, self.first[1] / self.area

    @property
    def radius_of_gyration(self) -> float:
        """√(∫|x − centroid|² dA / A)."""
        x, y = self.centroid
        return float(np.sqrt(max(sum(self.second) / self.area - x * x - y * y, 0.0)))


@dataclass(frozen=True)
class Contour:
    """A closed contour that runs counterclockwise about a body: the end of each arc is the start of the next.

    Attributes:
        arcs: the arcs in order; corners lie between arcs only.
    """

    arcs: tuple[Arc, ...]

    def moved(self, shift: Point) -> Contour:
        """Return the contour displaced by a vector."""
        return Contour(tuple(arc.mapped(1.0, shift) for arc in self.arcs))

    def scaled(self, factor: float) -> Contour:
        """Return the contour at x ↦ factor x, factor > 0."""
        return Contour(tuple(arc.mapped(factor, (0.0, 0.0)) for arc in self.arcs))

    @cached_property
    def bounds(self) -> tuple[float, float, float, float]:
        """Smallest x, largest x, smallest y and largest y."""
        points = np.concatenate(
            [arc.point(np.array([0.0, *arc.turns(0), *arc.turns(1)])) for arc in self.arcs],
        )
        (left, low), (right, high) = points.min(axis=0), points.max(axis=0)
        return float(left), float(right), float(low), float(high)

    def below(self, level: float) -> tuple[Arc, ...]:
        """Return the chain of arcs under a level, from the left contact point to the right one.

        The chain follows the contour counterclockwise; where the level cuts an arc, the arc is cut.

        Raises:
            ValueError: if the level cuts the contour in other than two points, or touches it.
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
        if side not in sides or -side not in sides:
            raise ValueError(f"the section lies wholly {'above' if side < 0 else 'below'} the still level")
        contacts = sum(1 for _, arc in pieces if arc.start[1] == level)
        if contacts != 2:
            raise ValueError(f"the still level meets the section in {contacts} points instead of two")
        begin = next(n for n in range(len(pieces)) if sides[n] == side and sides[n - 1] != side)
        turned = pieces[begin:] + pieces[:begin]
        return tuple(arc for sign, arc in turned if sign == side)

    def _pieces(self, level: float) -> Iterator[tuple[int, Arc]]:
        """The contour in pieces that lie above (1), below (-1) or along (0) a level; contact points have y = level."""
        _, _, low, high = self.bounds
        near = AT_LEVEL * (high - low)
        for arc in self.arcs:
            ends = [(0.0, _onto(arc.start, level, near)), (1.0, _onto(arc.end, level, near))]
            turning = np.array(arc.turns(1))
            between = zip(turning, (_onto(_point(p), level, near) for p in arc.point(turning)), strict=True)
            stops = [ends[0], *((float(t), p) for t, p in between), ends[1]]
            cut = [stops[0]]
            for (first, p), (last, q) in pairwise(stops):
                if (p[1] - level) * (q[1] - level) < 0.0:
                    t = arc.crossing(level, first, last)
                    cut.append((t, (float(arc.curve(np.array([t]))[0, 0]), level)))
                cut.append((last, q))
            yield from _by_side(arc, cut, level)

    def moments(self, level: float | None = None, *, side: Literal["below", "above"] = "below") -> AreaMoments:
        """Return the area integrals of the section, or of its part below or above a level.

        By Green's theorem, A = −∮y dx and so on, with Gauss quadrature on the arcs. With y counted from the level the
        closing lines along it add nothing, in however many points the level cuts the contour.

        Args:
            level: ordinate of the level; None takes the whole section.
            side: which part is meant.
        """
        if level is None:
            return _moments(self.arcs, 0.0)
        wanted = -1 if side == "below" else 1
        return _moments((arc for sign, arc in self._pieces(level) if sign == wanted), level)


def _onto(point: Point, level: float, near: float) -> Point:
    return (point[0], level) if abs(point[1] - level) <= near else point


def _by_side(arc: Arc, cut: list[tuple[float, Point]], level: float) -> Iterator[tuple[int, Arc]]:
    """Pieces of an arc between the stops where it meets the level."""
    begin = 0
    for stop in range(1, len(cut)):
        if stop == len(cut) - 1 or cut[stop][1][1] == level:
            heights = [p[1] - level for _, p in cut[begin : stop + 1]]
            sign = int(np.sign(max(heights, key=abs)))
            (first, start), (last, end) = cut[begin], cut[stop]
            yield sign, arc.part(first, last, start=start, end=end)
            begin = stop


def _moments(arcs: Iterable[Arc], level: float) -> AreaMoments:
    sums = np.zeros(5)
    for arc in arcs:
        for first, last in arc.stretches:
            half = 0.5 * (last - first)
            t = first + half * (1.0 + _POINTS)
            (x, y), (dx, dy) = arc.curve(t).T, half * _WEIGHTS * arc.velocity(t).T
            y = y - level
            sums += -(y @ dx), 0.5 * (x * x) @ dy, -0.5 * (y * y) @ dx, (x**3) @ dy / 3.0, -(y**3) @ dx / 3.0
    area, x1, y1, x2, y2 = map(float, sums)
    return AreaMoments(
        area=area, first=(x1, y1 + level * area), second=(x2, y2 + 2.0 * level * y1 + level * level * area)
    )
