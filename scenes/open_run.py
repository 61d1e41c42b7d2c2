"""Run a scene with open ends: solve, tabulate, write and draw."""

from __future__ import annotations

from pathlib import Path

from mpi4py import MPI

from hydroelastic.fem.modes import EigenSolverError
from hydroelastic.meshes.tagged_mesh import MeshError
from hydroelastic.scenes.dataset import write_dataset
from hydroelastic.scenes.errors import Problem, SceneError, UnsolvedError
from hydroelastic.scenes.field_solution import Stopwatch
from hydroelastic.scenes.models import TankScene
from hydroelastic.scenes.open_csv import write_csv
from hydroelastic.scenes.open_figures import draw_open
from hydroelastic.scenes.open_results import OpenSolution
from hydroelastic.scenes.open_solve import solve_open
from hydroelastic.scenes.open_summary import summarize_open
from hydroelastic.scenes.open_tables import markdown_open
from hydroelastic.scenes.output import raise_on_all, result_folder, write_summary
from hydroelastic.scenes.solve import Report
from hydroelastic.scenes.summary import Summary


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
    comm, watch = MPI.COMM_WORLD, Stopwatch()
    problem: BaseException | None = None
    if comm.rank == 0:
        try:
            with result_folder(out) as folder:
                with watch.stage("write"):
                    report("tables")
                    write_csv(solution, folder)
                    write_dataset(solution, folder / "dataset.nc")
                if images:
                    with watch.stage("draw"):
                        report("images")
                        (folder / "images").mkdir()
                        draw_open(solution, folder / "images")
                summary["timing"].update(watch.seconds)
                (folder / "summary.md").write_text(markdown_open(solution, summary), encoding="utf-8")
                write_summary(summary, folder)
        except BaseException as error:
            # Whatever it is, the other processes wait to hear of it.
            problem = error
    raise_on_all(problem, comm)
