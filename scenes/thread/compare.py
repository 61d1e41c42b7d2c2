"""Comparison of the field solution of a thread with asymptotic solutions and closed forms."""

from __future__ import annotations

from dataclasses import replace

from hydroelastic.fem.progress import Report
from hydroelastic.output.outcome import Outcome
from hydroelastic.output.provenance import SECONDS
from hydroelastic.output.thread.comparison import COMPARISON
from hydroelastic.output.thread.comparison_tables import comparison_sections
from hydroelastic.scenes.models.thread import ThreadScene
from hydroelastic.scenes.thread.differences import thread_differences
from hydroelastic.scenes.thread.estimates import thread_estimates
from hydroelastic.scenes.thread.run import run_thread


def compare_thread(scene: ThreadScene, *, report: Report = lambda _message: None) -> Outcome:
    """Solve a scene and compare the solution with all estimates that apply; writes nothing (collective)."""
    at_rest = scene.model_copy(update={"analysis": tuple(asked for asked in scene.analysis if asked.kind != "motion")})
    outcome = run_thread.solved(at_rest, report=report)
    report("estimates")
    estimates = tuple(thread_estimates(at_rest))
    differences = thread_differences(outcome.solution, estimates, outcome.summary[SECONDS.key])
    summary = outcome.summary | {COMPARISON.key: differences}
    return replace(outcome, summary=summary, sections=tuple(comparison_sections(differences)), notes=True)
