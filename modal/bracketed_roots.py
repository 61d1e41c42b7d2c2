"""Many roots at once, each between two places where a function has opposite signs."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from hydroelastic.physics.arrays import FloatArray

_MOST_STEPS = 200
# Of a bracket. Rounding of the function itself moves a root by not much less.
_TOLERANCE = 1e-14
_EPS = float(np.finfo(float).eps)


def sign_change_roots(
    function: Callable[[FloatArray], FloatArray], knots: FloatArray, values: FloatArray
) -> FloatArray:
    """Return one root of a continuous function between each two knots where its sign changes.

    Knots where the function is exactly 0 are left out first: a root there is found between its neighbours, and where a
    function only touches 0 there is none.

    Args:
        function: f, of places of any number.
        knots: increasing places, shape (n,).
        values: f at the knots, shape (n,).

    Returns:
        The roots, increasing, as `bracketed_roots` finds them, shape (roots,).
    """
    knots, values = knots[values != 0], values[values != 0]
    change = np.flatnonzero(np.sign(values[1:]) != np.sign(values[:-1]))
    return bracketed_roots(function, knots[change], knots[change + 1], values[change], values[change + 1])


def bracketed_roots(
    function: Callable[[FloatArray], FloatArray], left: FloatArray, right: FloatArray, low: FloatArray, high: FloatArray
) -> FloatArray:
    """Return a root in each bracket by Ridders' method, in all of them together.

    SciPy finds roots of many brackets at once from its version 1.15 only.

    Args:
        function: f of places of shape (places,), dimensionless or in any unit.
        left: lower ends of the brackets, shape (brackets,).
        right: upper ends, shape (brackets,).
        low: f at the lower ends, not 0, shape (brackets,).
        high: f at the upper ends, of opposite sign, shape (brackets,).

    Returns:
        The roots, to 1e-14 of the bracket or a few roundings of the place, shape (brackets,).
    """
    roots, active = np.array(left), np.arange(len(left))
    tolerance = _TOLERANCE * (right - left) + 2 * _EPS * np.abs(right)
    for _ in range(_MOST_STEPS):
        if not active.size:
            break
        middle = 0.5 * (left + right)
        at_middle = function(middle)
        # The root of at_middle² − low high, which would underflow late in a long decay.
        size = np.hypot(at_middle, np.sqrt(np.abs(low)) * np.sqrt(np.abs(high)))
        guess = middle + (middle - left) * np.sign(low) * at_middle / size
        at_guess = function(guess)
        step, roots[active] = np.abs(guess - roots[active]), guess
        for place, value in ((middle, at_middle), (guess, at_guess)):
            same = np.sign(value) == np.sign(low)
            left, low = np.where(same, place, left), np.where(same, value, low)
            right, high = np.where(same, right, place), np.where(same, high, value)
        on = (step > tolerance) & (right - left > tolerance) & (at_guess != 0)
        active, tolerance = active[on], tolerance[on]
        left, right, low, high = left[on], right[on], low[on], high[on]
    return roots
