"""The liquids of a scaled tank as a planar outline: layers, still levels, wetted contours, slits of thin floats.

Each layer is bounded from below by the bottom or the level under it, from above by its own level; at a
float the boundary follows its wetted contour. A thin float is a slit: its layer is divided by the vertical line through
it, which is not a boundary beyond the end of the slit.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from itertools import pairwise
from math import inf

import numpy as np

from hydroelastic.meshes.geometry import (
    AXIS,
    BOTTOM,
    FREE_SURFACE,
    INTERFACE,
    LEFT_WALL,
    LID,
    LIQUID,
    LOWER_LIQUID,
    RIGHT_WALL,
    SYMMETRY_PLANE,
    UPPER_LIQUID,
)
from hydroelastic.meshes.outline import Curve, Outline, Point, Region
from hydroelastic.meshes.tagged_mesh import MeshError
from hydroelastic.physics.contours import Arc, bowl_arc, root
from hydroelastic.physics.dofs import body_name, body_number
from hydroelastic.physics.hulls import Hull
from hydroelastic.physics.tank import MIDDLE, Piece, StillLevel, Tank

# Largest element along the sphere of a bowl, in radii of its surface.
_OF_BOWL = 0.5
Directed = tuple[int, bool]


@dataclass(frozen=True, kw_only=True)
class Sizes:
    """Largest sizes of elements in tank lengths: on each piece of all levels, and on the contour of each float by
    index."""

    pieces: tuple[float, ...]
    contours: dict[int, float]


def unsized(tank: Tank) -> Sizes:
    """Return infinite sizes of elements."""
    return Sizes(pieces=(inf,) * len(tank.pieces), contours=dict.fromkeys(tank.hulls, inf))


def layer_names(tank: Tank) -> tuple[str, ...]:
    """Return the physical names of the cells of each layer, from the bottom up."""
    return (LIQUID,) if len(tank.layers) == 1 else (LOWER_LIQUID, UPPER_LIQUID)


def zero_potential_surfaces(tank: Tank, *, infinite_frequency: bool) -> tuple[str, ...]:
    """Return the names of surfaces with ψ = 0: a pressure-release top, or in the infinite-frequency limit a free
    one."""
    is_zero = tank.top == "pressure_release" or (infinite_frequency and tank.top == "free")
    return (FREE_SURFACE,) if is_zero and tank.levels[-1].is_open else ()


def zero_on_axis(tank: Tank) -> tuple[str, ...]:
    """Return the name of the axis of revolution where ψ = 0 on it, as finite energy asks but for order 0."""
    return (AXIS,) if tank.geometry.is_revolved and tank.geometry.order else ()


def tank_outline(tank: Tank, sizes: Sizes, *, half: bool = False, infinite_frequency: bool = False) -> Outline:
    """Return the outline of a tank, or of its left half, without graded points."""
    builder = _Builder(
        tank=tank, sizes=sizes, right=MIDDLE if half else 1.0, half=half, infinite_frequency=infinite_frequency
    )
    regions = [region for number in range(len(tank.layers)) for region in builder.layer(number)]
    return Outline(curves=tuple(builder.curves), regions=tuple(regions))


@dataclass(kw_only=True)
class _Builder:
    tank: Tank
    sizes: Sizes
    right: float
    half: bool
    infinite_frequency: bool
    curves: list[Curve] = field(default_factory=list)
    _numbers: dict[tuple[str, Point, Point], int] = field(default_factory=dict)

    def layer(self, number: int) -> Iterator[Region]:
        """The regions of one layer: one, or several beside each other where thin floats split it."""
        name = layer_names(self.tank)[number]
        splits = self._splits(number)
        marks = tuple(splits)
        floor, ceiling = self._floor(number, marks), self._ceiling(number, marks)
        sides = [0.0, *(x for x in marks if x < self.right), self.right]
        for left, right in pairwise(sides):
            below, above = self._between(floor, left, right), self._between(ceiling, left, right)
            up = self._side(number, right, self._last(below), self._last(above), splits)
            down = self._side(number, left, self._first(below), self._first(above), splits)
            yield Region(name=name, loop=(*below, *up, *_reversed(above), *_reversed(down)))

    def _splits(self, number: int) -> dict[float, list[int]]:
        """Abscissae of the thin floats in a layer, with the indices of the floats."""
        splits: dict[float, list[int]] = {}
        for index, hull in self.tank.hulls.items():
            level = self.tank.level_of(index)
            if hull.is_thin and number in (level.below, level.above):
                splits.setdefault(hull.waterplane[0], []).append(index)
        return dict(sorted(splits.items()))

    def _floor(self, number: int, marks: tuple[float, ...]) -> list[Directed]:
        if number > 0:
            return self._level(self.tank.levels[number - 1], marks, upper_side=True)
        if self.tank.bed == "sphere":
            arc = bowl_arc(self.tank.layers[0].depth, 1.0)
            # Cells of the size of the radius follow it to the order of their degree.
            return [(self._curve(BOTTOM, arc.start, arc.end, arc=arc, size=_OF_BOWL), True)]
        if self.tank.bed is not None:
            return [(self._curve(BOTTOM, *ends), True) for ends in pairwise(self.tank.bed)]
        y = self.tank.layers[0].floor
        stops = [0.0, *(x for x in marks if x < self.right), self.right]
        return [(self._curve(BOTTOM, (start, y), (end, y)), True) for start, end in pairwise(stops)]

    def _ceiling(self, number: int, marks: tuple[float, ...]) -> list[Directed]:
        return self._level(self.tank.levels[number], marks, upper_side=False)

    def _level(self, level: StillLevel, marks: tuple[float, ...], *, upper_side: bool) -> list[Directed]:
        # Both layers must divide the level at the slits of either.
        other = level.above if not upper_side else level.below
        stops = sorted({*marks, *(self._splits(other) if other is not None else ())})
        first = sum(len(lower.pieces) for lower in self.tank.levels[: level.below])
        path: list[Directed] = []
        for place, piece in enumerate(level.pieces, first):
            if piece.start >= self.right:
                break
            hull = self.tank.hulls.get(piece.body) if piece.body is not None else None
            if hull is not None:
                path += self._contour(piece, hull, stops, upper_side=upper_side)
            else:
                path += self._flat(level, piece, stops, self.sizes.pieces[place])
        return path

    def _flat(self, level: StillLevel, piece: Piece, stops: list[float], size: float) -> list[Directed]:
        end = min(piece.end, self.right)
        nodes = self.tank.nodes_of(piece.body) if piece.body is not None else ()
        marks = [piece.start, *(x for x in sorted({*stops, *nodes}) if piece.start < x < end), end]
        name, cut = self._condition(level, piece)
        return [
            (self._curve(name, (start, level.height), (stop, level.height), size=size, cut=cut), True)
            for start, stop in pairwise(marks)
        ]

    def _condition(self, level: StillLevel, piece: Piece) -> tuple[str, bool]:
        """Physical name of a piece, and whether the liquids above and below it have separate nodes."""
        if piece.body is not None:
            return body_name(piece.body + 1), level.above is not None
        if level.above is not None:
            return ("", False) if self.infinite_frequency else (INTERFACE, True)
        return (LID if level.kind == "rigid" else FREE_SURFACE), False

    def _contour(self, piece: Piece, hull: Hull, stops: list[float], *, upper_side: bool) -> list[Directed]:
        assert piece.body is not None
        if hull.is_thin:
            return []
        low, high = hull.bounds[:2]
        on_axis = self.tank.geometry.is_revolved and low < 0.0
        if any(low < x < high for x in stops):
            raise MeshError(f"a thin float needs free liquid above and below it: body {piece.body + 1} is in its way")
        arcs = hull.above if upper_side else hull.below
        if self.half and high > self.right:
            arcs = arcs_beside(arcs, self.right, -1.0)
        if on_axis:
            arcs = arcs_beside(arcs, 0.0, 1.0)
        size, name = self.sizes.contours[piece.body], body_name(piece.body + 1)
        path = [
            (self._curve(name, smooth.start, smooth.end, arc=None if smooth.straight else smooth, size=size), True)
            for arc in arcs
            for smooth in _smooth_pieces(arc)
        ]
        # Contours are counterclockwise: above the float they run from right to left.
        return _reversed(path) if upper_side else path

    def _side(self, number: int, x: float, bottom: Point, top: Point, splits: dict[float, list[int]]) -> list[Directed]:
        """The vertical line at x from the floor to the ceiling: a wall, the mirror plane, or a line through slits."""
        name = "" if 0.0 < x < self.right else self._left if x == 0.0 else SYMMETRY_PLANE if self.half else RIGHT_WALL
        pieces = [(bottom, top, name)]
        # From the floor up: one slit may begin at the floor, another end at the ceiling.
        for index in sorted(splits.get(x, []), key=lambda index: self.tank.level_of(index).below == number):
            hull = self.tank.hulls[index]
            low, high = hull.slit
            (start, end, _) = pieces.pop()
            hangs = self.tank.level_of(index).below == number
            first, last = ((x, low), end) if hangs else (start, (x, high))
            stops = [first, *(kink for kink in hull.kinks if first[1] < kink[1] < last[1]), last]
            pieces += [(start, first, name)] if hangs else []
            pieces += [(*ends, body_name(index + 1)) for ends in pairwise(stops)]
            pieces += [] if hangs else [(last, end, name)]
        # A shaped bed may rise to the level, and leave no wall.
        pieces = [piece for piece in pieces if piece[0] != piece[1]]
        return [
            (
                self._curve(
                    part, start, end, cut=0.0 < x < self.right and bool(part), size=self._slit_size(part, start, end)
                ),
                True,
            )
            for start, end, part in pieces
        ]

    @property
    def _left(self) -> str:
        return AXIS if self.tank.geometry.is_revolved else LEFT_WALL

    def _slit_size(self, name: str, start: Point, end: Point) -> float:
        number = body_number(name)
        return inf if number is None else min(0.5 * (end[1] - start[1]), self.sizes.contours[number - 1])

    def _curve(
        self,
        name: str,
        start: Point,
        end: Point,
        *,
        arc: Arc | None = None,
        size: float = inf,
        cut: bool = False,
    ) -> int:
        key = name, start, end
        if key not in self._numbers:
            self._numbers[key] = len(self.curves)
            path = None if arc is None else arc.point
            self.curves.append(Curve(name=name, start=start, end=end, path=path, size=size, cut=cut))
        return self._numbers[key]

    def _between(self, path: list[Directed], left: float, right: float) -> tuple[Directed, ...]:
        """The part of a path from x = left to x = right, both of which are ends of curves."""
        return tuple(
            directed
            for directed in path
            if left <= min(self._ends(directed)[0][0], self._ends(directed)[1][0])
            and max(self._ends(directed)[0][0], self._ends(directed)[1][0]) <= right
        )

    def _ends(self, directed: Directed) -> tuple[Point, Point]:
        curve, forward = self.curves[directed[0]], directed[1]
        return (curve.start, curve.end) if forward else (curve.end, curve.start)

    def _first(self, path: tuple[Directed, ...]) -> Point:
        return self._ends(path[0])[0]

    def _last(self, path: tuple[Directed, ...]) -> Point:
        return self._ends(path[-1])[1]


def _reversed(path: tuple[Directed, ...] | list[Directed]) -> list[Directed]:
    return [(number, not forward) for number, forward in reversed(path)]


def _smooth_pieces(arc: Arc) -> Iterator[Arc]:
    if not arc.knots:
        yield arc
        return
    stops = [0.0, *arc.knots, 1.0]
    points = [arc.start, *((float(x), float(y)) for x, y in arc.point(np.array(arc.knots))), arc.end]
    for (first, last), (start, end) in zip(pairwise(stops), pairwise(points), strict=True):
        yield arc.part(first, last, start=start, end=end)


def arcs_beside(arcs: tuple[Arc, ...], x: float, side: float) -> tuple[Arc, ...]:
    """Return the part left (−1) or right (1) of a mirror plane of a contour: its own image, it meets the plane once."""
    kept = []
    for arc in (_onto(arc, x) for arc in arcs):
        start, end = (side * (point[0] - x) for point in (arc.start, arc.end))
        if min(start, end) >= 0.0:
            kept.append(arc)
        elif max(start, end) > 0.0:
            t = _meets(arc, x)
            on_plane = x, float(arc.curve(np.array([t]))[0, 1])
            if start > 0.0:
                kept.append(arc.part(0.0, t, start=arc.start, end=on_plane))
            else:
                kept.append(arc.part(t, 1.0, start=on_plane, end=arc.end))
    return tuple(kept)


def _meets(arc: Arc, x: float) -> float:
    """Parameter at which an arc that begins and ends on different sides of a vertical line crosses it."""
    return root(lambda t: float(arc.curve(np.array([t]))[0, 0]) - x, 0.0, 1.0)


# Rounding of the corners of a float on the mirror plane, in tank lengths.
_ON_PLANE = 1e-13


def _onto(arc: Arc, x: float) -> Arc:
    start, end = ((x, p[1]) if abs(p[0] - x) < _ON_PLANE else p for p in (arc.start, arc.end))
    return replace(arc, start=start, end=end)
