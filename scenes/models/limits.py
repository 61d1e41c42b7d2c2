"""Limits that are computed, and that messages name: the number that a message names is accepted."""

from __future__ import annotations

from decimal import ROUND_CEILING, ROUND_FLOOR, Decimal
from math import isfinite

from hydroelastic.physics.tank import ROUND_OFF

# Rounding of a difference of numbers that are read, relative to these.
_DIFFERENCE = 1e-14


def is_at_least(value: float, least: float, *, beside: float = 0.0) -> bool:
    """Whether a value is not below a limit, but for rounding.

    Args:
        value: what is compared.
        beside: the largest of the numbers of which the value is a difference.
    """
    return value >= least - max(ROUND_OFF * abs(least), _DIFFERENCE * abs(beside))


def is_at_most(value: float, most: float, *, beside: float = 0.0) -> bool:
    """Whether a value is not above a limit, but for rounding; see `is_at_least`."""
    return is_at_least(-value, -most, beside=beside)


def is_within(value: float, least: float, most: float, *, beside: float = 0.0) -> bool:
    """Whether a value is not outside of two limits, but for rounding; see `is_at_least`."""
    return is_at_least(value, least, beside=beside) and is_at_most(value, most, beside=beside)


def shown_least(limit: float) -> str:
    """A lower limit with six digits, rounded up: what is read is allowed."""
    return _shown(limit, ROUND_CEILING)


def shown_most(limit: float) -> str:
    """An upper limit with six digits, rounded down: what is read is allowed."""
    return _shown(limit, ROUND_FLOOR)


def shown_range(least: float, most: float) -> str:
    """Both limits: "1 to 2"."""
    return " to ".join((shown_least(least), shown_most(most)))


def _shown(limit: float, rounding: str) -> str:
    nearest = f"{limit:g}"
    if not isfinite(limit) or abs(float(nearest) - limit) <= ROUND_OFF * abs(limit):
        return nearest
    exact = Decimal(limit)
    return f"{float(exact.quantize(Decimal((0, (1,), exact.adjusted() - 5)), rounding=rounding)):g}"
