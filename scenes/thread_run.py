"""Run the scene of a thread in a stream: solve, tabulate, write and draw."""

from __future__ import annotations

from hydroelastic.scenes.staged_run import StagedRun
from hydroelastic.scenes.thread_figures import draw_thread
from hydroelastic.scenes.thread_files import write_thread_files
from hydroelastic.scenes.thread_solve import solve_thread_scene
from hydroelastic.scenes.thread_summary import summarize_thread
from hydroelastic.scenes.thread_tables import markdown_thread, printed_thread

run_thread = StagedRun(
    solve=solve_thread_scene,
    summarize=summarize_thread,
    write=write_thread_files,
    draw=draw_thread,
    markdown=markdown_thread,
    printed=printed_thread,
)
