"""Run the scene of a hanging string: solve, tabulate, write and draw."""

from __future__ import annotations

from hydroelastic.scenes.staged_run import StagedRun
from hydroelastic.scenes.string_figures import draw_string
from hydroelastic.scenes.string_files import write_string_files
from hydroelastic.scenes.string_solve import solve_string
from hydroelastic.scenes.string_summary import summarize_string
from hydroelastic.scenes.string_tables import markdown_string, printed_string

run_string = StagedRun(
    solve=solve_string,
    summarize=summarize_string,
    write=write_string_files,
    draw=draw_string,
    markdown=markdown_string,
    printed=printed_string,
)
