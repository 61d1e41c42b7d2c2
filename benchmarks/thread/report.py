"""What the threads' part of a run leaves: all rows as CSV, and a page."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from hydroelastic.benchmarks.cases import Code
from hydroelastic.benchmarks.measure import Benchmark
from hydroelastic.benchmarks.page import NAMES, by_tank, front, measurements, page, table
from hydroelastic.benchmarks.row_csv import measured_cells, rows_csv
from hydroelastic.benchmarks.rows import Row
from hydroelastic.benchmarks.thread.cases import Reference, jumper_tension, tension_difference

OWN: tuple[Code, ...] = ("thread field", "thread catenary")
PEERS: tuple[Code, ...] = ("moorpy", "moordyn")
THREAD_COLUMNS = (
    *("code", "thread", "variant", "segments", "step", "tolerance", "unknowns", "error"),
    *("seconds_median", "seconds_spread", "seconds_least", "rounds", "stages", "note"),
)

_METHOD = """\
Lines at rest, and lines that move. *Error*, at rest: the larger one of the errors of the forces on both ends, over the
larger force; of catenaries against Newton's method with 40 digits, in a stream against shooting to 1e-13. Of the
jumper that is moved: the largest error of its top tension at 109 times of the third period, over the largest tension,
against a fine run of the field (its own error is some 2e-5; MoorDyn's fine run is in the notes, and below). Of the
chain that swings: of the place of the body at four times over the length, against values known to 1e-6. Seconds are
the median of the rounds, from numbers or the input file to these values, in a process of its own on one thread; the
codes take turns, and neither imports nor the first round count, which for hydroelastic compiles forms.

- **hydroelastic, field**, at rest: the scene's equilibrium for an asked tolerance, on meshes that it chooses, with an
  error estimate. In motion, *one run*: elements of third degree and steps are given, and nothing tells the error;
  *certified*: the scene's analysis for an asked tolerance of positions, which halves steps and elements to tell it.
- **hydroelastic, closed form**: the elastic catenary of the package, without a stream only.
- **MoorPy**: its function `catenary`, whose tolerance is a displacement in metres; in a uniform stream, catenaries in a
  row, each with its mean drag as a weight. It knows neither sheared streams nor, in this use, motion.
- **MoorDyn**: point masses in time, as a line at rest by its two ways to initial conditions, in a stream followed until
  it is at rest. Its resolution is given, and nothing tells the error.
"""


def threads_csv(benchmark: Benchmark) -> str:
    """All rows at full precision."""

    def cells(row: Row) -> list[Any]:
        case = row.case
        chosen = (case.segments or "", case.step or "", case.tolerance or "")
        return [*(case.code, case.tank, case.variant), *chosen, *measured_cells(row)]

    return rows_csv(THREAD_COLUMNS, benchmark.rows, cells)


def threads_markdown(benchmark: Benchmark) -> str:
    """The page."""
    rows = benchmark.rows
    parts = [
        "## What the peers reach, and when hydroelastic is there",
        "The answers of each peer that no other of its own beats in both error and seconds, and the fastest of "
        "hydroelastic's with no larger error. Above 1 the peer is slower.",
        front(
            rows,
            (
                "thread",
                "peer",
                "resolution",
                "error",
                "milliseconds",
                "hydroelastic",
                "error",
                "milliseconds",
                "peer ÷",
            ),
            PEERS,
            OWN,
            lambda row: (NAMES[row.case.code], f"{row.case.variant}, {row.case.resolution}"),
            lambda row: f"{row.case.variant}, {row.case.resolution}",
        ),
        "## Three opinions on the jumper",
        _opinions(),
        "## All measurements",
        *by_tank(rows, _thread_table),
    ]
    return page("Flexible threads: error against seconds", _METHOD, "threads.png", parts, benchmark)


def _opinions() -> str:
    """How far fine runs and the digitised curve are from each other."""
    others: tuple[Reference, ...] = ("MoorDyn", "OrcaFlex")
    largest = jumper_tension("field").max()
    lines = []
    for other in others:
        difference = jumper_tension(other) - jumper_tension("field")
        root = float(np.sqrt(np.mean(difference**2)) / largest)
        lines.append([other, f"{tension_difference(jumper_tension(other)):.1e}", f"{root:.1e}"])
    head = ["top tension in the third period, against the field's fine run", "largest difference", "root mean square"]
    words = (
        "Of the fine runs, the field has 40 elements of degree 4 and steps of 0.025 s, MoorDyn 272 segments. The curve "
        "of OrcaFlex is digitised from Lowe and Langley (2006), good to 1 to 3 %, and has a little bending stiffness, "
        "which changes MoorDyn's tension by 0.2 %; the runs have none."
    )
    return f"{words}\n\n{table(head, lines)}"


def _thread_table(rows: Sequence[Row]) -> str:
    return measurements(
        rows,
        ("code", "variant", "resolution", "unknowns or nodes", "error", "milliseconds", "spread", "note"),
        lambda row: (NAMES[row.case.code], row.case.variant, row.case.resolution),
    )
