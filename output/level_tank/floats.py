"""Floats with draught of a tank in three dimensions at rest: how deep they float, and their stability."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from hydroelastic.output.quantities import Group, Quantity
from hydroelastic.output.reading import Reading
from hydroelastic.output.sections import Section
from hydroelastic.physics.level_tank import LevelTank
from hydroelastic.physics.solid_floats import SolidFloat
from hydroelastic.physics.volume_tank import VolumeTank

# Part of the draught below which a length is rounding.
_ROUNDING = 1e-9


@dataclass(frozen=True, kw_only=True)
class FloatAtRest:
    """A float at rest, SI units.

    Attributes:
        number: of the body, from 1.
        solid: the float.
        density: of the liquid, kg/m³.
        gravity: m/s².
    """

    number: int
    solid: SolidFloat
    density: float
    gravity: float

    @property
    def shape(self) -> str:
        """The name of its shape."""
        return self.solid.shape

    @property
    def draught(self) -> float:
        """Depth of its lowest point below the still level, m."""
        return self.solid.draught

    @property
    def displaced_volume(self) -> float:
        """Volume of its wetted part, m³."""
        return self.solid.hydrostatics.volume

    @property
    def mass(self) -> float:
        """That of the liquid that it displaces, kg."""
        return self.density * self.displaced_volume

    @property
    def centre_of_gravity(self) -> tuple[float, float, float]:
        """x and y, and z above the still level, m."""
        return (*self.solid.position, self._rounded(self.solid.centre_of_gravity))

    @property
    def centre_of_buoyancy(self) -> tuple[float, float, float]:
        """The same of its wetted part."""
        return (*self.solid.position, self._rounded(self.solid.hydrostatics.buoyancy))

    @property
    def waterplane_area(self) -> float:
        """Area of its waterplane, m²."""
        return self.solid.hydrostatics.waterplane

    @property
    def metacentric_heights(self) -> tuple[float, float]:
        """I/V + z_B − z_G of roll about x and of pitch about y, about the vertical axis through both centres, m."""
        found = self.solid.hydrostatics
        lever = found.buoyancy - self.solid.centre_of_gravity
        roll, pitch = (self._rounded(second / found.volume + lever) for second in found.second)
        return roll, pitch

    @property
    def heave_stiffness(self) -> float:
        """ρgA, N/m."""
        return self.density * self.gravity * self.waterplane_area

    @property
    def rotational_stiffness(self) -> tuple[float, float]:
        """mg times the metacentric heights, of roll and of pitch, N·m."""
        roll, pitch = self.metacentric_heights
        weight = self.mass * self.gravity
        return weight * roll, weight * pitch

    def _rounded(self, length: float) -> float:
        return length if abs(length) > _ROUNDING * self.draught else 0.0


def floats_at_rest(tank: LevelTank) -> tuple[FloatAtRest, ...]:
    """Return the floats of a tank, SI units, that is meshed in its volume; none of another."""
    return tuple(
        FloatAtRest(number=number, solid=solid, density=tank.density, gravity=tank.gravity)
        for number, solid in enumerate(tank.floats if isinstance(tank, VolumeTank) else (), len(tank.plates) + 1)
    )


_PLACE, _TURNS = ("x_y_and_z",), ("roll_and_pitch",)

# fmt: off
FLOATS = Group("bodies", "floats with draught at rest, in a volume", (
    NUMBER := Quantity("number", "number of the body", "1", short="body"),
    SHAPE := Quantity("shape", "shape of the float"),
    Quantity("mass", "mass", "kg", shown=".6g"),
    Quantity("draught", "draught", "m", shown=".6g"),
    Quantity("displaced_volume", "displaced volume", "m^3", shown=".6g"),
    Quantity("centre_of_gravity", "x and y of the centre of gravity, and its height above the still level", "m",
        dimensions=_PLACE, shown=".6g"),
    Quantity("centre_of_buoyancy", "x and y of the centre of buoyancy, and its height above the still level", "m",
        dimensions=_PLACE, shown=".6g"),
    Quantity("waterplane_area", "area of the waterplane", "m^2", shown=".6g"),
    Quantity("metacentric_heights", "metacentric heights of roll and of pitch", "m", symbol="GM",
        dimensions=_TURNS, shown=".6g"),
    Quantity("heave_stiffness", "hydrostatic stiffness of heave", "N/m", symbol="c33", shown=".6g"),
    Quantity("rotational_stiffness", "hydrostatic stiffness of roll and of pitch", "N m", symbol="c44, c55",
        dimensions=_TURNS, shown=".6g"),
), record=lambda result: list(result.floats), dimension="body", prefix="body")
# fmt: on


def floats_section(floats: Sequence[FloatAtRest]) -> Iterator[Section]:
    """Yield the table of the floats at rest, if there are any."""
    found = [Reading(FLOATS, FLOATS.evaluated(one)) for one in floats]
    if found:
        yield Section(
            title="Bodies at rest",
            headings=("quantity", *(f"{one[SHAPE]} {one[NUMBER]}" for one in found)),
            rows=[(part.label, *(one.cell(part) for one in found)) for part in FLOATS.quantities[2:]],
            lines=tuple(_ledges(floats)),
        )


def _ledges(floats: Sequence[FloatAtRest]) -> Iterator[str]:
    """Say which waterplane is taken where a hull has two at the still level."""
    for one in floats:
        above = one.solid.hull.waterplane_above if one.solid.hull else None
        if above is not None:
            yield (
                f"Attention: horizontal faces of {one.shape} {one.number} lie exactly at the still level. The "
                f"waterplane just below them is taken, of {one.waterplane_area:.6g} m²; just above them it is "
                f"{above:.6g} m². Change the draught a little to choose between both."
            )
