"""Singular points of ψ with their exponents: ends of bodies, corners of contours, contact points, ends of slits.

In a wedge of angle β ψ behaves like r^α: α = π/β between walls and bodies, π/(2β) where ψ = 0 on one of its sides. At a
beam's tip, β = π, it is r ln r for α = 1. The energy of ∇ψ within r of the corner is about r^{2α}.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import dist, inf, pi

from hydroelastic.fem.closed.outline import (
    SMOOTH,
    WALLS,
    Wedge,
    exponent_in,
    kinks,
    sectors,
    tank_outline,
    unsized,
    wedges,
    zero_potential_surfaces,
)
from hydroelastic.meshes.geometry import AXIS, BOTTOM, SYMMETRY_PLANE
from hydroelastic.meshes.outline import Outline, Point
from hydroelastic.physics.tank import Tank


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


def singular_points(
    outline: Outline,
    *,
    zero_potential: tuple[str, ...],
    continuous_pressure: bool,
    jumps: dict[Point, float] | None = None,
) -> tuple[SingularPoint, ...]:
    """Find the singular points of an outline."""
    ends = wedges(outline)
    points = []
    for point, around in ends.items():
        sharpest = min(
            (exponent_in(sector, zero_potential, continuous_pressure) for sector in sectors(outline, around)),
            default=inf,
        )
        sharpest = min(sharpest, (jumps or {}).get(point, inf))
        if sharpest < inf:
            points.append(
                SingularPoint(point=point, exponent=sharpest, grading_distance=_grading_distance(outline, point, ends))
            )
    return tuple(points)


def _grading_distance(outline: Outline, point: Point, ends: dict[Point, list[Wedge]]) -> float:
    others = [dist(point, other) for other in ends if other != point]
    beside = {number for wedge in ends[point] for number in (wedge.leaving, wedge.coming)}
    return min(0.45 * min(others), *(outline.curves[number].size for number in beside))


def tank_singular_points(
    tank: Tank, sizes: tuple[float, ...], *, half: bool, infinite_frequency: bool
) -> tuple[SingularPoint, ...]:
    """Return the singular points of a tank, or of its left half; see `tank_outline`."""
    return singular_points(
        tank_outline(tank, sizes, half=half, joined=infinite_frequency),
        zero_potential=zero_potential_surfaces(tank, infinite_frequency=infinite_frequency),
        continuous_pressure=infinite_frequency,
        jumps=kinks(tank),
    )


def weak_corners(tank: Tank, *, half: bool) -> dict[Point, float]:
    """Corners of bed and walls, and the bed's tip on the axis, where ψ ~ r^α is too weak for rings: α from 1 to 3."""
    outline = tank_outline(tank, unsized(tank), half=half)
    found = {}
    for point, around in wedges(outline).items():
        for names, angle in ((set(sector.names), sector.angle) for sector in sectors(outline, around)):
            exponent = pi / (angle * (2.0 if names & {AXIS, SYMMETRY_PLANE} else 1.0))
            if BOTTOM in names <= WALLS and 1.0 + SMOOTH < exponent < 3.0 and abs(exponent - 2.0) > SMOOTH:
                found[point] = exponent
    return found
