"""Writing the results: three files for each problem, each whole or not at all."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Callable, Sequence
from pathlib import Path

from hydroelastic.benchmarks.circle.figure import draw_circle
from hydroelastic.benchmarks.circle.report import circle_csv, circle_markdown
from hydroelastic.benchmarks.measure import Benchmark
from hydroelastic.benchmarks.rows import Row
from hydroelastic.benchmarks.string.figure import draw_strings
from hydroelastic.benchmarks.string.report import strings_csv, strings_markdown
from hydroelastic.benchmarks.tank.figure import draw_speed
from hydroelastic.benchmarks.tank.report import speed_csv, speed_markdown
from hydroelastic.benchmarks.thread.figure import draw_threads
from hydroelastic.benchmarks.thread.report import threads_csv, threads_markdown
from hydroelastic.output.pictures.curves import Sheets

NAME = "speed_against_error"
CIRCLE_NAME = "open_circle"
STRING_NAME = "hanging_string"
THREAD_NAME = "threads"

Text = Callable[[Benchmark], str]
Draw = Callable[[Sequence[Row], Sheets, str], None]


class OutputError(Exception):
    """The folder cannot be written; the message names it and says why."""


def check_folder(folder: Path) -> None:
    """See before anything is measured that files can be written into a folder; leaves nothing behind.

    Raises:
        OutputError: if not.
    """
    above = next(path for path in (folder.absolute(), *folder.absolute().parents) if os.path.lexists(path))
    try:
        with tempfile.TemporaryFile(dir=above):
            pass
    except OSError as error:
        raise _unwritable(folder, error) from error


def write_results(benchmark: Benchmark, folder: Path) -> None:
    """Write table, page and figure of the tanks; other files of the folder stay.

    Raises:
        OutputError: if the folder cannot be written.
    """
    _write(benchmark, folder, NAME, speed_csv, speed_markdown, draw_speed)


def write_circle(benchmark: Benchmark, folder: Path) -> None:
    """Write table, page and figure of the circle; other files of the folder stay.

    Raises:
        OutputError: if the folder cannot be written.
    """
    _write(benchmark, folder, CIRCLE_NAME, circle_csv, circle_markdown, draw_circle)


def write_strings(benchmark: Benchmark, folder: Path) -> None:
    """Write table, page and figure of the hanging string; other files of the folder stay.

    Raises:
        OutputError: if the folder cannot be written.
    """
    _write(benchmark, folder, STRING_NAME, strings_csv, strings_markdown, draw_strings)


def write_threads(benchmark: Benchmark, folder: Path) -> None:
    """Write table, page and figure of the flexible threads; other files of the folder stay.

    Raises:
        OutputError: if the folder cannot be written.
    """
    _write(benchmark, folder, THREAD_NAME, threads_csv, threads_markdown, draw_threads)


def _write(benchmark: Benchmark, folder: Path, name: str, rows: Text, page: Text, draw: Draw) -> None:
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory(prefix=".partial.", dir=folder) as scratch:
            inside = Path(scratch)
            (inside / f"{name}.csv").write_text(rows(benchmark), encoding="utf-8")
            (inside / f"{name}.md").write_text(page(benchmark), encoding="utf-8")
            draw(benchmark.rows, Sheets(folder=inside, title=""), name)
            for file in sorted(inside.iterdir()):
                os.replace(file, folder / file.name)
    except OSError as error:
        raise _unwritable(folder, error) from error


def _unwritable(folder: Path, error: OSError) -> OutputError:
    reason = error.strerror or str(error)
    return OutputError(f"output folder {folder}: it cannot be written ({reason}). Name another folder with --out")
