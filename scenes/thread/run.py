"""Run the scene of a thread in a stream: solve, tabulate, write and draw."""

from __future__ import annotations

from pathlib import Path

from hydroelastic.fem.progress import Report
from hydroelastic.output.pictures.options import OF_CURVES, OF_FIELDS, OF_MOTIONS, PictureOptions
from hydroelastic.output.thread.quantities import THREAD
from hydroelastic.output.thread.tables import thread_cost, thread_sections
from hydroelastic.scenes.staged_run import StagedRun
from hydroelastic.scenes.thread.animation import animation_notes
from hydroelastic.scenes.thread.files import write_thread_files
from hydroelastic.scenes.thread.results import ThreadSolutionOfScene
from hydroelastic.scenes.thread.solve import solve_thread_scene


def _draw(solution: ThreadSolutionOfScene, folder: Path, options: PictureOptions, _report: Report) -> None:
    # Who only wants the numbers does without what draws.
    from hydroelastic.scenes.thread.figures import draw_thread

    draw_thread(solution, folder, options)


run_thread = StagedRun(
    solve=solve_thread_scene,
    kind=THREAD,
    write=write_thread_files,
    draw=_draw,
    animation_warnings=animation_notes,
    used_options=OF_CURVES | OF_FIELDS | OF_MOTIONS,
    sections=lambda _solution, summary: thread_sections(summary),
    cost=thread_cost,
)
