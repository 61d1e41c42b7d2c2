"""The second divided difference of the exponential, exp[t; a, b, c], for nodes that may coincide.

It is the response u of u'' − (b + c) u' + b c u = e^{at} from rest, whatever nodes coincide: Σ e^{at}/((a − b)(a − c))
over the three nodes while they differ.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

# The series is used while the spread of the nodes times t is below this: the quotient loses no digit beyond.
SERIES_SPREAD = 2.0
# (4/3)ⁿ (n + 1)(n + 2)/2/(n + 2)! is below 1e-19 then.
SERIES_TERMS = 25


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
