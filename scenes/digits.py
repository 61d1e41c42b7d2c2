"""Numbers with the digits that their errors leave certain."""

from __future__ import annotations


def with_certain_digits(value: float, relative_error: float) -> str:
    """A number with the digits that its error leaves certain, between 4 and 13."""
    digits = 4
    while digits < 13 and 10.0 ** (-digits) > relative_error:
        digits += 1
    return f"{value:#.{digits}g}"
