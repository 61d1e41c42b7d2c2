"""Run the scene of a rolling ship: solve, tabulate, write and draw."""

from __future__ import annotations

from hydroelastic.output.dataset import LabelledResults
from hydroelastic.output.pictures.options import OF_CURVES
from hydroelastic.scenes.roll.dataset import ROLL_NAMES, roll_dataset
from hydroelastic.scenes.roll.figure import draw_roll
from hydroelastic.scenes.roll.files import write_roll_files
from hydroelastic.scenes.roll.solve import solve_roll
from hydroelastic.scenes.roll.summary import summarize_roll
from hydroelastic.scenes.roll.tables import roll_cost, roll_sections
from hydroelastic.scenes.staged_run import StagedRun

run_roll = StagedRun(
    solve=solve_roll,
    summarize=summarize_roll,
    write=write_roll_files,
    dataset=LabelledResults(arrays=roll_dataset, names=ROLL_NAMES),
    draw=lambda result, folder, options, _report: draw_roll(result, folder, options),
    used_options=OF_CURVES,
    sections=lambda _solution, summary: roll_sections(summary),
    cost=roll_cost,
)
