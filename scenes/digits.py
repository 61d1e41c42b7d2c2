"""Numbers as tables show them."""

from __future__ import annotations


def with_certain_digits(value: float, relative_error: float) -> str:
    """A number with the digits that its error leaves certain, between 4 and 13."""
    digits = 4
    while digits < 13 and 10.0 ** (-digits) > relative_error:
        digits += 1
    return f"{value:#.{digits}g}"


def number(value: float | None) -> str:
    """A number with seven digits, or a dash."""
    return "–" if value is None else f"{value:.7g}"


def per_cent(value: float | None) -> str:
    """A relative difference, or a dash."""
    return "–" if value is None else f"{100.0 * value:+.3g} %"
