"""Writing the results: three files, each whole or not at all."""

from __future__ import annotations

import os
import tempfile
from pathlib import Path

from hydroelastic.benchmarks.figure import draw_speed
from hydroelastic.benchmarks.measure import Benchmark
from hydroelastic.benchmarks.report import speed_csv, speed_markdown

NAME = "speed_against_error"


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
    """Write table, page and figure; other files of the folder stay.

    Raises:
        OutputError: if the folder cannot be written.
    """
    try:
        folder.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryDirectory(prefix=".partial.", dir=folder) as scratch:
            inside = Path(scratch)
            (inside / f"{NAME}.csv").write_text(speed_csv(benchmark), encoding="utf-8")
            (inside / f"{NAME}.md").write_text(speed_markdown(benchmark), encoding="utf-8")
            draw_speed(benchmark.rows, inside / f"{NAME}.png")
            for file in sorted(inside.iterdir()):
                os.replace(file, folder / file.name)
    except OSError as error:
        raise _unwritable(folder, error) from error


def _unwritable(folder: Path, error: OSError) -> OutputError:
    reason = error.strerror or str(error)
    return OutputError(f"output folder {folder}: it cannot be written ({reason}). Name another folder with --out")
