"""Units of a tank: L = ρ = g = 1, so that metres and millimetres give the same digits."""

from __future__ import annotations

from dataclasses import dataclass
from math import pi, sqrt


@dataclass(frozen=True, kw_only=True)
class Scales:
    """Units of the dimensionless tank; everything is per metre of width, or whole."""

    length: float  # L, m
    density: float  # ρ, kg/m³
    gravity: float  # g, m/s²
    dimensions: int = 2  # 2 where masses and forces are those of a metre of width, 3 where they are whole

    @property
    def volume(self) -> float:
        """Unit of displaced volume, m³, or m² per metre of width."""
        return self.length**self.dimensions

    @property
    def frequency(self) -> float:
        """Unit of ω, rad/s."""
        return sqrt(self.gravity / self.length)

    @property
    def mass_per_length(self) -> float:
        """Unit of mass per length of a beam, kg/m²."""
        return self.density * self.length

    @property
    def flexural_rigidity(self) -> float:
        """Unit of EI, N·m."""
        return self.density * self.gravity * self.length**4

    @property
    def rotational_stiffness(self) -> float:
        """Unit of the stiffness of joints, N·m/rad."""
        return self.flexural_rigidity / self.length

    def hertz(self, omega: float) -> float:
        """Frequency in Hz of a dimensionless ω."""
        return omega * self.frequency / (2 * pi)
