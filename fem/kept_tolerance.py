"""The tolerance that an error meets, in words."""

from __future__ import annotations

from math import ceil, floor, log10


def kept_tolerance(error: float) -> str:
    """The tolerance that an error meets, in words: the error rounded up."""
    if error > 0.1:
        return "no digit is certain"
    digit = 10.0 ** floor(log10(error))
    return f"a tolerance of {ceil(error / digit) * digit:.0e} is kept"
