"""Walls and outlines of plates of a tank as loops on its plan, and the planes of symmetry of all of them."""

from __future__ import annotations

import numpy as np

from hydroelastic.meshes.geometry import FREE_SURFACE
from hydroelastic.meshes.plan_loops import UNGRADED, CircleLoop, Loop, Mirrors, PlanRegion, PolygonLoop
from hydroelastic.physics.dofs import body_name
from hydroelastic.physics.level_tank import Box, Cylinder, LevelTank, PolygonPlan
from hydroelastic.physics.plate import Disc, Outline


def plan_regions(tank: LevelTank) -> tuple[PlanRegion, tuple[PlanRegion, ...]]:
    """Return the inside of the walls, and the outline of each plate."""
    wall = _wall(tank)
    return wall, tuple(_region(tank, index, wall) for index in range(len(tank.plates)))


def _wall(tank: LevelTank) -> PlanRegion:
    plan = tank.plan
    if isinstance(plan, Cylinder):
        outer: Loop = CircleLoop(centre=np.zeros(2), radius=plan.radius)
        inner = (CircleLoop(centre=np.zeros(2), radius=plan.inner_radius),) if plan.inner_radius else ()
        return PlanRegion(name=FREE_SURFACE, outside=outer, inside=inner)
    if isinstance(plan, Box):
        corners = np.array([[0.0, 0.0], [plan.length, 0.0], [plan.length, plan.width], [0.0, plan.width]])
    else:
        assert isinstance(plan, PolygonPlan)
        corners = np.asarray(plan.corners, dtype=np.float64)
    return PlanRegion(name=FREE_SURFACE, outside=PolygonLoop(corners=corners))


def _region(tank: LevelTank, index: int, wall: PlanRegion) -> PlanRegion:
    """The outline of a plate; that of the wall itself where it covers the plan."""
    outline, name = tank.plates[index].outline, body_name(index + 1)
    if outline.area > tank.plan.area * (1.0 - 1e-9):
        return PlanRegion(name=name, outside=wall.outside, inside=wall.inside)
    return outline_region(outline, name)


def outline_region(outline: Outline, name: str) -> PlanRegion:
    """Return what an outline covers."""
    if isinstance(outline, Disc):
        centre = np.array(outline.position)
        hole = (CircleLoop(centre=centre, radius=outline.inner_radius),) if outline.inner_radius else ()
        return PlanRegion(name=name, outside=CircleLoop(centre=centre, radius=outline.radius), inside=hole)
    return PlanRegion(name=name, outside=PolygonLoop(corners=np.asarray(outline.corners, dtype=np.float64)))


def mirrors_of(wall: PlanRegion, plates: tuple[PlanRegion, ...]) -> Mirrors:
    """Return x and y of the planes about which the walls and each plate are symmetric, ``None`` where there is none."""
    outline = wall.outside.parallel(0.0, wall.outside.places(np.inf, UNGRADED, UNGRADED))
    middles = 0.5 * (outline.min(axis=0) + outline.max(axis=0))
    loops = [loop for region in (wall, *plates) for loop in region.loops]
    along, across = (
        float(middle) if all(loop.is_symmetric(axis, float(middle)) for loop in loops) else None
        for axis, middle in enumerate(middles)
    )
    return along, across
