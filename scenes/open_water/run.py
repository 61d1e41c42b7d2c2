"""Run a scene with open ends: solve, tabulate, write and draw."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from mpi4py import MPI

from hydroelastic.fem.open_water.decay import DriftingFloatError, UnstableFloatError
from hydroelastic.fem.open_water.field_samples import SampledField, sample_field
from hydroelastic.fem.open_water.fields import open_fields
from hydroelastic.fem.open_water.plan_waves import plan_waves
from hydroelastic.fem.open_water.solve import solve_open_water
from hydroelastic.fem.progress import Report
from hydroelastic.fem.solver_error import EigenSolverError
from hydroelastic.fem.time_domain.motion import UnsolvedMotionError
from hydroelastic.meshes.tagged_mesh import MeshError
from hydroelastic.output.hydrodynamic_files.bemio import write_bemio
from hydroelastic.output.hydrodynamic_files.capytaine import write_capytaine
from hydroelastic.output.hydrodynamic_files.nemoh import write_nemoh
from hydroelastic.output.hydrodynamic_files.wamit import write_wamit
from hydroelastic.output.hydrodynamic_files.whole_bodies import bodies_of_tables
from hydroelastic.output.open_water.files import write_open_csv
from hydroelastic.output.open_water.plan_pictures import draw_plan_waves, draw_wave_view
from hydroelastic.output.open_water.quantities import OPEN_WATER
from hydroelastic.output.open_water.tables import open_cost, open_sections
from hydroelastic.output.open_water.variables import COMMENT, open_variables
from hydroelastic.output.plots import OF_CURVES, OF_FIELDS, OF_MOTIONS, PictureOptions, Sheets
from hydroelastic.output.reading import Reading
from hydroelastic.output.vtu import write_vtu
from hydroelastic.scenes.errors import Problem, SceneError, UnsolvedError, cannot_be_meshed
from hydroelastic.scenes.models.tank_parts import TankParts
from hydroelastic.scenes.open_water.figures import draw_open
from hydroelastic.scenes.open_water.physics import open_water_problem
from hydroelastic.scenes.open_water.results import OpenSolution
from hydroelastic.scenes.staged_run import StagedRun
from hydroelastic.scenes.tank.body_file import displacement_of, write_bodies

if TYPE_CHECKING:
    from hydroelastic.fem.open_water.plan_waves import PlanWaves
    from hydroelastic.fem.open_water.problem import OpenWaterProblem

_NAME = "bodies"


@dataclass(frozen=True, kw_only=True)
class SampledWater:
    """Results that are written and drawn."""

    solution: OpenSolution  # the tables
    fields: tuple[SampledField, ...]  # fields of the analyses, on rank 0
    plans: tuple[PlanWaves, ...]  # waves around solids of revolution in plan view, on rank 0
    missing: tuple[str, ...]  # which fields there are not, and why


def _sample(solution: OpenSolution, _summary: Reading) -> SampledWater:
    sampled, missing = [], []
    problem = open_water_problem(solution.scene, MPI.COMM_WORLD)
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
    return tuple(waves for number, one in enumerate(solution.response, 1) for waves in plan_waves(problem, one, number))


def _write(water: SampledWater, folder: Path) -> None:
    write_open_csv(water.solution, folder)
    write_exports(water.solution, folder / "export")
    write_fields(water.fields, folder / "fields")


def _draw(water: SampledWater, folder: Path, options: PictureOptions, report: Report) -> None:
    from hydroelastic.output.fields import animate_motion, draw_motion

    report("pictures of curves")
    draw_open(water.solution, folder, options)
    sheets = Sheets(folder=folder, title=water.solution.scene.title, options=options)
    for waves in water.plans:
        draw_plan_waves(waves, sheets)
    report("pictures of fields")
    for field in water.fields:
        draw_motion(field.picture, f"waves_{field.name}", sheets)
        if options.animate:
            # A motion that dies out is animated as if it did not: it goes on without a jump.
            animate_motion(field.picture, f"waves_{field.name}", sheets)
    for waves in water.plans:
        draw_wave_view(waves, sheets)


def write_fields(fields: tuple[SampledField, ...], folder: Path) -> None:
    """Write each field into a new folder: real parts, imaginary parts, magnitudes; for ParaView.

    ``<name>.vtu`` is of the liquids, ``<name>_bodies.vtu`` of surfaces, beams and floats.
    """
    if fields:
        folder.mkdir()
    for field in fields:
        _write_field(field, folder)
        _write_bodies(field, folder)


def _write_field(field: SampledField, folder: Path) -> None:
    moved = np.column_stack([field.displacement, np.zeros(len(field.displacement))])
    data = _parts("potential", field.potential) | _parts("pressure", field.pressure) | _parts("displacement", moved)
    points = np.column_stack([field.points, np.zeros(len(field.points))])
    file = folder / f"{field.name}.vtu"
    write_vtu(file, points, [("triangle", field.triangles)], data, {"liquid": field.liquid})


def _write_bodies(field: SampledField, folder: Path) -> None:
    surfaces, floats = field.picture.surfaces, field.picture.floats
    moved = displacement_of(surfaces, floats)
    write_bodies(folder / f"{field.name}_bodies.vtu", surfaces, floats, _parts("displacement", moved))


def _parts(name: str, values: np.ndarray) -> dict[str, np.ndarray]:
    """Real part, imaginary part and magnitude, since ParaView has no complex numbers."""
    size = np.abs(values) if values.ndim == 1 else np.linalg.norm(values, axis=1)
    return {f"{name}_real": values.real, f"{name}_imaginary": values.imag, f"{name}_magnitude": size}


def write_exports(solution: OpenSolution, folder: Path) -> None:
    """Write ``bodies.1`` … and ``bodies.h5``, ``bodies.nc`` and ``nemoh/`` into a new folder, if they are asked for."""
    asked = solution.scene.export
    if asked is None:
        return
    bodies = bodies_of_tables(
        solution.tank, solution.radiation, solution.response, solution.impulse_response, width=asked.width or 1.0
    )
    folder.mkdir()
    for one in asked.formats:
        match one:
            case "wamit":
                write_wamit(bodies, folder, _NAME)
            case "bemio":
                write_bemio(bodies, folder / f"{_NAME}.h5")
            case "nemoh":
                write_nemoh(bodies, folder / "nemoh")
            case "capytaine":
                write_capytaine(bodies, folder / f"{_NAME}.nc")


def solve_open(scene: TankParts, comm: MPI.Comm, report: Report) -> OpenSolution:
    """Solve all analyses of a scene with open ends (collective)."""
    requests = tuple(analysis.request for analysis in scene.analyses)
    try:
        solved = solve_open_water(open_water_problem(scene, comm), requests, report)
    except MeshError as error:
        raise cannot_be_meshed(error, scene) from error
    except EigenSolverError as error:
        raise UnsolvedError(f"the eigen-solver failed: {error}") from error
    except UnsolvedMotionError as error:
        raise UnsolvedError(f"a motion in waves grows without bound: {error}") from error
    except UnstableFloatError:
        wrong, remedy = "a float is unstable and would capsize", "Lower its centre of mass"
    except DriftingFloatError as error:
        motions = " and ".join(error.motions)
        wrong = f"the float would drift away: the release excites {motions}, without restoring force"
        remedy = f"Leave {motions} out of motions, or release it in another motion"
    else:
        return OpenSolution(scene=scene, **vars(solved))
    raise SceneError(Problem(key='[[analysis]] key "displacement"', wrong=wrong, remedy=remedy))


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
