"""Solve a tank in three dimensions in its smallest model: only what that model takes is imported."""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING

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
from hydroelastic.fem.progress import Report
from hydroelastic.physics.level_tank import Box, FilePlan, LevelTank
from hydroelastic.physics.volume_tank import VolumeTank

if TYPE_CHECKING:
    from hydroelastic.fem.plan.box import BoxSolution
    from hydroelastic.fem.plan.plan import PlanSolution
    from hydroelastic.fem.plan.released_solve import ReleasedSolution
    from hydroelastic.fem.volume.solve import VolumeSolution


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
        from hydroelastic.fem.level_bed.solve import solve_level_tank

        return solve_level_tank(physical, tolerance=tolerance, modes=modes, tones=tones, report=report)
    from hydroelastic.fem.plan.plate_tone import class_tones, listed_tones

    tank = physical.scaled()
    problems: list[LevelProblem] = []
    released = tank.top == "pressure_release" and len(tank.plates) > 0
    found: BoxSolution | PlanSolution | ReleasedSolution | VolumeSolution
    if model == "box":
        from hydroelastic.fem.plan.box import BoxModel, solve_box, symmetries
        from hydroelastic.fem.plan.box_problem import BoxProblem

        assert isinstance(tank.plan, Box)
        if released:
            from hydroelastic.fem.plan.released_solve import solve_released

            found = solve_released(
                BoxModel(tank=tank), symmetries(tank), tolerance=tolerance, count=modes, report=report
            )
        else:
            found = solve_box(tank, tolerance=tolerance, count=modes, report=report)
        size = (tank.plan.length, tank.plan.width)
        problems += [
            BoxProblem(symmetry_class=one, plates=found.plates[one.parity], size=size) for one in found.modes.classes
        ]
        tones_of = partial(listed_tones, tank) if released else partial(class_tones, BoxModel(tank=tank))
    elif model == "volume":
        from hydroelastic.fem.volume.problem import VolumeProblem
        from hydroelastic.fem.volume.solve import solve_volume

        assert isinstance(tank, VolumeTank)
        found = solve_volume(tank, tolerance=tolerance, count=modes, comm=comm, report=report)
        problems += [VolumeProblem(symmetry_class=one, model=found.model) for one in found.modes.classes]
        tones_of = partial(listed_tones, tank)
    else:
        from hydroelastic.fem.plan.mesh_problem import MeshProblem
        from hydroelastic.fem.plan.plan import PlanModel, mirrored_classes, solve_plan
        from hydroelastic.meshes.plan_regions import mirrors_of, plan_regions

        plan_model = PlanModel(tank=tank, comm=comm or MPI.COMM_WORLD)
        wall, regions = plan_regions(tank)
        mirrors = mirrors_of(wall, regions)
        if released:
            from hydroelastic.fem.plan.released_solve import solve_released

            found = solve_released(
                plan_model, mirrored_classes(mirrors), tolerance=tolerance, count=modes, report=report
            )
        else:
            found = solve_plan(tank, tolerance=tolerance, count=modes, comm=comm, report=report)
        problems += [
            MeshProblem(symmetry_class=one, plates=found.plates[one.parity], regions=regions, mirrors=mirrors)
            for one in found.modes.classes
        ]
        tones_of = partial(listed_tones, tank) if released else partial(class_tones, plan_model)
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
