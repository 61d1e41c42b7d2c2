"""The interface of floating bodies."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterator
from typing import TYPE_CHECKING, ClassVar, Self

from hydroelastic.physics.dofs import Dof, Level
from hydroelastic.physics.scales import Scales

if TYPE_CHECKING:
    from hydroelastic.physics.beam_parts import Section
    from hydroelastic.physics.hulls import Hull


class Body(ABC):
    """A body at rest, per metre of width; in SI units, or in those of a scaled tank.

    Attributes:
        is_elastic: whether it is flexible.
        level: at which it floats.
        hull: its contour in the liquids; ``None`` of a body without draught.
    """

    is_elastic: ClassVar[bool] = False
    level: Level
    hull: Hull | None = None

    @property
    @abstractmethod
    def waterplane(self) -> tuple[float, float]:
        """x of its ends in the still level, m; the same for a thin float."""

    @property
    @abstractmethod
    def rigid_motions(self) -> tuple[Dof, ...]:
        """Its rigid motions."""

    @abstractmethod
    def zero_stiffness_motions(self) -> Iterator[tuple[Dof, bool]]:
        """The rigid motions without stiffness, and whether each displaces a net volume."""

    @property
    @abstractmethod
    def displaces_volume(self) -> bool:
        """Whether one of its motions displaces a net volume."""

    @abstractmethod
    def moved(self, shift: float) -> Self:
        """Return the same body further to the right, m."""

    @abstractmethod
    def scaled(self, units: Scales, start: float, end: float) -> Self:
        """Return the body in other units, between given ends of its waterplane in these units."""

    @property
    def orders(self) -> tuple[int, ...]:
        """Azimuthal orders of the motions of a solid of revolution."""
        return (0,)

    def of_order(self, order: int) -> Self:
        """Return the same body with the motions of one azimuthal order alone."""
        return self

    @abstractmethod
    def is_mirror_image_of(self, other: object) -> bool:
        """Whether it is the mirror image of another body up to rounding, wherever both float."""

    @property
    def nodes(self) -> dict[float, float]:
        """Distances from its left end at which its slope or curvature jumps, m, with α of ψ ~ r^α there."""
        return {}

    @property
    def flexural_sections(self) -> tuple[Section, ...]:
        """The parts along which flexural waves travel, from left to right."""
        return ()

    @property
    def is_restored(self) -> bool:
        """Whether the hydrostatic restoring acts on it."""
        return True
