"""Run a scene with open ends: solve, tabulate, write and draw."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

from mpi4py import MPI

from hydroelastic.fem.open_water.field_samples import SampledField, sample_field
from hydroelastic.fem.open_water.fields import open_fields
from hydroelastic.fem.solver_error import EigenSolverError
from hydroelastic.fem.stopwatch import Report, Stopwatch
from hydroelastic.meshes.tagged_mesh import MeshError
from hydroelastic.output.open_water.files import write_open_csv
from hydroelastic.output.open_water.quantities import OPEN_WATER
from hydroelastic.output.open_water.tables import open_cost, open_sections
from hydroelastic.output.open_water.variables import COMMENT, open_variables
from hydroelastic.output.pictures.options import OF_CURVES, OF_FIELDS, OF_MOTIONS, PictureOptions
from hydroelastic.output.reading import Reading
from hydroelastic.scenes.open_water.export import write_exports
from hydroelastic.scenes.open_water.field_files import write_fields
from hydroelastic.scenes.open_water.figures import draw_open
from hydroelastic.scenes.open_water.physics import open_water_problem
from hydroelastic.scenes.open_water.results import OpenSolution
from hydroelastic.scenes.open_water.solve import solve_open
from hydroelastic.scenes.staged_run import StagedRun

if TYPE_CHECKING:
    from hydroelastic.fem.open_water.plan_waves import PlanWaves
    from hydroelastic.fem.open_water.problem import OpenWaterProblem


@dataclass(frozen=True, kw_only=True)
class SampledWater:
    """Results that are written and drawn."""

    solution: OpenSolution  # the tables
    fields: tuple[SampledField, ...]  # fields of the analyses, on rank 0
    plans: tuple[PlanWaves, ...]  # waves around solids of revolution in plan view, on rank 0
    missing: tuple[str, ...]  # which fields there are not, and why


def _sample(solution: OpenSolution, _summary: Reading) -> SampledWater:
    sampled, missing = [], []
    problem = open_water_problem(solution.scene, MPI.COMM_WORLD, Stopwatch())
    plans = _plans(problem, solution) if solution.scene.is_revolved else ()
    for name, fields in () if solution.scene.is_revolved else open_fields(problem, solution):
        try:
            # One field after the other: each comes with a mesh and matrices of its own.
            sampled += [sample_field(field) for field in fields]
        except (MeshError, EigenSolverError) as error:
            # A field that fails does not affect the tables.
            missing.append(f"no field of {name}: {error}")
    fields_here = tuple(field for field in sampled if field is not None)
    return SampledWater(solution=solution, fields=fields_here, plans=plans, missing=tuple(missing))


def _plans(problem: OpenWaterProblem, solution: OpenSolution) -> tuple[PlanWaves, ...]:
    from hydroelastic.fem.open_water.plan_waves import plan_waves

    return tuple(waves for number, one in enumerate(solution.response, 1) for waves in plan_waves(problem, one, number))


def _write(water: SampledWater, folder: Path) -> None:
    write_open_csv(water.solution, folder)
    write_exports(water.solution, folder / "export")
    write_fields(water.fields, folder / "fields")


def _draw(water: SampledWater, folder: Path, options: PictureOptions, report: Report) -> None:
    # Who only wants the numbers does without what draws.
    from hydroelastic.scenes.open_water.field_pictures import draw_fields

    report("pictures of curves")
    draw_open(water.solution, folder, options)
    report("pictures of fields")
    draw_fields(water.fields, folder, options)
    if water.plans:
        from hydroelastic.output.open_water.plan_pictures import draw_plan_waves
        from hydroelastic.output.open_water.wave_views import draw_wave_view

        for waves in water.plans:
            draw_plan_waves(waves, water.solution.scene.title, folder, options)
            draw_wave_view(waves, water.solution.scene.title, folder, options)


run_open = StagedRun(
    solve=solve_open,
    kind=OPEN_WATER,
    sections=open_sections,
    cost=open_cost,
    sample=_sample,
    sampling_warnings=lambda water: water.missing,
    write=_write,
    arrays=lambda water: open_variables(water.solution),
    attributes={"comment": COMMENT},
    swept=open_variables,
    draw=_draw,
    used_options=OF_CURVES | OF_FIELDS | OF_MOTIONS,
)
