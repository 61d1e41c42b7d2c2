"""What the plane of a mesh stands for: a section per metre of width, a half-plane of revolution, an extruded section.

With the displacement potential ψ(x, y) of a section, ψ(r, z) cos nθ of a solid of revolution with r = x ≥ 0, z = y, or
ψ(x, y) cos kz of a section that is extruded along z, Laplace's equation in three dimensions is one form in the plane,

    c ∫ρ (∂ₓψ ∂ₓq + ∂ᵧψ ∂ᵧq + m² ψ q) w dx dy,

    | kind     | weight w | m²    | c                                         |
    |----------|----------|-------|-------------------------------------------|
    | plane    | 1        | 0     | 1, per metre of width                     |
    | revolved | r        | n²/r² | 2π for n = 0, else π                      |
    | extruded | 1        | k²    | 1 for k = 0, else 1/2, per metre of width |

with k = jπ/B, B the width between two walls across the section. The weight is also that of surfaces and of loads.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import pi
from typing import Literal

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True, kw_only=True)
class Geometry:
    """Geometry of a plane problem."""

    kind: Literal["plane", "revolved", "extruded"] = "plane"  # what the plane stands for
    order: int = 0  # azimuthal order n of a solid of revolution, or number j of half waves across an extruded section
    width: float = 1.0  # B of an extruded section, in the unit of the plane's coordinates

    @property
    def is_revolved(self) -> bool:
        """Whether x is the distance r from a vertical axis."""
        return self.kind == "revolved"

    @property
    def is_whole(self) -> bool:
        """Whether masses and forces are those of a whole solid, instead of a metre of its width."""
        return self.is_revolved

    @property
    def measure(self) -> float:
        """c, the integral of cos² over the direction that is left out, or its mean."""
        whole = 2.0 * pi if self.is_revolved else 1.0
        return whole if self.order == 0 else 0.5 * whole

    @property
    def transverse(self) -> float:
        """m² w over 1/r of a solid of revolution, n²; of other sections m² w itself, k²."""
        return float(self.order**2) if self.is_revolved else (self.order * pi / self.width) ** 2

    def weight(self, x: NDArray[np.float64]) -> NDArray[np.float64]:
        """w at abscissas x, of the same shape."""
        return x if self.is_revolved else np.ones_like(x)


PLANE = Geometry()
"""A section, per metre of width."""
