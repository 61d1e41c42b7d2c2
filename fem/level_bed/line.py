"""The space of ψ on the line of one order, with the weight of its second direction."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from hydroelastic.fem.level_bed.interval import IntervalSpace
from hydroelastic.fem.level_bed.separation import Separation
from hydroelastic.physics.arrays import FloatArray


@dataclass(frozen=True, kw_only=True)
class Line(IntervalSpace):
    """A space on the line of one order: integrals are over the plan.

    Attributes:
        separation: the tank's.
        order: n.
    """

    separation: Separation
    order: int
    # Gauss points beyond those of polynomials: n²/r² is none.
    spare_points: ClassVar[int] = 8

    @property
    def zero_at_start(self) -> bool:
        """Whether ψ = 0 on the axis, as for n ≥ 1 without an inner cylinder."""
        return self.separation.round and self.order > 0 and self.nodes[0] == 0.0

    @property
    def holds_constant(self) -> bool:
        """Whether the constant is among the functions: of order 0."""
        return self.order == 0

    def measure(self, places: FloatArray) -> FloatArray:
        """Return ∫cos² over the second direction, times r of a radius."""
        return self.separation.factor(self.order) * (places if self.separation.round else places**0)

    def transverse_squares(self, places: FloatArray) -> FloatArray:
        """Return n²/r² or k_y²."""
        return self.separation.transverse(self.order) ** 2 / (places**2 if self.separation.round else places**0)
