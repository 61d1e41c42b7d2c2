"""A heavy string that hangs from a moving upper end in a resisting liquid, in SI units and without dimensions.

    (ρ + m_a) U_tt = −2λ U_t + (T U_x)_x,    T(x) = g [(M − M_d) + (ρ − ρ_d) x],    U = f(t) at x = l,

with x up from the lower end, where M U_tt = T U_x. The liquid adds the mass m_a and displaces ρ_d per unit of length.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import isfinite, sqrt

import numpy as np
from numpy.typing import ArrayLike, NDArray


@dataclass(frozen=True, kw_only=True)
class HangingString:
    """A string that hangs from its upper end, the lower end free or with a mass.

    Raises:
        ValueError: if a number is out of range, or the string is not under tension.
    """

    length: float  # l, m
    linear_density: float  # ρ, kg/m
    gravity: float = 9.81  # g, m/s²
    # λ at the lower and at the upper end, kg/(m s), linear between; the drag is 2λ ∂U/∂t per unit length
    resistance: tuple[float, float] = (0.0, 0.0)
    tip_mass: float = 0.0  # M at the lower end, kg
    added_mass: float = 0.0  # m_a, of the liquid that moves with the string, kg/m
    displaced_mass: float = 0.0  # ρ_d, of the liquid that the string displaces, kg/m
    tip_displaced_mass: float = 0.0  # M_d, of the liquid that the tip mass displaces, kg

    def __post_init__(self) -> None:
        for name in ("length", "linear_density", "gravity"):
            _require(name, getattr(self, name), positive=True)
        for name in ("tip_mass", "added_mass", "displaced_mass", "tip_displaced_mass"):
            _require(name, getattr(self, name), positive=False)
        for value in self.resistance:
            _require("resistance", value, positive=False)
        hung = self.tip_mass - self.tip_displaced_mass
        if hung < 0.0 or (self.tip_mass > 0.0 and hung == 0.0):
            raise ValueError(
                f"tip_displaced_mass is {self.tip_displaced_mass:g} kg: it must be less than tip_mass"
                f" ({self.tip_mass:g} kg), whose weight keeps the lower end under tension"
            )
        if hung + (self.linear_density - self.displaced_mass) * self.length <= 0.0:
            raise ValueError(
                f"displaced_mass is {self.displaced_mass:g} kg/m: no tension is left at the upper end, the string"
                " must be heavier than the liquid it displaces"
            )

    @property
    def inertia(self) -> float:
        """Mass per unit length that moves, ρ + m_a, kg/m."""
        return self.linear_density + self.added_mass

    @property
    def tension(self) -> tuple[float, float]:
        """Tension at the lower end, N, and its slope, N/m: the weight below less the buoyancy."""
        return (
            self.gravity * (self.tip_mass - self.tip_displaced_mass),
            self.gravity * (self.linear_density - self.displaced_mass),
        )

    @property
    def apparent_gravity(self) -> float:
        """g(ρ − ρ_d)/(ρ + m_a), m/s²: the gravity of a string in vacuo with the same waves."""
        return self.gravity * (self.linear_density - self.displaced_mass) / self.inertia

    @property
    def damping(self) -> float:
        """Mean of α = λ/(ρ + m_a) over the length, 1/s."""
        return 0.5 * (self.resistance[0] + self.resistance[1]) / self.inertia

    @property
    def smallest_damping(self) -> float:
        """Smallest α along the string, 1/s."""
        return min(self.resistance) / self.inertia

    @property
    def uniform_damping(self) -> float | None:
        """α, 1/s, if the drag is 2α times the mass everywhere: the undamped mode shapes are then the damped ones."""
        uniform = self.resistance[0] == self.resistance[1] and (self.tip_mass == 0.0 or self.resistance[0] == 0.0)
        return self.resistance[0] / self.inertia if uniform else None

    @property
    def has_closed_form(self) -> bool:
        """Whether Bessel functions and exponentials solve it: no tip mass, and a uniform resistance."""
        return self.tip_mass == 0.0 and self.resistance[0] == self.resistance[1]

    @property
    def travel_time(self) -> float:
        """R, the time in which a wave runs along the whole string, s; 2√(l/g) in vacuo without a tip mass."""
        return float(self.travel_times(self.length))

    def travel_times(self, positions: ArrayLike) -> NDArray[np.float64]:
        """Return s(x) = ∫dx/√(T/(ρ + m_a)), the travel time of a wave from the lower end, s, in the shape of x, m."""
        positions = np.asarray(positions, dtype=float)
        bottom, slope = self.tension
        if bottom == 0.0:
            return np.asarray(2.0 * np.sqrt(self.inertia * positions / slope))
        return np.asarray(2.0 * sqrt(self.inertia) * positions / (sqrt(bottom) + np.sqrt(bottom + slope * positions)))

    def arrival_times(self, positions: ArrayLike) -> NDArray[np.float64]:
        """Return R − s(x), s: first arrival, at the positions x, m, of a wave that leaves the upper end at t = 0."""
        return self.travel_time - self.travel_times(positions)

    def front_distance(self, positions: NDArray[np.float64], times: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the time from points to the nearest wave front of a motion that begins at t = 0, over R.

        Both ends reflect a front, so that it passes x at t = (2j + 1)R ∓ s(x), j = 0, 1, …; U or a derivative of it
        jumps there.

        Args:
            positions: x, m, shape (positions,).
            times: t, s, shape (times,).

        Returns:
            Dimensionless, shape (positions, times).
        """
        whole = self.travel_time
        height, moment = (self.travel_times(positions) / whole)[:, None], times / whole
        # Fronts pass where moment ± height is an odd number.
        away = [np.abs(np.mod(moment + sign * height, 2.0) - 1.0) for sign in (1.0, -1.0)]
        return np.asarray(np.minimum(*away))

    @property
    def time_unit(self) -> float:
        """√(l/g), s: the unit of time of `dimensionless`."""
        return sqrt(self.length / self.gravity)

    def dimensionless(self) -> HangingString:
        """Return the same string in the units l of length, √(l/g) of time and ρl of mass."""
        whole = self.linear_density * self.length
        bottom, top = (value / self.linear_density * self.time_unit for value in self.resistance)
        return HangingString(
            length=1.0,
            linear_density=1.0,
            gravity=1.0,
            resistance=(bottom, top),
            tip_mass=self.tip_mass / whole,
            added_mass=self.added_mass / self.linear_density,
            displaced_mass=self.displaced_mass / self.linear_density,
            tip_displaced_mass=self.tip_displaced_mass / whole,
        )


def _require(name: str, value: float, *, positive: bool) -> None:
    if not (isfinite(value) and (value > 0.0 if positive else value >= 0.0)):
        raise ValueError(f"{name} is {value:g}: it must be finite and {'above' if positive else 'not below'} zero")
