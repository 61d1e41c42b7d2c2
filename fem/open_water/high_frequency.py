"""High-frequency series of H, used above the frequencies that the mesh resolves.

With s = p² over that of the mesh's highest frequency, p = −iω, and N orders,

    H = a(∞) + Σ_{j=1…N} (Cⱼ + Dⱼ ln s) s⁻ʲ,        Cⱼ, Dⱼ real,

the expansion for short waves, which depend only on the body near its waterline: powers are those of multipoles there,
logarithms come from the curvature of the body and from contours that meet the level at other than right angles. The
coefficients are fitted on the arc |p| = constant between the positive axis, where no waves are radiated, and the ray:
around it H is analytic but for the cut of ln s, so that the error decreases geometrically with N. The difference from
N − 2 orders estimates the error.

Measured with H of thin floats of five shapes (slenderness 0.1 to 0.6), exact but for noise of 1e-7: the error of their
motion with N = 10 is less than 1e-5 from 1.5 times their frequency on, 6e-7 from 2 and 3e-8 from 2.7 on.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import log10, pi

import numpy as np

# N, and the number of points of the arc to which the 2N coefficients are fitted.
_ORDERS = 10
_POINTS = 48


@dataclass(frozen=True, kw_only=True)
class HighFrequencySeries:
    """The high-frequency series of H. Shapes: m body unknowns."""

    unit: float  # the frequency |ω| of the arc
    limit: np.ndarray  # a(∞), shape (m, m)
    coefficients: np.ndarray  # C₁, D₁, C₂ …, shape (2N, m, m)
    fewer: np.ndarray  # coefficients with N − 2 orders, shape (2N − 4, m, m)

    def hydrodynamic(self, omegas: np.ndarray) -> np.ndarray:
        """Return H at ω of shape (n,): shape (n, m, m)."""
        return self.limit + self.beyond_limit(omegas)

    def beyond_limit(self, omegas: np.ndarray) -> np.ndarray:
        """Return H − a(∞) at ω of shape (n,), with all digits: shape (n, m, m)."""
        return self._sum(omegas, self.coefficients)

    def errors(self, omegas: np.ndarray) -> np.ndarray:
        """Return an upper estimate of |δH| of the truncated series at ω of shape (n,): shape (n, m, m)."""
        return np.abs(self._sum(omegas, self.coefficients) - self._sum(omegas, self.fewer))

    def _sum(self, omegas: np.ndarray, coefficients: np.ndarray) -> np.ndarray:
        values: np.ndarray = np.tensordot(_terms(omegas / self.unit, len(coefficients) // 2), coefficients, axes=1)
        return values


def arc(highest: complex, count: int) -> np.ndarray:
    """Return ω of one magnitude from where p = −iω is positive to the ray, shape (count,)."""
    omegas: np.ndarray = abs(highest) * np.exp(1j * np.linspace(0.5 * pi, np.angle(highest), count))
    return omegas


def high_frequency_series(
    hydrodynamics: Callable[[np.ndarray], np.ndarray], highest: complex, limit: np.ndarray
) -> HighFrequencySeries:
    """Fit the series to H on the arc."""
    omegas = arc(highest, _POINTS)
    wanted = hydrodynamics(omegas) - limit
    flat = wanted.reshape(len(omegas), -1)

    def fitted(orders: int) -> np.ndarray:
        terms = _terms(omegas / abs(highest), orders)
        known, values = (np.vstack([part.real, part.imag]) for part in (terms, flat))
        coefficients: np.ndarray = np.linalg.lstsq(known, values, rcond=None)[0]
        return coefficients.reshape(-1, *limit.shape)

    return HighFrequencySeries(unit=abs(highest), limit=limit, coefficients=fitted(_ORDERS), fewer=fitted(_ORDERS - 2))


def _terms(omegas: np.ndarray, orders: int) -> np.ndarray:
    """s⁻¹, s⁻¹ ln s, s⁻² … at ω of shape (n,): shape (n, 2N)."""
    logarithm = 2.0 * np.log(-1j * omegas)
    powers = (-(omegas**2))[:, None] ** -np.arange(1.0, orders + 1.0)
    return np.stack([powers, powers * logarithm[:, None]], axis=2).reshape(len(omegas), -1)


def highest_meshed_frequency(fastest: float, tolerance: float) -> float:
    """Return the highest frequency that the mesh must resolve, rad/s: the lower the tolerance, the higher."""
    return fastest * (1.0 - 0.2 * log10(tolerance))
