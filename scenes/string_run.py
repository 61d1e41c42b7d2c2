"""Run the scene of a hanging string: solve, tabulate, write and draw."""

from __future__ import annotations

from pathlib import Path

from mpi4py import MPI

from hydroelastic.scenes.model_string import StringScene
from hydroelastic.scenes.outcome import Outcome
from hydroelastic.scenes.result_writer import write_results
from hydroelastic.scenes.stopwatch import Report
from hydroelastic.scenes.string_figures import draw_string
from hydroelastic.scenes.string_files import write_string_files
from hydroelastic.scenes.string_solve import solve_string
from hydroelastic.scenes.string_summary import summarize_string
from hydroelastic.scenes.string_tables import markdown_string, printed_string


def run_string(
    scene: StringScene,
    *,
    out: Path | None = None,
    images: bool = True,
    import_seconds: float = 0.0,
    report: Report = lambda _message: None,
) -> Outcome:
    """Solve a scene and write its result folder (collective).

    Args:
        scene: the scene.
        out: result folder, made whole or not at all; ``None`` writes nothing.
        images: whether to draw.
        import_seconds: time that importing libraries took, for the record.
        report: told what is being done.

    Raises:
        SceneError: if the folder cannot be written.
        UnsolvedError: if the eigen-solver of a field solution fails.
    """
    comm = MPI.COMM_WORLD
    solution = solve_string(scene, comm, report)
    summary = summarize_string(solution, comm, import_seconds=import_seconds)
    if out is not None:
        write_results(
            out,
            summary,
            tables=lambda folder: write_string_files(solution, folder),
            pictures=(lambda folder: draw_string(solution, folder)) if images else None,
            text=markdown_string,
            report=report,
        )
    return Outcome(summary=summary, tables=printed_string(summary), folder=out)
