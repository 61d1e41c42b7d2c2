"""The rigid float in a rectangular tank: inputs of every estimate of its heave."""

from __future__ import annotations

import math
from dataclasses import dataclass

from hydroelastic.modal.estimate import NoEstimateError
from hydroelastic.modal.liquid.two_layer import TwoLayers
from hydroelastic.physics.profiles import Profile

_ROUNDING = 1e-12


@dataclass(frozen=True, kw_only=True)
class FloatInTank:
    """A rigid float at the level y = 0 of a rectangular tank, per metre of width.

    Raises:
        ValueError: on construction, if a quantity is out of its range or the float leaves the tank.
    """

    layers: TwoLayers  # the liquids; without an upper one y = 0 is a free surface
    tank_length: float  # L, m
    position: float  # distance from the left wall to the middle of the float's waterline, m
    mass: float  # m, kg/m
    stiffness: float  # hydrostatic stiffness in heave c = (ρ₂ − ρ₁) g B, N/m², B the width of the waterline
    # the section of a symmetric float that rests with its level y = 0 at y = 0; ``None`` for any other
    profile: Profile | None = None

    def __post_init__(self) -> None:
        for name in ("tank_length", "mass", "stiffness"):
            if not (math.isfinite(getattr(self, name)) and getattr(self, name) > 0):
                raise ValueError(f"{name} is {getattr(self, name)}; it must be finite and positive")
        if not 0 < self.position < self.tank_length:
            raise ValueError(f"position is {self.position}; it must lie between the walls, 0 and {self.tank_length}")
        half_width = self.waterline_width / 2
        if not half_width < min(self.position, self.tank_length - self.position):
            raise ValueError(f"a waterline {self.waterline_width} m wide at {self.position} m reaches a wall")
        if self.profile is not None and not self.profile.extent < self.clearance:
            raise ValueError(f"the float reaches {self.profile.extent} m from y = 0, as far as {self.clearance} m")

    @property
    def waterline_width(self) -> float:
        """B = c/((ρ₂ − ρ₁) g), m."""
        layers = self.layers
        return self.stiffness / ((layers.density_below - layers.density_above) * layers.gravity)

    @property
    def clearance(self) -> float:
        """Depth of the shallower liquid, m."""
        layers = self.layers
        return min(layers.depth_below, layers.depth_above) if layers.density_above else layers.depth_below

    @property
    def is_centred(self) -> bool:
        """Whether the float is in the middle of the tank."""
        return abs(self.position - self.tank_length / 2) <= _ROUNDING * self.tank_length

    def section(self) -> Profile:
        """Return the profile."""
        if self.profile is None:
            raise NoEstimateError("the float is not a known symmetric shape that rests with its level y = 0 at y = 0")
        return self.profile
