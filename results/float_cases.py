"""Measure the reference floats: true error, estimate and cost of each case of tests/reference/floats.json.

    ./hydro python results/float_cases.py

It writes results/float_cases/float_cases.csv and float_cases.md, which docs/hard_cases.md refers to. Seconds are of one
run on the machine at hand, without imports.
"""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Any

sys.path.insert(0, str(Path(__file__).parents[1] / "tests" / "support"))

from answers import answer
from case_files import TANK_COLUMNS, tank_row, write_cases

from hydroelastic.scenes.models.tank import TankScene

ROOT = Path(__file__).parents[1]
TOLERANCES = (1e-4, 1e-6, 1e-8)
COLUMNS = (
    "case",
    "tolerance",
    "status",
    "modes",
    "true_error",
    "estimate",
    *TANK_COLUMNS,
)


def measured(name: str, case: dict[str, Any], tolerance: float) -> dict[str, Any]:
    """A row: the largest true error and estimate over the modes, and what they cost."""
    reference = [float(omega) for omega in case["omega"]]
    scene = TankScene.model_validate(case["scene"] | {"accuracy": {"tolerance": tolerance, "modes": len(reference)}})
    found = answer(scene)
    return {"case": name, "tolerance": tolerance, "modes": len(reference)} | tank_row(found, reference)


def markdown(rows: list[dict[str, Any]]) -> str:
    """The table for a page: largest true error / largest estimate, seconds."""
    lines = [
        "# Floats and two liquids, measured",
        "",
        "Made by `./hydro python results/float_cases.py`; the scenes are in `tests/reference/floats.json`. Largest",
        "true error / largest estimate of the frequencies, seconds; at the smallest tolerance also the unknowns.",
        "",
        "| case | " + " | ".join(f"{tolerance:.0e}" for tolerance in TOLERANCES) + " | unknowns |",
        "|---" * (len(TOLERANCES) + 2) + "|",
    ]
    for name in dict.fromkeys(row["case"] for row in rows):
        own = [row for row in rows if row["case"] == name]
        cells = [_cell(row) for row in own]
        lines.append(f"| `{name}` | " + " | ".join(cells) + f" | {own[-1]['unknowns']} |")
    return "\n".join([*lines, ""])


def _cell(row: dict[str, Any]) -> str:
    said = f"{row['true_error']:.0e} / {row['estimate']:.0e}, {row['seconds']:.2f} s"
    return said if row["status"] == "ok" else f"{said}, *unconverged*"


def main() -> None:
    """Solve every case at every tolerance and write the tables."""
    cases = json.loads((ROOT / "tests" / "reference" / "floats.json").read_text(encoding="utf-8"))["cases"]
    # What is imported or prepared on first use is no part of the first case.
    for tolerance in TOLERANCES:
        measured("circle", cases["circle"], 0.9 * tolerance)
    rows = []
    for name, case in cases.items():
        for tolerance in TOLERANCES:
            rows.append(measured(name, case, tolerance))
            print(*rows[-1].values(), sep=", ", flush=True)
    write_cases("float_cases", COLUMNS, rows, markdown(rows))


if __name__ == "__main__":
    main()
