"""Solve a tank in three dimensions in its smallest model."""

from __future__ import annotations

from dataclasses import replace
from functools import partial

from mpi4py import MPI

from hydroelastic.fem.level_bed.choice import MODEL_WORDS, LevelModel, level_model
from hydroelastic.fem.level_bed.solution import (
    BY_INERTIA,
    LevelMode,
    LevelProblem,
    LevelSolution,
    PlateTone,
    shortcomings,
)
from hydroelastic.fem.level_bed.solve import solve_level_tank
from hydroelastic.fem.plan.mesh_problem import MeshProblem
from hydroelastic.fem.plan.plan import PlanModel, PlanSolution, solve_plan
from hydroelastic.fem.plan.plate_tone import class_tones, listed_tones
from hydroelastic.fem.plan.released_solve import solve_released
from hydroelastic.fem.progress import Report
from hydroelastic.fem.volume.problem import VolumeProblem
from hydroelastic.fem.volume.solve import VolumeSolution, solve_volume
from hydroelastic.physics.level_tank import FilePlan, LevelTank
from hydroelastic.physics.volume_tank import VolumeTank


def solve_smallest_model(
    physical: LevelTank,
    *,
    tolerance: float,
    modes: int,
    comm: MPI.Comm | None = None,
    model: LevelModel | None = None,
    tones: bool = True,
    report: Report = lambda _message: None,
) -> LevelSolution:
    """Solve a tank in three dimensions in its smallest model (collective)."""
    model = model or level_model(physical)
    if model == "orders":
        return solve_level_tank(physical, tolerance=tolerance, modes=modes, tones=tones, report=report)
    tank = physical.scaled()
    problems: list[LevelProblem] = []
    found: PlanSolution | VolumeSolution
    if model == "volume":
        assert isinstance(tank, VolumeTank)
        found = solve_volume(tank, tolerance=tolerance, count=modes, comm=comm, report=report)
        problems += [VolumeProblem(symmetry_class=one, model=found.model) for one in found.modes.classes]
        tones_of = partial(listed_tones, tank)
    else:
        plan = PlanModel(tank=tank, comm=comm or MPI.COMM_WORLD)
        released = tank.top == "pressure_release" and len(tank.plates) > 0
        found = (solve_released if released else solve_plan)(plan, tolerance=tolerance, count=modes, report=report)
        problems += [
            MeshProblem(symmetry_class=one, plates=found.plates[one.parity], model=plan) for one in found.modes.classes
        ]
        tones_of = partial(listed_tones, tank) if released else partial(class_tones, plan)
    errors = found.relative_errors
    classes = found.modes
    has_water = any(one.pencil.surfaces for one in classes.classes)
    found_tones: list[PlateTone] = []
    if tones and any(plate.is_elastic for plate in tank.plates):
        report("first elastic tones of the plates")
        found_tones = tones_of(classes, errors, tolerance, has_water=has_water)
    measures = f"; {physical.plan.measures}" if isinstance(physical.plan, FilePlan) else ""
    solution = LevelSolution(
        physical=physical,
        tank=tank,
        model=MODEL_WORDS[model] + getattr(found, "remark", "") + measures,
        tolerance=tolerance,
        count=modes,
        modes=tuple(
            LevelMode(
                problem=problems[classes.origins[index][0]],
                bodies=problems[classes.origins[index][0]].pencil.bodies,
                mode=classes.completed(index),
                relative_error=float(errors[index]),
            )
            for index in range(min(modes, len(errors)))
        ),
        tones=tuple(found_tones),
        zero_modes=sum(one.modes.zero_modes for one in classes.classes),
        counted=found.counted,
        count_method=getattr(found, "count_method", BY_INERTIA),
        size={
            **found.sizes,
            "dofs": sum(one.pencil.liquid.size + one.pencil.size for one in classes.classes),
            "surface_unknowns": sum(one.pencil.size for one in classes.classes),
            "plate_shapes": sum(one.pencil.body_size for one in classes.classes),
        },
        reasons=(),
    )
    return replace(solution, reasons=tuple(shortcomings(solution)))
