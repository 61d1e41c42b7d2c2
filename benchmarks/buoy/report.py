"""What the buoys' part of a run leaves: all rows as CSV, and a page."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from hydroelastic.benchmarks.cases import BUOY_CODES
from hydroelastic.benchmarks.measure import Benchmark
from hydroelastic.benchmarks.page import NAMES, by_tank, front, measurements, page
from hydroelastic.benchmarks.row_csv import measured_cells, rows_csv
from hydroelastic.benchmarks.rows import Row

OWN, *PEERS = BUOY_CODES
BUOY_COLUMNS = (
    *("code", "buoy", "variant", "panels", "terms", "tolerance", "unknowns", "error"),
    *("seconds_median", "seconds_spread", "seconds_least", "rounds", "stages", "note"),
)

_METHOD = """\
Added mass and radiation damping in heave of solids of revolution of radius 1 m at one frequency, Ka = ω²a/g: a
half-immersed sphere in infinitely deep water, and two upright cylinders of draught d over a bed at depth H. *Error* is
|h − h_exact|/|h_exact|, h = a + ib/ω, against values to 11 digits. Seconds are the median of the rounds, from the scene
or the panels to these numbers, in a process of its own on one thread; the codes take turns, and neither imports nor the
first round count.

- **hydroelastic** gets a tolerance, chooses its resolution, and gives an error estimate; the solution also has the
  excitation forces of waves, which are in its seconds.
- **Capytaine** gets panels in a wedge that is turned about the axis, its symmetry of rotation, on three meshes, with
  and without a lid on the water inside. Its panels are flat; those of cylinders get smaller towards the edge.
- **OpenFLASH** matches eigenfunctions of the water under and beside a cylinder, as many in each; it has cylinders over
  a bed and heave alone.
"""


def buoys_csv(benchmark: Benchmark) -> str:
    """All rows at full precision."""

    def cells(row: Row) -> list[Any]:
        case = row.case
        return [
            *(case.code, case.tank, case.variant, case.panels or "", case.terms or "", case.tolerance or ""),
            *measured_cells(row),
        ]

    return rows_csv(BUOY_COLUMNS, benchmark.rows, cells)


def buoys_markdown(benchmark: Benchmark) -> str:
    """The page."""
    rows = benchmark.rows
    parts = [
        "## What the others reach, and when hydroelastic is there",
        "Answers of each that no other of its own beats in both error and seconds, and the fastest of hydroelastic's "
        "with no larger error. Above 1, the other one is slower.",
        front(
            rows,
            ("buoy", "code", "resolution"),
            PEERS,
            (OWN,),
            lambda row: (NAMES[row.case.code], f"{row.case.variant}, {row.case.resolution}"),
            lambda row: row.case.resolution,
        ),
        "## All measurements",
        *by_tank(rows, _buoy_table),
    ]
    return page("Heaving buoys: error against seconds", _METHOD, "buoys.png", parts, benchmark)


def _buoy_table(rows: Sequence[Row]) -> str:
    return measurements(
        rows,
        ("code", "variant", "resolution", "unknowns", "error", "milliseconds", "spread", "note"),
        lambda row: (NAMES[row.case.code], row.case.variant, row.case.resolution),
    )
