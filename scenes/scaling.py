"""Scenes in units of the tank: L = ρ = g = 1, so that metres and millimetres give the same digits."""

from __future__ import annotations

from dataclasses import dataclass
from math import pi, sqrt

from hydroelastic.scenes.models import Beam, TankScene


@dataclass(frozen=True, kw_only=True)
class Scales:
    """Units of the dimensionless model.

    Attributes:
        length: the tank's length, m.
        density: ρ, kg/m³.
        gravity: g, m/s².
    """

    length: float
    density: float
    gravity: float

    @property
    def frequency(self) -> float:
        """Unit of ω, rad/s."""
        return sqrt(self.gravity / self.length)

    @property
    def mass_per_length(self) -> float:
        """Unit of mass per length and metre of width, kg/m²."""
        return self.density * self.length

    @property
    def flexural_rigidity(self) -> float:
        """Unit of EI per metre of width, N·m."""
        return self.density * self.gravity * self.length**4

    def hertz(self, omega: float) -> float:
        """Frequency in Hz of a dimensionless ω."""
        return omega * self.frequency / (2 * pi)


def scales(scene: TankScene) -> Scales:
    """Units of a scene."""
    return Scales(length=scene.tank.length, density=scene.liquid[0].density, gravity=scene.tank.gravity)


def scaled_beam(beam: Beam, units: Scales, start: float, end: float) -> Beam:
    """The beam in the units of the tank, between the given dimensionless ends."""
    return Beam(
        start=start,
        length=end - start,
        flexural_rigidity=beam.flexural_rigidity / units.flexural_rigidity,
        mass_per_length=beam.mass_per_length / units.mass_per_length,
        hydrostatic=beam.hydrostatic,
        ends=beam.ends,
    )
