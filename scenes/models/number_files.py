"""Columns of numbers from text files."""

from __future__ import annotations

import re
from pathlib import Path

from hydroelastic.scenes.errors import shown_value

MOST_ROWS = 100_000
"""Of any table: most kinds of table allow fewer, and say so."""

MOST_BYTES = 20_000_000
"""Of its file, 200 for a row: what is larger is no such table, and is not read."""

_SEPARATOR = re.compile(r"\s*[,;]\s*|\s+")
_LONGEST_SHOWN = 40
_WORDS = {2: "two", 3: "three", 4: "four"}


def read_columns(file: Path, columns: int) -> list[tuple[float, ...]]:
    """Return the rows of a file with a few columns of numbers.

    Columns are separated by commas, semicolons or blanks. Empty lines, text after a ``#``, and one line of headings
    before the numbers are ignored. A file with too many rows is not read to its end.

    Raises:
        ValueError: with the error in the file and its line.
    """
    rows: list[tuple[float, ...]] = []
    headed = False
    for number, line in enumerate(_lines(file), start=1):
        text = line.partition("#")[0].strip()
        if not text:
            continue
        words = _SEPARATOR.split(text)
        shown = f"line {number}, {shown_value(text[:_LONGEST_SHOWN])},"
        try:
            values = tuple(map(float, words))
        except ValueError:
            if rows or headed:
                raise ValueError(f"{shown} is not {_WORDS[columns]} numbers") from None
            headed = True
            continue
        if len(values) != columns:
            raise ValueError(f"{shown} does not have {_WORDS[columns]} columns")
        if not all(abs(value) < float("inf") for value in values):
            raise ValueError(f"{shown} is not {_WORDS[columns]} finite numbers")
        if len(rows) == MOST_ROWS:
            raise ValueError(f"it holds more than {MOST_ROWS} rows, the most of any table: leave some out")
        rows.append(values)
    return rows


def _lines(file: Path) -> list[str]:
    try:
        if not file.exists():
            raise ValueError("there is no such file")
        if not file.is_file():
            raise ValueError("it is not a regular file")
        size = file.stat().st_size
        if size > MOST_BYTES:
            allowed = f"a table of up to {MOST_ROWS} rows takes {MOST_BYTES / 1e6:g} MB at most"
            raise ValueError(f"it is {size / 1e6:.3g} MB large: {allowed}")
        return file.read_text(encoding="utf-8-sig").splitlines()
    except OSError as error:
        raise ValueError(f"it cannot be read ({error.strerror})") from error
    except UnicodeDecodeError as error:
        raise ValueError("it is not UTF-8 text") from error
