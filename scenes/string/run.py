"""Run the scene of a hanging string: solve, tabulate, write and draw."""

from __future__ import annotations

from hydroelastic.output.plots import OF_CURVES, OF_MOTIONS
from hydroelastic.output.string.quantities import HANGING_STRING
from hydroelastic.output.string.tables import string_cost, string_sections
from hydroelastic.scenes.staged_run import StagedRun
from hydroelastic.scenes.string.drawn import animation_notes
from hydroelastic.scenes.string.figures import draw_string
from hydroelastic.scenes.string.files import write_string_files
from hydroelastic.scenes.string.solve import solve_string

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
