"""Interface of a body in the field model."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass

from hydroelastic.fem.surfaces import Body
from hydroelastic.physics.symmetry import Parity
from hydroelastic.physics.tank import Tank


@dataclass(frozen=True, kw_only=True)
class BodyModel(ABC):
    """A body of a scaled tank.

    Attributes:
        tank: the dimensionless tank.
        index: index of the body.
    """

    tank: Tank
    index: int

    @abstractmethod
    def moving(self, count: int, parity: Parity | None) -> Body:
        """Return the body as unknowns of the field model."""

    def dry_mode_count(self, wavenumber: float, tolerance: float) -> int:
        """Return the number of dry modes that a tolerance needs, rigid ones included; 0 for a rigid body."""
        return 0

    def elastic_shapes(self, count: int) -> int:
        """Return how many of the lowest elastic dry modes of a body, in all azimuthal orders, are of the tank's."""
        return count

    @property
    def has_tone(self) -> bool:
        """Whether its first elastic tone is one of the tank's order."""
        return bool(self.expected_tones())

    def expected_tones(self) -> tuple[float, ...]:
        """Estimate the dimensionless λ of its first elastic tone, for the choice of a mesh; empty for a rigid body, and
        for a plate whose first elastic tone is of another order."""
        return ()

    def ends_of_motions(self) -> tuple[float, ...]:
        """Return the dimensionless λ up to which the mode of each of its restored rigid motions is sought."""
        return ()
