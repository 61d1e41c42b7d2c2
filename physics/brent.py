"""A root of a function of one variable by Brent's method, step for step as SciPy's ``brentq``, whose import takes
longer than the plan of a tank."""

from __future__ import annotations

from collections.abc import Callable

_ABSOLUTE, _RELATIVE = 2e-12, 4 * 2.0**-52
_MOST_STEPS = 100


def brent_root(
    function: Callable[[float], float], low: float, high: float, *, relative_tolerance: float = _RELATIVE
) -> float:
    """Return a root between two places where a function has opposite signs.

    Args:
        function: f.
        low: lower end of the bracket.
        high: upper end.
        relative_tolerance: of the root.

    Raises:
        ValueError: if the signs are equal.

    Source: R. P. Brent, Algorithms for Minimization Without Derivatives, 1973, chapter 4.
    """
    before, at = low, high
    f_before, f_at = function(before), function(at)
    if f_before == 0.0:
        return before
    if f_at == 0.0:
        return at
    if (f_before < 0.0) == (f_at < 0.0):
        raise ValueError(f"the function has the same sign at {low:g} and {high:g}")
    other = f_other = step = last = 0.0
    for _ in range(_MOST_STEPS):
        if f_before != 0.0 and (f_before < 0.0) != (f_at < 0.0):
            other, f_other = before, f_before
            step = last = at - before
        if abs(f_other) < abs(f_at):
            before, at, other = at, other, at
            f_before, f_at, f_other = f_at, f_other, f_at
        least = 0.5 * (_ABSOLUTE + relative_tolerance * abs(at))
        half = 0.5 * (other - at)
        if f_at == 0.0 or abs(half) < least:
            break
        if abs(last) > least and abs(f_at) < abs(f_before):
            if before == other:
                tried = -f_at * (at - before) / (f_at - f_before)
            else:
                left = (f_before - f_at) / (before - at)
                right = (f_other - f_at) / (other - at)
                tried = -f_at * (f_other * right - f_before * left) / (right * left * (f_other - f_before))
            if 2.0 * abs(tried) < min(abs(last), 3.0 * abs(half) - least):
                last, step = step, tried
            else:
                last = step = half
        else:
            last = step = half
        before, f_before = at, f_at
        if abs(step) > least:
            at += step
        else:
            at += least if half > 0.0 else -least
        f_at = function(at)
    return at
