"""Escaping of text for Markdown (CommonMark, with the tables of GitHub)."""

from __future__ import annotations

import re
from collections.abc import Sequence

# Characters that are markup anywhere, and those that are markup only before or beside certain others.
_SIGNS = re.compile(r"[\\`*~|$#\[\]]|<(?=[A-Za-z/!?])|&(?=#|\w+;)|(?<![^\W_])_|_(?![^\W_])")
# Characters that begin a quotation, a list or a rule at the beginning of a line; numbered lists are separate.
_BEGINNING = re.compile(r"^\s*(?=>|[+-](?:[\s-]|$))|^\s*\d{1,9}(?=[.)](?:\s|$))")


def markdown_text(text: str) -> str:
    """Return a text of one line escaped for a heading, a line or a cell of Markdown."""
    return _BEGINNING.sub(r"\g<0>\\", _SIGNS.sub(r"\\\g<0>", text))


def markdown_table(headings: tuple[str, ...], rows: Sequence[tuple[str, ...]]) -> str:
    """Return a table whose cells are Markdown already."""
    lines = [headings, tuple("---" for _ in headings), *rows]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)


def read_markdown_text(text: str) -> str:
    """Return the text that `markdown_text` has escaped."""
    return re.sub(r"\\(.)", r"\1", text)


def read_markdown_row(line: str) -> tuple[str, ...]:
    """Return the cells of a row of `markdown_table`, in which the bars within cells are escaped."""
    return tuple(map(read_markdown_text, line.removeprefix("| ").removesuffix(" |").split(" | ")))
