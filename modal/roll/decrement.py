"""Decay of free roll: swing ratios, and the extinction coefficients of Froude and Bertin."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt
from scipy.integrate import solve_ivp
from scipy.optimize import brentq
from scipy.special import hyp2f1, lambertw

from hydroelastic.physics.arrays import FloatArray
from hydroelastic.physics.ship import Ship

_TOLERANCE = 1e-13
# Of 2dA: below, the argument of Lambert's W lies so near −1/e that it takes digits.
_LAMBERT_FROM = 1.0


@dataclass(frozen=True, kw_only=True)
class FroudeCoefficients:
    """Extinction δφ = aφ_m + bφ_m² of a swing in half a cycle, by the mean φ_m of the swings before and after."""

    linear: float  # a, dimensionless
    quadratic: float  # b, 1/rad; alone it is Bertin's N. In degrees, 1/°, it is π/180 of that.


def linear_decrement(ship: Ship) -> float:
    """Return the ratio of a swing to the one before, half a cycle earlier, with linear damping: e^{−πn/√(k² − n²)}."""
    _check_oscillates(ship)
    return math.exp(-math.pi * ship.damping / ship.damped_frequency)


def quadratic_decrement(quadratic_damping: float, amplitude: float) -> float:
    """Return the swing B after a swing A, half a cycle later, with quadratic damping alone, φ'' + d|φ'|φ' + k²φ = 0.

    On the way back u = φ'² satisfies du/dφ − 2d u + 2k²φ = 0, and vanishes at A and −B where

        (1 − 2dB) e^{2dB} = (1 + 2dA) e^{−2dA},    2dB = 1 + W₀(−(1 + 2dA) e^{−1 − 2dA}),

    whatever k. For small amplitudes B = A − (4/3)dA² + …, and no B is larger than 1/(2d).

    Args:
        quadratic_damping: d, 1/rad, from 0.
        amplitude: A, rad, from 0.

    Returns:
        B, rad.
    """
    _check_from_zero("quadratic_damping", quadratic_damping)
    _check_from_zero("amplitude", amplitude)
    doubled = 2 * quadratic_damping
    a = doubled * amplitude
    if a == 0:
        return amplitude
    if a >= _LAMBERT_FROM:
        return float(1 + lambertw(-(1 + a) * math.exp(-1 - a)).real) / doubled
    # −ln(1 − b) − b = a − ln(1 + a), both sides without cancellation.
    root = a * math.sqrt(hyp2f1(1, 2, 3, -a))
    return float(brentq(lambda b: b * math.sqrt(hyp2f1(1, 2, 3, b)) - root, 0.0, a, xtol=1e-300, rtol=1e-15)) / doubled


def swing_amplitudes(ship: Ship, amplitude: float, count: int) -> FloatArray:
    """Return the successive swings |φ|, half a cycle each, of a ship released from rest at an angle.

    In closed form where one of both dampings is 0; otherwise by integration from swing to swing, to about 1e-12.

    Args:
        amplitude: the first swing, rad, from 0.

    Returns:
        The swings, rad, shape (count + 1,), the first one included.
    """
    _check_oscillates(ship)
    _check_from_zero("amplitude", amplitude)
    if count < 0:
        raise ValueError(f"count is {count}; it must be 0 or more")
    if ship.quadratic_damping == 0:
        return amplitude * linear_decrement(ship) ** np.arange(count + 1.0)
    swings = [float(amplitude)]
    for _ in range(count):
        if ship.damping == 0:
            swings.append(quadratic_decrement(ship.quadratic_damping, swings[-1]))
        else:
            swings.append(_next_swing(ship, swings[-1]))
    return np.array(swings)


def froude_coefficients(ship: Ship) -> FroudeCoefficients:
    """Return a = 2 tanh(πn/(2√(k² − n²))) and b = 4d/3.

    Each is that of its damping alone: a exactly, b but for a relative (2dφ_m)²/15. Together they hold for small n/k and
    dφ_m, where a → πn/k.
    """
    _check_oscillates(ship)
    linear = 2 * math.tanh(math.pi * ship.damping / (2 * ship.damped_frequency))
    return FroudeCoefficients(linear=linear, quadratic=4 / 3 * ship.quadratic_damping)


def damping_from_froude(natural_frequency: float, coefficients: FroudeCoefficients) -> Ship:
    """Return the ship that has given coefficients: the inverse of `froude_coefficients`.

    Args:
        natural_frequency: k, rad/s.
        coefficients: a, from 0 and below 2, and b.
    """
    if not 0 <= coefficients.linear < 2:
        raise ValueError(f"linear is {coefficients.linear}; it must be 0 or more, and less than 2")
    ratio = 2 / math.pi * math.atanh(coefficients.linear / 2)
    return Ship(
        natural_frequency=natural_frequency,
        damping=natural_frequency * ratio / math.hypot(1, ratio),
        quadratic_damping=3 / 4 * coefficients.quadratic,
    )


def fit_froude(swings: npt.ArrayLike) -> FroudeCoefficients:
    """Return the coefficients that fit a series of successive swings best, by least squares in δφ/φ_m = a + bφ_m.

    Args:
        swings: |φ|, rad, half a cycle each, shape (swings,), at least three of them.
    """
    swings = np.asarray(swings, float)
    if swings.ndim != 1 or len(swings) < 3:
        raise ValueError(f"swings have shape {swings.shape}; there must be a list of at least three")
    if not (np.isfinite(swings) & (swings > 0)).all():
        raise ValueError("swings must be finite and positive")
    mean = (swings[1:] + swings[:-1]) / 2
    quadratic, linear = np.polyfit(mean, (swings[:-1] - swings[1:]) / mean, 1)
    return FroudeCoefficients(linear=float(linear), quadratic=float(quadratic))


def equivalent_roll_damping(ship: Ship, amplitude: float) -> float:
    """Return the linear damping that takes as much energy from a harmonic roll with k: n + (4/(3π)) d k A, 1/s.

    Args:
        amplitude: A, rad, from 0.
    """
    _check_from_zero("amplitude", amplitude)
    return ship.damping + 4 / (3 * math.pi) * ship.quadratic_damping * ship.natural_frequency * amplitude


def _next_swing(ship: Ship, amplitude: float) -> float:
    # From A = 1 in the time kt: φ falls until it turns, with φ' < 0 and |φ'|φ' = −φ'².
    linear = 2 * ship.damping / ship.natural_frequency
    quadratic = ship.quadratic_damping * amplitude

    def derivatives(_: float, state: Any) -> tuple[float, float]:
        angle, rate = float(state[0]), float(state[1])
        return rate, -angle - linear * rate + quadratic * rate**2

    def turn(_: float, state: Any) -> float:
        return float(state[1])

    turn.terminal = True  # type: ignore[attr-defined]
    turn.direction = 1.0  # type: ignore[attr-defined]
    # Nothing takes longer than half a cycle of the linear motion but strong quadratic damping, by 1 + d A at most.
    longest = 2 * math.pi * (1 + quadratic) * ship.natural_frequency / ship.damped_frequency
    result = solve_ivp(
        derivatives, (0.0, longest), (1.0, 0.0), method="DOP853", rtol=_TOLERANCE, atol=_TOLERANCE, events=turn
    )
    return -amplitude * float(result.y_events[0][0][0])


def _check_oscillates(ship: Ship) -> None:
    if ship.damping >= ship.natural_frequency:
        raise ValueError(
            f"damping is {ship.damping}; a ship swings back and forth only below its natural_frequency, "
            f"{ship.natural_frequency}"
        )


def _check_from_zero(name: str, value: float) -> None:
    if not 0 <= value < math.inf:
        raise ValueError(f"{name} is {value}; it must be finite, and 0 or more")
