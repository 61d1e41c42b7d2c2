"""The layer in which a thread of small bending stiffness turns to the direction of a clamp."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from hydroelastic.modal.thread.asymptotics import NoAsymptoticError
from hydroelastic.physics.arrays import FloatArray

_LARGEST = 0.2


@dataclass(frozen=True, kw_only=True)
class ClampLayer:
    """EI φ″ = T sin(φ − φ₀) at a clamp at s = 0, φ₀ and T those of the thread without bending stiffness at its end.

    Attributes:
        flexural_rigidity: EI, N m².
        tension: T at the end, N.
        angle: of the clamp less φ₀, rad, between −π and π.
        length: L of the thread, m.
    """

    flexural_rigidity: float
    tension: float
    angle: float
    length: float

    def __post_init__(self) -> None:
        """Check the ranges."""
        for name in ("flexural_rigidity", "tension", "length"):
            if not (math.isfinite(getattr(self, name)) and getattr(self, name) > 0):
                raise ValueError(f"{name} is {getattr(self, name)}: it must be finite and positive")
        if not abs(self.angle) < math.pi:
            raise ValueError(f"angle is {self.angle}: it must lie between −π and π")
        if not self.small < _LARGEST:
            raise NoAsymptoticError(f"the layer is {self.small:.3g} of the length: it must be below {_LARGEST}")

    @property
    def decay_length(self) -> float:
        """√(EI/T), m."""
        return math.sqrt(self.flexural_rigidity / self.tension)

    @property
    def small(self) -> float:
        """√(EI/T)/L: order of the relative truncation error of the moment."""
        return self.decay_length / self.length

    @property
    def moment(self) -> float:
        """|M| = 2√(EI T) |sin(Δφ/2)| at the clamp, N m."""
        return 2 * math.sqrt(self.flexural_rigidity * self.tension) * abs(math.sin(0.5 * self.angle))

    def angles(self, s: ArrayLike) -> FloatArray:
        """Return φ − φ₀ = 4 atan(tan(Δφ/4) e^{−s/l}), rad, at distances from the clamp, m."""
        decay = np.exp(-np.asarray(s, dtype=float) / self.decay_length)
        return np.asarray(4 * np.arctan(math.tan(0.25 * self.angle) * decay))
