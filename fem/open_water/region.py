"""The region of the complex plane in which resonances ω − iγ are sought."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

MOST_DAMPING_ANYWHERE = 0.7
"""−Im ω/Re ω up to which resonances are found in water of any depth."""

# Im ω/Re ω of the upper side.
_ABOVE_THE_AXIS = 0.02


@dataclass(frozen=True, kw_only=True)
class Region:
    """Region in which resonances are sought: lowest < Re ω < highest, −Im ω < damping · Re ω."""

    lowest: float  # lower limit of Re ω, rad/s, positive
    highest: float  # upper limit of Re ω, rad/s
    damping: float  # largest −Im ω/Re ω

    def holds(self, omega: complex) -> bool:
        """Whether a frequency in rad/s lies in the region."""
        above = omega.imag < _ABOVE_THE_AXIS * omega.real
        return above and self.lowest < omega.real < self.highest and -omega.imag < self.damping * omega.real

    def boundary(self, places: np.ndarray) -> np.ndarray:
        """Return ω of points on the boundary, rad/s."""
        corners = [
            self.lowest * (1.0 - 1j * self.damping),
            self.highest * (1.0 - 1j * self.damping),
            self.highest * (1.0 + 1j * _ABOVE_THE_AXIS),
            self.lowest * (1.0 + 1j * _ABOVE_THE_AXIS),
        ]
        points = []
        for place in places:
            side, part = int(place) % 4, float(place) % 1.0
            start, end = corners[side], corners[(side + 1) % 4]
            # Geometric steps along the real axis, equal steps across it.
            along = side % 2 == 0
            points.append(start * (end / start) ** part if along else start + part * (end - start))
        return np.array(points)
