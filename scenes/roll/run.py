"""Run the scene of a rolling ship: solve, tabulate, write and draw."""

from __future__ import annotations

from pathlib import Path

from hydroelastic.output.csv_files import write_csv
from hydroelastic.output.plots import OF_CURVES
from hydroelastic.output.roll.quantities import ROLL
from hydroelastic.output.roll.tables import roll_cost, roll_sections
from hydroelastic.output.variables import array_variables
from hydroelastic.scenes.roll.figure import draw_roll
from hydroelastic.scenes.roll.results import RollResult
from hydroelastic.scenes.roll.solve import solve_roll
from hydroelastic.scenes.staged_run import StagedRun


def _write(result: RollResult, folder: Path) -> None:
    """Write ``response.csv``, one row for each time; SI units."""
    write_csv(folder / "response.csv", {array.name: array.values for array in array_variables(ROLL, result)})


run_roll = StagedRun(
    solve=solve_roll,
    kind=ROLL,
    write=_write,
    draw=lambda result, folder, options, _report: draw_roll(result, folder, options),
    used_options=OF_CURVES,
    sections=lambda _solution, summary: roll_sections(summary),
    cost=roll_cost,
)
