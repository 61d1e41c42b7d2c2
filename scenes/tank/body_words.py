"""How `check` describes any body."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterator
from dataclasses import dataclass
from typing import ClassVar

from hydroelastic.physics.dofs import Level
from hydroelastic.scenes.models.tank_parts import TankParts
from hydroelastic.scenes.tank.symbols import Group


@dataclass(frozen=True, kw_only=True)
class BodyWords(ABC):
    """Description of a body.

    Attributes:
        scene: the scene.
        index: index of the body.
        symbol: symbol of its unknowns.
        name: what it is.
    """

    scene: TankParts
    index: int
    symbol: ClassVar[str]
    name: ClassVar[str]

    @property
    def level(self) -> Level:
        """Still level on which it floats."""
        return self.scene.level_of(self.scene.body[self.index])

    @abstractmethod
    def condition(self) -> str:
        """Return the boundary condition on the body, as formulas."""

    @abstractmethod
    def basis(self, *, is_held: bool) -> str:
        """Return a description of its unknowns; ``is_held``: whether conservation of volume excludes its heave."""

    @abstractmethod
    def groups(self) -> Iterator[Group]:
        """Yield its dimensionless groups."""

    def at_rest(self) -> dict[str, str]:
        """Return its hydrostatics, by quantity and unit; empty for a body without draught."""
        return {}
