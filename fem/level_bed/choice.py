"""The smallest model of a tank: orders on a line, a plan of triangles, or its volume."""

from __future__ import annotations

from dataclasses import replace
from typing import Literal, TypeAlias

from hydroelastic.fem.level_bed.separation import separated
from hydroelastic.meshes.plan_regions import plan_regions
from hydroelastic.physics.level_tank import Box, LevelTank
from hydroelastic.physics.plate import Polygon, Rectangle, Strip
from hydroelastic.physics.volume_tank import VolumeTank


class NotTreatedError(ValueError):
    """No solver takes such a tank."""


LevelModel: TypeAlias = Literal["orders", "plan", "volume"]

MODEL_WORDS: dict[LevelModel, str] = {
    "orders": "upright tank with a level bed whose orders separate: one problem on a line for each, exact in depth",
    "plan": "upright tank with a level bed: triangles on the plan, the depth by its poles",
    "volume": "volume: tetrahedra in all of the liquid",
}
"""What each model is, as summaries tell it."""

# A plate this close to a wall touches it, in units of the tank.
_TOUCHING = 1e-9


def level_model(physical: LevelTank) -> LevelModel:
    """Return the smallest model of a tank."""
    if isinstance(physical, VolumeTank):
        return "volume"
    tank = physical.scaled()
    if separated(tank) is not None:
        return "orders"
    _require_plan(tank)
    return "plan"


def _require_plan(tank: LevelTank) -> None:
    """Refuse a dimensionless tank that cannot be solved on its plan."""
    if any(plate.slats for plate in tank.plates):
        raise NotTreatedError("beams side by side go with other such covers and strips of plate only")
    if isinstance(tank.plan, Box) and all(isinstance(plate.outline, Rectangle | Strip) for plate in tank.plates):
        return
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
            raise NotTreatedError(f"plate {index + 1} touches a wall or crosses it, and covers only a part of the plan")
        if not wall.contains(region) or any(region.contains(replace(wall, outside=hole)) for hole in wall.inside):
            raise NotTreatedError(f"plate {index + 1} does not lie inside the plan")
        for other, earlier in enumerate(regions[:index]):
            if region.gap(earlier) < _TOUCHING:
                raise NotTreatedError(f"plates {other + 1} and {index + 1} touch each other")


def models_of(physical: LevelTank) -> tuple[LevelModel, ...]:
    """Return all models that take a tank, the smallest one first."""
    smallest = level_model(physical)
    if smallest == "orders":
        try:
            _require_plan(physical.scaled())
        except NotTreatedError:
            return (smallest,)
        return "orders", "plan"
    return (smallest,)
