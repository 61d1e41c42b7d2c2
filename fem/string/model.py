"""The hanging string and its liquid in SI units, and the same without dimensions.

    ∫m U_tt v + ∫2λ U_t v + M U_tt v|₀ + ∫T U_x v_x = 0,    U = f(t) at the upper end x = l,

with m = ρ + added mass, T(x) = g [(M − M_displaced) + (ρ − ρ_displaced) x]: the weight hung below x less the buoyancy.
The unit of length is l, of time √(l/g), of mass ρl.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import isfinite, sqrt

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True, kw_only=True)
class StringModel:
    """A string that hangs from a moving point, its lower end free or with a mass.

    Attributes:
        length: l, m.
        linear_density: ρ, kg/m.
        gravity: g, m/s².
        resistance: λ at the lower and at the upper end, kg/(m s), linear between; the drag is 2λ ∂U/∂t per unit length.
        tip_mass: M at the lower end, kg.
        added_mass: of the liquid that moves along with the string, kg/m.
        displaced_mass: of the liquid whose place the string takes, kg/m.
        tip_displaced_mass: the same of the mass at the lower end, kg.

    Raises:
        ValueError: where a number is out of range, or the string is not under tension.
    """

    length: float
    linear_density: float
    gravity: float = 9.81
    resistance: tuple[float, float] = (0.0, 0.0)
    tip_mass: float = 0.0
    added_mass: float = 0.0
    displaced_mass: float = 0.0
    tip_displaced_mass: float = 0.0

    def __post_init__(self) -> None:
        """Refuse what does not hang."""
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


def _require(name: str, value: float, *, positive: bool) -> None:
    allowed = value > 0.0 if positive else value >= 0.0
    if not (isfinite(value) and allowed):
        raise ValueError(f"{name} is {value:g}: it must be finite and {'above' if positive else 'not below'} zero")


@dataclass(frozen=True, kw_only=True)
class ScaledString:
    """The same string on 0 ≤ x ≤ 1.

    Attributes:
        time_unit: √(l/g), s.
        length_unit: l, m.
        mass: m.
        tip_mass: M.
        tension: T at the lower end, and its slope.
        resistance: 2λ at the lower end, and its slope.
    """

    time_unit: float
    length_unit: float
    mass: float
    tip_mass: float
    tension: tuple[float, float]
    resistance: tuple[float, float]

    @property
    def travel_time(self) -> float:
        """Of a wave from one end to the other, ∫dx/√(T/m)."""
        return float(self.travel_times(np.ones(1))[0])

    def travel_times(self, positions: NDArray[np.float64]) -> NDArray[np.float64]:
        """Of a wave from the lower end to the positions, shape (positions,)."""
        bottom, slope = self.tension
        # 0/0 at the lower end without a tip mass.
        both = np.maximum(sqrt(bottom) + np.sqrt(bottom + slope * positions), np.finfo(float).tiny)
        return np.asarray(2.0 * sqrt(self.mass) * positions / both)

    @property
    def uniform_damping(self) -> float | None:
        """α where the drag is 2α times the mass everywhere, so that undamped modes are those of the damped string."""
        uniform = self.resistance[1] == 0.0 and (self.tip_mass == 0.0 or self.resistance[0] == 0.0)
        return 0.5 * self.resistance[0] / self.mass if uniform else None

    @property
    def smallest_damping(self) -> float:
        """The smallest λ/m of the string."""
        return 0.5 * min(self.resistance[0], self.resistance[0] + self.resistance[1]) / self.mass


def scaled_string(model: StringModel) -> ScaledString:
    """Take the dimensions out of a string."""
    whole = model.linear_density * model.length
    time_unit = float(np.sqrt(model.length / model.gravity))
    bottom, top = (2.0 * value / model.linear_density * time_unit for value in model.resistance)
    return ScaledString(
        time_unit=time_unit,
        length_unit=model.length,
        mass=1.0 + model.added_mass / model.linear_density,
        tip_mass=model.tip_mass / whole,
        tension=(
            (model.tip_mass - model.tip_displaced_mass) / whole,
            1.0 - model.displaced_mass / model.linear_density,
        ),
        resistance=(bottom, top - bottom),
    )
