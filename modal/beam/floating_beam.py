"""The beam that floats in a rectangular tank: inputs of every estimate."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from hydroelastic.modal.beam.dry_modes import free_free_roots
from hydroelastic.physics.arrays import FloatArray

_ROUNDING = 1e-12


@dataclass(frozen=True, kw_only=True)
class FloatingBeam:
    """A uniform elastic beam with free ends on the water of a rectangular tank, per metre of width.

    Raises:
        ValueError: on construction, if a quantity is not finite or not positive, or the beam leaves the tank.
    """

    tank_length: float  # L, m
    depth: float  # H, m
    density: float  # ρ of the liquid, kg/m³
    gravity: float  # g, m/s²
    start: float  # x₁, distance from the left wall to the left tip, m
    length: float  # l, m
    flexural_rigidity: float  # EI, N·m (N·m² per metre of width)
    mass_per_length: float  # m, kg/m²
    hydrostatic: bool  # whether the restoring pressure ρ g w acts on the beam; ``False`` is the paper's model

    def __post_init__(self) -> None:
        wrong = [
            name
            for name in (
                "tank_length",
                "depth",
                "density",
                "gravity",
                "length",
                "flexural_rigidity",
                "mass_per_length",
            )
            if not (math.isfinite(getattr(self, name)) and getattr(self, name) > 0)
        ]
        if wrong:
            raise ValueError(f"must be finite and positive: {', '.join(wrong)}")
        if not (math.isfinite(self.start) and self.start >= 0):
            raise ValueError(f"start is {self.start}; it must be finite and not negative")
        if self.start + self.length > self.tank_length * (1 + _ROUNDING):
            raise ValueError(f"the beam ends at {self.start + self.length} m, beyond the tank of {self.tank_length} m")

    @property
    def hydrostatic_stiffness(self) -> float:
        """Restoring stiffness s ρ g of the beam, N/m³; zero without hydrostatics."""
        return self.density * self.gravity if self.hydrostatic else 0.0

    @property
    def left_gap(self) -> float:
        """Free surface to the left of the beam, m; exactly zero when the tip touches the wall."""
        return 0.0 if self.start <= _ROUNDING * self.tank_length else self.start

    @property
    def right_gap(self) -> float:
        """Free surface to the right of the beam, m; exactly zero when the tip touches the wall."""
        gap = self.tank_length - self.start - self.length
        return 0.0 if gap <= _ROUNDING * self.tank_length else gap

    @property
    def is_centred(self) -> bool:
        """Whether the two gaps are equal, so that modes are symmetric or antisymmetric."""
        return abs(self.left_gap - self.right_gap) <= _ROUNDING * self.tank_length

    @property
    def touches_wall(self) -> bool:
        """Whether a tip is at a wall."""
        return self.left_gap == 0.0 or self.right_gap == 0.0

    @property
    def covers_tank(self) -> bool:
        """Whether no free surface is left."""
        return self.left_gap == 0.0 and self.right_gap == 0.0

    @property
    def first_dry_stiffness(self) -> float:
        """Generalised stiffness EI κ₁⁴ + s ρ g of the first dry mode, N/m³."""
        return float(self.dry_stiffnesses(3)[2])

    @property
    def frequency_unit(self) -> float:
        """The frequency √(g/l), rad/s, by which the dimensionless problem is scaled."""
        return math.sqrt(self.gravity / self.length)

    @property
    def dimensionless_groups(self) -> dict[str, float]:
        """The five groups on which ω² l/g depends (with and without hydrostatics apart)."""
        return {
            "rigidity": self.flexural_rigidity / (self.density * self.gravity * self.length**4),
            "mass": self.mass_per_length / (self.density * self.length),
            "tank_length": self.tank_length / self.length,
            "depth": self.depth / self.length,
            "start": self.start / self.length,
        }

    def dimensionless(self) -> FloatingBeam:
        """Return the same problem with l = ρ = g = 1; its frequencies are ω / `frequency_unit`."""
        groups = self.dimensionless_groups
        left, right = self.left_gap / self.length, self.right_gap / self.length
        return FloatingBeam(
            tank_length=left + 1.0 + right,
            depth=groups["depth"],
            density=1.0,
            gravity=1.0,
            start=left,
            length=1.0,
            flexural_rigidity=groups["rigidity"],
            mass_per_length=groups["mass"],
            hydrostatic=self.hydrostatic,
        )

    def dry_stiffnesses(self, count: int) -> FloatArray:
        """Return EI κ⁴ + s ρ g of heave, pitch and the elastic shapes, per unit ∫W² dz.

        Args:
            count: number of shapes, the two rigid ones included.

        Returns:
            Stiffness per area, N/m³, shape (count,).
        """
        roots = np.concatenate([np.zeros(2), free_free_roots(max(count - 2, 0))])[:count]
        return self.flexural_rigidity * (roots / self.length) ** 4 + self.hydrostatic_stiffness
