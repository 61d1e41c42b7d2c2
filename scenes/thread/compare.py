"""Comparison of the field solution of a thread with asymptotic solutions and closed forms."""

from __future__ import annotations

from mpi4py import MPI

from hydroelastic.fem.stopwatch import Report
from hydroelastic.output.outcome import Outcome
from hydroelastic.output.thread.comparison import COMPARISON
from hydroelastic.output.thread.comparison_tables import comparison_sections
from hydroelastic.scenes.models.thread import ThreadScene
from hydroelastic.scenes.thread.differences import thread_differences
from hydroelastic.scenes.thread.estimates import thread_estimates
from hydroelastic.scenes.thread.run import run_thread
from hydroelastic.scenes.thread.solve import solve_thread_scene


def compare_thread(scene: ThreadScene, *, report: Report = lambda _message: None) -> Outcome:
    """Solve a scene and compare the solution with all estimates that apply; writes nothing (collective)."""
    comm = MPI.COMM_WORLD
    at_rest = scene.model_copy(update={"analysis": tuple(asked for asked in scene.analysis if asked.kind != "motion")})
    solution = solve_thread_scene(at_rest, comm, report)
    report("estimates")
    estimates = tuple(thread_estimates(at_rest))
    summary = run_thread.summarized(at_rest, solution)
    differences = thread_differences(solution, estimates)
    sections, cost = tuple(comparison_sections(differences)), run_thread.cost(run_thread.read(summary))
    summary |= {COMPARISON.key: differences}
    return Outcome(solution=solution, summary=summary, sections=sections, cost=cost, notes=True)
