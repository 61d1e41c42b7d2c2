"""Outlines of floats from text files: two columns of numbers, x and y in metres."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

POINTS = (3, 1000)
"""How many points an outline may have: with more, the elements of the mesh would follow noise."""

_SEPARATOR = re.compile(r"\s*[,;]\s*|\s+")
_LONGEST_SHOWN = 40


def read_outline(file: Path) -> NDArray[np.float64]:
    """Return the points of an outline, m, shape (n, 2): without repeated ones, and not closed by its first point.

    Columns are separated by commas, semicolons or blanks. Empty lines, what follows a ``#``, and one line of headings
    before the numbers count for nothing.

    Raises:
        ValueError: saying what is wrong with the file, and in which line.
    """
    points: list[tuple[float, float]] = []
    headed = False
    for number, line in enumerate(_lines(file), start=1):
        text = line.partition("#")[0].strip()
        if not text:
            continue
        words = _SEPARATOR.split(text)
        try:
            values = tuple(map(float, words))
        except ValueError:
            if points or headed:
                raise ValueError(f'line {number}, "{text[:_LONGEST_SHOWN]}", is not two numbers') from None
            headed = True
            continue
        if len(values) != 2:
            raise ValueError(f'line {number}, "{text[:_LONGEST_SHOWN]}", does not have two columns')
        if not all(map(np.isfinite, values)):
            raise ValueError(f'line {number}, "{text[:_LONGEST_SHOWN]}", is not two finite numbers')
        if not points or values != points[-1]:
            points.append((values[0], values[1]))
    if len(points) > 1 and points[-1] == points[0]:
        points.pop()
    least, most = POINTS
    if not least <= len(points) <= most:
        raise ValueError(f"it holds {len(points) or 'no'} points; {least} to {most} make an outline")
    return np.array(points)


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
