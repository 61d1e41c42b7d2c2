"""Run a closed tank: solve, compare with the estimates, tabulate, write and draw."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

from mpi4py import MPI

from hydroelastic.fem.progress import Report
from hydroelastic.fem.solver_error import EigenSolverError
from hydroelastic.fem.tank.liquids import ANEW, Liquids
from hydroelastic.fem.tank.solve import TankSolution
from hydroelastic.meshes.tagged_mesh import MeshError
from hydroelastic.modal.tank_estimates import tone_estimates
from hydroelastic.output.csv_files import write_csv
from hydroelastic.output.outcome import Outcome
from hydroelastic.output.plots import OF_FIELDS, OF_MOTIONS, PictureOptions
from hydroelastic.output.reading import Reading
from hydroelastic.output.tank.quantities import MODE_OMEGA, MODES, TANK
from hydroelastic.output.tank.tables import compared_sections, mode_columns, tank_cost, tank_sections
from hydroelastic.output.tank.variables import tank_variables
from hydroelastic.output.variables import Variable
from hydroelastic.scenes.errors import UnsolvedError
from hydroelastic.scenes.models.physical import physical_tank
from hydroelastic.scenes.models.tank import TankScene
from hydroelastic.scenes.read import closed_tank
from hydroelastic.scenes.staged_run import StagedRun
from hydroelastic.scenes.tank.check_hints import draughts_left_out
from hydroelastic.scenes.tank.solve import EstimatedTank, solve_scene
from hydroelastic.scenes.tank.user_mesh import mesh_refused, user_mesh

if TYPE_CHECKING:
    from hydroelastic.fem.tank.mode_shapes import ModeShapes


@dataclass(frozen=True, kw_only=True)
class SampledTank:
    """Results that are written and drawn.

    Attributes:
        solution: the field solution.
        shapes: mode shapes in SI units; ``None`` except on rank 0.
        summary: what is written of them.
    """

    solution: TankSolution
    shapes: ModeShapes | None
    summary: Reading


def solve_tank(scene: TankScene, comm: MPI.Comm, report: Report, liquids: Liquids = ANEW) -> EstimatedTank:
    """Solve a closed tank and estimate it (collective); `liquids` makes its mesh and matrices."""
    closed_tank(scene, "the estimates of the older theories are those of closed tanks")
    report("estimates")
    physical = physical_tank(scene)
    estimates = tone_estimates(physical)
    of_floats = None
    if scene.floats:
        # Floats need more of SciPy, which takes a while to import.
        from hydroelastic.modal.floats.estimates import float_estimates

        of_floats = float_estimates(physical)
    solved = solve_tank_alone(scene, comm, report, liquids)
    return replace(solved, beam=estimates, floats=of_floats)


def solve_tank_alone(scene: TankScene, comm: MPI.Comm, report: Report, liquids: Liquids = ANEW) -> EstimatedTank:
    """As `solve_tank`, without the estimates (collective)."""
    try:
        solution = solve_scene(scene, comm=comm, mesh=user_mesh(scene, comm), liquids=liquids, report=report)
    except MeshError as error:
        raise mesh_refused(scene, error) from error
    except EigenSolverError as error:
        raise UnsolvedError(f"the eigen-solver failed: {error}") from error
    return EstimatedTank(scene=scene, tank=solution)


def _sample(estimated: EstimatedTank, summary: Reading) -> SampledTank:
    # Without pictures their modules are not imported.
    from hydroelastic.fem.tank.mode_shapes import sample_shapes

    return SampledTank(solution=estimated.tank, shapes=sample_shapes(estimated.tank), summary=summary)


def _write(tank: SampledTank, folder: Path) -> None:
    from hydroelastic.scenes.tank.shapes import write_fields

    assert tank.shapes is not None
    write_fields(tank.shapes, [mode[MODE_OMEGA] for mode in tank.summary[MODES]], folder / "fields")
    write_csv(folder / "modes.csv", mode_columns(tank.summary))


def _arrays(tank: SampledTank) -> Iterator[Variable]:
    assert tank.shapes is not None
    return tank_variables(tank.solution, tank.shapes)


def _draw(tank: SampledTank, folder: Path, options: PictureOptions, report: Report) -> None:
    from hydroelastic.scenes.tank.shapes import draw_all

    assert tank.shapes is not None
    draw_all(tank.shapes, tank.summary, folder, options, report)


run_tank = StagedRun(
    solve=solve_tank,
    kind=TANK,
    arrays=_arrays,
    solve_alone=solve_tank_alone,
    sections=lambda estimated, summary: tank_sections(summary, draughts_left_out(estimated.scene)),
    cost=tank_cost,
    sample=_sample,
    write=_write,
    draw=_draw,
    used_options=OF_FIELDS | OF_MOTIONS,
)


def compare_tank(scene: TankScene, *, report: Report = lambda _message: None) -> Outcome:
    """Solve a closed tank and compare, with what each estimate neglects; writes nothing (collective)."""
    outcome = run_tank(scene, report=report)
    return replace(outcome, sections=tuple(compared_sections(run_tank.read(outcome.summary))), notes=True)
