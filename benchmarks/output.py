"""Writing the results: two or three files for each problem, each whole or not at all."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

from hydroelastic.benchmarks.basin.figure import draw_basins
from hydroelastic.benchmarks.basin.report import basins_csv, basins_markdown
from hydroelastic.benchmarks.buoy.figure import draw_buoys
from hydroelastic.benchmarks.buoy.report import buoys_csv, buoys_markdown
from hydroelastic.benchmarks.circle.figure import draw_circle
from hydroelastic.benchmarks.circle.report import circle_csv, circle_markdown
from hydroelastic.benchmarks.measure import Benchmark
from hydroelastic.benchmarks.rows import Row
from hydroelastic.benchmarks.string.figure import draw_strings
from hydroelastic.benchmarks.string.report import strings_csv, strings_markdown
from hydroelastic.benchmarks.sweep.report import sweeps_csv, sweeps_markdown
from hydroelastic.benchmarks.tank.figure import draw_speed
from hydroelastic.benchmarks.tank.report import speed_csv, speed_markdown
from hydroelastic.benchmarks.thread.figure import draw_threads
from hydroelastic.benchmarks.thread.report import threads_csv, threads_markdown
from hydroelastic.output.plots import Sheets


@dataclass(frozen=True, kw_only=True)
class Output:
    """What is written of a problem.

    Attributes:
        name: of its files.
        rows: gives the rows as CSV.
        page: gives the page.
        draw: draws the figure of a name; ``None`` for none.
    """

    name: str
    rows: Callable[[Benchmark], str]
    page: Callable[[Benchmark], str]
    draw: Callable[[Sequence[Row], Sheets, str], None] | None


TANKS = Output(name="speed_against_error", rows=speed_csv, page=speed_markdown, draw=draw_speed)
SWEEPS = Output(name="sweeps", rows=sweeps_csv, page=sweeps_markdown, draw=None)
CIRCLE = Output(name="open_circle", rows=circle_csv, page=circle_markdown, draw=draw_circle)
STRING = Output(name="hanging_string", rows=strings_csv, page=strings_markdown, draw=draw_strings)
THREADS = Output(name="threads", rows=threads_csv, page=threads_markdown, draw=draw_threads)
BASINS = Output(name="basins", rows=basins_csv, page=basins_markdown, draw=draw_basins)
BUOYS = Output(name="buoys", rows=buoys_csv, page=buoys_markdown, draw=draw_buoys)


class OutputError(Exception):
    """The folder cannot be written; the message names it and says why."""


def check_folder(folder: Path) -> None:
    """See before anything is measured that files can be written into a folder; leaves nothing behind."""
    above = next(path for path in (folder.absolute(), *folder.absolute().parents) if os.path.lexists(path))
    try:
        with tempfile.TemporaryFile(dir=above):
            pass
    except OSError as error:
        raise _unwritable(folder, error) from error


def write_results(benchmark: Benchmark, folder: Path, output: Output) -> None:
    """Write table, page and figure of a problem; other files of the folder stay."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory(prefix=".partial.", dir=folder) as scratch:
            inside = Path(scratch)
            (inside / f"{output.name}.csv").write_text(output.rows(benchmark), encoding="utf-8")
            (inside / f"{output.name}.md").write_text(output.page(benchmark), encoding="utf-8")
            if output.draw is not None:
                output.draw(benchmark.rows, Sheets(folder=inside, title=""), output.name)
            for file in sorted(inside.iterdir()):
                os.replace(file, folder / file.name)
    except OSError as error:
        raise _unwritable(folder, error) from error


def _unwritable(folder: Path, error: OSError) -> OutputError:
    reason = error.strerror or str(error)
    return OutputError(f"output folder {folder}: it cannot be written ({reason}). Name another folder with --out")
