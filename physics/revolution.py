"""Solids of revolution about a vertical axis: volumes, waterplanes and their moments, from the contour of a section.

With the section's contour counterclockwise, r = |x| and z = y, by Green's theorem over its part of x > 0

    V = π∮r² dz,   ∫z dV = π∮r² z dz,   ∫x² dV = ∫y² dV = (π/4)∮r⁴ dz,   ∫z² dV = π∮r² z² dz,

in which lines along the axis and along a level from which z is counted add nothing. A waterplane r₁ < r < r₂ has

    A_w = π(r₂² − r₁²),    I_w = ∫x² dA = (π/4)(r₂⁴ − r₁⁴).
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from math import pi
from typing import Literal

import numpy as np

from hydroelastic.physics.contours import Arc, AreaMoments, Contour, Point, arc_quadrature


@dataclass(frozen=True)
class SolidOfRevolution:
    """A solid with a vertical axis at x = 0."""

    # of the whole section of a solid that the axis passes through, symmetric about x = 0; of a ring the contour of its
    # section at x > 0
    contour: Contour

    @property
    def bounds(self) -> tuple[float, float, float, float]:
        """Smallest and largest x, smallest and largest z of the contour."""
        return self.contour.bounds

    @property
    def corners(self) -> tuple[Point, ...]:
        """Corners of the contour."""
        return self.contour.corners

    @property
    def is_ring(self) -> bool:
        """Whether the axis lies outside the solid."""
        return self.bounds[0] > 0.0

    def moved(self, shift: Point) -> SolidOfRevolution:
        """Return the solid displaced along its axis, by (0, z)."""
        return SolidOfRevolution(self.contour.moved(shift))

    def below(self, level: float) -> tuple[Arc, ...]:
        """See `Contour.below`."""
        return self.contour.below(level)

    def moments(self, level: float | None = None, *, side: Literal["below", "above"] = "below") -> AreaMoments:
        """Volume and its moments, of the whole solid or of its part below or above a level.

        In `AreaMoments` the first of each pair is that of x.

        Args:
            level: z of the level; None takes the whole solid.
            side: which part is meant.
        """
        arcs = self.contour.arcs if level is None else self.contour.part_of(level, side)
        # Both halves of a symmetric section make the same solid.
        return _moments(arcs, level or 0.0, 1.0 if self.is_ring else 0.5)

    def waterplane(self, left: float, right: float) -> tuple[float, float]:
        """A_w and I_w between two contact points of the contour with the level."""
        inner = left if self.is_ring else 0.0
        return pi * (right**2 - inner**2), 0.25 * pi * (right**4 - inner**4)


def _moments(arcs: Iterable[Arc], level: float, part: float) -> AreaMoments:
    sums = np.zeros(4)
    for arc in arcs:
        x, z, _, dz = arc_quadrature(arc)
        z = z - level
        squares = x * np.abs(x)
        sums += squares @ dz, (squares * z) @ dz, (squares * x**2) @ dz, (squares * z**2) @ dz
    volume, first, across, along = map(float, part * pi * sums)
    return AreaMoments(
        area=volume,
        first=(0.0, first + level * volume),
        second=(0.25 * across, along + 2.0 * level * first + level * level * volume),
    )
