"""Solve random threads in a stream: what fails, how equilibria are come to, what they cost, whether estimates are true.

    ./hydro python results/thread_cases.py

It writes results/thread_cases/thread_cases.csv, all numbers, and thread_cases.md, the tables that docs/hard_cases.md
refers to. The scenes are those of tests/support/random_threads.py. Seconds are of one run on the machine at
hand, without imports.
"""

from __future__ import annotations

import sys
import time
from pathlib import Path
from typing import Any

import numpy as np
from mpi4py import MPI

sys.path.insert(0, str(Path(__file__).parents[1] / "tests" / "support"))

from case_files import write_cases
from random_threads import KINDS, all_numbers, random_thread
from thread_truth import true_error

from hydroelastic.fem.thread.equilibrium_search import FoundEquilibrium
from hydroelastic.scenes.errors import UnsolvedError
from hydroelastic.scenes.models.thread import ThreadScene
from hydroelastic.scenes.thread.solve import equilibrium_of

# One in so many is solved by another way too.
EVERY = 12
# Error of what is integrated with steps of 1e-12, and of a tail that begins straight over 1e-5 of its length.
INTEGRATION = 1e-10
COLUMNS = (
    "kind",
    "number",
    "status",
    "start",
    "ramp",
    "starts_before",
    "newton_steps",
    "elements",
    "smallest_tension",
    "estimate",
    "true_error",
    "seconds",
    "reason",
)


def measured(kind: str, number: int) -> dict[str, Any]:
    """A row: how the equilibrium was found, and of one in twelve its true error; or why there is none."""
    scene = ThreadScene.model_validate(random_thread(kind, number))
    row: dict[str, Any] = {"kind": kind, "number": number}
    begin = time.perf_counter()
    try:
        found = equilibrium_of(MPI.COMM_WORLD, scene)
    except UnsolvedError as error:
        return row | {"status": "failed", "seconds": time.perf_counter() - begin, "reason": str(error)}
    seconds = time.perf_counter() - begin
    return (
        row
        | _numbers(found)
        | {
            "status": "ok",
            "true_error": true_error(scene, found.solution) if number % EVERY == 0 or kind == "bodies" else None,
            "seconds": seconds,
        }
    )


def _numbers(found: FoundEquilibrium) -> dict[str, Any]:
    solution = found.solution
    return {
        "start": found.start,
        "ramp": solution.ramps[0][0] if solution.ramps else "",
        "starts_before": len(found.failed),
        "newton_steps": solution.newton_steps[0],
        "elements": solution.elements[-1],
        # Of the characteristic tension.
        "smallest_tension": solution.profile.smallest_tension()[0] / solution.equilibrium.units.force,
        "estimate": solution.errors.relative,
        "reason": "; ".join(found.failed),
    }


def markdown(rows: list[dict[str, Any]]) -> str:
    """Tables for a page: what was found by kind, and true errors beside estimates."""
    lines = [
        "# Random threads, measured",
        "",
        "Made by `./hydro python results/thread_cases.py`; the scenes are in `tests/support/random_threads.py`,",
        "the tolerance is 1e-6. *Newton* is the mean and largest number of steps on the first mesh; *another start*",
        "tells how many were not found by the first start that there is, for compression or because steps did not end;",
        "*T < 0* how many threads without flexural rigidity were returned in compression.",
        "",
        "| kind | cases | failed | T < 0 | starts | with a ramp | another start | Newton | elements | seconds |",
        "|---|---|---|---|---|---|---|---|---|---|",
    ]
    for kind in KINDS:
        lines.append(_line(kind, [row for row in rows if row["kind"] == kind]))
    lines += [
        "",
        "Errors of one case in twelve, and of all with bodies, against an independent solution: marching or shooting",
        "by an integrator of high order; where the thread bends, or hangs from both ends with bodies on it, the same",
        "equations on elements of a quarter of the length and of another degree. Of positions by the length and of",
        "tensions by the largest force.",
        "Integration is good to 1e-10: *missed* counts true errors that exceed their estimates by more.",
        "",
        "| kind | cases | largest true error | largest estimate | missed |",
        "|---|---|---|---|---|",
    ]
    for kind in KINDS:
        known = [row for row in rows if row["kind"] == kind and row.get("true_error") is not None]
        true, estimates = (np.array([row[key] for row in known]) for key in ("true_error", "estimate"))
        missed = np.count_nonzero(true > estimates + INTEGRATION)
        lines.append(f"| {kind} | {len(known)} | {true.max():.0e} | {estimates.max():.0e} | {missed} |")
    return "\n".join([*lines, ""])


def _line(kind: str, rows: list[dict[str, Any]]) -> str:
    found = [row for row in rows if row["status"] == "ok"]
    starts = {name: sum(row["start"] == name for row in found) for name in sorted({row["start"] for row in found})}
    ramps = {name: sum(row["ramp"] == name for row in found) for name in sorted({row["ramp"] for row in found} - {""})}
    compressed = sum(row["smallest_tension"] < -1e-8 for row in found) if kind != "bending" else "-"
    steps, elements, seconds = (
        np.array([row[key] for row in found], dtype=float) for key in ("newton_steps", "elements", "seconds")
    )
    cells = [
        kind,
        len(rows),
        len(rows) - len(found),
        compressed,
        ", ".join(f"{name} {count}" for name, count in starts.items()),
        ", ".join(f"{name} {count}" for name, count in ramps.items()) or "0",
        sum(row["starts_before"] > 0 for row in found),
        f"{steps.mean():.1f}, {steps.max():.0f}",
        f"{elements.mean():.0f}, {elements.max():.0f}",
        f"{seconds.mean():.2f}, {seconds.max():.1f}",
    ]
    return "| " + " | ".join(str(cell) for cell in cells) + " |"


def main() -> None:
    """Solve every scene and write the tables."""
    # What is imported or compiled on first use is no part of the first case.
    for kind in KINDS:
        measured(kind, 1)
    rows = []
    for kind, number in all_numbers():
        rows.append(measured(kind, number))
        print(*rows[-1].values(), sep=", ", flush=True)
    write_cases("thread_cases", COLUMNS, rows, markdown(rows))


if __name__ == "__main__":
    main()
