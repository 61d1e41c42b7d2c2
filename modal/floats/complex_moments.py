"""The wave moment R of a thin float at complex wavenumbers, where its waves grow or fall along the surface."""

from __future__ import annotations

import functools
import math

import numpy as np
import numpy.typing as npt
from numpy.polynomial.legendre import leggauss

from hydroelastic.modal.floats.thin_shapes import check_pointed, wave_moment_series
from hydroelastic.physics.arrays import FloatArray
from hydroelastic.physics.profiles import Profile

ComplexArray = npt.NDArray[np.complex128]

MOST_ANGLE = math.radians(80)
"""Greatest |arg κ|: beyond |κ| = 200 the pointed end, e^{−κ}, is then below rounding."""

_FAR = 200.0
_POINTS = 256
_SERIES_BELOW = 2.0
_SERIES_TERMS = 30


def complex_wave_moment(profile: Profile, argument: npt.ArrayLike) -> ComplexArray:
    """Return R(κ)/b = ∫ q e^{−κy} dy over the upper half, y in units of h, for complex κ.

    `wave_moment` has the same for real κ. Closed forms, but for the ellipse: 256 Gauss points up to |κ| = 200, then
    the asymptotic series.

    Args:
        argument: κ with |arg κ| ≤ `MOST_ANGLE`, not checked.

    Returns:
        Values in the shape of ``argument``.

    Source: open water, docs, thin float.
    """
    check_pointed(profile)
    kappa = np.atleast_1d(np.asarray(argument, dtype=np.complex128))
    if profile.shape == "exponential":
        moment = _exponential(profile, kappa)
    elif profile.shape == "wedge":
        moment = -np.expm1(-kappa) / kappa
    else:
        moment = _parabola(kappa) if profile.shape == "parabola" else _ellipse(profile, kappa)
    return moment.reshape(np.shape(argument))


def _exponential(profile: Profile, kappa: ComplexArray) -> ComplexArray:
    if not profile.tail:
        return 1 / (1 + kappa)
    end = profile.extent / profile.half_height
    return -np.expm1(-(1 + kappa) * end) / ((1 + kappa) * (1 - profile.tail))


def _parabola(kappa: ComplexArray) -> ComplexArray:
    """2 [1 − (1 + κ) e^{−κ}]/κ², which cancels for small κ, there by its power series."""
    moment = np.empty_like(kappa)
    small = np.abs(kappa) < _SERIES_BELOW
    coefficients = [2 * (-1) ** m / (math.factorial(m) * (m + 2)) for m in range(_SERIES_TERMS)]
    moment[small] = np.polyval(coefficients[::-1], kappa[small])
    large = kappa[~small]
    moment[~small] = 2 * (1 - (1 + large) * np.exp(-large)) / large**2
    return moment


def _ellipse(profile: Profile, kappa: ComplexArray) -> ComplexArray:
    moment = np.empty_like(kappa)
    large = np.abs(kappa) > _FAR
    heights, weights = _ellipse_rule()
    moment[~large] = np.exp(-np.multiply.outer(kappa[~large], heights)) @ weights
    _, coefficients = wave_moment_series(profile)
    # Powers −2, −4, …: κ itself to a high power would overflow.
    square = kappa[large] ** -2
    moment[large] = square * np.polyval(coefficients[::-1], square)
    return moment


@functools.lru_cache(maxsize=1)
def _ellipse_rule() -> tuple[FloatArray, FloatArray]:
    """Return heights y = sin t and weights of ∫ sin t f(sin t) dt over a quarter turn."""
    nodes, weights = leggauss(_POINTS)
    angle = math.pi / 4 * (nodes + 1)
    return np.sin(angle), math.pi / 4 * weights * np.sin(angle)
