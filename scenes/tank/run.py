"""Run a closed tank: solve, compare with the estimates, tabulate, write and draw."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from pathlib import Path

import xarray as xr
from mpi4py import MPI

from hydroelastic.fem.closed.section import SectionSolution, solve_section
from hydroelastic.fem.progress import Report
from hydroelastic.fem.solver_error import EigenSolverError
from hydroelastic.meshes.tagged_mesh import MeshError
from hydroelastic.modal.tank_estimates import tone_estimates
from hydroelastic.output.csv_files import write_csv
from hydroelastic.output.outcome import Outcome
from hydroelastic.output.plots import OF_FIELDS, OF_MOTIONS, PictureOptions
from hydroelastic.output.reading import Reading
from hydroelastic.output.tank.quantities import TANK
from hydroelastic.output.tank.tables import compared_sections, mode_columns, tank_cost, tank_sections
from hydroelastic.output.tank.variables import tank_variables
from hydroelastic.output.variables import Variable
from hydroelastic.scenes.errors import UnsolvedError
from hydroelastic.scenes.models.physical import physical_tank
from hydroelastic.scenes.models.tank import TankScene
from hydroelastic.scenes.read import closed_tank
from hydroelastic.scenes.staged_run import StagedRun
from hydroelastic.scenes.tank.check_hints import draughts_left_out
from hydroelastic.scenes.tank.solve import EstimatedTank
from hydroelastic.scenes.tank.user_mesh import mesh_refused, user_mesh


@dataclass(frozen=True, kw_only=True)
class SampledTank:
    """Results that are written and drawn.

    Attributes:
        solution: the field solution.
        samples: ψ and ∇ψ of the modes on triangles; ``None`` except on rank 0.
        summary: what is written of them.
    """

    solution: SectionSolution
    samples: xr.Dataset | None
    summary: Reading


def solve_tank(scene: TankScene, comm: MPI.Comm, report: Report) -> EstimatedTank:
    """Solve a closed tank and estimate it (collective)."""
    closed_tank(scene, "the estimates of the older theories are those of closed tanks")
    report("estimates")
    physical = physical_tank(scene)
    estimates = tone_estimates(physical)
    of_floats = None
    if scene.floats:
        # Floats need more of SciPy, which takes a while to import.
        from hydroelastic.modal.floats.estimates import float_estimates

        of_floats = float_estimates(physical)
    solved = solve_tank_alone(scene, comm, report)
    return replace(solved, beam=estimates, floats=of_floats)


def solve_tank_alone(scene: TankScene, comm: MPI.Comm, report: Report) -> EstimatedTank:
    """As `solve_tank`, without the estimates (collective)."""
    try:
        solution = solve_section(
            physical_tank(scene),
            tolerance=scene.accuracy.tolerance,
            modes=scene.accuracy.modes,
            comm=comm,
            mesh=user_mesh(scene, comm),
            report=report,
        )
    except MeshError as error:
        raise mesh_refused(scene, error) from error
    except EigenSolverError as error:
        raise UnsolvedError(f"the eigen-solver failed: {error}") from error
    return EstimatedTank(scene=scene, tank=solution)


def _sample(estimated: EstimatedTank, summary: Reading) -> SampledTank:
    return SampledTank(solution=estimated.tank, samples=estimated.tank.samples(), summary=summary)


def _write(tank: SampledTank, folder: Path) -> None:
    from hydroelastic.scenes.tank.shapes import write_fields

    assert tank.samples is not None
    write_fields(tank.solution, tank.samples, folder / "fields")
    write_csv(folder / "modes.csv", mode_columns(tank.summary))


def _arrays(tank: SampledTank) -> Iterator[Variable]:
    return tank_variables(tank.solution.dataset, tank.solution.shapes)


def _draw(tank: SampledTank, folder: Path, options: PictureOptions, report: Report) -> None:
    from hydroelastic.scenes.tank.shapes import draw_all

    assert tank.samples is not None
    draw_all(tank.solution, tank.samples, tank.summary, folder, options, report)


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
