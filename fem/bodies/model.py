"""What the field model asks of a body, whatever it is."""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass

from hydroelastic.fem.surfaces import Body
from hydroelastic.physics.symmetry import Parity
from hydroelastic.physics.tank import Tank

FAR_ENOUGH = 1.5
"""Modes up to this many times the λ that a float's motion has at infinite frequency hold its mode."""


@dataclass(frozen=True, kw_only=True)
class BodyModel(ABC):
    """A body of a scaled tank.

    Attributes:
        tank: the tank.
        index: of the body.
    """

    tank: Tank
    index: int

    @abstractmethod
    def moving(self, count: int, parity: Parity | None) -> Body:
        """The body as unknowns of the field model.

        Args:
            count: number of dry modes, rigid ones included, of a body that bends; without any it is held still.
            parity: of the shapes that are meant, with the energies of half the body; ``None`` takes all, and the whole.
        """

    def dry_mode_count(self, wavenumber: float, tolerance: float) -> int:
        """How many dry modes a tolerance asks for, rigid ones included; 0 of a body that does not bend.

        Args:
            wavenumber: of the shortest wave on the body.
            tolerance: asked relative error.
        """
        return 0

    def expected_tones(self) -> tuple[float, ...]:
        """About the λ of its first elastic tone: enough to choose a mesh."""
        return ()

    def ends_of_motions(self) -> tuple[float, ...]:
        """Up to which λ modes are looked at for each of its rigid motions that is reported."""
        return ()
