"""What the pages of all problems share: names of the codes, tables, the machine, and how measurements are listed."""

from __future__ import annotations

import os
import platform
from collections.abc import Callable, Iterable, Sequence
from datetime import date

from hydroelastic.benchmarks.cases import Code
from hydroelastic.benchmarks.equal_error import best_of, fastest_as_good
from hydroelastic.benchmarks.machine import cores, processor
from hydroelastic.benchmarks.measure import Benchmark
from hydroelastic.benchmarks.rows import Row

NAMES: dict[Code, str] = {
    "hydroelastic": "hydroelastic",
    "hydroelastic modes": "its modes alone",
    "ngsolve": "NGSolve",
    "scikit-fem": "scikit-fem",
    "lower bound": "lower bound",
    "sweep": "hydroelastic",
    "ngsolve loop": "NGSolve",
    "hydroelastic radiation": "hydroelastic",
    "capytaine": "Capytaine",
    "string field": "field solution",
    "string series": "series, cut smoothly",
    "string sum": "series, cut sharply",
    "thread field": "hydroelastic, field",
    "thread catenary": "hydroelastic, closed form",
    "moorpy": "MoorPy",
    "moordyn": "MoorDyn",
    "basin field": "hydroelastic",
    "ngsolve plan": "NGSolve, plan",
    "ngsolve volume": "NGSolve, volume",
    "hydroelastic buoy": "hydroelastic",
    "capytaine buoy": "Capytaine",
    "open-flash": "OpenFLASH",
}

Cells = Callable[[Row], Sequence[str]]

_MISSING = "—"


def page(title: str, method: str, picture: str, parts: Iterable[str], benchmark: Benchmark) -> str:
    """Return a page in Markdown."""
    head = [f"# {title}", method.rstrip(), *([f"![Error against seconds]({picture})"] if picture else [])]
    return "\n\n".join([*head, *parts, "## Measured on", machine_list(benchmark)]) + "\n"


def tanks_of(rows: Sequence[Row]) -> list[str]:
    """Return what was solved, in the order of the rows."""
    return list(dict.fromkeys(row.case.tank for row in rows))


def measurements(
    rows: Sequence[Row], head: Sequence[str], named: Cells, *, told: Cells = lambda row: (row.note,)
) -> str:
    """Return a table of all that was measured."""
    lines = [
        [
            *(*named(row), str(row.unknowns), f"{row.error:.1e}"),
            *(milliseconds(row.median), milliseconds(row.spread), *told(row)),
        ]
        for row in rows
    ]
    return table(head, lines)


def by_tank(rows: Sequence[Row], part: Callable[[Sequence[Row]], str], *, level: int = 3) -> list[str]:
    """Return what `part` makes of the rows of each problem, below a heading with its name."""
    parts = []
    for tank in tanks_of(rows):
        parts += [f"{'#' * level} {tank}", part([row for row in rows if row.case.tank == tank])]
    return parts


def front(
    rows: Sequence[Row],
    heads: Sequence[str],
    peers: Sequence[Code],
    own: Sequence[Code],
    named: Cells,
    own_name: Callable[[Row], str],
) -> str:
    """Return a table of the best answers of peers, and the fastest own ones with no larger error."""
    slower = f"{NAMES[peers[0]] if len(peers) == 1 else 'peer'} ÷"
    head = [*heads, "error", "milliseconds", "hydroelastic", "error", "milliseconds", slower]
    lines = []
    for tank in tanks_of(rows):
        for code in peers:
            for row in best_of(rows, code, tank):
                answer = fastest_as_good(rows, row, *own)
                found = [_MISSING] * 4
                if answer is not None:
                    ratio = row.median / answer.median
                    times = f"{ratio:.1f}" if ratio >= 1.0 else f"{ratio:.2g}"
                    found = [own_name(answer), f"{answer.error:.1e}", milliseconds(answer.median), times]
                lines.append([tank, *named(row), f"{row.error:.1e}", milliseconds(row.median), *found])
    return table(head, lines)


def milliseconds(seconds: float | None) -> str:
    """Seconds as milliseconds in words, or a dash."""
    return _MISSING if seconds is None else f"{1e3 * seconds:.1f}"


def machine_list(benchmark: Benchmark) -> str:
    """Machine, day and versions."""
    lines = [
        f"{processor()}, {cores()} cores, of which one is used at a time; {platform.system()}",
        f"{date.today().isoformat()}, {benchmark.repeats} rounds that count; Python {platform.python_version()}",
    ]
    load = os.getloadavg()[0]
    if load > 1.5 * cores():
        lines.append(f"other work kept the machine busy: a load of {load:.0f} at the end")
    for code, versions in benchmark.versions.items():
        lines.append(f"{NAMES[code]}: " + ", ".join(f"{name} {version}" for name, version in versions.items()))
    lines += [f"{NAMES[code]}: **not measured**: {reason}" for code, reason in benchmark.not_measured.items()]
    return "\n".join(f"- {line}" for line in lines)


def table(head: Sequence[str], lines: Sequence[Sequence[str]]) -> str:
    """A table in Markdown."""
    rows = [head, ["---"] * len(head), *lines]
    return "\n".join("| " + " | ".join(row) + " |" for row in rows)
