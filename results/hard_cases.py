"""Measure the hard cases: true error, estimate and cost of each case of tests/support/hard_cases.py at each tolerance.

    ./hydro python results/hard_cases.py

It writes results/hard_cases/hard_cases.csv, all numbers, and hard_cases.md, the tables that docs/hard_cases.md refers
to. Seconds are of one run on the machine at hand, without imports.
"""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Any

# First on the path: there, `hard_cases` is the catalogue.
sys.path.insert(0, str(Path(__file__).parents[1] / "tests" / "support"))

from answers import answer
from case_files import TANK_COLUMNS, tank_row, write_cases
from hard_cases import CASES, TOLERANCES, HardCase

from hydroelastic.fem.solver_error import EigenSolverError

ROOT = Path(__file__).parents[1]
COLUMNS = (
    "case",
    "tolerance",
    "status",
    "modes",
    "true_error",
    "estimate",
    "pressure_release_true_error",
    "pressure_release_estimate",
    *TANK_COLUMNS,
)


def measured(case: HardCase, tolerance: float, reference: dict[str, Any]) -> dict[str, Any]:
    """A row: the largest true error and estimate over the modes asked for, and what they cost."""
    row = {"case": case.name, "tolerance": tolerance, "modes": case.scene.accuracy.modes}
    try:
        found = answer(case.asked(tolerance))
    except EigenSolverError:
        return row | {"status": "failed"}
    errors, estimates = _pressure_release(found.summary["first_elastic_by_body"], reference)
    return (
        row
        | tank_row(found, reference["omega"])
        | {
            "pressure_release_true_error": max(errors, default=None),
            "pressure_release_estimate": max(estimates, default=None),
        }
    )


def _pressure_release(tones: list[dict[str, Any]], reference: dict[str, Any]) -> tuple[list[float], list[float]]:
    """True errors of the pressure-release tones that have a reference, and estimates of all."""
    errors = [
        abs(tone["pressure_release_omega"] / expected["omega"] - 1.0)
        for tone, expected in zip(tones, reference.get("pressure_release", []), strict=False)
        if expected is not None and tone["pressure_release_omega"] is not None
    ]
    given = [tone["pressure_release_relative_error"] for tone in tones]
    return errors, [estimate for estimate in given if estimate is not None]


def markdown(rows: list[dict[str, Any]]) -> str:
    """Two tables: what each case is, and what was measured."""
    lines = [
        "# Hard cases, measured",
        "",
        "Made by `./hydro python results/hard_cases.py`. [docs/hard_cases.md](../../docs/hard_cases.md) explains it.",
        "",
        "| case | what is hard | what protects the answer |",
        "|---|---|---|",
        *(f"| `{case.name}` | {case.hard} | {case.protects} |" for case in CASES),
        "",
        "Largest true error / largest estimate of the frequencies asked for, seconds; at the smallest tolerance also",
        "the unknowns, and true error / estimate of the pressure-release tone. *Unconverged*: the solution says",
        "that it misses the tolerance somewhere.",
        "",
        "| case | " + " | ".join(f"{tolerance:.0e}" for tolerance in TOLERANCES) + " | unknowns | ψ = 0 tone |",
        "|---" * (len(TOLERANCES) + 3) + "|",
    ]
    for case in CASES:
        own = [row for row in rows if row["case"] == case.name]
        release = _pair(own[-1].get("pressure_release_true_error"), own[-1].get("pressure_release_estimate"))
        cells = [f"`{case.name}`", *map(_cell, own), str(own[-1].get("unknowns", "")), release]
        lines.append("| " + " | ".join(cells) + " |")
    return "\n".join([*lines, ""])


def _pair(error: float | None, estimate: float | None) -> str:
    if estimate is None:
        return ""
    return f"{'?' if error is None else format(error, '.0e')} / {estimate:.0e}"


def _cell(row: dict[str, Any]) -> str:
    if row["status"] == "failed":
        return "*failed*"
    said = f"{_pair(row['true_error'], row['estimate'])}, {row['seconds']:.1f} s"
    return said if row["status"] == "ok" else f"{said}, *unconverged*"


def main() -> None:
    """Solve every case at every tolerance and write the tables."""
    references = json.loads((ROOT / "tests" / "reference" / "hard_cases.json").read_text(encoding="utf-8"))["cases"]
    # What is imported or prepared on first use is no part of the first case.
    answer(CASES[0].asked(1e-2))
    rows = []
    for case in CASES:
        for tolerance in TOLERANCES:
            rows.append(measured(case, tolerance, references[case.name]))
            print(*rows[-1].values(), sep=", ", flush=True)
    write_cases("hard_cases", COLUMNS, rows, markdown(rows))


if __name__ == "__main__":
    main()
