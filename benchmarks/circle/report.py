"""What the circle's part of a run leaves: all rows as CSV, and a page."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from hydroelastic.benchmarks.cases import CIRCLE_CODES
from hydroelastic.benchmarks.measure import Benchmark
from hydroelastic.benchmarks.page import NAMES, by_tank, front, measurements, page
from hydroelastic.benchmarks.row_csv import measured_cells, rows_csv
from hydroelastic.benchmarks.rows import Row

OWN, PEER = CIRCLE_CODES
CIRCLE_COLUMNS = (
    *("code", "frequency", "variant", "length", "panels", "tolerance", "unknowns", "error"),
    *("seconds_median", "seconds_spread", "seconds_least", "rounds", "stages", "note"),
)

_METHOD = """\
Added mass and radiation damping of a half-immersed circle of radius 1 m in infinitely deep water, heave and sway, at
one frequency Ka = ω²a/g. *Error* is the larger one of |h − h_exact|/|h_exact| of heave and sway, h = a' + ib', against
Ursell's multipoles to 13 digits. Seconds are the median of the rounds, from the scene or the panels to these numbers,
in a process of its own on one thread; the codes take turns, and neither imports nor the first round count.

**This is not a comparison of like with like.** Capytaine is a three-dimensional code: it is asked here for the section
of a long cylinder, which is not what it is made for, while hydroelastic solves plane problems only. For a body of three
dimensions hydroelastic has no answer at all, and the table says nothing about Capytaine's error there.

- **hydroelastic** gets a tolerance, chooses its resolution, and gives an error estimate; the solution also has the
  excitation forces of waves from both sides, which are in its seconds.
- **Capytaine** gets a cylinder with end discs, in equal rows of panels, a quarter of it mirrored twice. Its error has
  two parts: panels (their number on a quarter of the circle is given), and the finite length (in radii). *One length*:
  A(L)/L. *Two lengths*: (A(L) − A(L/2))/(L/2), which removes what belongs to the ends alone; the seconds are those of
  both. What else was tried is in `benchmarks/circle/capytaine.py`.
"""


def circle_csv(benchmark: Benchmark) -> str:
    """All rows at full precision."""

    def cells(row: Row) -> list[Any]:
        case = row.case
        return [
            *(case.code, case.tank, case.variant, case.length or "", case.panels or "", case.tolerance or ""),
            *measured_cells(row),
        ]

    return rows_csv(CIRCLE_COLUMNS, benchmark.rows, cells)


def circle_markdown(benchmark: Benchmark) -> str:
    """The page."""
    rows = benchmark.rows
    parts = [
        "## What Capytaine reaches, and when hydroelastic is there",
        "Capytaine's answers that no other of its own beats in both error and seconds, and the fastest of "
        "hydroelastic's with no larger error. Above 1, Capytaine is slower.",
        front(
            rows,
            ("frequency", "Capytaine"),
            (PEER,),
            (OWN,),
            lambda row: (f"{row.case.variant}, {row.case.resolution}",),
            lambda row: row.case.resolution,
        ),
        "## All measurements",
        *by_tank(rows, _frequency_table),
    ]
    return page("A circle in open water: error against seconds", _METHOD, "open_circle.png", parts, benchmark)


def _frequency_table(rows: Sequence[Row]) -> str:
    return measurements(
        rows,
        ("code", "variant", "resolution", "unknowns", "error", "milliseconds", "spread", "note"),
        lambda row: (NAMES[row.case.code], row.case.variant, row.case.resolution),
    )
