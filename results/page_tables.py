"""Put tables of the committed measurements into the pages that tell of them.

    ./hydro python results/page_tables.py

Run it after `./hydro bench`, for docs/speed_against_error.md, and after
results/start_up_shares.py, for docs/performance.md.
It replaces what stands between the marks of each table on a page, and nothing else.
"""

from __future__ import annotations

import csv
import re
from dataclasses import dataclass
from pathlib import Path

from hydroelastic.benchmarks.equal_error import seconds_at
from hydroelastic.benchmarks.page import milliseconds, table

ROOT = Path(__file__).parent.parent
BENCHMARKS = ROOT / "results" / "benchmarks"
SHARES = ROOT / "results" / "start_up" / "shares.csv"

# MoorPy's last digits are exact; logarithms are taken.
_LEAST_ERROR = 1e-16


@dataclass(frozen=True, kw_only=True)
class Method:
    """A column: what the CSV calls it, and the page.

    Attributes:
        code: of its rows.
        name: heading.
        variant: of its rows; empty where all count.
    """

    code: str
    name: str
    variant: str = ""


@dataclass(frozen=True, kw_only=True)
class Table:
    """The table of one problem.

    Attributes:
        file: name of the CSV file.
        case: its column that tells what was solved.
        errors: at which seconds are compared.
        methods: columns, this project's first.
        own: how many they are; the seconds of the fastest of them are set over those of the others.
    """

    file: str
    case: str
    errors: tuple[float, ...]
    methods: tuple[Method, ...]
    own: int = 1


TABLES = (
    Table(
        file="speed_against_error",
        case="tank",
        errors=(1e-4, 1e-6, 1e-8, 1e-9),
        methods=(
            Method(code="hydroelastic", name="hydroelastic"),
            Method(code="ngsolve", name="NGSolve"),
            Method(code="scikit-fem", name="scikit-fem"),
            Method(code="lower bound", name="lower bound"),
        ),
    ),
    Table(
        file="open_circle",
        case="frequency",
        errors=(5e-2, 2e-2, 1e-2, 5e-3),
        methods=(
            Method(code="hydroelastic radiation", name="hydroelastic"),
            Method(code="capytaine", name="Capytaine"),
        ),
    ),
    Table(
        file="buoys",
        case="buoy",
        errors=(1e-2, 3e-3, 5e-4, 1e-4, 1e-6),
        methods=(
            Method(code="hydroelastic buoy", name="hydroelastic"),
            Method(code="capytaine buoy", name="Capytaine", variant="without lid"),
            Method(code="capytaine buoy", name="Capytaine, lid", variant="with lid"),
            Method(code="open-flash", name="OpenFLASH"),
        ),
    ),
    Table(
        file="hanging_string",
        case="motion",
        errors=(1e-3, 1e-5, 1e-7, 1e-9),
        methods=(
            Method(code="string field", name="field"),
            Method(code="string series", name="series"),
            Method(code="string sum", name="series, cut sharply"),
        ),
    ),
    Table(
        file="threads",
        case="thread",
        errors=(1e-2, 1e-3, 2e-4),
        methods=(
            Method(code="thread field", name="hydroelastic, certified", variant="certified"),
            Method(code="thread field", name="hydroelastic, one run", variant="one run"),
            Method(code="thread catenary", name="closed form"),
            Method(code="moorpy", name="MoorPy"),
            Method(code="moordyn", name="MoorDyn"),
        ),
        own=3,
    ),
)


def table_text(problem: Table) -> str:
    """The Markdown of a table: milliseconds at equal error, and ratios; a dash where an error was not reached."""
    with (BENCHMARKS / f"{problem.file}.csv").open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    names = [method.name for method in problem.methods]
    head = [problem.case, "error", *names, *(f"÷ {name}" for name in names[problem.own :])]
    lines = []
    for case in dict.fromkeys(row[problem.case] for row in rows):
        for error in problem.errors:
            seconds = [seconds_at(_points(rows, problem, case, method), error) for method in problem.methods]
            own = min((value for value in seconds[: problem.own] if value is not None), default=None)
            ratios = [_ratio(own, value) for value in seconds[problem.own :]]
            lines.append([case, f"{error:.0e}", *map(milliseconds, seconds), *ratios])
    return table(head, lines)


def _points(rows: list[dict[str, str]], problem: Table, case: str, method: Method) -> list[tuple[float, float]]:
    return [
        (float(row["seconds_median"]), max(float(row["error"]), _LEAST_ERROR))
        for row in rows
        if row[problem.case] == case and row["code"] == method.code and method.variant in ("", row.get("variant", ""))
    ]


def _ratio(own: float | None, other: float | None) -> str:
    if own is None or other is None:
        return "—"
    return f"{own / other:.0f}" if own > 10.0 * other else f"{own / other:.2g}"


def machines_text() -> str:
    """A list of the problems with machine, day and rounds, as the page of each problem tells them."""
    lines = []
    for problem in TABLES:
        told = (BENCHMARKS / f"{problem.file}.md").read_text(encoding="utf-8").split("## Measured on\n")[1]
        machine, day = re.findall(r"^- (.*)$", told, re.MULTILINE)[:2]
        lines.append(f"- `{problem.file}`: {machine}; {day}")
    return "\n".join(lines)


def shares_text() -> str:
    """The Markdown of whole runs beside the import of libraries."""
    with SHARES.open(encoding="utf-8", newline="") as file:
        rows = [tuple(row.values()) for row in csv.DictReader(file)]
    return table(["process", "by the clock, s", "over the import", "processor time, s", "over the import"], rows)


def pages() -> dict[Path, str]:
    """Each page with its tables as the measurements have them now."""
    benchmarks = {f"results/benchmarks/{problem.file}.csv": table_text(problem) for problem in TABLES}
    tables = {
        "speed_against_error.md": {"the pages in results/benchmarks": machines_text(), **benchmarks},
        "performance.md": {
            "results/start_up/shares.csv": shares_text(),
        },
    }
    return {ROOT / "docs" / name: _with_tables(ROOT / "docs" / name, texts) for name, texts in tables.items()}


def _with_tables(page: Path, texts: dict[str, str]) -> str:
    """A page with texts between their marks, by what they are made of."""
    content = page.read_text(encoding="utf-8")
    for made_of, text in texts.items():
        begin, end = (f"<!-- {word}: {made_of} by results/page_tables.py -->" for word in ("begin", "end"))
        if content.count(begin) != 1 or content.count(end) != 1:
            raise ValueError(f"{page.name}: not one place for {made_of}, between {begin!r} and {end!r}")
        before, _, rest = content.partition(begin)
        content = f"{before}{begin}\n\n{text}\n\n{end}{rest.partition(end)[2]}"
    return content


def main() -> None:
    """Write the pages anew."""
    for page, content in pages().items():
        page.write_text(content, encoding="utf-8")
        print(f"Written to {page.relative_to(ROOT)}")


if __name__ == "__main__":
    main()
