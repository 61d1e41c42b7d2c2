"""Columns of numbers from text files."""

from __future__ import annotations

import re
from pathlib import Path

_SEPARATOR = re.compile(r"\s*[,;]\s*|\s+")
_LONGEST_SHOWN = 40
_WORDS = {2: "two", 3: "three", 4: "four"}


def read_columns(file: Path, columns: int) -> list[tuple[float, ...]]:
    """Return the rows of a file with a few columns of numbers.

    Columns are separated by commas, semicolons or blanks. Empty lines, what follows a ``#``, and one line of headings
    before the numbers count for nothing.

    Args:
        file: the file.
        columns: how many.

    Raises:
        ValueError: saying what is wrong with the file, and in which line.
    """
    rows: list[tuple[float, ...]] = []
    headed = False
    for number, line in enumerate(_lines(file), start=1):
        text = line.partition("#")[0].strip()
        if not text:
            continue
        words = _SEPARATOR.split(text)
        shown = f'line {number}, "{text[:_LONGEST_SHOWN]}",'
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
        rows.append(values)
    return rows


def _lines(file: Path) -> list[str]:
    try:
        if not file.exists():
            raise ValueError("there is no such file")
        if not file.is_file():
            raise ValueError("it is not a regular file")
        return file.read_text(encoding="utf-8-sig").splitlines()
    except OSError as error:
        raise ValueError(f"it cannot be read ({error.strerror})") from error
    except UnicodeDecodeError as error:
        raise ValueError("it is not UTF-8 text") from error
