"""Two liquids on a flat bed: waves, evanescent modes, and how the surface or the interface answers a load.

Nothing of the package is imported.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from open_levels import Level, Symbol
from scipy.optimize import brentq


@dataclass(frozen=True, kw_only=True)
class TwoLiquids:
    """Two liquids on a flat bed.

    Attributes:
        densities: ρ₂ below, ρ₁ < ρ₂ above, kg/m³.
        depths: h₂ below, h₁ above, m; h₂ may be infinite.
        lid: whether the upper liquid ends at a rigid lid.
        gravity: g, m/s².
    """

    densities: tuple[float, float]
    depths: tuple[float, float]
    lid: bool = False
    gravity: float = 9.81

    def squares(self, k: float) -> list[float]:
        """ω² of the waves of a wave number, ascending: the interface wave, then with a free top the surface wave."""
        ratio, pull = self.densities[1] / self.densities[0], self.gravity * k
        below, above = (math.tanh(k * depth) for depth in self.depths)
        if self.lid:
            return [(1 - ratio) * pull * below * above / (above + ratio * below)]
        # ω⁴(1 + R t₁t₂) − ω² gk (t₁ + t₂) + (1 − R)(gk)² t₁t₂ = 0
        leading, middle = 1 + ratio * below * above, pull * (below + above)
        last = (1 - ratio) * pull**2 * below * above
        upper = (middle + math.sqrt(middle**2 - 4 * leading * last)) / (2 * leading)
        return [last / (leading * upper), upper]

    def wave_numbers(self, omega: float) -> np.ndarray:
        """Of the waves of ω, 1/m, ascending: the surface wave comes before the interface wave."""
        found = []
        for branch in range(1 if self.lid else 2):
            high = omega**2 / self.gravity
            while self.squares(high)[branch] < omega**2:
                high *= 2
            low = high
            while self.squares(low)[branch] > omega**2:
                low /= 2
            found.append(brentq(lambda k, b=branch: self.squares(k)[b] - omega**2, low, high, xtol=1e-300, rtol=1e-15))
        return np.sort(found)

    def evanescent(self, omega: float, count: int) -> np.ndarray:
        """The lowest decay rates κ of the modes e^{−κ|x|}, 1/m, shape (count,); both depths are finite.

        c − S(iκ) falls from ∞ to −∞ between the poles of S, where the interface does not move.
        """
        orders = np.arange(count + 1)
        below, above = (orders * math.pi / depth for depth in self.depths)
        surface = omega**2 / self.gravity
        if not self.lid:
            # κ tan κh₁ = −ω²/g, once in each quarter before nπ/h₁.
            above = above[1:]
            low, high = above - math.pi / 2 / self.depths[1], above
            above = _bisected(
                lambda k: surface * np.cos(k * self.depths[1]) + k * np.sin(k * self.depths[1]), low, high
            )
        poles = np.sort(np.concatenate([below, above[1:] if self.lid else above]))[: count + 1]
        level = self.interface(omega)
        return _bisected(lambda k: level.stiffness - level.symbol(1j * k).real, poles[:-1], poles[1:])

    def interface_over_surface(self, omega: float) -> np.ndarray:
        """Elevation of the interface over that of the free surface, of each wave by wave number."""
        (below, above), (depth_below, depth_above) = self.densities, self.depths
        k = self.wave_numbers(omega)
        restoring = (below - above) * self.gravity / (above * omega**2)
        potential = below / above / (k * np.tanh(k * depth_below)) - restoring
        return np.asarray(1 / (np.cosh(k * depth_above) + k * potential * np.sinh(k * depth_above)))

    def interface(self, omega: float) -> Level:
        """The interface, S = ω²(ρ₂ψ₂ − ρ₁ψ₁) with ∂ψ/∂y = 1."""
        (below, above), (depth_below, depth_above) = self.densities, self.depths
        surface = omega**2 / self.gravity

        def symbol(k: np.ndarray) -> np.ndarray:
            tanh = np.tanh(k * depth_above)
            upper = 1 / tanh if self.lid else (k - surface * tanh) / (k * tanh - surface)
            return np.asarray(omega**2 / k * (below / np.tanh(k * depth_below) + above * upper))

        return self._level(omega, symbol, below - above, below + above, min(self.depths))

    def surface(self, omega: float) -> Level:
        """The free surface of the upper liquid, S = ρ₁ω²ψ₁ with ∂ψ₁/∂y = 1 above a moving interface.

        The residue of the interface wave, of the order e^{−2kh₁}, is lost in rounding where kh₁ > 10.
        """
        (below, above), (depth_below, depth_above) = self.densities, self.depths
        restoring = (below - above) * self.gravity / (above * omega**2)

        def symbol(k: np.ndarray) -> np.ndarray:
            tanh = np.tanh(k * depth_above)
            potential = below / above / (k * np.tanh(k * depth_below)) - restoring
            return np.asarray(above * omega**2 * (potential + tanh / k) / (k * potential * tanh + 1))

        return self._level(omega, symbol, above, above, depth_above)

    def _level(self, omega: float, symbol: Symbol, difference: float, inertia: float, depth: float) -> Level:
        stiffness = difference * self.gravity
        return Level(
            omega=omega,
            stiffness=stiffness,
            symbol=symbol,
            deep=omega**2 * inertia / stiffness,
            depth=depth,
            wave_numbers=self.wave_numbers(omega),
        )


def _bisected(function: Symbol, low: np.ndarray, high: np.ndarray) -> np.ndarray:
    """The zeros of a function of one change of sign in each interval."""
    middle = (low + high) / 2
    rising = function(low + 1e-9 * (high - low)) < 0
    for _ in range(60):
        left = (function(middle) < 0) == rising
        low, high = np.where(left, middle, low), np.where(left, high, middle)
        middle = (low + high) / 2
    return middle
