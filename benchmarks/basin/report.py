"""What the basin's part of a run leaves: all rows as CSV, and a page."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from hydroelastic.benchmarks.measure import Benchmark
from hydroelastic.benchmarks.page import NAMES, by_tank, measurements, page
from hydroelastic.benchmarks.row_csv import measured_cells, rows_csv
from hydroelastic.benchmarks.rows import Row

BASIN_COLUMNS = (
    *("code", "basin", "variant", "degree", "size", "tolerance", "unknowns", "error"),
    *("seconds_median", "seconds_spread", "seconds_least", "rounds", "stages", "note"),
)

_METHOD = """\
The twelve lowest modes of a tank of 10 m × 8 m × 3 m with an elastic plate of 6 m × 4 m on the middle of its surface.
*Error* is the largest one of the twelve frequencies, against a reference of 10 digits by two methods. Seconds are the
median of the rounds, from the scene or the mesh to these numbers, in a process of its own on one thread; the codes take
turns, and neither imports nor the first round count.

- **hydroelastic** gets a tolerance, chooses its resolution, and gives an error estimate and an independent count of the
  modes, which are in its seconds. *Quarters*: its smallest model, products of two intervals. *Triangles*: what it does
  where plan and plates are arbitrary, forced here.
- **NGSolve, plan** takes the same idea: ψ on a quarter of the plan, the depth in the same poles, the same dry modes of
  the plate; Netgen's triangles with hp-refinement at the plate's edge.
- **NGSolve, volume** is what a user would write first: tetrahedra of a quarter of the tank, small ones at the plate's
  edge, the same dry modes.

Neither script of NGSolve has an error estimate or a count; degrees and sizes were chosen by hand, knowing the answer.
"""


def basins_csv(benchmark: Benchmark) -> str:
    """All rows at full precision."""

    def cells(row: Row) -> list[Any]:
        case = row.case
        return [
            *(case.code, case.tank, case.variant, case.degree or "", case.size or "", case.tolerance or ""),
            *measured_cells(row),
        ]

    return rows_csv(BASIN_COLUMNS, benchmark.rows, cells)


def basins_markdown(benchmark: Benchmark) -> str:
    """The page."""
    parts = by_tank(benchmark.rows, _table, level=2)
    return page("A plate in a basin: error against seconds", _METHOD, "basins.png", parts, benchmark)


def _table(rows: Sequence[Row]) -> str:
    return measurements(
        rows,
        ("code", "variant", "resolution", "unknowns", "error", "milliseconds", "spread", "note"),
        lambda row: (NAMES[row.case.code], row.case.variant, row.case.resolution),
    )
