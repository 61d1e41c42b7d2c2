"""The liquids of a tank as a planar outline, and the singular points of ψ in it.

Each layer is bounded from below by the bottom or the level under it, from above by its own level; at a float the
boundary follows its wetted contour. A thin float is a slit: its layer is divided by the vertical line through it, which
is not a boundary beyond the end of the slit.

In a wedge of angle β ψ behaves like r^α: α = π/β between walls and bodies, π/(2β) where ψ = 0 on one of its sides. At a
beam's tip, β = π, it is r ln r for α = 1.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator
from dataclasses import replace
from itertools import pairwise
from math import atan2, inf, pi
from typing import NamedTuple

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

Directed = tuple[int, bool]
"""Number of a curve, and whether it is passed from its start to its end."""

# Largest element along the sphere of a bowl, in radii of its surface.
_OF_BOWL = 0.5


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


def unsized(tank: Tank) -> tuple[float, ...]:
    """Return infinite sizes of elements."""
    return (inf,) * len(tank.pieces)


def tank_outline(tank: Tank, sizes: tuple[float, ...], *, half: bool = False, joined: bool = False) -> Outline:
    """Return the outline of a tank, or of its left half.

    Args:
        tank: dimensionless.
        sizes: largest elements on each piece of the still levels, of a float along its contour.
        half: whether of the left half alone.
        joined: whether two liquids share their nodes at an interface, across which ρψ is continuous then.
    """
    builder = _Builder(tank, sizes, half, joined)
    regions = [region for number in range(len(tank.layers)) for region in builder.layer(number)]
    return Outline(curves=tuple(builder.curves), regions=tuple(regions))


class _Builder:
    def __init__(self, tank: Tank, sizes: tuple[float, ...], half: bool, joined: bool) -> None:
        self.tank, self.half, self.joined, self.right = tank, half, joined, MIDDLE if half else 1.0
        pieces = [(level.below, piece) for level in tank.levels for piece in level.pieces]
        self.sizes = dict(zip(pieces, sizes, strict=True))
        self.contours = {piece.body: size for (_, piece), size in self.sizes.items() if piece.body in tank.hulls}
        self.curves: list[Curve] = []
        self._numbers: dict[tuple[str, Point, Point], int] = {}

    def layer(self, number: int) -> Iterator[Region]:
        """The regions of one layer: one, or several beside each other where thin floats split it."""
        name = layer_names(self.tank)[number]
        splits = self._splits(number)
        marks = tuple(splits)
        floor, ceiling = self._floor(number, marks), self._level(self.tank.levels[number], marks, upper_side=False)
        sides = [0.0, *(x for x in marks if x < self.right), self.right]
        for left, right in pairwise(sides):
            below, above = self._between(floor, left, right), self._between(ceiling, left, right)
            up = self._side(number, right, self._ends(below[-1])[1], self._ends(above[-1])[1], splits)
            down = self._side(number, left, self._ends(below[0])[0], self._ends(above[0])[0], splits)
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

    def _level(self, level: StillLevel, marks: tuple[float, ...], *, upper_side: bool) -> list[Directed]:
        # Both layers must divide the level at the slits of either.
        other = level.above if not upper_side else level.below
        stops = sorted({*marks, *(self._splits(other) if other is not None else ())})
        path: list[Directed] = []
        for piece in level.pieces:
            if piece.start < self.right and piece.body in self.tank.hulls:
                path += self._contour(piece, self.tank.hulls[piece.body], stops, upper_side=upper_side)
            elif piece.start < self.right:
                path += self._flat(level, piece, stops)
        return path

    def _flat(self, level: StillLevel, piece: Piece, stops: list[float]) -> list[Directed]:
        end, size, y, cut = (
            min(piece.end, self.right),
            self.sizes[level.below, piece],
            level.height,
            level.above is not None,
        )
        name = INTERFACE if cut else LID if level.kind == "rigid" else FREE_SURFACE
        if cut and self.joined and piece.body is None:
            name, cut = "", False
        nodes: dict[float, float] = {}
        if piece.body is not None:
            name, nodes = body_name(piece.body + 1), self.tank.nodes_of(piece.body)
        marks = [piece.start, *(x for x in sorted({*stops, *nodes}) if piece.start < x < end), end]
        return [(self._curve(name, (a, y), (b, y), size=size, cut=cut), True) for a, b in pairwise(marks)]

    def _contour(self, piece: Piece, hull: Hull, stops: list[float], *, upper_side: bool) -> list[Directed]:
        assert piece.body is not None
        if hull.is_thin:
            return []
        low, high = hull.bounds[:2]
        if any(low < x < high for x in stops):
            raise MeshError(f"a thin float needs free liquid above and below it: body {piece.body + 1} is in its way")
        arcs = hull.above if upper_side else hull.below
        if self.half and high > self.right:
            arcs = arcs_beside(arcs, self.right, -1.0)
        if self.tank.geometry.is_revolved and low < 0.0:
            arcs = arcs_beside(arcs, 0.0, 1.0)
        size, name = self.contours[piece.body], body_name(piece.body + 1)
        path = [
            (self._curve(name, smooth.start, smooth.end, arc=None if smooth.straight else smooth, size=size), True)
            for arc in arcs
            for smooth in _smooth_pieces(arc)
        ]
        # Contours are counterclockwise: above the float they run from right to left.
        return _reversed(path) if upper_side else path

    def _side(self, number: int, x: float, bottom: Point, top: Point, splits: dict[float, list[int]]) -> list[Directed]:
        """The vertical line at x from the floor to the ceiling: a wall, the mirror plane, or a line through slits."""
        left, right = AXIS if self.tank.geometry.is_revolved else LEFT_WALL, SYMMETRY_PLANE if self.half else RIGHT_WALL
        name = "" if 0.0 < x < self.right else left if x == 0.0 else right
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
        path: list[Directed] = []
        for start, end, part in pieces:
            body = body_number(part)
            size = inf if body is None else min(0.5 * (end[1] - start[1]), self.contours[body - 1])
            path.append((self._curve(part, start, end, cut=0.0 < x < self.right and bool(part), size=size), True))
        return path

    def _curve(
        self, name: str, start: Point, end: Point, *, arc: Arc | None = None, size: float = inf, cut: bool = False
    ) -> int:
        key = name, start, end
        if key not in self._numbers:
            self._numbers[key] = len(self.curves)
            path = None if arc is None else arc.point
            self.curves.append(Curve(name=name, start=start, end=end, path=path, size=size, cut=cut))
        return self._numbers[key]

    def _between(self, path: list[Directed], left: float, right: float) -> tuple[Directed, ...]:
        """The part of a path from x = left to x = right, both of which are ends of curves."""
        return tuple(own for own in path if all(left <= x <= right for x, _ in self._ends(own)))

    def _ends(self, directed: Directed) -> tuple[Point, Point]:
        curve, forward = self.curves[directed[0]], directed[1]
        return (curve.start, curve.end) if forward else (curve.end, curve.start)


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
    """The part of a contour left (−1) or right (1) of the mirror plane; the contour is its own image and meets it
    once."""
    kept = []
    for arc in (_onto(arc, x) for arc in arcs):
        start, end = (side * (point[0] - x) for point in (arc.start, arc.end))
        if min(start, end) >= 0.0:
            kept.append(arc)
        elif max(start, end) > 0.0:
            t = root(lambda t: float(arc.curve(np.array([t]))[0, 0]) - x, 0.0, 1.0)  # noqa: B023
            on_plane = x, float(arc.curve(np.array([t]))[0, 1])
            if start > 0.0:
                kept.append(arc.part(0.0, t, start=arc.start, end=on_plane))
            else:
                kept.append(arc.part(t, 1.0, start=on_plane, end=arc.end))
    return tuple(kept)


# Rounding of the corners of a float on the mirror plane, in tank lengths.
_ON_PLANE = 1e-13


def _onto(arc: Arc, x: float) -> Arc:
    start, end = ((x, p[1]) if abs(p[0] - x) < _ON_PLANE else p for p in (arc.start, arc.end))
    return replace(arc, start=start, end=end)


_MIRRORS = (AXIS, LEFT_WALL, RIGHT_WALL, SYMMETRY_PLANE)

WALLS = {BOTTOM, *_MIRRORS}

# Largest change of direction at a joint of arcs that counts as smooth, rad.
SMOOTH = 1e-6
# α of a smooth body at an interface across which ρψ is continuous: r² ln r beside the jump of the slope.
_JUMP = 2.0
# α where the flux on a side jumps: r ln r.
_SIDE_JUMPS = 1.0
# ψ with terms weaker than this is smooth enough.
_SMOOTH_ENOUGH = 2.9
# Curvatures that differ by a smaller part are equal; parameters of a curve at which they are taken.
_SAME_CURVATURE, _BESIDE = 0.1, 1e-3
# Parameter of a curve from its end at which its direction there is taken.
_NEAR = 1e-7


class SingularPoint(NamedTuple):
    """A point where ψ has a term like r^α."""

    point: Point
    exponent: float

    @property
    def largest_angle(self) -> float:
        """Of a cell there, rad.

        With mα near 2 the functions of the angle are polynomials of degree 2 or 3 in a cell: halved angles make errors
        at sharp points 10 to 50 times smaller.
        """
        return 0.7 if self.exponent < 0.9 else 1.15

    def power(self, degree: int) -> int:
        """m of cells with r = sᵐ there: mα near 2, more at high degrees."""
        if self.exponent < 0.6:
            return 4 if degree < 8 else 5
        if self.exponent < 0.9:
            return 3 if degree < 8 else 4
        return 3 if self.exponent < 1.5 else 2


def singular_points(tank: Tank, *, half: bool, released: bool) -> tuple[SingularPoint, ...]:
    """Return the singular points of a tank, or of its left half, up to exponents that cells do not feel."""
    outline = tank_outline(tank, unsized(tank), half=half)
    zero = (*zero_potential_surfaces(tank, infinite_frequency=released), *zero_on_axis(tank))
    jumps, smooth = kinks(tank, released=released), _guided(tank)
    points = []
    for point, around in wedges(outline).items():
        if point in smooth:
            continue
        exponents = [exponent_in(sector, zero, released) for sector in sectors(outline, around, released)]
        sharpest = min([*exponents, jumps.get(point, inf), _bend(outline, around)])
        if sharpest < _SMOOTH_ENOUGH:
            points.append(SingularPoint(point, sharpest))
    return tuple(points)


class Wedge(NamedTuple):
    """A region's wedge at a point, between the curve of its boundary that leaves the point and the one that arrives."""

    leaving: int
    coming: int
    angle: float


def wedges(outline: Outline) -> dict[Point, list[Wedge]]:
    """Return the wedges of all regions at each end of a curve."""
    found: dict[Point, list[Wedge]] = defaultdict(list)
    for region in outline.regions:
        for (coming, forward), (leaving, onwards) in zip(region.loop, (*region.loop[1:], region.loop[0]), strict=True):
            point = outline.curves[leaving].start if onwards else outline.curves[leaving].end
            back = _direction(outline, coming, from_start=not forward)
            ahead = _direction(outline, leaving, from_start=onwards)
            found[point].append(Wedge(leaving=leaving, coming=coming, angle=(back - ahead) % (2.0 * pi)))
    return found


def _direction(outline: Outline, number: int, *, from_start: bool) -> float:
    t = np.array([0.0, _NEAR]) if from_start else np.array([1.0, 1.0 - _NEAR])
    curve = outline.curves[number]
    (x, y), (x_near, y_near) = curve.at(t)
    return atan2(y_near - y, x_near - x)


class Sector(NamedTuple):
    names: tuple[str, str]
    angle: float
    crossed: bool


def sectors(outline: Outline, around: list[Wedge], released: bool = False) -> Iterator[Sector]:
    by_leaving = {wedge.leaving: wedge for wedge in around}
    inner = {
        wedge.coming
        for wedge in around
        if wedge.coming in by_leaving
        and not (outline.curves[wedge.coming].cut and not (released and outline.curves[wedge.coming].name == INTERFACE))
    }
    for wedge in around:
        if wedge.leaving in inner:
            continue
        angle, last = wedge.angle, wedge.coming
        while last in inner:
            angle, last = angle + by_leaving[last].angle, by_leaving[last].coming
        names = outline.curves[wedge.leaving].name, outline.curves[last].name
        yield Sector(names=names, angle=angle, crossed=last != wedge.coming)


def exponent_in(sector: Sector, zero_potential: tuple[str, ...], continuous_pressure: bool) -> float:
    """α in a sector; infinite where ψ is smooth."""
    # A wall is a mirror: the sector continues as its image.
    angle = sector.angle * (2.0 if any(name in _MIRRORS for name in sector.names) else 1.0)
    if not any(body_number(name) for name in sector.names):
        # Between walls ψ is singular at corners of the bed that point into the liquid.
        return pi / angle if set(sector.names) <= WALLS and angle > pi + SMOOTH else inf
    if (len(set(sector.names)) == 1 or {AXIS, SYMMETRY_PLANE} & {*sector.names}) and abs(angle - pi) < SMOOTH:
        # Where two liquids meet a smooth body the slope of ψ jumps.
        return _JUMP if continuous_pressure and sector.crossed else inf
    return (0.5 if any(name in zero_potential for name in sector.names) else 1.0) * pi / angle


def _bend(outline: Outline, around: list[Wedge]) -> float:
    """α where the curvature of a contour jumps, as between a straight side and a round bilge; else infinite."""
    for wedge in around:
        curves = [outline.curves[number] for number in (wedge.leaving, wedge.coming)]
        if any(curve.path is not None for curve in curves) and abs(wedge.angle - pi) < SMOOTH:
            point = {curves[0].start, curves[0].end} & {curves[1].start, curves[1].end}
            one, other = (_curvature(curve, from_start=curve.start in point) for curve in curves)
            # Both are seen from the point outwards: of a smooth curve they have opposite signs.
            if abs(one + other) > _SAME_CURVATURE * max(abs(one), abs(other)):
                return 2.0
    return inf


def _curvature(curve: Curve, *, from_start: bool) -> float:
    """Signed curvature of a curve at one of its ends, seen from there."""
    points = curve.at(
        np.array([0.0, _BESIDE, 2.0 * _BESIDE]) if from_start else 1.0 - np.array([0.0, _BESIDE, 2.0 * _BESIDE])
    )
    one, other = points[1] - points[0], points[2] - points[1]
    return float(np.arctan2(one[0] * other[1] - one[1] * other[0], one @ other) / np.hypot(*one))


def kinks(tank: Tank, *, released: bool = False) -> dict[Point, float]:
    """Points of bodies at which the displacement of a thin float jumps, or the slope or curvature of a beam."""
    on_hulls = {kink: _SIDE_JUMPS for hull in tank.hulls.values() for kink in hull.kinks}
    if released:
        # The widest place of a pointed shape may lie at an interface, which is open then.
        on_hulls |= {
            (hull.waterplane[0], hull.height): _SIDE_JUMPS
            for hull in tank.hulls.values()
            if hull.is_thin and hull.wet_above and hull.profile and hull.profile.shape in ("wedge", "exponential")
        }
    on_levels = {
        (x, tank.level_of(index).height): exponent
        for index in range(len(tank.bodies))
        for x, exponent in tank.nodes_of(index).items()
    }
    return on_hulls | on_levels


def _guided(tank: Tank) -> set[Point]:
    """Ends of beams that walls guide: the mirror image in the wall goes on smoothly."""
    return {
        (x, tank.level_of(index).height)
        for index, beam in tank.beams.items()
        if beam.ends == "guided"
        for x in (tank.piece_of(index).start, tank.piece_of(index).end)
    }
