"""Rows of long tables that are printed, and the largest of many errors."""

from __future__ import annotations

from math import ceil

import numpy as np

MOST_ROWS = 25
"""Largest number of rows of a table; longer ones are shown at equal distances."""


def shown_rows(count: int, what: str, file: str, places: int = MOST_ROWS) -> tuple[list[int], tuple[str, ...]]:
    """Return the rows that are shown, at equal distances with the first and the last one, and a note on the others."""
    if count <= places:
        return list(range(count)), ()
    least = ceil((count - 1) / (places - 1))
    # With a few rows less all distances may be equal.
    stride = next((step for step in range(least, ceil(1.5 * least)) if (count - 1) % step == 0), least)
    rows = sorted({*range(0, count, stride), count - 1})
    return rows, (f"{len(rows)} of {count} {what}; all of them are in {file}.",)


def largest(values: np.ndarray) -> str:
    """Return the largest known magnitude as it is printed."""
    known = np.abs(values[np.isfinite(values)])
    return f"{known.max():.1e}" if known.size else "–"
