"""A tank whose frequencies are studied, and the data that all of its solutions share."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from hydroelastic.fem.study.reference import Reference, finest_resolution, reference_of
from hydroelastic.fem.tank.resolution import Resolution, rounding_error
from hydroelastic.physics.symmetry import is_mirror_image
from hydroelastic.physics.tank import Tank

# Rounding error at any degree, measured on meshes of up to 2e5 unknowns with exact frequencies.
_ROUNDING = 1e-11


@dataclass(frozen=True, kw_only=True)
class StudiedTank:
    """A tank whose frequencies are studied.

    Attributes:
        physical: the tank, in SI units.
        modes: number of frequencies, from the lowest.
    """

    physical: Tank
    modes: int

    @cached_property
    def tank(self) -> Tank:
        """The dimensionless tank."""
        return self.physical.scaled()

    @cached_property
    def half(self) -> bool:
        """Whether it is symmetric and therefore solved as two halves, in every family."""
        return is_mirror_image(self.tank)

    @cached_property
    def finest(self) -> Resolution:
        """Elements, rings and dry modes with errors below those of any row."""
        return finest_resolution(self.tank, self.modes)

    @cached_property
    def reference(self) -> Reference:
        """Reference frequencies, computed at the first access (collective)."""
        return reference_of(self.physical, self.modes, half=self.half)

    def errors(self, omega: np.ndarray) -> tuple[float, ...]:
        """Return ω/ω_exact − 1 of frequencies in rad/s, shape (frequencies,), as far as there are references."""
        shared = min(len(omega), len(self.reference.omega))
        return tuple(map(float, omega[:shared] / self.reference.omega[:shared] - 1.0))

    def floor(self, degree: int) -> float:
        """Return the relative error below which errors of a degree are rounding or that of the reference."""
        return max(_ROUNDING, self.reference.uncertainty, rounding_error(degree, self.tank.depth))
