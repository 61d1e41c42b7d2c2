"""Outlines of floats from text files: two columns of numbers, x and y in metres."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from hydroelastic.scenes.models.number_files import read_columns

POINTS = (3, 1000)
"""How many points an outline may have: with more, the elements of the mesh would follow noise."""


def read_outline(file: Path) -> NDArray[np.float64]:
    """Return the points of an outline, m, shape (n, 2): without repeated ones, and not closed by its first point.

    Raises:
        ValueError: with the error in the file and its line.
    """
    rows = read_columns(file, 2)
    points = [row for place, row in enumerate(rows) if place == 0 or row != rows[place - 1]]
    if len(points) > 1 and points[-1] == points[0]:
        points.pop()
    least, most = POINTS
    if not least <= len(points) <= most:
        raise ValueError(f"it holds {len(points) or 'no'} points; {least} to {most} make an outline")
    return np.array(points)
