"""Run the scene of a hanging string: solve, tabulate, write and draw."""

from __future__ import annotations

from hydroelastic.output.dataset import LabelledResults
from hydroelastic.output.pictures.options import OF_CURVES, OF_MOTIONS
from hydroelastic.scenes.staged_run import StagedRun
from hydroelastic.scenes.string.dataset import STRING_NAMES, string_dataset
from hydroelastic.scenes.string.drawn import animation_notes
from hydroelastic.scenes.string.figures import draw_string
from hydroelastic.scenes.string.files import write_string_files
from hydroelastic.scenes.string.solve import solve_string
from hydroelastic.scenes.string.summary import summarize_string
from hydroelastic.scenes.string.tables import string_cost, string_sections

run_string = StagedRun(
    solve=solve_string,
    summarize=summarize_string,
    write=write_string_files,
    dataset=LabelledResults(arrays=string_dataset, names=STRING_NAMES),
    draw=lambda result, folder, options, _report: draw_string(result, folder, options),
    animation_warnings=animation_notes,
    used_options=OF_CURVES | OF_MOTIONS,
    sections=lambda _solution, summary: string_sections(summary),
    cost=string_cost,
)
