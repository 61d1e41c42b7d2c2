"""What the solutions of all closed tanks have in common."""

from __future__ import annotations

from dataclasses import dataclass
from math import sqrt
from typing import Generic, Protocol, TypeVar

from hydroelastic.physics.scales import Scales


class _InUnits(Protocol):
    @property
    def units(self) -> Scales:
        """The units in which it is solved."""


_Tank = TypeVar("_Tank", bound=_InUnits)


@dataclass(frozen=True, kw_only=True)
class ClosedSolution(Generic[_Tank]):
    """The dimensionless solution of a closed tank.

    Attributes:
        physical: the tank, in SI units.
        tank: the same in its own units.
        tolerance: requested relative error of the frequencies.
        count: number of requested modes.
        counted: whether an independent count confirms that no mode is missing.
        reasons: why the solution does not keep the tolerance or is incomplete; empty if it does.
    """

    physical: _Tank
    tank: _Tank
    tolerance: float
    count: int
    counted: bool
    reasons: tuple[str, ...]

    @property
    def units(self) -> Scales:
        """Units of the dimensionless tank."""
        return self.physical.units

    def omega(self, eigenvalue: float) -> float:
        """Return ω in rad/s of a dimensionless λ."""
        return sqrt(eigenvalue) * self.units.frequency
