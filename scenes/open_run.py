"""Run a scene with open ends: solve, tabulate, write and draw."""

from __future__ import annotations

from pathlib import Path

from mpi4py import MPI

from hydroelastic.fem.modes import EigenSolverError
from hydroelastic.meshes.tagged_mesh import MeshError
from hydroelastic.scenes.dataset import write_dataset
from hydroelastic.scenes.errors import Problem, SceneError, UnsolvedError
from hydroelastic.scenes.models import TankScene
from hydroelastic.scenes.open_csv import write_csv
from hydroelastic.scenes.open_figures import draw_open
from hydroelastic.scenes.open_results import OpenSolution
from hydroelastic.scenes.open_solve import solve_open
from hydroelastic.scenes.open_summary import summarize_open
from hydroelastic.scenes.open_tables import markdown_open
from hydroelastic.scenes.provenance import Summary
from hydroelastic.scenes.result_writer import write_results
from hydroelastic.scenes.stopwatch import Report


def solved_open_scene(scene: TankScene, *, import_seconds: float, report: Report) -> tuple[OpenSolution, Summary]:
    """Solve a scene with open ends and summarize it, on all processes (collective).

    Raises:
        SceneError: if no mesh can be made of it.
        UnsolvedError: if the eigen-solver fails.
    """
    comm = MPI.COMM_WORLD
    try:
        solution = solve_open(scene, comm, report)
    except MeshError as error:
        problem = Problem(wrong=f"no mesh could be made: {error}", remedy="Please report this scene")
        raise SceneError(problem) from error
    except EigenSolverError as error:
        raise UnsolvedError(f"the eigen-solver failed: {error}") from error
    return solution, summarize_open(solution, comm, import_seconds=import_seconds)


def write_open(solution: OpenSolution, summary: Summary, out: Path, *, images: bool, report: Report) -> None:
    """Write the result folder on rank 0 (collective)."""

    def tables(folder: Path) -> None:
        write_csv(solution, folder)
        write_dataset(solution, folder / "dataset.nc")

    write_results(
        out,
        summary,
        tables=tables,
        pictures=(lambda folder: draw_open(solution, folder)) if images else None,
        text=lambda content: markdown_open(solution, content),
        report=report,
    )
