"""Conversion of a scene to a `physics.level_tank.LevelTank`, in SI units."""

from __future__ import annotations

from hydroelastic.physics.level_tank import Box, Cylinder, LevelTank, Plan, PolygonPlan
from hydroelastic.physics.plate import Disc, Outline, Plate, Point, Polygon, Rectangle, Strip
from hydroelastic.scenes.models import level_tank_parts as parts


def physical_level_tank(scene: parts.LevelTankParts) -> LevelTank:
    """Return the tank of a scene; SI units."""
    (liquid,) = scene.liquid
    return LevelTank(
        plan=physical_plan(scene.tank),
        depth=liquid.depth,
        density=liquid.density,
        gravity=scene.tank.gravity,
        top=scene.tank.top,
        plates=tuple(
            Plate(
                outline=physical_outline(scene.tank, plate),
                flexural_rigidity=plate.whole_rigidity,
                mass_per_area=plate.whole_mass,
                poisson_ratio=plate.poisson_ratio,
                hydrostatic=plate.hydrostatic,
                edge=plate.edge,
                slats=plate.kind == "beam",
            )
            for plate in scene.body
        ),
    )


def physical_plan(tank: parts.PlanTank) -> Plan:
    """Return the plan of a tank."""
    if tank.plan is not None:
        return PolygonPlan(points=tank.plan)
    if tank.radius is not None:
        return Cylinder(radius=tank.radius, inner_radius=tank.inner_radius or 0.0)
    assert tank.length is not None
    assert tank.width is not None
    return Box(length=tank.length, width=tank.width)


def middle_of(plan: Plan) -> Point:
    """Return the middle of a plan: of a box, the axis of a cylinder, of the box around a polygon."""
    if isinstance(plan, Box):
        return 0.5 * plan.length, 0.5 * plan.width
    if isinstance(plan, Cylinder):
        return 0.0, 0.0
    x, y = zip(*plan.points, strict=True)
    return 0.5 * (min(x) + max(x)), 0.5 * (min(y) + max(y))


def physical_outline(tank: parts.PlanTank, plate: parts.PlanBody) -> Outline:
    """Return the outline of a plate in a tank."""
    plan = physical_plan(tank)
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
