"""Conversion of a scene to a `physics.level_tank.LevelTank`, in SI units."""

from __future__ import annotations

from dataclasses import fields
from pathlib import Path

from hydroelastic.physics.level_tank import Box, Cylinder, FilePlan, LevelTank, Plan, PolygonPlan, middle_of
from hydroelastic.physics.plate import Disc, Outline, Plate, Polygon, Rectangle, Strip
from hydroelastic.physics.volume_tank import Bed, LowerLiquid, SlopingBed, SurveyedBed, VolumeTank
from hydroelastic.scenes.models import level_tank_parts as parts
from hydroelastic.scenes.models.number_files import read_columns


def physical_level_tank(scene: parts.LevelTankParts) -> LevelTank:
    """Return the tank of a scene; SI units."""
    plan = physical_plan(scene)
    tank = LevelTank(
        plan=plan,
        depth=depth_of(plan, scene),
        density=scene.density,
        gravity=scene.tank.gravity,
        top=scene.tank.top,
        plates=tuple(
            Plate(
                outline=physical_outline(scene, plate),
                flexural_rigidity=plate.whole_rigidity,
                mass_per_area=plate.whole_mass,
                poisson_ratio=plate.poisson_ratio,
                hydrostatic=plate.hydrostatic,
                edge=plate.edge,
                slats=plate.kind == "beam",
            )
            for plate in scene.plates
        ),
    )
    if not needs_volume(scene):
        return tank
    given = {field.name: getattr(tank, field.name) for field in fields(tank)}
    middle = middle_of(tank.plan)
    lower = scene.liquid[0]
    return VolumeTank(
        **given,
        bed=_physical_bed(scene),
        floats=tuple(body.solid(middle, scene.density, scene.folder) for body in scene.floats),
        columns=tuple(column.outline(middle) for column in scene.column),
        baffles=tuple(baffle.physical(middle) for baffle in scene.baffle),
        lower=LowerLiquid(density=lower.density, depth=lower.depth or 0.0) if len(scene.liquid) == 2 else None,
    )


def depth_of(plan: Plan, scene: parts.LevelTankParts) -> float:
    """Return the depth of all liquids together, m, which a mesh of a file has by itself."""
    return plan.fill if isinstance(plan, FilePlan) else scene.depth


def needs_volume(scene: parts.LevelTankParts) -> bool:
    """Return whether a mesh of the volume is wanted, or nothing smaller fits."""
    tank = scene.tank
    given = scene.floats or scene.column or scene.baffle or len(scene.liquid) == 2
    return tank.model == "volume" or tank.shape is not None or tank.bed is not None or bool(given)


def _physical_bed(scene: parts.LevelTankParts) -> Bed | None:
    bed = scene.tank.bed
    if bed is None:
        return None
    if bed.slope is not None:
        return SlopingBed(slope=bed.slope)
    return SurveyedBed(points=bed_points(scene))


def bed_points(scene: parts.LevelTankParts) -> tuple[tuple[float, float, float], ...]:
    """Return the points of a bed, from the scene or its file.

    Raises:
        ValueError: with the error in the file and its line.
    """
    bed = scene.tank.bed
    assert bed is not None
    if bed.points is not None:
        return bed.points
    assert bed.file is not None

    return tuple((x, y, z) for x, y, z in read_columns(scene.folder / bed.file, 3))


def shape_file(scene: parts.LevelTankParts) -> Path:
    """Return the file of a tank's shape."""
    assert scene.tank.shape is not None
    return (scene.folder / scene.tank.shape).resolve()


def physical_plan(scene: parts.LevelTankParts) -> Plan:
    """Return the plan of a tank.

    Raises:
        MeshError: if the file of its shape cannot be read.
    """
    tank = scene.tank
    if tank.shape is not None:
        from hydroelastic.meshes.volume_file import file_plan

        return file_plan(shape_file(scene), scene.depth)
    if tank.plan is not None:
        return PolygonPlan(points=tank.plan)
    if tank.radius is not None:
        return Cylinder(radius=tank.radius, inner_radius=tank.inner_radius or 0.0)
    assert tank.length is not None
    assert tank.width is not None
    return Box(length=tank.length, width=tank.width)


def physical_outline(scene: parts.LevelTankParts, plate: parts.PlanBody) -> Outline:
    """Return the outline of a plate in a tank."""
    plan = physical_plan(scene)
    if isinstance(plate, parts.Slats):
        assert isinstance(plan, Box)
        return Strip(start=plate.start, length=plate.length, width=plan.width)
    position = plate.position if plate.position is not None else middle_of(plan)
    if plate.outline == "rectangle":
        assert plate.size is not None
        return Rectangle(position=position, size=plate.size)
    if plate.outline == "strip":
        assert isinstance(plan, Box)
        assert plate.start is not None
        assert plate.length is not None
        return Strip(start=plate.start, length=plate.length, width=plan.width)
    if plate.outline == "polygon":
        assert plate.points is not None
        return Polygon(points=plate.points)
    assert plate.radius is not None
    return Disc(radius=plate.radius, position=position, inner_radius=plate.inner_radius or 0.0)
