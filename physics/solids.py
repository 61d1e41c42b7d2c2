"""Contours of floating solids of revolution: cylinder, sphere, ellipsoid, cone, an outline [r, z], and rings."""

from __future__ import annotations

from typing import Literal, TypeAlias

from hydroelastic.physics.contours import Point
from hydroelastic.physics.point_contours import polygon_contour
from hydroelastic.physics.profiles import FloatShape, float_profile, profile_contour
from hydroelastic.physics.revolution import SolidOfRevolution

SolidShape: TypeAlias = Literal["cylinder", "sphere", "ellipsoid", "cone", "revolved"]

_PROFILES: dict[SolidShape, FloatShape] = {
    "cylinder": "rectangle",
    "sphere": "ellipse",
    "ellipsoid": "ellipse",
    "cone": "wedge",
}


def solid_of_revolution(
    shape: SolidShape,
    *,
    radius: float = 0.0,
    draught: float | None = None,
    inner_radius: float = 0.0,
    outline: tuple[Point, ...] = (),
) -> SolidOfRevolution:
    """Return a solid in its own frame, m: r = 0 on its axis, z = 0 at its reference level.

    The reference level is the still level unless a mass immerses the solid otherwise. What rises above it is its mirror
    image in it, but for spheres and outlines.

    Args:
        radius: largest radius, that of all shapes but outlines.
        draught: depth of its lowest point under the reference level; by default the radius.
        inner_radius: of a cylinder with a coaxial hole, a ring.
        outline: corners [r, z] of a revolved outline, from the axis back to the axis, or around the section of a ring.
    """
    depth = radius if draught is None else draught
    if shape == "revolved":
        around = outline if all(r > 0.0 for r, _ in outline) else (*outline, *((-r, z) for r, z in outline[::-1] if r))
        return SolidOfRevolution(polygon_contour(around))
    if inner_radius:
        corners = ((inner_radius, -depth), (radius, -depth), (radius, depth), (inner_radius, depth))
        return SolidOfRevolution(polygon_contour(corners))
    height = radius if shape == "sphere" else depth
    contour = profile_contour(float_profile(_PROFILES[shape], radius, height))
    return SolidOfRevolution(contour.moved((0.0, height - depth)))
