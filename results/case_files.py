"""What the measured catalogues share: the row of a tank that was solved, and the two files that are written of rows."""

from __future__ import annotations

import csv
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

TANK_COLUMNS = ("seconds", "unknowns", "degree")


def tank_row(found: Any, reference: Sequence[float]) -> dict[str, Any]:
    """Return the largest true error and estimate over the modes of an answer, and what they cost."""
    return {
        "status": found.summary["status"],
        "true_error": float(np.abs(found.errors(reference)).max()),
        "estimate": float(found.estimates.max()),
        "seconds": found.seconds,
        "unknowns": found.summary["size"]["dofs"],
        "degree": found.summary["size"]["degree"],
    }


def write_cases(name: str, columns: Sequence[str], rows: Sequence[dict[str, Any]], page: str) -> None:
    """Write the rows, numbers with three digits and nothing where something is unknown, and the page beside them."""
    folder = Path(__file__).parent / name
    folder.mkdir(exist_ok=True)
    with (folder / f"{name}.csv").open("w", encoding="utf-8", newline="") as file:
        writer = csv.DictWriter(file, columns, lineterminator="\n")
        writer.writeheader()
        writer.writerows({column: _shown(row.get(column)) for column in columns} for row in rows)
    (folder / f"{name}.md").write_text(page, encoding="utf-8")


def _shown(value: Any) -> Any:
    return f"{value:.3g}" if isinstance(value, float) else value
