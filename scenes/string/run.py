"""Run the scene of a hanging string: solve, tabulate, write and draw."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np

from hydroelastic.modal.string.solution import StringSolution
from hydroelastic.output.csv_files import write_csv
from hydroelastic.output.line_sequence import Frame, frame_numbers, write_sequence
from hydroelastic.output.plots import OF_CURVES, OF_MOTIONS
from hydroelastic.output.string.quantities import HANGING_STRING
from hydroelastic.output.string.tables import string_cost, string_sections
from hydroelastic.output.variables import array_variables, grid_columns
from hydroelastic.scenes.staged_run import StagedRun
from hydroelastic.scenes.string.figures import animation_notes, draw_string
from hydroelastic.scenes.string.results import StringResult
from hydroelastic.scenes.string.solve import solve_string


def write_string_files(result: StringResult, folder: Path) -> None:
    """Write ``response.csv``, ``modes.csv`` and ``fields/`` into an existing folder; SI units."""
    # One row for each time and position.
    names = ("time", "position", "displacement", "absolute_error")
    write_csv(folder / "response.csv", grid_columns(array_variables(HANGING_STRING, result), names, names[:2]))
    motions = result.solution.free_motions
    columns = {
        "mode": np.arange(1, len(motions.roots) + 1),
        "omega": motions.frequencies,
        "real_part": motions.roots.real,
        "imaginary_part": motions.roots.imag,
        "relative_error": motions.relative_errors,
    }
    write_csv(folder / "modes.csv", columns)
    if result.scene.output.frames:
        (folder / "fields").mkdir()
        write_sequence(folder / "fields", "string", _frames(result.solution, result.scene.output.frames))


def _frames(solution: StringSolution, count: int) -> Iterator[Frame]:
    for number in frame_numbers(count, len(solution.times)):
        moved = solution.displacement[:, number]
        points = np.column_stack([moved, solution.positions, np.zeros(len(moved))])
        data = {"displacement": moved, "absolute_error": solution.absolute_error[:, number]}
        yield float(solution.times[number]), points, data


run_string = StagedRun(
    solve=solve_string,
    kind=HANGING_STRING,
    write=write_string_files,
    draw=lambda result, folder, options, _report: draw_string(result, folder, options),
    animation_warnings=animation_notes,
    used_options=OF_CURVES | OF_MOTIONS,
    sections=lambda _solution, summary: string_sections(summary),
    cost=string_cost,
)
