"""What the string's part of a run leaves: all rows as CSV, and a page."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from hydroelastic.benchmarks.measure import Benchmark
from hydroelastic.benchmarks.page import NAMES, by_tank, measurements, page
from hydroelastic.benchmarks.row_csv import measured_cells, rows_csv
from hydroelastic.benchmarks.rows import Row

STRING_COLUMNS = (
    *("code", "motion", "tolerance", "terms", "unknowns", "error"),
    *("seconds_median", "seconds_spread", "seconds_least", "rounds", "stages", "note"),
)

_METHOD = """\
Displacements of a hanging string of 1 m in a resisting medium, λ/ρ = 0.5 1/s, whose upper end is moved, at 41 heights
and 121 times up to 3.2 travel times R. *Error* is the largest difference at points further than 5 % of R from a wave
front, relative to the largest displacement, against the series at its smallest tolerance, which the tests hold against
methods that know nothing of it. Seconds are the median of the rounds, from the scene to these numbers, in a process of
its own on one thread; the methods take turns, and neither imports nor the first round count.

- The **field solution** gets a tolerance: polynomials of degree 10 on elements of equal travel time, collocation of
  order 8 in time; it chooses how far fronts are softened, mesh and step, and gives an error for each value. The ten
  lowest free motions are in its seconds. It solves strings that have no series as well.
- The **series, cut smoothly**, gets a tolerance, takes as many terms at each point as that needs, and gives an error
  for each value.
- The **series, cut sharply**, is its plain sum: the same functions, with a number of terms given, and no error.
"""


def strings_csv(benchmark: Benchmark) -> str:
    """All rows at full precision."""

    def cells(row: Row) -> list[Any]:
        case = row.case
        return [*(case.code, case.tank, case.tolerance or "", case.terms or ""), *measured_cells(row)]

    return rows_csv(STRING_COLUMNS, benchmark.rows, cells)


def strings_markdown(benchmark: Benchmark) -> str:
    """The page."""
    parts = by_tank(benchmark.rows, _motion_table, level=2)
    return page("A hanging string: error against seconds", _METHOD, "hanging_string.png", parts, benchmark)


def _motion_table(rows: Sequence[Row]) -> str:
    return measurements(
        rows,
        ("method", "resolution", "unknowns or terms", "error", "milliseconds", "spread", "note"),
        lambda row: (NAMES[row.case.code], row.case.resolution),
    )
