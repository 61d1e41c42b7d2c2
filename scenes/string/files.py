"""The motion of a hanging string as files: CSV, and a sequence that ParaView plays."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np

from hydroelastic.modal.string.solution import FreeMotions, StringSolution
from hydroelastic.output.line_sequence import Frame, frame_numbers, write_sequence
from hydroelastic.scenes.string.results import StringResult

COLUMNS = ("time", "position", "displacement", "absolute_error")


def write_string_files(result: StringResult, folder: Path) -> None:
    """Write ``response.csv``, ``modes.csv`` and ``fields/`` into an existing folder; SI units."""
    _write_response(result.solution, folder / "response.csv")
    _write_modes(result.solution.free_motions, folder / "modes.csv")
    if result.scene.output.frames:
        (folder / "fields").mkdir()
        write_sequence(folder / "fields", "string", _frames(result.solution, result.scene.output.frames))


def _write_response(solution: StringSolution, file: Path) -> None:
    """One row for each time and position."""
    times, positions = np.meshgrid(solution.times, solution.positions, indexing="ij")
    values = (times, positions, solution.displacement.T, solution.absolute_error.T)
    rows = np.column_stack([value.ravel() for value in values])
    formats = ["%.12g", "%.12g", "%.17g", "%.3g"]
    np.savetxt(file, rows, delimiter=",", fmt=formats, header=",".join(COLUMNS), comments="", encoding="utf-8")


def _write_modes(motions: FreeMotions, file: Path) -> None:
    relative = motions.relative_errors
    rows = np.column_stack(
        [np.arange(1, len(relative) + 1), motions.frequencies, motions.roots.real, motions.roots.imag, relative]
    )
    formats = ["%d", "%.17g", "%.17g", "%.17g", "%.3g"]
    header = "mode,omega,real_part,imaginary_part,relative_error"
    np.savetxt(file, rows, delimiter=",", fmt=formats, header=header, comments="", encoding="utf-8")


def _frames(solution: StringSolution, count: int) -> Iterator[Frame]:
    """The string at each frame as a line in the plane."""
    for number in frame_numbers(count, len(solution.times)):
        moved = solution.displacement[:, number]
        points = np.column_stack([moved, solution.positions, np.zeros(len(moved))])
        data = {"displacement": moved, "absolute_error": solution.absolute_error[:, number]}
        yield float(solution.times[number]), points, data
