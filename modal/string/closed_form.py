"""Closed forms of a uniform hanging string: modes, roots, fronts and steady motion.

U_tt + 2αU_t = (g x U_x)_x with x up from the free lower end, U(l, t) = f(t), and g the apparent gravity. With the
travel time R = 2√(l/g), r = √(x/l) and the zeros μ_k of J₀ the mode shapes are J₀(μ_k r) with frequencies Ω_k = μ_k/R,
and the motion of the upper end reaches x in Laplace images by I₀(z r)/I₀(z), z = R√(p² + 2αp).

All functions raise ValueError for a string with a tip mass or a resistance that varies: it has no such forms.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.special import i0e, ive, j0, j1

from hydroelastic.modal.bessel_zeros import bessel_zeros
from hydroelastic.physics.string import HangingString

# Fraction of μ below which J₀ near its zero is rounding alone.
AT_A_ZERO = 4 * np.finfo(float).eps


def natural_frequencies(string: HangingString, count: int) -> NDArray[np.float64]:
    """Return the undamped frequencies Ω_k = μ_k/R of the first modes, rad/s, shape (count,)."""
    _check_closed_form(string)
    if count < 0:
        raise ValueError(f"count is {count}: it must not be negative")
    return np.divide(bessel_zeros(count), string.travel_time)


def natural_frequency(string: HangingString, number: int) -> float:
    """Return Ω_k of mode k = number, counted from 1, rad/s: with the damping α = Ω_k this mode is critically damped."""
    _check_mode(number)
    return float(natural_frequencies(string, number)[-1])


def free_roots(string: HangingString, count: int) -> NDArray[np.complex128]:
    """Return the roots of p² + 2αp + Ω_k² for the first modes, 1/s, shape (count, 2).

    −α ± i√(Ω_k² − α²); beyond critical damping the slow root −Ω_k²/(α + s) first, then the fast −(α + s), with
    s = √(α² − Ω_k²); both −α at critical damping.
    """
    frequencies, damping = natural_frequencies(string, count), string.damping
    excess = (frequencies - damping) * (frequencies + damping)
    root = np.sqrt(np.abs(excess))
    under = -damping + np.outer(root, [1j, -1j])
    fast = damping + root
    slow = np.divide(frequencies**2, fast, out=np.zeros_like(fast), where=fast > 0)
    return np.where((excess > 0)[:, None], under, -np.stack([slow, fast], axis=1))


def first_oscillating_mode(string: HangingString) -> int:
    """Return the number of the lowest mode that oscillates: Ω_{k−1} ≤ α < Ω_k, counted from 1.

    Higher modes oscillate too: no damping suppresses the oscillation of all.
    """
    # Ω_k > π(k − 1/4)/R, so that no mode above this one is aperiodic.
    enough = int(string.damping * string.travel_time / math.pi + 2)
    return int(np.searchsorted(natural_frequencies(string, enough), string.damping, side="right")) + 1


def mode_shape(string: HangingString, number: int, positions: ArrayLike) -> NDArray[np.float64]:
    """Return J₀(μ_k √(x/l)) of mode k = number, counted from 1, at the positions x, m, in their shape."""
    _check_mode(number)
    return np.asarray(j0(bessel_zeros(number)[-1] * relative_roots(string, positions)))


def relative_roots(string: HangingString, positions: ArrayLike) -> NDArray[np.float64]:
    """Return r = √(x/l) at positions x (m) above the lower end, in their shape."""
    _check_closed_form(string)
    positions = np.asarray(positions, dtype=float)
    wrong = ~((positions >= 0) & (positions <= string.length))
    if wrong.any():
        raise ValueError(
            f"positions has {positions[wrong].flat[0]}: from 0, the free lower end, to {string.length} m is allowed"
        )
    return np.sqrt(positions / string.length)


def front_jump(string: HangingString, positions: ArrayLike) -> NDArray[np.float64]:
    """Return the height (l/x)^{1/4} e^{−α t_f}, m, of the front of a unit step at positions x, m; infinite at 0."""
    ratios = relative_roots(string, positions)
    with np.errstate(divide="ignore"):
        return np.asarray(np.exp(-string.damping * string.travel_time * (1 - ratios)) / np.sqrt(ratios))


def transfer(string: HangingString, exponents: ArrayLike, positions: ArrayLike) -> NDArray[np.complex128]:
    """Return h = I₀(z r)/I₀(z), z = R√(p² + 2αp): the string moves as h e^{pt} under f = e^{pt}.

    Args:
        exponents: p, 1/s, complex, shape (exponents,) or one.
        positions: x, m, shape (positions,) or one.

    Returns:
        h, shape (positions, exponents).
    """
    exponents = np.atleast_1d(np.asarray(exponents, dtype=complex))
    radicands = exponents * (exponents + 2 * string.damping)
    return bessel_ratio(
        np.sqrt(radicands) * complex(string.travel_time), np.atleast_1d(relative_roots(string, positions))
    )


def steady_amplitude(string: HangingString, omega: float, positions: ArrayLike) -> NDArray[np.float64]:
    """Return A(x)/Δ = |J₀(μ r)/J₀(μ)|, μ = R√(ω² − 2iαω), of the steady motion under f = Δ sin ωt.

    Args:
        omega: ω, rad/s, not negative.
        positions: x, m, shape (positions,) or one.

    Returns:
        The ratio of amplitudes, shape (positions,). Infinite below the upper end without damping at ω = Ω_k, where
        the motion grows with time.
    """
    if not (omega >= 0 and math.isfinite(omega)):
        raise ValueError(f"omega is {omega}: it must be finite and not negative")
    ratios = np.atleast_1d(relative_roots(string, positions))
    argument = string.travel_time * omega
    if string.damping == 0 and abs(j0(argument)) <= AT_A_ZERO * argument * abs(j1(argument)):
        return np.where(ratios < 1, math.inf, 1.0)
    return np.asarray(np.abs(transfer(string, 1j * omega, positions)[:, 0]))


def participations(zeros: NDArray[np.float64], ratios: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return B_k = 2J₀(μ_k r)/(μ_k J₁(μ_k)), of sum 1 for r < 1: how modes take part in a motion of the upper end.

    Args:
        zeros: μ_k, shape (modes,).
        ratios: r, from 0 to 1, shape (positions,).

    Returns:
        B_k, shape (positions, modes).
    """
    return np.asarray(j0(np.outer(ratios, zeros)) * (2 / (zeros * j1(zeros))))


def bessel_ratio(arguments: NDArray[np.complex128], ratios: NDArray[np.float64]) -> NDArray[np.complex128]:
    """Return I₀(z r)/I₀(z), shape (ratios, arguments), without overflow.

    Args:
        arguments: z, complex, with real part from 0, shape (arguments,).
        ratios: r, from 0 to 1, shape (ratios,).
    """
    scaled = np.exp(-np.multiply.outer(1 - ratios, np.abs(arguments.real)))
    return scaled * _scaled_bessel(np.multiply.outer(ratios, arguments)) / _scaled_bessel(arguments)


def _scaled_bessel(arguments: NDArray[np.complex128]) -> NDArray[np.complex128]:
    """Return I₀(z) e^{−|Re z|}; on the axes by the real functions, which hold for any size."""
    if not arguments.imag.any():
        return i0e(arguments.real).astype(complex)
    if not arguments.real.any():
        return j0(arguments.imag).astype(complex)
    return np.asarray(ive(0, arguments))


def _check_closed_form(string: HangingString) -> None:
    if not string.has_closed_form:
        raise ValueError("a string with a tip mass or a resistance that varies has no closed form")


def _check_mode(number: int) -> None:
    if number < 1:
        raise ValueError(f"number is {number}: modes are counted from 1")
