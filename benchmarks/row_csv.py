"""All rows of a run as CSV, at full precision."""

from __future__ import annotations

import csv
import io
from collections.abc import Callable, Sequence
from typing import Any

from hydroelastic.benchmarks.rows import Row


def rows_csv(columns: Sequence[str], rows: Sequence[Row], cells: Callable[[Row], Sequence[Any]]) -> str:
    """Return a line for each row, which ends with its stages and its note."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(columns)
    for row in rows:
        stages = "; ".join(f"{stage} {seconds:.6f}" for stage, seconds in row.stages.items())
        writer.writerow([*cells(row), stages, row.note])
    return text.getvalue()


def measured_cells(row: Row) -> tuple[float, ...]:
    """Return unknowns, error, and median, spread, least and number of the seconds."""
    return row.unknowns, row.error, row.median, row.spread, min(row.seconds), len(row.seconds)
