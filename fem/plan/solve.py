"""The smallest model of a tank with a level bed: orders on a line, a box of two intervals, or a plan of triangles."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import Literal, TypeAlias

import numpy as np
from mpi4py import MPI

from hydroelastic.fem.kept_tolerance import kept_tolerance
from hydroelastic.fem.level_bed.separation import separated
from hydroelastic.fem.level_bed.solution import LevelMode, LevelSolution, PlanProblem, PlateTone
from hydroelastic.fem.level_bed.solve import NotTreatedError, solve_level_tank
from hydroelastic.fem.plan.box import BoxSolution, solve_box
from hydroelastic.fem.plan.box_problem import BoxProblem
from hydroelastic.fem.plan.classes import ClassModes
from hydroelastic.fem.plan.mesh_problem import MeshProblem
from hydroelastic.fem.plan.plan import PlanSolution, solve_plan
from hydroelastic.fem.plan.regions import plan_regions
from hydroelastic.fem.stopwatch import Report, Stopwatch
from hydroelastic.fem.tank.elastic_tone import elastic_tone
from hydroelastic.fem.volume.problem import VolumeProblem
from hydroelastic.fem.volume.solve import VolumeSolution, solve_volume
from hydroelastic.physics.dofs import FIRST_ELASTIC, body_name
from hydroelastic.physics.level_tank import Box, LevelTank
from hydroelastic.physics.plate import Polygon, Rectangle, Strip
from hydroelastic.physics.volume_tank import VolumeTank

LevelModel: TypeAlias = Literal["orders", "box", "plan", "volume"]

MODEL_WORDS: dict[LevelModel, str] = {
    "orders": "upright tank with a level bed whose orders separate: one problem on a line for each, exact in depth",
    "box": "upright box with a level bed and rectangular plates: products of two intervals, exact in depth",
    "plan": "upright tank with a level bed: triangles on the plan, the depth by its poles",
    "volume": "volume: tetrahedra in all of the liquid",
}
"""What each model is, as summaries tell it."""

# A plate this close to a wall touches it, in units of the tank.
_TOUCHING = 1e-9


def level_model(physical: LevelTank) -> LevelModel:
    """Return the smallest model of a tank.

    Raises:
        NotTreatedError: if there is none.
    """
    if isinstance(physical, VolumeTank):
        return "volume"
    tank = physical.scaled()
    if separated(tank) is not None:
        return "orders"
    if any(plate.slats for plate in tank.plates):
        raise NotTreatedError("beams side by side go with other such covers and strips of plate only")
    if tank.top == "pressure_release" and tank.plates:
        raise NotTreatedError("ψ = 0 on the water is for strips in a box, and discs and rings about a cylinder's axis")
    if isinstance(tank.plan, Box) and all(isinstance(plate.outline, Rectangle | Strip) for plate in tank.plates):
        return "box"
    for index, plate in enumerate(tank.plates):
        number = index + 1
        if isinstance(plate.outline, Strip):
            raise NotTreatedError(f"plate {number} is a strip, which goes with strips and rectangles only")
        if isinstance(plate.outline, Polygon) and plate.edge != "free":
            raise NotTreatedError(f"plate {number} is a polygon, whose edges are free")
    wall, regions = plan_regions(tank)
    for index, region in enumerate(regions):
        if region.outside is wall.outside:
            continue
        if region.gap(wall) < _TOUCHING:
            raise NotTreatedError(f"plate {index + 1} touches a wall, and covers only a part of the plan")
        corner = region.outside.parallel(0.0, np.zeros(1))[0]
        if not wall.outside.contains(corner) or any(hole.contains(corner) for hole in wall.inside):
            raise NotTreatedError(f"plate {index + 1} does not lie inside the plan")
        for other, earlier in enumerate(regions[:index]):
            if region.gap(earlier) < _TOUCHING:
                raise NotTreatedError(f"plates {other + 1} and {index + 1} touch each other")
    return "plan"


def solve_upright_tank(
    physical: LevelTank,
    *,
    tolerance: float,
    modes: int,
    comm: MPI.Comm | None = None,
    report: Report = lambda _message: None,
) -> LevelSolution:
    """Solve a tank in three dimensions in its smallest model (collective).

    Args:
        physical: the tank, in SI units.
        tolerance: largest relative error of the frequencies that is accepted.
        modes: number of modes, from the lowest.
        comm: the processes, all by default; each solves the same, but for the poles of a plan, which they share, and
            the mesh of a volume, which is distributed.
        report: receives messages on the progress.

    Raises:
        NotTreatedError: if no model takes it.
        MeshError: if its plan cannot be meshed.
        EigenSolverError: if the eigen-solver fails.
    """
    model = level_model(physical)
    if model == "orders":
        return solve_level_tank(physical, tolerance=tolerance, modes=modes, report=report)
    watch = Stopwatch()
    tank = physical.scaled()
    problems: list[PlanProblem] = []
    found: BoxSolution | PlanSolution | VolumeSolution
    with watch.stage("modes"):
        if model == "box":
            assert isinstance(tank.plan, Box)
            found = solve_box(tank, tolerance=tolerance, count=modes, report=report)
            size = (tank.plan.length, tank.plan.width)
            problems += [
                BoxProblem(symmetry_class=one, plates=found.plates[one.parity], size=size)
                for one in found.modes.classes
            ]
        elif model == "volume":
            assert isinstance(tank, VolumeTank)
            found = solve_volume(tank, tolerance=tolerance, count=modes, comm=comm, report=report)
            problems += [VolumeProblem(symmetry_class=one, model=found.model) for one in found.modes.classes]
        else:
            found = solve_plan(tank, tolerance=tolerance, count=modes, comm=comm, report=report)
            _, regions = plan_regions(tank)
            problems += [
                MeshProblem(symmetry_class=one, plates=found.plates[one.parity], regions=regions, mirrors=found.mirrors)
                for one in found.modes.classes
            ]
    errors = found.relative_errors
    classes = found.modes
    listed = tuple(
        LevelMode(
            problem=problems[classes.origins[index][0]],
            mode=classes.completed(index),
            relative_error=float(errors[index]),
        )
        for index in range(min(modes, len(errors)))
    )
    tones = tuple(_tone(tank, classes, index, errors) for index, plate in enumerate(tank.plates) if plate.is_elastic)
    return LevelSolution(
        physical=physical,
        tank=tank,
        model=MODEL_WORDS[model],
        tolerance=tolerance,
        count=modes,
        modes=listed,
        tones=tones,
        zero_modes=sum(one.modes.zero_modes for one in classes.classes),
        counted=found.counted,
        size={
            **found.sizes,
            "dofs": sum(one.pencil.liquid.size + one.pencil.size for one in classes.classes),
            "surface_unknowns": sum(one.pencil.size for one in classes.classes),
            "plate_shapes": sum(one.pencil.body_size for one in classes.classes),
        },
        solves=sum(one.modes.solves for one in classes.classes),
        attempts=found.attempts,
        reasons=tuple(_reasons(listed, found.counted, tolerance)),
        seconds=dict(watch.seconds),
    )


def _tone(tank: LevelTank, found: ClassModes, plate: int, errors: np.ndarray) -> PlateTone:
    """The first elastic tone of a plate, of the class of its softest dry mode, among the modes that were solved."""
    best: tuple[float, int, int] | None = None
    for number, one in enumerate(found.classes):
        for place, body in enumerate(one.pencil.bodies):
            if body.surface == body_name(plate + 1) and FIRST_ELASTIC in body.dofs:
                first = body.dofs.index(FIRST_ELASTIC)
                softness = float(body.stiffness[first] / max(body.mass[first, first], np.finfo(float).tiny))
                if best is None or softness < best[0]:
                    best = softness, number, place
    assert best is not None
    dry, number, place = best
    one = found.classes[number]
    body = one.pencil.bodies[place]
    first = body.dofs.index(FIRST_ELASTIC)
    density = tank.plates[plate].mass_per_area
    plain = PlateTone(
        plate=plate,
        order=None,
        dry=dry,
        squares=float(body.mass[first, first] / density) if density else 1.0,
        stiffness=float(body.stiffness[first]),
        mass=float(body.mass[first, first]),
        reason="it may lie above the modes that were solved; more modes show it",
    )
    tone = elastic_tone(one.modes, one.pencil.bodies, place) if len(one.modes.eigenvalues) else None
    index = found.origins.index((number, tone.index)) if tone and (number, tone.index) in found.origins else None
    if tone is None or not tone.certain or index is None:
        return plain
    return replace(
        plain,
        tone=tone,
        eigenvalue=float(one.modes.eigenvalues[tone.index]),
        relative_error=float(errors[index]),
        reason="",
    )


def _reasons(listed: tuple[LevelMode, ...], counted: bool, tolerance: float) -> Iterator[str]:
    """Yield why a solution does not keep the tolerance, or is incomplete."""
    errors = [one.relative_error for one in listed]
    if errors and max(errors) > tolerance:
        yield (
            f"mode {int(np.argmax(errors)) + 1} has an estimated relative error of {max(errors):.1e}, above the "
            f"tolerance {tolerance:g}; {kept_tolerance(max(errors))}"
        )
    if not counted:
        yield "an independent count of the modes by inertia disagrees: a mode may be missing"
