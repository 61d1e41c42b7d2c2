"""Spectra of irregular waves, S(ω) in m² s/rad with ∫S dω = Hs²/16, and what they leave out beyond a range.

    Pierson–Moskowitz   S = (5/16) Hs² ωₚ⁴ ω⁻⁵ e^{−(5/4)(ωₚ/ω)⁴}
    JONSWAP             S = A γ^r S_PM,   r = e^{−(ω/ωₚ − 1)²/(2σ²)},  σ = 0.07 below ωₚ and 0.09 above,

with A so that the integral is Hs²/16 exactly. Sources: W. J. Pierson and L. Moskowitz, J. Geophys. Res. 69 (1964) 5181;
K. Hasselmann et al., Dtsch. Hydrogr. Z. A8 (1973) 12.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from dataclasses import dataclass
from functools import cached_property
from math import exp, pi, sqrt

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import quad

# Where S of Pierson and Moskowitz begins and ends, in parts of ωₚ: below, e^{−(5/4) x⁻⁴} is 1e-11 of the energy.
_LOWEST = 0.47
_HIGHEST = 4.0
_WIDTHS = (0.07, 0.09)
_PRECISION = 1e-12


class WaveSpectrum(ABC):
    """A spectrum of wave elevation."""

    @property
    @abstractmethod
    def band(self) -> tuple[float, float]:
        """Frequencies between which nearly all of its energy lies, rad/s."""

    @property
    @abstractmethod
    def edges(self) -> tuple[float, ...]:
        """Frequencies at which it is not smooth, or has a narrow peak, rad/s."""

    @abstractmethod
    def density(self, omega: NDArray[np.float64]) -> NDArray[np.float64]:
        """S at ω > 0, in the shape of ω, m² s/rad."""

    @abstractmethod
    def tail(self, omega: float, order: int) -> float:
        """∫ S ω'^order dω' from ω to ∞, for orders 0 to 2."""

    @property
    @abstractmethod
    def significant_height(self) -> float:
        """Hs = 4 (∫S dω)^{1/2}, m."""

    def below(self, omega: float, order: int) -> float:
        """∫ S ω'^order dω' from 0 to ω."""
        value = quad(lambda x: float(self.density(np.array([x]))[0]) * x**order, 1e-9 * omega, omega, limit=200)[0]
        return float(value)


@dataclass(frozen=True, kw_only=True)
class PeakedSpectrum(WaveSpectrum):
    """The spectrum of Pierson and Moskowitz, or of JONSWAP."""

    height: float  # significant height Hs, m
    period: float  # of the peak, s
    enhancement: float = 1.0  # γ; 1 is Pierson and Moskowitz

    @property
    def peak(self) -> float:
        """ωₚ, rad/s."""
        return 2.0 * pi / self.period

    @property
    def significant_height(self) -> float:
        """See `WaveSpectrum.significant_height`."""
        return self.height

    @property
    def band(self) -> tuple[float, float]:
        """See `WaveSpectrum.band`."""
        return _LOWEST * self.peak, _HIGHEST * self.peak

    @property
    def edges(self) -> tuple[float, ...]:
        """See `WaveSpectrum.edges`; the enhancement jumps in its second derivative at the peak."""
        return tuple(factor * self.peak for factor in (0.8, 0.9, 1.0, 1.1, 1.3))

    @cached_property
    def _scale(self) -> float:
        if self.enhancement == 1.0:
            return 1.0
        energy = sum(
            quad(lambda x: 5.0 * x**-5 * exp(-1.25 * x**-4) * (self._enhanced(x) - 1.0), low, high, epsabs=_PRECISION)[
                0
            ]
            for low, high in ((0.3, 0.8), (0.8, 1.0), (1.0, 1.3), (1.3, 3.0))
        )
        # ∫ 5 x⁻⁵ e^{−(5/4)x⁻⁴} dx = 1.
        return 1.0 / (1.0 + energy)

    def _enhanced(self, x: float) -> float:
        width = _WIDTHS[0] if x <= 1.0 else _WIDTHS[1]
        return float(self.enhancement ** exp(-0.5 * ((x - 1.0) / width) ** 2))

    def density(self, omega: NDArray[np.float64]) -> NDArray[np.float64]:
        """See `WaveSpectrum.density`."""
        x = np.maximum(omega / self.peak, 1e-3)
        widths = np.where(x <= 1.0, *_WIDTHS)
        growth = self.enhancement ** np.exp(-0.5 * ((x - 1.0) / widths) ** 2)
        values: NDArray[np.float64] = (
            self._scale * growth * 5.0 / 16.0 * self.height**2 / self.peak * x**-5.0 * np.exp(-1.25 * x**-4.0)
        )
        return values

    def tail(self, omega: float, order: int) -> float:
        """See `WaveSpectrum.tail`; by the tail (5/16) Hs² ωₚ⁴ ω⁻⁵, which is an upper bound beyond 1.5 ωₚ."""
        power = 4 - order
        return self._scale * 5.0 / 16.0 * self.height**2 * self.peak**4 / (power * omega**power)


@dataclass(frozen=True, kw_only=True)
class TabulatedSpectrum(WaveSpectrum):
    """A spectrum of given values, linear between them and zero outside."""

    omega: tuple[float, ...]  # frequencies, ascending, rad/s
    values: tuple[float, ...]  # S, m² s/rad

    @property
    def significant_height(self) -> float:
        """See `WaveSpectrum.significant_height`."""
        return 4.0 * sqrt(float(np.trapezoid(self.values, self.omega)))

    @property
    def band(self) -> tuple[float, float]:
        """See `WaveSpectrum.band`."""
        return self.omega[0], self.omega[-1]

    @property
    def edges(self) -> tuple[float, ...]:
        """See `WaveSpectrum.edges`."""
        return self.omega

    def density(self, omega: NDArray[np.float64]) -> NDArray[np.float64]:
        """See `WaveSpectrum.density`."""
        return np.interp(omega, self.omega, self.values, left=0.0, right=0.0)

    def tail(self, omega: float, order: int) -> float:
        """See `WaveSpectrum.tail`: nothing beyond the table."""
        return 0.0

    def below(self, omega: float, order: int) -> float:
        """See `WaveSpectrum.below`: nothing before the table."""
        return 0.0
