"""Run the scene of a rolling ship: solve, tabulate, write and draw."""

from __future__ import annotations

from pathlib import Path

from mpi4py import MPI

from hydroelastic.scenes.model_roll import RollScene
from hydroelastic.scenes.outcome import Outcome
from hydroelastic.scenes.result_writer import write_results
from hydroelastic.scenes.roll_figure import draw_roll
from hydroelastic.scenes.roll_files import write_roll_files
from hydroelastic.scenes.roll_solve import solve_roll
from hydroelastic.scenes.roll_summary import summarize_roll
from hydroelastic.scenes.roll_tables import markdown_roll, printed_roll
from hydroelastic.scenes.stopwatch import Report


def run_roll(
    scene: RollScene,
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
        SceneError: if the scene of the section cannot be used, or the folder cannot be written.
        UnsolvedError: if the section, or a motion with quadratic damping, cannot be solved to its tolerance.
    """
    comm = MPI.COMM_WORLD
    solution = solve_roll(scene, comm, report)
    summary = summarize_roll(solution, comm, import_seconds=import_seconds)
    if out is not None:
        write_results(
            out,
            summary,
            tables=lambda folder: write_roll_files(solution, folder),
            pictures=(lambda folder: draw_roll(solution, folder)) if images else None,
            text=markdown_roll,
            report=report,
        )
    return Outcome(summary=summary, tables=printed_roll(summary), folder=out)
