"""Exponents of the singular points of ψ in a tank, for all modes or for those of one symmetry.

In a sector of angle θ between walls, bodies and mirror planes ψ ~ r^α with α = π/θ, and α = π/(2θ) where ψ = 0 on one
side; an integer α brings r^α ln r, by incompatible loads of both sides. In a tank that is its own mirror image the
middle plane is a wall for symmetric modes and has ψ = 0 for antisymmetric ones: at the ends of a thin float in the
middle α is 1 for the former and 1/2 for the latter. The load of a thin ellipse, ω′ ~ r^{-1/2}, brings r^{1/2} to both.
"""

from __future__ import annotations

from dataclasses import replace
from math import inf

from hydroelastic.fem.closed.outline import tank_outline, zero_potential_surfaces
from hydroelastic.fem.tank.singularities import singular_points
from hydroelastic.meshes.geometry import LEFT_WALL, RIGHT_WALL, SYMMETRY_PLANE
from hydroelastic.meshes.outline import Outline, Point
from hydroelastic.physics.symmetry import PARITIES, Parity, is_mirror_image
from hydroelastic.physics.tank import MIDDLE, Tank

# Names of walls and mirror plane that `singular_points` does not treat as mirrors, which it does for all modes at once.
_WALL, _PLANE = "wall", "plane"


def plain_outline(tank: Tank, size: float = inf, *, half: bool) -> Outline:
    """Return the outline of a tank, or of its left half, with one size of elements along levels and floats, in tank
    lengths, without rings."""
    return tank_outline(tank, (size,) * len(tank.pieces), half=half)


def has_curved_contours(tank: Tank) -> bool:
    """Whether a float's contour, which the mesh follows, is curved."""
    return any(curve.path is not None for curve in plain_outline(tank, half=False).curves)


def singular_exponents(tank: Tank, parity: Parity | None = None) -> dict[Point, float]:
    """Return α of every singular point, of a symmetric tank in its left half."""
    if not tank.bodies:
        return {}
    if not is_mirror_image(tank):
        return _exponents(tank, None)
    if parity is not None:
        return _exponents(tank, parity)
    one, other = (_exponents(tank, parity) for parity in PARITIES)
    return {point: min(one[point], other[point]) for point in one}


def sharpest_of(tank: Tank, parity: Parity | None = None) -> float | None:
    """Return the smallest α of all singular points; ``None`` where ψ is smooth.

    1 at a tip beside a free surface or a lid, 1/2 beside a surface with ψ = 0, 2 where a free end meets a wall; π/θ at
    the corner of a float with the liquid's angle θ.
    """
    return min(singular_exponents(tank, parity).values(), default=None)


def symmetries_apart(tank: Tank) -> tuple[Parity, ...]:
    """Return both symmetries if their smallest α differ, so that their modes converge at different orders; else
    none."""
    if not is_mirror_image(tank):
        return ()
    one, other = (sharpest_of(tank, parity) for parity in PARITIES)
    return () if one == other else PARITIES


def _exponents(tank: Tank, parity: Parity | None) -> dict[Point, float]:
    outline = plain_outline(tank, half=parity is not None)
    zero_potential = zero_potential_surfaces(tank, infinite_frequency=False)
    # Only points that are singular for some mode: smooth contours cross the middle plane at right angles.
    singular = {
        point.point for point in singular_points(outline, zero_potential=zero_potential, continuous_pressure=False)
    }
    unmirrored = replace(
        outline, curves=tuple(replace(curve, name=_unmirrored(curve.name)) for curve in outline.curves)
    )
    plane = (_PLANE,) if parity == "antisymmetric" else ()
    found = singular_points(unmirrored, zero_potential=zero_potential + plane, continuous_pressure=False)
    smooth = _ends_of_guided_beams(tank)
    blunt = _ends_of_thin_ellipses(tank)
    return {
        point.point: min(point.exponent, 0.5) if point.point in blunt else point.exponent
        for point in found
        if point.point in singular and point.point not in smooth
    }


def _unmirrored(name: str) -> str:
    return {LEFT_WALL: _WALL, RIGHT_WALL: _WALL, SYMMETRY_PLANE: _PLANE}.get(name, name)


def _ends_of_guided_beams(tank: Tank) -> set[Point]:
    """Guided ends at walls: beam and liquid continue smoothly as their images beyond the wall."""
    return {
        (x, tank.level_of(index).height)
        for index, beam in tank.beams.items()
        if beam.ends == "guided"
        for x in (0.0, MIDDLE, 1.0)
    }


def _ends_of_thin_ellipses(tank: Tank) -> set[Point]:
    return {
        (hull.waterplane[0], y)
        for hull in tank.hulls.values()
        if hull.profile is not None and hull.is_thin and hull.profile.shape == "ellipse"
        for y in hull.slit
    }
