"""Run the scene of a rolling ship: solve, tabulate, write and draw."""

from __future__ import annotations

from hydroelastic.scenes.roll_figure import draw_roll
from hydroelastic.scenes.roll_files import write_roll_files
from hydroelastic.scenes.roll_solve import solve_roll
from hydroelastic.scenes.roll_summary import summarize_roll
from hydroelastic.scenes.roll_tables import markdown_roll, printed_roll
from hydroelastic.scenes.staged_run import StagedRun

run_roll = StagedRun(
    solve=solve_roll,
    summarize=summarize_roll,
    write=write_roll_files,
    draw=draw_roll,
    markdown=markdown_roll,
    printed=printed_roll,
)
