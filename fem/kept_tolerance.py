"""Errors above the tolerance, and the tolerance that an error meets, in words."""

from __future__ import annotations

from collections.abc import Iterator
from math import ceil, floor, log10


def kept_tolerance(error: float) -> str:
    """The tolerance that an error meets, in words: the error rounded up."""
    if error > 0.1:
        return "no digit is certain"
    digit = 10.0 ** floor(log10(error))
    return f"a tolerance of {ceil(error / digit) * digit:.0e} is kept"


def excess(quantity: str, error: float | None, tolerance: float, *, rounding: float = 0.0) -> Iterator[str]:
    """Yield a message if an error is above the tolerance."""
    if error is not None and error > tolerance:
        cause = f"rounding alone leaves {rounding:.1e}; " if rounding > 0.5 * tolerance else ""
        yield f"{quantity} of {error:.1e}, above the tolerance {tolerance:g}; {cause}{kept_tolerance(error)}"
