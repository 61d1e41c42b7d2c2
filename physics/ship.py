"""A ship in roll: φ'' + 2nφ' + d|φ'|φ' + k²φ = k² × slope of the wave."""

from __future__ import annotations

import math
from dataclasses import dataclass


@dataclass(frozen=True, kw_only=True)
class Ship:
    """Parameters of the roll of a ship.

    Raises:
        ValueError: if k is not finite and positive, or n or d not finite and from 0.
    """

    natural_frequency: float  # k, rad/s, without damping
    damping: float = 0.0  # n, 1/s, from 0; critical where n = k
    quadratic_damping: float = 0.0  # d, 1/rad, from 0

    def __post_init__(self) -> None:
        if not (math.isfinite(self.natural_frequency) and self.natural_frequency > 0):
            raise ValueError(f"natural_frequency is {self.natural_frequency}; it must be finite and positive")
        for name in ("damping", "quadratic_damping"):
            value = getattr(self, name)
            if not 0 <= value < math.inf:
                raise ValueError(f"{name} is {value}; it must be finite, and 0 or more")

    @property
    def damped_frequency(self) -> float:
        """√(k² − n²) of the free motion with linear damping alone, rad/s; 0 from critical damping on."""
        k, n = self.natural_frequency, self.damping
        return math.sqrt(max((k - n) * (k + n), 0.0))

    @property
    def fastest_decay(self) -> float:
        """Rate at which the faster of the free motions decays by linear damping, n or n + √(n² − k²), 1/s."""
        k, n = self.natural_frequency, self.damping
        return n + math.sqrt(max((n - k) * (n + k), 0.0))
