"""Run a scene: solve, set the estimates beside the solution, tabulate, write and draw."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

from mpi4py import MPI

from hydroelastic.fem.modes import EigenSolverError
from hydroelastic.fem.pictures import NoRendererError
from hydroelastic.meshes.files import load_mesh
from hydroelastic.meshes.tagged_mesh import MeshError, TaggedMesh
from hydroelastic.scenes.errors import Problem, SceneError, UnsolvedError
from hydroelastic.scenes.estimates import scene_estimates
from hydroelastic.scenes.models import TankScene
from hydroelastic.scenes.open_results import OpenSolution
from hydroelastic.scenes.open_tables import printed_open
from hydroelastic.scenes.outcome import Outcome
from hydroelastic.scenes.output import raise_on_all, result_folder, write_summary
from hydroelastic.scenes.provenance import Summary
from hydroelastic.scenes.read import closed_tank
from hydroelastic.scenes.solve import TankSolution, solve_scene
from hydroelastic.scenes.stopwatch import Report, Stopwatch
from hydroelastic.scenes.summary import summarize
from hydroelastic.scenes.tables import markdown, mode_csv, printed


@dataclass(frozen=True, kw_only=True)
class TankOutcome(Outcome):
    """What the run of a tank, or of open water, gave.

    Attributes:
        solution: the field solution, or that of a scene with open ends.
    """

    solution: TankSolution | OpenSolution


def run_scene(
    scene: TankScene,
    *,
    out: Path | None = None,
    images: bool = True,
    import_seconds: float = 0.0,
    report: Report = lambda _message: None,
) -> TankOutcome:
    """Solve a scene and write its result folder.

    Args:
        scene: the scene.
        out: result folder, made whole or not at all; ``None`` writes nothing.
        images: whether to draw the modes.
        import_seconds: time that importing libraries took, for the record.
        report: told what is being done.

    Returns:
        The solution and its summary (collective).

    Raises:
        SceneError: if the scene's mesh does not fit it, or the folder cannot be written.
        UnsolvedError: if the eigen-solver fails.
    """
    if scene.is_open:
        # Closed tanks do without what open water needs.
        from hydroelastic.scenes.open_run import solved_open_scene, write_open

        opened, summary = solved_open_scene(scene, import_seconds=import_seconds, report=report)
        if out is not None:
            write_open(opened, summary, out, images=images, report=report)
        return TankOutcome(solution=opened, summary=summary, tables=printed_open(opened, summary), folder=out)
    solution, summary = solved_scene(scene, import_seconds=import_seconds, report=report)
    warnings = _write(solution, summary, out, images, report) if out is not None else ()
    return TankOutcome(solution=solution, summary=summary, tables=printed(summary), folder=out, warnings=warnings)


def solved_scene(
    scene: TankScene, *, import_seconds: float = 0.0, report: Report = lambda _message: None
) -> tuple[TankSolution, Summary]:
    """Solve a closed tank and set the estimates beside the solution, on all processes (collective).

    Raises:
        SceneError: if the scene's ends are open, or its mesh does not fit it.
        UnsolvedError: if the eigen-solver fails.
    """
    closed_tank(scene, "the estimates of the older theories are those of closed tanks")
    comm = MPI.COMM_WORLD
    watch = Stopwatch()
    with watch.stage("estimates"):
        report("estimates")
        estimates = scene_estimates(scene)
        of_floats = None
        if scene.floats:
            # Floats need more of SciPy, which takes a while to import.
            from hydroelastic.scenes.float_estimates import float_estimates

            of_floats = float_estimates(scene)
    try:
        solution = solve_scene(scene, comm=comm, mesh=_own_mesh(scene, comm), report=report)
    except MeshError as error:
        raise SceneError(_mesh_problem(scene, error)) from error
    except EigenSolverError as error:
        raise UnsolvedError(f"the eigen-solver failed: {error}") from error
    summary = summarize(solution, estimates, of_floats, import_seconds=import_seconds)
    summary["timing"].update(watch.seconds)
    return solution, summary


def _own_mesh(scene: TankScene, comm: MPI.Comm) -> TaggedMesh | None:
    """The mesh that the user brings, on rank 0."""
    if scene.mesh is None:
        return None
    mesh, problem = None, None
    if comm.rank == 0:
        try:
            mesh = load_mesh(scene.mesh.file)
        except Exception as error:
            # Whatever it is, the other processes wait to hear of it.
            problem = str(error) or type(error).__name__
    problem = comm.bcast(problem, root=0)
    if problem is not None:
        raise SceneError(_mesh_problem(scene, MeshError(problem)))
    return mesh


def _mesh_problem(scene: TankScene, error: MeshError) -> Problem:
    if scene.mesh is None:
        return Problem(wrong=f"no mesh could be made: {error}", remedy="Please report this scene")
    return Problem(
        key='[mesh] key "file"',
        value=f'"{scene.mesh.file}"',
        wrong=str(error),
        remedy="Mend the mesh, or leave [mesh] out to use the built-in one",
    )


def _write(
    solution: TankSolution,
    summary: Summary,
    out: Path,
    images: bool,
    report: Report,
) -> tuple[str, ...]:
    """Write the result folder on rank 0; the others help to sample the fields, and wait.

    Returns:
        Warnings.
    """
    comm, watch = MPI.COMM_WORLD, Stopwatch()
    from hydroelastic.scenes.shapes import draw_all, sample_shapes, write_fields

    with watch.stage("sample"):
        shapes = sample_shapes(solution)
    problem: BaseException | None = None
    warnings: list[str] = []
    if shapes is not None:
        try:
            with result_folder(out) as folder:
                with watch.stage("write"):
                    report("fields")
                    write_fields(shapes, folder / "fields")
                    (folder / "modes.csv").write_text(mode_csv(summary), encoding="utf-8")
                if images:
                    with watch.stage("draw"):
                        report("images")
                        try:
                            draw_all(shapes, summary, folder / "images")
                        except NoRendererError as error:
                            (folder / "images").rmdir()
                            warnings.append(f"no images: {error}")
                summary["timing"].update(watch.seconds)
                (folder / "summary.md").write_text(markdown(summary), encoding="utf-8")
                write_summary(summary, folder)
        except BaseException as error:
            # Whatever it is, the other processes wait to hear of it.
            problem = error
    raise_on_all(problem, comm)
    return tuple(warnings)
