"""Text that Markdown (CommonMark, with the tables of GitHub) shows as it is."""

from __future__ import annotations

import re
from collections.abc import Sequence

# Signs that begin something wherever they stand, and those that do so only before or beside something.
_SIGNS = re.compile(r"[\\`*~|$#\[\]]|<(?=[A-Za-z/!?])|&(?=#|\w+;)|(?<![^\W_])_|_(?![^\W_])")
# What stands before the sign of a quotation, a list or a rule at the beginning of a line; numbers have theirs.
_BEGINNING = re.compile(r"^\s*(?=>|[+-](?:[\s-]|$))|^\s*\d{1,9}(?=[.)](?:\s|$))")


def markdown_text(text: str) -> str:
    """Return a text of one line as it is written in Markdown: as a heading, a line or a cell it is read as given."""
    return _BEGINNING.sub(r"\g<0>\\", _SIGNS.sub(r"\\\g<0>", text))


def markdown_table(headings: tuple[str, ...], rows: Sequence[tuple[str, ...]]) -> str:
    """Return a table whose cells are Markdown already."""
    lines = [headings, tuple("---" for _ in headings), *rows]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)
