"""The forced part of a string's motion: functions of x times functions of t, in closed form up to the upper end.

The second divided difference of the exponential, exp[t; a, b, c], for nodes that may coincide.

It is the response u of u'' − (b + c) u' + b c u = e^{at} from rest, whatever nodes coincide: Σ e^{at}/((a − b)(a − c))
over the three nodes while they differ.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hydroelastic.modal.bessel_zeros import bessel_zeros
from hydroelastic.modal.string.closed_form import bessel_ratio, free_roots, natural_frequencies, participations
from hydroelastic.physics.string import HangingString
from hydroelastic.physics.string_forcing import Forcing

# A mode is taken out of h(x, s) where ζ = R√(−s² − 2αs) is nearer than this to its μ_k (zeros are 3.1 apart) …
NEAR_A_POLE = 0.5
# … and what is left is its mean over a circle of ζ: half a unit at least from μ_k, the next pole 2.6 from the centre.
CIRCLE_RADIUS = 1.0
CIRCLE_POINTS = 40
# Rounding of a term that takes a few operations, and how much less a phase is rounded, which takes one or two.
ROUNDING = 4 * float(np.finfo(float).eps)
PHASE_SHARE = 4

# The series is used while the spread of the nodes times t is below this: the quotient loses no digit beyond.
SERIES_SPREAD = 2.0
# (4/3)ⁿ (n + 1)(n + 2)/2/(n + 2)! is below 1e-19 then.
SERIES_TERMS = 25


@dataclass(frozen=True, kw_only=True)
class Exponential:
    """One exponential c e^{st} of the motion of the upper end."""

    rate: complex  # s, 1/s
    weight: complex  # c, m
    argument: complex  # ζ = R√(−s² − 2αs), from 0 in its real part: h = J₀(ζr)/J₀(ζ) has poles at μ_k
    mode: int  # number of the mode that is taken out of h, or 0


def exponentials(string: HangingString, forcing: Forcing) -> list[Exponential]:
    """Return the exponentials of a motion, each with the mode it nearly meets."""
    found = []
    for rate, weight in zip(forcing.rates, forcing.weights, strict=True):
        argument = complex(string.travel_time * np.sqrt(-rate * (rate + 2 * string.damping)))
        # μ_k = π(k − 1/4) + 1/(8πk) …, so that rounding gives the nearest one.
        nearest = max(1, round(argument.real / np.pi + 0.25))
        close = abs(argument - bessel_zeros(nearest)[-1]) < NEAR_A_POLE
        found.append(Exponential(rate=rate, weight=weight, argument=argument, mode=nearest if close else 0))
    return found


def forced_part(
    string: HangingString,
    forcing: Forcing,
    ratios: NDArray[np.float64],
    times: NDArray[np.float64],
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return the forced part of the motion, with the whole motion of the modes that are taken out of it.

    Args:
        forcing: the motion of the upper end.
        ratios: r = √(x/l), shape (positions,).
        times: s, shape (times,).

    Returns:
        Values and estimates of their rounding errors, m, of shape (positions, times).
    """
    left, right, size_left, size_right = _polynomial_part(string, forcing, ratios, times)
    for exponential in exponentials(string, forcing):
        shape = participations(bessel_zeros(exponential.mode)[-1:], ratios)
        static = _regular_transfer(string, exponential, ratios, shape)
        motion = exponential.weight * np.exp(exponential.rate * times)
        left += [static.real, -static.imag]
        right += [motion.real, motion.imag]
        size_left += [(1 + abs(exponential.argument)) * np.abs(static), np.abs(static)]
        size_right += [np.abs(motion), (1 + abs(exponential.rate) * times / PHASE_SHARE) * np.abs(motion)]
        if exponential.mode:
            coordinate, size = _met_mode(string, exponential, times)
            left.append(shape[:, 0])
            right.append(coordinate)
            size_left.append(np.abs(shape[:, 0]))
            size_right.append(size)
    values = np.stack(left, axis=1) @ np.stack(right)
    return values, ROUNDING * (np.stack(size_left, axis=1) @ np.stack(size_right))


Factors = list[NDArray[np.float64]]


def _polynomial_part(
    string: HangingString, forcing: Forcing, ratios: NDArray[np.float64], times: NDArray[np.float64]
) -> tuple[Factors, Factors, Factors, Factors]:
    """Return Σ h_n(x) (D² + 2αD)ⁿ f, h = Σ h_n σⁿ, as factors of x and of t, and their sizes."""
    drag = 2 * string.damping
    value, slope, curvature, third = (forcing.polynomial(order, times) for order in range(4))
    terms = [
        [value],
        [curvature, drag * slope],
        [drag**2 * curvature, 2 * drag * third],
        [drag**3 * third],
    ]
    right = [np.asarray(sum(parts)) for parts in terms]
    sizes = [np.asarray(sum(np.abs(part) for part in parts)) for parts in terms]
    left = static_terms(string, ratios)
    return list(left), right, [np.abs(term) for term in left], sizes


def static_terms(string: HangingString, ratios: NDArray[np.float64]) -> list[NDArray[np.float64]]:
    """Return h_0 … h_3 of h = I₀(2√(xσ/g))/I₀(2√(lσ/g)) = Σ h_n(x) σⁿ, polynomials in x, each of shape (positions,)."""
    # All vanish at the upper end: its factor is not left to a difference of rounded terms.
    height, fall = ratios**2, (ratios - 1) * (ratios + 1)
    second = (height + 1) / 4 - 1
    third = (height**2 + height + 1) / 36 - 1 / 4 - second
    terms = [np.ones_like(height), fall, fall * second, fall * third]
    return [term * (string.length / string.apparent_gravity) ** order for order, term in enumerate(terms)]


def _regular_transfer(
    string: HangingString, exponential: Exponential, ratios: NDArray[np.float64], shape: NDArray[np.float64]
) -> NDArray[np.complex128]:
    """Return h(x, s), or h − B_m μ_m²/(μ_m² − ζ²) where mode m is taken out."""
    if not exponential.mode:
        return _transfer(np.array([exponential.argument]), ratios)[:, 0]
    angles = 2 * np.pi * (np.arange(CIRCLE_POINTS) + 0.5) / CIRCLE_POINTS
    circle = exponential.argument + CIRCLE_RADIUS * np.exp(1j * angles)
    zero = bessel_zeros(exponential.mode)[-1]
    pole = zero**2 / ((zero - circle) * (zero + circle))
    return np.asarray((_transfer(circle, ratios) - shape * pole).mean(axis=1))


def _transfer(arguments: NDArray[np.complex128], ratios: NDArray[np.float64]) -> NDArray[np.complex128]:
    """Return J₀(ζr)/J₀(ζ) = I₀(zr)/I₀(z) with z = iζ, or −iζ, whichever has a real part from 0."""
    return bessel_ratio(np.where(arguments.imag > 0, -1j, 1j) * arguments, ratios)


def _met_mode(
    string: HangingString, exponential: Exponential, times: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return the whole motion u'' + 2αu' + Ω²u = Ω² Re(c e^{st}) of the mode from rest, and its size for rounding."""
    frequency = float(natural_frequencies(string, exponential.mode)[-1])
    nodes = (exponential.rate, *free_roots(string, exponential.mode)[-1])
    values = exponential.weight * divided_exponential(nodes, times)
    bound = abs(exponential.weight) * divided_exponential_bound(nodes, times)
    phase = 2 + (abs(exponential.rate) + frequency) * times / PHASE_SHARE
    return frequency**2 * values.real, frequency**2 * phase * bound


def divided_exponential(nodes: Sequence[complex], times: NDArray[np.float64]) -> NDArray[np.complex128]:
    """Return exp[t; a, b, c].

    Args:
        nodes: a, b, c, 1/s, in any order.
        times: t, s, from 0.

    Returns:
        Values in s², of the shape of the times.
    """
    first, middle, last = farthest_ends(nodes)
    series = abs(first - last) * times <= SERIES_SPREAD
    values = np.empty(times.shape, dtype=complex)
    values[series] = _series((first, middle, last), times[series])
    late = times[~series]
    if late.size:
        difference = _first_difference(first, middle, late) - _first_difference(middle, last, late)
        values[~series] = difference / (first - last)
    return values


def divided_exponential_bound(nodes: Sequence[complex], times: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return a bound of |exp[t; a, b, c]| for nodes with real parts up to 0, of the shape of the times."""
    first, middle, last = farthest_ends(nodes)
    spread, gap = abs(first - last), min(abs(first - middle), abs(middle - last))
    growth = np.exp(max(node.real for node in nodes) * times)
    with np.errstate(divide="ignore", over="ignore"):
        single = np.minimum(times, np.divide(2.0, gap))
        return np.asarray(growth * np.minimum(times**2 / 2, np.divide(2.0, spread) * single))


def farthest_ends(nodes: Sequence[complex]) -> tuple[complex, complex, complex]:
    """Return the nodes so ordered that the first and the last are farthest apart."""
    a, b, c = (complex(node) for node in nodes)
    orders = ((a, b, c), (b, a, c), (a, c, b))
    return max(orders, key=lambda order: abs(order[0] - order[2]))


def _first_difference(a: complex, b: complex, times: NDArray[np.float64]) -> NDArray[np.complex128]:
    """Return (e^{at} − e^{bt})/(a − b)."""
    if a.real < b.real:
        a, b = b, a
    exponents = (b - a) * times
    quotient = np.ones_like(exponents)
    np.divide(np.expm1(exponents), exponents, out=quotient, where=exponents != 0)
    return np.asarray(np.exp(a * times) * times * quotient)


def _series(nodes: Sequence[complex], times: NDArray[np.float64]) -> NDArray[np.complex128]:
    """Return t² e^{mt} Σ H_n(δt)/(n + 2)!, m the mean and H_n the complete homogeneous polynomials of nodes − m."""
    mean = sum(nodes) / 3
    a, b, c = (node - mean for node in nodes)
    pairs, product = (a * b + b * c + c * a) * times**2, a * b * c * times**3
    before, previous, current = np.zeros_like(pairs), np.zeros_like(pairs), np.ones_like(pairs)
    total, factorial = current / 2, 2.0
    for order in range(1, SERIES_TERMS):
        before, previous, current = previous, current, product * before - pairs * previous
        factorial *= order + 2
        total = total + current / factorial
    return np.asarray(times**2 * np.exp(mean * times) * total)
