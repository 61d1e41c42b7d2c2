"""Closed lines on a plan: walls and outlines of plates, their parallels, and the room between them."""

from __future__ import annotations

from dataclasses import dataclass
from math import ceil, pi
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from hydroelastic.meshes.crossings import crossing_pair
from hydroelastic.physics.point_contours import distance_from

RATIO = 0.2
"""Ratio of the thicknesses of successive layers beside an edge."""

Grading: TypeAlias = NDArray[np.float64]
"""Distances of nodes from a corner, ascending."""
UNGRADED: Grading = np.zeros(0)
"""No nodes but those of the cells' size."""
Mirrors: TypeAlias = tuple[float | None, float | None]
"""x and y of planes of symmetry, ``None`` without one; the part of the plan with larger coordinates is kept."""

# Corners that turn by less than this, radians, need no smaller cells: the part of r^{π/α} in ψ is in proportion to it.
# The plan of 48 corners on a circle has errors of 1e-6 without, at a tolerance of 1e-5.
_GENTLE = 0.14
# Corners of a wall that turn by less than this are obtuse: ψ ~ r^{π/α} with an angle α of 100 degrees or more, which
# few nodes resolve.
_OBTUSE, _FEW_NODES = 1.4, 3
# Corners that turn by less than this are none: where mirror planes cross a side.
_FLAT = 1e-9


@dataclass(frozen=True, kw_only=True, eq=False)
class PolygonLoop:
    """A closed polygon; its interior is on the left of its sides."""

    corners: NDArray[np.float64]  # shape (corners, 2), anticlockwise

    def parallel(self, distance: float, places: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return points of the mitred parallel outside it (inside if negative)."""
        sides = np.roll(self.corners, -1, axis=0) - self.corners
        tangents = sides / np.linalg.norm(sides, axis=1)[:, None]
        before = np.roll(tangents, 1, axis=0)
        normals = np.column_stack([tangents[:, 1], -tangents[:, 0]])
        # The mitre of a corner: the sum of both normals over one plus the cosine between them.
        sums = normals + np.roll(normals, 1, axis=0)
        mitres = sums / (1.0 + (tangents * before).sum(axis=1))[:, None]
        moved = self.corners + distance * mitres
        number = np.floor(places).astype(int) % len(moved)
        part = (places - np.floor(places))[:, None]
        points: NDArray[np.float64] = (1.0 - part) * moved[number] + part * moved[(number + 1) % len(moved)]
        return points

    def places(self, size: float, towards: Grading, towards_reentrant: Grading) -> NDArray[np.float64]:
        """Return where the nodes lie: cells of a size, smaller ones towards the corners."""
        places = []
        ahead = np.roll(self.corners, -1, axis=0) - self.corners
        lengths = np.linalg.norm(ahead, axis=1)
        at_obtuse = towards if len(towards) else towards_reentrant[-_FEW_NODES:]
        graded = [
            UNGRADED
            if abs(turn) < _GENTLE
            else towards_reentrant
            if turn < 0.0
            else at_obtuse
            if turn < _OBTUSE
            else towards
            for turn in self._turns
        ]
        for number, length in enumerate(lengths):
            start, end = (_fitting(one, length) for one in (graded[number], graded[(number + 1) % len(lengths)]))
            low, high = start[-1] if len(start) else 0.0, 1.0 - (end[-1] if len(end) else 0.0)
            count = max(ceil((high - low) * length / size), 1)
            inner = np.linspace(low, high, count + 1)
            inner = inner[int(len(start) > 0 or low == 0.0) : -1]
            places.append(number + np.concatenate([[0.0], start, inner, 1.0 - end[::-1]]))
        return np.concatenate(places)

    def contains(self, point: NDArray[np.float64]) -> bool:
        """Whether a point lies inside."""
        x, y = (self.corners - point).T
        u, v = np.roll(x, -1), np.roll(y, -1)
        crossing = (y > 0.0) != (v > 0.0)
        return bool(np.sum(crossing & ((x * v - u * y > 0.0) == (v > y))) % 2)

    @property
    def graded_corners(self) -> NDArray[np.float64]:
        """Re-entrant and obtuse corners, towards which cells of a wall shrink, shape (corners, 2)."""
        return np.asarray(self.corners[(self._turns < _OBTUSE) & (np.abs(self._turns) > _GENTLE)])

    @property
    def _turns(self) -> NDArray[np.float64]:
        """The angle by which the outline turns to the left at each corner."""
        ahead = np.roll(self.corners, -1, axis=0) - self.corners
        behind = np.roll(ahead, 1, axis=0)
        return np.arctan2(behind[:, 0] * ahead[:, 1] - behind[:, 1] * ahead[:, 0], (behind * ahead).sum(axis=1))

    def cut(self, mirrors: Mirrors) -> PolygonLoop:
        """Return it with a corner wherever one of its sides crosses a mirror plane."""
        corners = self.corners
        for axis, mirror in enumerate(mirrors):
            if mirror is not None:
                away, ahead = corners[:, axis] - mirror, np.roll(corners, -1, axis=0)
                beyond = np.where(np.abs(away) > _FLAT, np.sign(away), 0.0)
                crossing = np.flatnonzero(beyond * np.roll(beyond, -1) < 0.0)
                part = (away / np.where(away == np.roll(away, -1), 1.0, away - np.roll(away, -1)))[:, None]
                corners = np.insert(corners, crossing + 1, (corners + part * (ahead - corners))[crossing], axis=0)
        return PolygonLoop(corners=corners)

    def is_symmetric(self, axis: int, mirror: float) -> bool:
        """Whether it is its own image in a plane."""
        image = self.corners.copy()
        image[:, axis] = 2.0 * mirror - image[:, axis]
        away = np.abs(image[:, None] - self.corners).max(axis=2).min(axis=1)
        return bool(away.max() < _FLAT)


@dataclass(frozen=True, kw_only=True, eq=False)
class CircleLoop:
    """A circle, anticlockwise."""

    centre: NDArray[np.float64]  # shape (2,)
    radius: float

    def parallel(self, distance: float, places: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return points of the concentric circle outside it, at parts of a turn."""
        angles = 2.0 * pi * places
        return self.centre + (self.radius + distance) * np.column_stack([np.cos(angles), np.sin(angles)])

    def places(self, size: float, _towards: Grading, _towards_reentrant: Grading) -> NDArray[np.float64]:
        """Return where the nodes lie, in parts of a turn; it has no corners."""
        # Of a whole number of nodes in a quarter some lie on planes of symmetry.
        count = 4 * max(ceil(0.5 * pi * self.radius / size), 3)
        return np.arange(count) / count

    def cut(self, _mirrors: Mirrors) -> CircleLoop:
        """Return it; it has nodes on planes through its centre."""
        return self

    def is_symmetric(self, axis: int, mirror: float) -> bool:
        """Whether it is its own image in a plane."""
        return bool(abs(self.centre[axis] - mirror) < _FLAT)

    def contains(self, point: NDArray[np.float64]) -> bool:
        """Whether a point lies inside."""
        return bool(np.hypot(*(point - self.centre)) < self.radius)

    @property
    def graded_corners(self) -> NDArray[np.float64]:
        """It has no corners."""
        return np.empty((0, 2))


Loop = PolygonLoop | CircleLoop


@dataclass(frozen=True, kw_only=True)
class PlanRegion:
    """A region of a plan."""

    name: str  # physical name of its cells
    outside: Loop  # its outer loop
    inside: tuple[Loop, ...] = ()  # loops of its holes

    @property
    def loops(self) -> tuple[Loop, ...]:
        """Its outer loop and those of its holes."""
        return (self.outside, *self.inside)

    def gap(self, other: PlanRegion) -> float:
        """Return the distance of its loops from those of another region, as far as a few hundred points show it.

        It is 0 where they cross.
        """
        return min(_gap(one, another) for one in self.loops for another in other.loops)

    def contains(self, other: PlanRegion) -> bool:
        """Whether the outer loop of another region, which crosses none of its own, lies in it."""
        point = other.outside.parallel(0.0, np.zeros(1))[0]
        return self.outside.contains(point) and not any(hole.contains(point) for hole in self.inside)


def image_count(mirrors: Mirrors) -> int:
    """Return the number of parts that planes of symmetry make."""
    return 2 ** sum(mirror is not None for mirror in mirrors)


def kept_by(mirrors: Mirrors, points: NDArray[np.float64], near: float) -> NDArray[np.bool_]:
    """Return which points lie on the kept side of mirror planes, or as close to them as said."""
    kept = np.full(len(points), True)
    for axis, mirror in enumerate(mirrors):
        if mirror is not None:
            kept &= points[:, axis] > mirror - near
    return kept


def _fitting(grading: Grading, length: float) -> Grading:
    """Distances in parts of a side, the largest of which is 0.3 of it at most."""
    return grading * min(1.0 / length, 0.3 / grading[-1]) if len(grading) else grading


def gaps_around(walls: tuple[Loop, ...], edges: tuple[Loop, ...]) -> NDArray[np.float64]:
    """Return the distances of each edge from the next wall and from the next edge, shape (edges, 2)."""
    gaps = np.full((len(edges), 2), np.inf)
    for number, loop in enumerate(edges):
        gaps[number, 0] = min(_gap(loop, wall) for wall in walls)
        for other in range(number):
            gaps[[number, other], 1] = np.minimum(gaps[[number, other], 1], _gap(loop, edges[other]))
    return gaps


def room_between(walls: tuple[Loop, ...], edges: tuple[Loop, ...]) -> float:
    """Two fifths of the smallest distance between two loops, and a third of the smallest length along one."""
    inner = [loop.radius / 3.0 if isinstance(loop, CircleLoop) else _inner_room(loop) for loop in edges]
    return min(0.4 * float(gaps_around(walls, edges).min(initial=np.inf)), *inner, np.inf)


def _gap(one: Loop, other: Loop) -> float:
    """Distance of two loops: of the points of one from the straight pieces between those of the other."""
    first, second = (loop.parallel(0.0, loop.places(_extent(loop) / 60.0, UNGRADED, UNGRADED)) for loop in (one, other))
    gap = min(distance_from(first, second), distance_from(second, first))
    if gap < max(_extent(one), _extent(other)) / 60.0:
        starts, ends = (np.vstack([np.roll(loop, turn, axis=0) for loop in (first, second)]) for turn in (0, -1))
        gap = 0.0 if crossing_pair(starts, ends) is not None else gap
    return gap


def _extent(loop: Loop) -> float:
    return float(np.ptp(loop.parallel(0.0, np.linspace(0.0, 1.0, 200) * _turns(loop)), axis=0).max())


def _turns(loop: Loop) -> float:
    return len(loop.corners) - 1e-9 if isinstance(loop, PolygonLoop) else 1.0


def _inner_room(loop: PolygonLoop) -> float:
    """The offset inwards at which a side of the polygon vanishes, a third of it."""
    here = loop.parallel(0.0, np.arange(len(loop.corners), dtype=float))
    there = loop.parallel(-1.0, np.arange(len(loop.corners), dtype=float))
    lengths = np.linalg.norm(np.roll(here, -1, axis=0) - here, axis=1)
    sides = (np.roll(here, -1, axis=0) - here) / lengths[:, None]
    shrinking = ((np.roll(there, -1, axis=0) - there) * sides).sum(axis=1)
    rate = np.abs(lengths - shrinking)
    return float((lengths / np.maximum(rate, 1e-12)).min()) / 3.0
