"""Checks of the round plates of a sea: none overlaps another, and none is too soft, stiff, light or heavy."""

from __future__ import annotations

from collections.abc import Iterator
from math import inf

from pydantic_core import InitErrorDetails

from hydroelastic.scenes.models.limits import is_within, shown_range
from hydroelastic.scenes.models.problems import problem_at
from hydroelastic.scenes.models.tank_checks import MASS_GROUP, STIFFNESS_GROUP, touching
from hydroelastic.scenes.models.tank_parts import TankParts


def round_plates_keep_apart(scene: TankParts) -> Iterator[InitErrorDetails]:
    """Yield plates at one level that overlap or touch."""
    for first, inner, second, outer in touching(scene, scene.plates):
        yield problem_at(
            ("body", second, "inner_radius"),
            outer.start,
            f"the plate overlaps or touches [[body]] number {first + 1}, whose radius is {inner.end:g} m",
            remedy="Leave a gap between them",
        )


def round_plates_are_in_range(scene: TankParts) -> Iterator[InitErrorDetails]:
    """Yield plates whose stiffness or mass is lost in rounding beside that of the liquid."""
    for index, plate in scene.plates:
        below, above = scene.densities_at(scene.level_of(plate))
        weight = (below - above) * scene.tank.gravity
        stiffness = plate.whole_rigidity + (plate.tension or 0.0) * plate.radius**2
        groups = (
            ("flexural_rigidity", "(D + T a²)/(Δρ g a⁴)", stiffness, weight * plate.radius**4, STIFFNESS_GROUP),
            ("mass_per_area", "m/(ρ a)", plate.whole_mass, below * plate.radius, MASS_GROUP),
        )
        for key, formula, value, scale, (least, most) in groups:
            if value not in (0.0, inf) and not is_within(value, least * scale, most * scale):
                yield problem_at(
                    ("body", index, key),
                    value,
                    f"{formula} = {value / scale:g} is beyond the resolution of double precision",
                    allowed=f"{shown_range(least * scale, most * scale)} for this plate and liquid",
                )
