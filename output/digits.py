"""Numbers as tables show them."""

from __future__ import annotations

from math import floor, log10


def with_certain_digits(value: float, relative_error: float) -> str:
    """A number with the digits that are certain by its error estimate, between 4 and 13."""
    digits = 4
    while digits < 13 and 10.0 ** (-digits) > relative_error:
        digits += 1
    return f"{value:#.{digits}g}"


def beyond_error(value: float, absolute_error: float) -> str:
    """A number with its certain digits, at most six; 0 where it is not larger than its error."""
    if abs(value) <= absolute_error:
        return "0"
    certain = floor(log10(abs(value))) - floor(log10(absolute_error)) if absolute_error > 0.0 else 6
    return f"{value:.{min(max(certain, 1), 6)}g}"


def number(value: float | None) -> str:
    """A number with seven digits, or a dash."""
    return "–" if value is None else f"{value:.7g}"


def counted(count: int, noun: str) -> str:
    """A count with its noun: "1 wave", "2 waves", "2 meshes"."""
    plural = "es" if noun.endswith("sh") else "s"
    return f"{count} {noun}{'' if count == 1 else plural}"


def per_cent(value: float | None) -> str:
    """A relative difference, or a dash."""
    return "–" if value is None else f"{100.0 * value:+.3g} %"
