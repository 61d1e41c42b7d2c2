"""What the circle's part of a run leaves: all rows as CSV, and a page."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from hydroelastic.benchmarks.cases import CIRCLE_CODES
from hydroelastic.benchmarks.equal_error import best_of, fastest_as_good
from hydroelastic.benchmarks.measure import Benchmark
from hydroelastic.benchmarks.report import NAMES, machine_list, milliseconds, table
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
  both. What else was tried is in `benchmarks/capytaine_circle.py`.
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
    names = list(dict.fromkeys(row.case.tank for row in rows))
    parts = [
        "# A circle in open water: error against seconds",
        _METHOD.rstrip(),
        "![Error against seconds](open_circle.png)",
        "## What Capytaine reaches, and when hydroelastic is there",
        "Capytaine's answers that no other of its own beats in both error and seconds, and the fastest of "
        "hydroelastic's with no larger error. Above 1, Capytaine is slower.",
        _front_table(names, rows),
        "## All measurements",
        *(
            part
            for name in names
            for part in (f"### {name}", _frequency_table([row for row in rows if row.case.tank == name]))
        ),
        "## Measured on",
        machine_list(benchmark),
    ]
    return "\n\n".join(parts) + "\n"


def _front_table(names: Sequence[str], rows: Sequence[Row]) -> str:
    head = ["frequency", "Capytaine", "error", "milliseconds", "hydroelastic", "error", "milliseconds", "Capytaine ÷"]
    lines = []
    for name in names:
        for row in best_of(rows, PEER, name):
            own = fastest_as_good(rows, row, OWN)
            lines.append(
                [
                    *(name, f"{row.case.variant}, {row.case.resolution}", f"{row.error:.1e}", milliseconds(row.median)),
                    *(("—", "—", "—", "—") if own is None else _own_cells(own, row)),
                ]
            )
    return table(head, lines)


def _own_cells(own: Row, peer: Row) -> tuple[str, str, str, str]:
    ratio = f"{peer.median / own.median:.1f}"
    return own.case.resolution, f"{own.error:.1e}", milliseconds(own.median), ratio


def _frequency_table(rows: Sequence[Row]) -> str:
    head = ["code", "variant", "resolution", "unknowns", "error", "milliseconds", "spread", "note"]
    return table(
        head,
        [
            [
                *(NAMES[row.case.code], row.case.variant, row.case.resolution, str(row.unknowns), f"{row.error:.1e}"),
                *(milliseconds(row.median), milliseconds(row.spread), row.note),
            ]
            for row in rows
        ],
    )
