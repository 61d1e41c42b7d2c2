"""Singular points of ψ with their exponents: ends of bodies, corners of contours, contact points, ends of slits.

In a wedge of angle β ψ behaves like r^α: α = π/β between walls and bodies, π/(2β) where ψ = 0 on one of its sides. At a
beam's tip, β = π, it is r ln r for α = 1. The energy of ∇ψ within r of the corner is about r^{2α}.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator
from dataclasses import dataclass
from math import atan2, dist, inf, pi

import numpy as np

from hydroelastic.fem.tank.outline import Sizes, tank_outline, unsized, zero_potential_surfaces
from hydroelastic.meshes.geometry import AXIS, BOTTOM, LEFT_WALL, RIGHT_WALL, SYMMETRY_PLANE
from hydroelastic.meshes.outline import Outline, Point
from hydroelastic.physics.dofs import body_number
from hydroelastic.physics.tank import Tank

_MIRRORS = (AXIS, LEFT_WALL, RIGHT_WALL, SYMMETRY_PLANE)

_WALLS = {BOTTOM, *_MIRRORS}

# Largest change of direction at a joint of arcs that counts as smooth, rad.
_SMOOTH = 1e-6
# α of a smooth body at an interface across which ρψ is continuous: r² ln r beside the jump of the slope.
_JUMP = 2.0
# α where the flux on a side jumps: r ln r.
_SIDE_JUMPS = 1.0
# Parameter of a curve from its end at which its direction there is taken.
_NEAR = 1e-7


@dataclass(frozen=True, kw_only=True)
class SingularPoint:
    """A point where ψ is singular.

    Attributes:
        point: coordinates, in units of the outline.
        exponent: α of the sharpest term r^α.
        grading_distance: largest radius of graded rings: less than half the distance to the next end of a curve, and
            the sizes of elements beside the point.
    """

    point: Point
    exponent: float
    grading_distance: float


@dataclass(frozen=True, kw_only=True)
class _Wedge:
    """A region's wedge at a point, between the curve of its boundary that leaves the point and the one that arrives."""

    leaving: int
    coming: int
    angle: float


def singular_points(
    outline: Outline,
    *,
    zero_potential: tuple[str, ...],
    continuous_pressure: bool,
    kinks: dict[Point, float] | None = None,
) -> tuple[SingularPoint, ...]:
    """Find the singular points of an outline."""
    wedges = _wedges(outline)
    points = []
    for point, around in wedges.items():
        sharpest = min(
            (_exponent(sector, zero_potential, continuous_pressure) for sector in _sectors(outline, around)),
            default=inf,
        )
        sharpest = min(sharpest, (kinks or {}).get(point, inf))
        if sharpest < inf:
            points.append(
                SingularPoint(
                    point=point, exponent=sharpest, grading_distance=_grading_distance(outline, point, wedges)
                )
            )
    return tuple(points)


def _wedges(outline: Outline) -> dict[Point, list[_Wedge]]:
    found: dict[Point, list[_Wedge]] = defaultdict(list)
    for region in outline.regions:
        for (coming, forward), (leaving, onwards) in zip(region.loop, (*region.loop[1:], region.loop[0]), strict=True):
            point = outline.curves[leaving].start if onwards else outline.curves[leaving].end
            back = _direction(outline, coming, from_start=not forward)
            ahead = _direction(outline, leaving, from_start=onwards)
            found[point].append(_Wedge(leaving=leaving, coming=coming, angle=(back - ahead) % (2.0 * pi)))
    return found


def _direction(outline: Outline, number: int, *, from_start: bool) -> float:
    t = np.array([0.0, _NEAR]) if from_start else np.array([1.0, 1.0 - _NEAR])
    curve = outline.curves[number]
    (x, y), (x_near, y_near) = curve.at(t)
    return atan2(y_near - y, x_near - x)


@dataclass(frozen=True, kw_only=True)
class _Sector:
    names: tuple[str, str]
    angle: float
    crossed: bool


def _sectors(outline: Outline, around: list[_Wedge]) -> Iterator[_Sector]:
    by_leaving = {wedge.leaving: wedge for wedge in around}
    inner = {wedge.coming for wedge in around if wedge.coming in by_leaving and not outline.curves[wedge.coming].cut}
    for wedge in around:
        if wedge.leaving in inner:
            continue
        angle, last = wedge.angle, wedge.coming
        while last in inner:
            angle, last = angle + by_leaving[last].angle, by_leaving[last].coming
        names = outline.curves[wedge.leaving].name, outline.curves[last].name
        yield _Sector(names=names, angle=angle, crossed=last != wedge.coming)


def _exponent(sector: _Sector, zero_potential: tuple[str, ...], continuous_pressure: bool) -> float:
    """α in a sector; infinite where ψ is smooth."""
    # A wall is a mirror: the sector continues as its image.
    angle = sector.angle * (2.0 if any(name in _MIRRORS for name in sector.names) else 1.0)
    if not any(body_number(name) for name in sector.names):
        # Between walls ψ is singular at corners of the bed that point into the liquid.
        return pi / angle if set(sector.names) <= _WALLS and angle > pi + _SMOOTH else inf
    if (len(set(sector.names)) == 1 or {AXIS, SYMMETRY_PLANE} & {*sector.names}) and abs(angle - pi) < _SMOOTH:
        # Where two liquids meet a smooth body the slope of ψ jumps.
        return _JUMP if continuous_pressure and sector.crossed else inf
    return (0.5 if any(name in zero_potential for name in sector.names) else 1.0) * pi / angle


def _grading_distance(outline: Outline, point: Point, wedges: dict[Point, list[_Wedge]]) -> float:
    others = [dist(point, other) for other in wedges if other != point]
    beside = {number for wedge in wedges[point] for number in (wedge.leaving, wedge.coming)}
    return min(0.45 * min(others), *(outline.curves[number].size for number in beside))


def tank_singular_points(
    tank: Tank, sizes: Sizes, *, half: bool, infinite_frequency: bool
) -> tuple[SingularPoint, ...]:
    """Return the singular points of a tank, or of its left half; see `tank_outline`."""
    return singular_points(
        tank_outline(tank, sizes, half=half, infinite_frequency=infinite_frequency),
        zero_potential=zero_potential_surfaces(tank, infinite_frequency=infinite_frequency),
        continuous_pressure=infinite_frequency,
        kinks=_kinks(tank),
    )


def weak_corners(tank: Tank, *, half: bool) -> dict[Point, float]:
    """Corners of bed and walls, and the bed's tip on the axis, where ψ ~ r^α is too weak for rings: α from 1 to 3."""
    outline = tank_outline(tank, unsized(tank), half=half, infinite_frequency=False)
    found = {}
    for point, around in _wedges(outline).items():
        for names, angle in ((set(sector.names), sector.angle) for sector in _sectors(outline, around)):
            exponent = pi / (angle * (2.0 if names & {AXIS, SYMMETRY_PLANE} else 1.0))
            if BOTTOM in names <= _WALLS and 1.0 + _SMOOTH < exponent < 3.0 and abs(exponent - 2.0) > _SMOOTH:
                found[point] = exponent
    return found


def _kinks(tank: Tank) -> dict[Point, float]:
    """Points of bodies at which the displacement of a thin float jumps, or the slope or curvature of a beam."""
    on_hulls = {kink: _SIDE_JUMPS for hull in tank.hulls.values() for kink in hull.kinks}
    on_levels = {
        (x, tank.level_of(index).height): exponent
        for index in range(len(tank.bodies))
        for x, exponent in tank.nodes_of(index).items()
    }
    return on_hulls | on_levels
