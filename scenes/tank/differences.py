"""Differences of estimates to the field solution."""

from __future__ import annotations


def difference(value: float | None, reference: float | None) -> float | None:
    """Relative difference of a value to a reference, where there are both."""
    return None if value is None or not reference else value / reference - 1.0
