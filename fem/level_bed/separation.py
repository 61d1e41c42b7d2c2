"""Separation of the plan's second direction: for each order n a problem in x or r alone is left.

box:       ψ = ψ(x) cos(nπy/B),    k_y = nπ/B
cylinder:  ψ = ψ(r) cos nθ, and for n ≥ 1 also ψ(r) sin nθ
"""

from __future__ import annotations

from dataclasses import dataclass
from math import inf, pi
from typing import TypeAlias

from hydroelastic.physics.level_tank import Box, Cylinder, LevelTank
from hydroelastic.physics.plate import Disc, Plate, Strip

Place: TypeAlias = tuple[float, float]
"""Start and end of a plate along x or r."""


@dataclass(frozen=True, kw_only=True)
class Separation:
    """A dimensionless tank whose order can be separated.

    Attributes:
        start: left wall x = 0, or the axis or inner wall.
        end: right or outer wall.
        round: whether the line is a radius.
        width: B of a box; infinite of a cylinder.
        places: of the plates along the line.
    """

    start: float
    end: float
    round: bool
    width: float
    places: tuple[Place, ...]

    def factor(self, order: int) -> float:
        """Return ∫cos² over the second direction: B or B/2, 2π or π."""
        whole = 2.0 * pi if self.round else self.width
        return whole if order == 0 else 0.5 * whole

    def transverse(self, order: int) -> float:
        """Return n of a cylinder, k_y = nπ/B of a box."""
        return float(order) if self.round else order * pi / self.width

    def least_wavenumber(self, order: int) -> float:
        """Return a lower bound of the wavenumbers of an order: n/R < j'ₙ₁/R, or nπ/B."""
        return order / self.end if self.round else self.transverse(order)

    def multiplicity(self, order: int) -> int:
        """Return how many independent modes share one frequency: cos nθ and sin nθ."""
        return 2 if self.round and order else 1


def separated(tank: LevelTank) -> Separation | None:
    """Return how orders separate: a box with strips, or a round tank with concentric plates; ``None`` for others."""
    if isinstance(tank.plan, Box) and all(isinstance(plate.outline, Strip) for plate in tank.plates):
        places = tuple(map(_place, tank.plates))
        return Separation(start=0.0, end=tank.plan.length, round=False, width=tank.plan.width, places=places)
    if isinstance(tank.plan, Cylinder) and all(_is_concentric(plate) for plate in tank.plates):
        places = tuple(map(_place, tank.plates))
        return Separation(start=tank.plan.inner_radius, end=tank.plan.radius, round=True, width=inf, places=places)
    return None


def _is_concentric(plate: Plate) -> bool:
    return isinstance(plate.outline, Disc) and plate.outline.position == (0.0, 0.0)


def _place(plate: Plate) -> Place:
    if isinstance(plate.outline, Strip):
        return plate.outline.start, plate.outline.end
    assert isinstance(plate.outline, Disc)
    return plate.outline.inner_radius, plate.outline.radius
