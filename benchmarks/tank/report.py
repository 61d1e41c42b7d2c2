"""What a run leaves: all rows as CSV, and a page with the comparison, the machine and how it was measured."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from hydroelastic.benchmarks.cases import CODES, Code
from hydroelastic.benchmarks.equal_error import points_of, seconds_at, times_slower
from hydroelastic.benchmarks.measure import Benchmark
from hydroelastic.benchmarks.page import NAMES, by_tank, measurements, milliseconds, page, table, tanks_of
from hydroelastic.benchmarks.row_csv import measured_cells, rows_csv
from hydroelastic.benchmarks.rows import Row

ERRORS = (1e-4, 1e-6, 1e-8, 1e-9, 1e-10)
COMPARED: tuple[Code, ...] = ("ngsolve", "scikit-fem", "lower bound")
OWN: tuple[Code, ...] = ("hydroelastic", "hydroelastic modes")
CSV_COLUMNS = (
    *("code", "tank", "variant", "degree", "tolerance", "unknowns", "error"),
    *("seconds_median", "seconds_spread", "seconds_least", "rounds"),
    *("times_ngsolve", "times_scikit_fem", "times_lower_bound", "stages", "note"),
)

_METHOD = """\
Each code solves the same tanks for the ten lowest frequencies, from the mesh to the eigenvalues, in a process of its
own on one thread. The codes take turns, case by case and round by round; the first round, which compiles forms and
warms caches, does not count. Imports do not count. *Error* is the largest relative error of the ten frequencies
against exact ones, *seconds* the processor's, median of the rounds with the distance of their quartiles; those of
stages are by the wall.

- **hydroelastic** is the whole of `solve_scene` for a tolerance asked: it chooses its resolution, solves, and
  gives an error estimate for each frequency, a count of the modes by an independent factorization, the
  pressure-release tone and the first elastic tone. All of that is in its seconds.
- **Its modes alone** is what of it the scripts of the peers do: one solution of planned resolution, from the mesh to
  the frequencies, without estimate, count and tones.
- **NGSolve** and **scikit-fem** are scripts for these tanks, with their resolution tuned to them by search, each for
  the whole tank and, where it is its own mirror image, for its two half tanks; the better counts. They solve once and
  give no estimate, no count and no such tone: their error is known here because the exact frequencies are.
- The **lower bound** is one sparse factorization of hydroelastic's own matrix of all unknowns, those inside of
  elements not condensed, by the fastest library at hand, and the products and solutions of as many Lanczos steps as
  the ten eigenvalues need. Mesh, assembly, pressure-release tone, estimate, count and the rest of the iteration are
  free in it. It is a bound for these matrices, not for all: where unknowns inside of elements are condensed, as the
  peers and hydroelastic do, they are smaller.
"""


def speed_csv(benchmark: Benchmark) -> str:
    """All rows at full precision."""

    def cells(row: Row) -> list[Any]:
        case = row.case
        return [
            *(case.code, case.tank, case.variant, case.degree or "", case.tolerance or ""),
            *measured_cells(row),
            *_compared(row, benchmark.rows),
        ]

    return rows_csv(CSV_COLUMNS, benchmark.rows, cells)


def _compared(row: Row, rows: Sequence[Row]) -> list[float | None]:
    if row.case.code not in OWN:
        return [None for _ in COMPARED]
    return [times_slower(row, rows, code) for code in COMPARED]


def speed_markdown(benchmark: Benchmark) -> str:
    """The page."""
    rows = benchmark.rows
    parts = [
        "## Milliseconds at equal error",
        "Between measurements by interpolation on logarithmic scales; a dash where a code did not reach the error.",
        _equal_error_table(rows),
        "## Where hydroelastic stands",
        "Its seconds over those of the others at the error of the row: above 1 it is slower.",
        _standing_table(rows),
        "## All measurements",
        *by_tank(rows, _tank_table),
    ]
    return page("Error against seconds", _METHOD, "speed_against_error.png", parts, benchmark)


def _equal_error_table(rows: Sequence[Row]) -> str:
    ratios = [f"÷ {NAMES[code]}" for code in COMPARED]
    head = ["tank", "error", *(NAMES[code] for code in CODES), *ratios, "its modes alone ÷ NGSolve"]
    lines = []
    for tank in tanks_of(rows):
        for error in ERRORS:
            seconds = {code: seconds_at(points_of(rows, code, tank), error) for code in CODES}
            own = seconds["hydroelastic"]
            lines.append(
                [
                    *(tank, f"{error:.0e}"),
                    *(milliseconds(seconds[code]) for code in CODES),
                    *(_times(own, seconds[code]) for code in COMPARED),
                    _times(seconds["hydroelastic modes"], seconds["ngsolve"]),
                ]
            )
    return table(head, lines)


def _times(own: float | None, other: float | None) -> str:
    return "—" if own is None or other is None else f"{own / other:.1f}"


def _standing_table(rows: Sequence[Row]) -> str:
    head = ["tank", "asked", "error", "milliseconds", *(f"÷ {NAMES[code]}" for code in COMPARED)]
    lines = []
    for row in rows:
        if row.case.code == "hydroelastic":
            ratios = ("—" if ratio is None else f"{ratio:.1f}" for ratio in _compared(row, rows))
            asked = f"{row.case.tolerance:.0e}"
            lines.append([row.case.tank, asked, f"{row.error:.1e}", milliseconds(row.median), *ratios])
    return table(head, lines)


def _tank_table(rows: Sequence[Row]) -> str:
    return measurements(
        sorted(rows, key=lambda row: (CODES.index(row.case.code), row.case.variant)),
        (
            *("code", "variant", "resolution", "unknowns", "error", "milliseconds", "spread"),
            *("stages, milliseconds", "note"),
        ),
        lambda row: (NAMES[row.case.code], row.case.variant, row.case.resolution),
        told=lambda row: (
            ", ".join(f"{stage} {1e3 * seconds:.1f}" for stage, seconds in row.stages.items()),
            row.note,
        ),
    )
