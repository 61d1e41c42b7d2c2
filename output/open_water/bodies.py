"""Bodies at rest in open water: how deep they float, and their hydrostatics."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from math import pi
from typing import Any

from hydroelastic.output.quantities import Group, Quantity
from hydroelastic.output.reading import Reading
from hydroelastic.output.sections import Section
from hydroelastic.output.whole_units import of_whole_solids
from hydroelastic.physics.round_plates import RoundPlate
from hydroelastic.physics.tank import Tank

# Part of the width of the waterplane.
_ROUNDING = 1e-12


@dataclass(frozen=True, kw_only=True)
class BodyAtRest:
    """A body at rest, SI units per metre of width or of a whole solid; ``None`` where a body has no such value.

    Attributes:
        number: of the body, from 1.
        kind: "float", "beam" or "plate".
        mass: kg/m.
        draught: depth of its lowest point below the still level, m; of a beam or plate that of its mean weight, which
            is not modelled.
        waterplane: x of both ends of its waterplane, m; of a ring both radii.
        centre_of_gravity: x, and y above its still level, m.
        centre_of_buoyancy: the same of the part below the level, m.
        radius_of_gyration: about the centre of gravity, m.
        metacentric_height: c55 / (m g), m.
        heave_stiffness: hydrostatic stiffness of heave, N/m².
        roll_stiffness: hydrostatic stiffness of roll, with free heave if the float heaves, N.
    """

    number: int
    kind: str
    mass: float
    draught: float
    waterplane: tuple[float, float]
    centre_of_gravity: tuple[float, float] | None = None
    centre_of_buoyancy: tuple[float, float] | None = None
    radius_of_gyration: float | None = None
    metacentric_height: float | None = None
    heave_stiffness: float
    roll_stiffness: float | None = None


def bodies_at_rest(tank: Tank) -> Iterator[BodyAtRest]:
    """Yield each body of open water at rest, in SI units."""
    for index, body in enumerate(tank.bodies):
        if isinstance(body, RoundPlate):
            yield _round_plate(tank, index, body)
        else:
            yield _beam(tank, index) if body.is_elastic else _float(tank, index)


def _beam(tank: Tank, index: int) -> BodyAtRest:
    beam, jump = tank.beams[index], tank.level_of(index).jump
    return BodyAtRest(
        number=index + 1,
        kind="beam",
        mass=beam.mass_per_length * beam.length,
        draught=beam.mass_per_length / jump,
        waterplane=beam.waterplane,
        heave_stiffness=jump * tank.gravity * beam.length if beam.hydrostatic else 0.0,
    )


def _round_plate(tank: Tank, index: int, plate: RoundPlate) -> BodyAtRest:
    jump, (inner, outer) = tank.level_of(index).jump, plate.waterplane
    area, weight = pi * (outer**2 - inner**2), jump * tank.gravity * float(plate.hydrostatic)
    return BodyAtRest(
        number=index + 1,
        kind="plate",
        mass=plate.mass_per_area * area,
        draught=plate.mass_per_area / jump,
        waterplane=(inner or -outer, outer),
        heave_stiffness=weight * area,
        roll_stiffness=0.25 * weight * area * (inner**2 + outer**2),
    )


def _float(tank: Tank, index: int) -> BodyAtRest:
    placed = tank.floats[index]
    rest = placed.hydrostatics

    left, right = rest.waterplane

    def above_level(point: tuple[float, float]) -> tuple[float, float]:
        # A number that is zero but for rounding is shown as zero.
        x, y = point[0], point[1] - rest.level
        least = _ROUNDING * (right - left)
        return x if abs(x) > least else 0.0, y if abs(y) > least else 0.0

    return BodyAtRest(
        number=index + 1,
        kind="float",
        mass=rest.mass,
        draught=rest.level - placed.hull.bounds[2],
        waterplane=rest.waterplane,
        centre_of_gravity=above_level(rest.centre_of_mass),
        centre_of_buoyancy=above_level(rest.centroids[0]),
        radius_of_gyration=rest.radius_of_gyration,
        metacentric_height=placed.roll_stiffness / (rest.displaced_mass * tank.gravity),
        heave_stiffness=rest.heave_stiffness,
        roll_stiffness=placed.roll_stiffness,
    )


def _point(key: str, meaning: str) -> Quantity:
    return Quantity(key, meaning, "m", dimensions=("x_and_y",), shown=".6g")


# fmt: off
BODIES = Group("bodies", "bodies at rest", (
    NUMBER := Quantity("number", "number of the body", "1", short="body"),
    KIND := Quantity("kind", '`"float"`, `"beam"` or `"plate"`', short="kind"),
    Quantity("mass", "mass", "kg/m", shown=".6g", short="mass"),
    Quantity("draught", "draught", "m", shown=".6g", short="draught",
        note="of a beam or plate that of its mean weight, which is not modelled"),
    Quantity("waterplane", "x of both ends of the waterplane", "m", dimensions=("end",), shown=".6g",
        short="waterplane x"),
    _point("centre_of_gravity", "x of the centre of gravity, and its height above the still level"),
    _point("centre_of_buoyancy", "x of the centre of buoyancy, and its height above the still level"),
    Quantity("radius_of_gyration", "radius of gyration about the centre of gravity", "m", shown=".6g",
        short="radius of gyration"),
    Quantity("metacentric_height", "metacentric height", "m", symbol="GM", shown=".6g"),
    Quantity("heave_stiffness", "hydrostatic stiffness of heave", "N/m^2", symbol="c33", shown=".6g"),
    Quantity("roll_stiffness", "hydrostatic stiffness of roll", "N", symbol="c55", shown=".6g",
        note="of solids of revolution that of pitch"),
), record=lambda solution: list(bodies_at_rest(solution.tank)), dimension="body", prefix="body",
    note="`null` where a beam has no such value")
# fmt: on


def bodies_section(solution: Any) -> Section:
    """Return the table of the bodies at rest."""
    return bodies_at_rest_section(solution.tank)


def bodies_at_rest_section(tank: Tank) -> Section:
    """Return the table of the bodies of a tank or of open water at rest, in SI units."""
    whole = tank.geometry.is_whole
    group = of_whole_solids(BODIES) if whole else BODIES
    found = [Reading(group, BODIES.evaluated(one)) for one in bodies_at_rest(tank)]
    return Section(
        title="Bodies at rest" if whole else "Bodies at rest, per metre of width",
        headings=("quantity", *(f"{body[KIND]} {body[NUMBER]}" for body in found)),
        rows=[
            (part.label, *(body.cell(part) for body in found))
            for part in group.quantities[2:]
            if any(body[part] is not None for body in found)
        ],
    )
