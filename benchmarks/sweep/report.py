"""What the sweeps' part of a run leaves: all rows as CSV, and a page."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from hydroelastic.benchmarks.equal_error import seconds_at
from hydroelastic.benchmarks.measure import Benchmark
from hydroelastic.benchmarks.page import NAMES, by_tank, measurements, milliseconds, page, table, tanks_of
from hydroelastic.benchmarks.row_csv import measured_cells, rows_csv
from hydroelastic.benchmarks.rows import Row
from hydroelastic.benchmarks.sweep.cases import SWEEPS

SWEEP_COLUMNS = (
    *("code", "sweep", "variant", "degree", "tolerance", "unknowns", "error"),
    *("seconds_median", "seconds_spread", "seconds_least", "rounds", "seconds_processor", "stages", "note"),
)
ERRORS = (1e-7, 1e-8)

_METHOD = """\
The tank base_s0 at 40 positions of its beam, and for 100 flexural rigidities: its ten lowest frequencies at every
point. *Error* is the largest relative error at every eighth position, or every twentieth rigidity. Seconds are those of
the whole sweep, by the wall and of the processor, median of the rounds; imports and the first round do not count, but
the start of a second process does.

- **hydroelastic** is its sweep for a tolerance asked, without following modes: at every point an error estimate for
  each frequency, a count of the modes, the first elastic tone and the pressure-release tone, and all that is in the
  tables of a sweep. Points that differ in rigidity share the answer of the liquid.
- **NGSolve** is a loop over the script of the tanks on one process, which solves once at each point and gives
  frequencies alone.
"""


def sweeps_csv(benchmark: Benchmark) -> str:
    """All rows at full precision."""

    def cells(row: Row) -> list[Any]:
        case = row.case
        named = (case.code, case.tank, case.variant, case.degree or "", case.tolerance or "")
        return [*named, *measured_cells(row), row.stages.get("processor", "")]

    return rows_csv(SWEEP_COLUMNS, benchmark.rows, cells)


def sweeps_markdown(benchmark: Benchmark) -> str:
    """The page."""
    parts = [
        "## Milliseconds a point at equal error",
        "Between measurements by interpolation on logarithmic scales. *÷* is hydroelastic on one process over NGSolve.",
        _equal_error_table(benchmark.rows),
        "## All measurements",
        *by_tank(benchmark.rows, _sweep_table),
    ]
    return page("Sweeps", _METHOD, "", parts, benchmark)


def _equal_error_table(rows: Sequence[Row]) -> str:
    kinds = (("sweep", "one process"), ("sweep", "two processes"), ("ngsolve loop", ""))
    names = ("hydroelastic", "hydroelastic, two processes", "NGSolve")
    clocks = ("wall", "processor")
    head = ["sweep", "error", *(f"{name}, {clock}" for clock in clocks for name in names), *(f"÷ {c}" for c in clocks)]
    lines = []
    for sweep in tanks_of(rows):
        own = [row for row in rows if row.case.tank == sweep]
        points = len(SWEEPS[sweep].values)
        for error in ERRORS:
            cells, ratios = [], []
            for clock in clocks:
                found = []
                for code, variant in kinds:
                    chosen = [row for row in own if row.case.code == code and variant in ("", row.case.variant)]
                    timed = [(_seconds(row, clock), row.error) for row in chosen]
                    found.append(seconds_at([(s, e) for s, e in timed if s is not None], error))
                cells += [milliseconds(None if value is None else value / points) for value in found]
                ratios.append("—" if found[0] is None or found[2] is None else f"{found[0] / found[2]:.2f}")
            lines.append([sweep, f"{error:.0e}", *cells, *ratios])
    return table(head, lines)


def _seconds(row: Row, clock: str) -> float | None:
    return row.median if clock == "wall" else row.stages.get("processor")


def _sweep_table(rows: Sequence[Row]) -> str:
    return measurements(
        rows,
        (*("code", "variant", "resolution", "unknowns", "error", "milliseconds", "spread", "processor"), "note"),
        lambda row: (NAMES[row.case.code], row.case.variant, row.case.resolution),
        told=lambda row: (milliseconds(row.stages.get("processor")), row.note),
    )
