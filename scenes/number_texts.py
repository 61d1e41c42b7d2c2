"""Texts that are nearly numbers: with a decimal comma, or with a unit."""

from __future__ import annotations

import re

_WITH_COMMA = re.compile(r"([+-]?\d+),(\d+)")
_WITH_UNIT = re.compile(r"[+-]?\d+(\.\d+)?([eE][+-]?\d+)?\s*[^\W\d_][\w/·^*²³⁴]*|[+-]?\d+(\.\d+)?\s*[%°]")
_UNIT = r"(?:rad|kg|m|s|N|Pa|1)[²³⁴]?"
_SAID_UNIT = re.compile(rf", ({_UNIT}(?:[/·]{_UNIT})*)(?=$|[;,.])")


def how_to_write(text: str, description: str = "") -> str:
    """Return the corrected form of a text that is nearly a number; empty otherwise."""
    bare = text.strip().strip("\"'").strip()
    with_comma = _WITH_COMMA.fullmatch(bare)
    if with_comma:
        return f"Write a decimal point, not a comma: {with_comma[1]}.{with_comma[2]}"
    if _WITH_UNIT.fullmatch(bare):
        unit = _SAID_UNIT.search(description)
        return "Write a number without a unit" + (f"; the unit is {unit[1]}" if unit else "")
    return ""


def how_to_write_line(line: str) -> str:
    """The same of the value in a line ``key = value  # comment`` of a file."""
    return how_to_write(line.partition("=")[2].partition("#")[0])
