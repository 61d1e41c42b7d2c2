"""The hanging string in closed form, for tests: motions of its end, series of its answer, frequencies with a tip mass.

U = f-part + free modes, mode k of J0(μ_k √(x/l)) with Ω_k = μ_k/R, R = 2√(l/g); the series is cut by ½ erfc, so that
away from fronts it is exact to rounding.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.optimize import brentq
from scipy.special import erfc, ive, j0, j1, jn_zeros, y0, y1

from hydroelastic.modal.damped_pair import damped_pair

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Motion:
    """f, f', f'' after t = 0, and how a string without dimensions answers: (damping, positions, times) → U."""

    value: Callable[[ArrayLike], Array]
    slope: Callable[[ArrayLike], Array]
    curvature: Callable[[ArrayLike], Array]
    answer: Callable[[float, Array, Array], Array]
    breaks: tuple[float, ...] = (0.0,)
    end: float = np.inf


def _times(times: ArrayLike) -> Array:
    return np.asarray(times, float)


def _zero(times: ArrayLike) -> Array:
    return 0.0 * _times(times)


_COUNT = 3000
_ZEROS = jn_zeros(0, _COUNT)
_CUT = 0.5 * erfc(np.sqrt(14.0 * np.log(10.0)) * (2.0 * np.arange(1, _COUNT + 1) / _COUNT - 1.0))
FREQUENCIES = 0.5 * _ZEROS
"""Ω_k of a string without dimensions and damping."""


def _series(damping: float, positions: Array, times: Array, first: Array, second: Array) -> Array:
    """Σ B_k (a_k C_k + b_k S_k), B_k = 2 J0(μ_k √x)/(μ_k J1(μ_k))."""
    shapes = 2.0 * j0(np.outer(np.sqrt(positions), _ZEROS)) / (_ZEROS * j1(_ZEROS)) * _CUT
    cosine, sine = damped_pair(FREQUENCIES, damping, times)
    return shapes @ (first[:, None] * cosine + second[:, None] * sine)


def _transfer(p: complex, damping: float, positions: Array) -> NDArray[np.complex128]:
    z, r = 2.0 * np.sqrt(p * p + 2.0 * damping * p + 0j), np.sqrt(positions)
    return ive(0, z * r) / ive(0, z) * np.exp(-abs(z.real) * (1.0 - r))


def ramp() -> Motion:
    def answer(damping: float, positions: Array, times: Array) -> Array:
        e = 2.0 * damping / FREQUENCIES**2
        free = _series(damping, positions, times, e, damping * e - 1.0)
        return times - 2.0 * damping * (1.0 - positions[:, None]) + free

    return Motion(_times, lambda t: 1.0 + _zero(t), _zero, answer)


def step() -> Motion:
    def answer(damping: float, positions: Array, times: Array) -> Array:
        one = np.ones(_COUNT)
        return 1.0 - _series(damping, positions, times, one, damping * one)

    return Motion(lambda t: 1.0 + _zero(t), _zero, _zero, answer)


def sine(omega: float) -> Motion:
    def answer(damping: float, positions: Array, times: Array) -> Array:
        h = _transfer(1j * omega, damping, positions)[:, None]
        gain = FREQUENCIES**2 / (FREQUENCIES**2 - omega**2 + 2j * damping * omega)
        free = _series(damping, positions, times, gain.imag, damping * gain.imag + omega * gain.real)
        return h.real * np.sin(omega * times) + h.imag * np.cos(omega * times) - free

    return Motion(
        lambda t: np.sin(omega * _times(t)),
        lambda t: omega * np.cos(omega * _times(t)),
        lambda t: -(omega**2) * np.sin(omega * _times(t)),
        answer,
    )


def smooth(rate: float) -> Motion:
    def answer(damping: float, positions: Array, times: Array) -> Array:
        def pole(p: float) -> Array:
            return FREQUENCIES**2 / (p * p + 2.0 * damping * p + FREQUENCIES**2)

        c1, c2 = -2.0 * pole(-rate), pole(-2.0 * rate)
        u, v = 1.0 + c1 + c2, -rate * c1 - 2.0 * rate * c2
        forced = 1.0 - 2.0 * _transfer(-rate, damping, positions).real[:, None] * np.exp(-rate * times)
        forced = forced + _transfer(-2.0 * rate, damping, positions).real[:, None] * np.exp(-2.0 * rate * times)
        return forced - _series(damping, positions, times, u, damping * u + v)

    return Motion(
        lambda t: np.expm1(-rate * _times(t)) ** 2,
        lambda t: 2.0 * rate * np.exp(-rate * _times(t)) * -np.expm1(-rate * _times(t)),
        lambda t: 2.0 * rate**2 * np.exp(-rate * _times(t)) * (2.0 * np.exp(-rate * _times(t)) - 1.0),
        answer,
    )


def tip_frequencies(count: int, *, tip: float, hung: float, mass: float = 1.0, slope: float = 1.0) -> Array:
    """Frequencies of ((a + bx)φ')' = −m ω² φ, aφ'(0) = −Mω²φ(0), φ(1) = 0, with a = hung, M = tip.

    φ = A J0(z) + B Y0(z), z = 2ω√(m (a + bx))/b: the determinant of both ends changes sign at each frequency.
    """

    def determinant(omega: float) -> float:
        low, high = (2.0 * omega / slope * np.sqrt(mass * (hung + slope * x)) for x in (0.0, 1.0))
        # dz/dx = ω √(m/(a + bx)).
        rate = hung * omega * np.sqrt(mass / hung)
        first, second = (tip * omega**2 * f(low) - rate * g(low) for f, g in ((j0, j1), (y0, y1)))
        return float(first * y0(high) - second * j0(high))

    travel = 2.0 * np.sqrt(mass) / slope * (np.sqrt(hung + slope) - np.sqrt(hung))
    grid = np.arange(0.002, (count + 2) * np.pi / travel, 0.02 / travel)
    values = np.array([determinant(omega) for omega in grid])
    places = np.flatnonzero(np.sign(values[:-1]) != np.sign(values[1:]))[:count]
    return np.array([brentq(determinant, grid[place], grid[place + 1], xtol=1e-15, rtol=1e-14) for place in places])
