"""Where ψ is singular: ends of bodies, corners of contours, contact points, ends of slits; and how sharply.

In a wedge of angle β ψ behaves like r^α: α = π/β between walls and bodies, π/(2β) where ψ = 0 on one of its sides. At a
beam's tip, β = π, it is r ln r for α = 1. The energy of ∇ψ within r of the corner is about r^{2α}.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterator
from dataclasses import dataclass
from math import atan2, dist, inf, pi

import numpy as np

from hydroelastic.fem.tank.outline import Sizes, grounded_names, tank_outline
from hydroelastic.meshes.geometry import LEFT_WALL, RIGHT_WALL, SYMMETRY_PLANE
from hydroelastic.meshes.outline import Outline, Point
from hydroelastic.physics.dofs import body_number
from hydroelastic.physics.tank import Tank

_MIRRORS = (LEFT_WALL, RIGHT_WALL, SYMMETRY_PLANE)

# Joints of smooth arcs turn by rounding and by how the arcs are given.
_SMOOTH = 1e-6
# α of a smooth body between two liquids that move as one: r² ln r beside the jump of the slope.
_JUMP = 2.0
# α where the flux on a side jumps: r ln r.
_SIDE_JUMPS = 1.0
# How far along a curve its direction at an end is taken.
_NEAR = 1e-7


@dataclass(frozen=True, kw_only=True)
class SingularPoint:
    """A point where ψ is singular.

    Attributes:
        point: where.
        exponent: α of the sharpest term there.
        reach: how far it may be graded: distance to the next end of a curve, and sizes of elements beside it.
    """

    point: Point
    exponent: float
    reach: float


@dataclass(frozen=True, kw_only=True)
class _Wedge:
    """A region's part around a point: from the curve that leaves the point counterclockwise to the one that comes."""

    leaving: int
    coming: int
    angle: float


def singular_points(
    outline: Outline, *, grounded: tuple[str, ...], continuous_pressure: bool, kinks: dict[Point, float] | None = None
) -> tuple[SingularPoint, ...]:
    """Find the singular points of an outline.

    Args:
        outline: the liquids.
        grounded: names of curves with ψ = 0.
        continuous_pressure: whether liquids of different densities move as one across uncut lines.
        kinks: points of smooth sides at which what is prescribed, or a derivative of it, jumps, with α there.
    """
    wedges = _wedges(outline)
    points = []
    for point, around in wedges.items():
        sharpest = min(
            (_exponent(sector, grounded, continuous_pressure) for sector in _sectors(outline, around)), default=inf
        )
        sharpest = min(sharpest, (kinks or {}).get(point, inf))
        if sharpest < inf:
            points.append(SingularPoint(point=point, exponent=sharpest, reach=_reach(outline, point, wedges)))
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
    """Angle at which a curve leaves one of its ends."""
    t = np.array([0.0, _NEAR]) if from_start else np.array([1.0, 1.0 - _NEAR])
    curve = outline.curves[number]
    (x, y), (x_near, y_near) = curve.at(t)
    return atan2(y_near - y, x_near - x)


@dataclass(frozen=True, kw_only=True)
class _Sector:
    """Wedges that no boundary parts."""

    names: tuple[str, str]
    angle: float
    crossed: bool


def _sectors(outline: Outline, around: list[_Wedge]) -> Iterator[_Sector]:
    """Wedges with those beyond uncut lines joined to them."""
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


def _exponent(sector: _Sector, grounded: tuple[str, ...], continuous_pressure: bool) -> float:
    """α in a sector; infinite where ψ is smooth."""
    if not any(body_number(name) for name in sector.names):
        return inf
    # A wall is a mirror: beyond it the sector goes on as its image.
    angle = sector.angle * (2.0 if any(name in _MIRRORS for name in sector.names) else 1.0)
    if (len(set(sector.names)) == 1 or SYMMETRY_PLANE in sector.names) and abs(angle - pi) < _SMOOTH:
        # Where two liquids meet a smooth body the slope of ψ jumps.
        return _JUMP if continuous_pressure and sector.crossed else inf
    return (0.5 if any(name in grounded for name in sector.names) else 1.0) * pi / angle


def _reach(outline: Outline, point: Point, wedges: dict[Point, list[_Wedge]]) -> float:
    others = [dist(point, other) for other in wedges if other != point]
    beside = {number for wedge in wedges[point] for number in (wedge.leaving, wedge.coming)}
    return min(0.45 * min(others), *(outline.curves[number].size for number in beside))


def tank_singular_points(
    tank: Tank, sizes: Sizes, *, half: bool, infinite_frequency: bool
) -> tuple[SingularPoint, ...]:
    """The singular points of a scene, or of its left half; see `tank_outline`."""
    return singular_points(
        tank_outline(tank, sizes, half=half, infinite_frequency=infinite_frequency),
        grounded=grounded_names(tank, infinite_frequency=infinite_frequency),
        continuous_pressure=infinite_frequency,
        kinks=_kinks(tank),
    )


def _kinks(tank: Tank) -> dict[Point, float]:
    """Points of bodies at which the displacement of a thin float jumps, or the slope or curvature of a beam."""
    on_hulls = {kink: _SIDE_JUMPS for hull in tank.hulls.values() for kink in hull.kinks}
    on_levels = {
        (x, tank.level_of(index).height): exponent
        for index in range(len(tank.bodies))
        for x, exponent in tank.nodes_of(index).items()
    }
    return on_hulls | on_levels
