"""Checks of the parts of a tank that is meshed in its volume: liquids, columns, baffles, floats."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import combinations
from math import hypot

import numpy as np
from pydantic_core import InitErrorDetails

from hydroelastic.meshes.plan_regions import outline_region
from hydroelastic.physics.level_tank import Box, Cylinder, Plan, middle_of
from hydroelastic.physics.plate import Bounds, Disc, Outline, Rectangle, Strip, bounds_of
from hydroelastic.physics.solid_floats import SolidFloat
from hydroelastic.scenes.models.level_tank_parts import LevelTankParts
from hydroelastic.scenes.models.level_tank_physics import needs_volume, physical_plan
from hydroelastic.scenes.models.limits import is_at_most, shown_most
from hydroelastic.scenes.models.problems import problem_at
from hydroelastic.scenes.models.volume_floats import UnfloatableError, VolumeFloat

LEAST_DEPTH = 0.05
"""Part of the depth that a bed leaves: cells over a shallower one would be flat."""

LEAST_FLOAT = 1e-5
"""Least draught and sides of a float in units of the tank's extent: planes closer than 1e-6 of it are one."""

# Part of the size of a float.
_TOUCHING = 1e-6
# Part of the largest stiffness.
_ROUNDING = 1e-12


def liquids_are_layered(scene: LevelTankParts) -> Iterator[InitErrorDetails]:
    """Two liquids have the lighter one above, and upright walls or those of a solid around both."""
    if len(scene.liquid) == 1:
        return
    lower, upper = scene.liquid
    if upper.density >= lower.density:
        yield problem_at(
            ("liquid", 1, "density"),
            upper.density,
            "the upper liquid is not lighter than the lower one",
            allowed=f"less than {lower.density:g} kg/m³",
            remedy="Liquids are given from the bottom up",
        )
    if scene.tank.shape is not None and scene.tank.shape.suffix.lower() == ".msh":
        yield problem_at(
            ("liquid",),
            None,
            "the cells of a mesh are of one liquid",
            remedy="Give the shape of the tank as a solid, *.step or *.brep",
        )


def columns_lie_in_the_tank(scene: LevelTankParts) -> Iterator[InitErrorDetails]:
    """Columns stand inside, without touching each other, and a mesh of a file has none."""
    plan = physical_plan(scene)
    middle = middle_of(plan)
    if scene.tank.shape is not None and scene.tank.shape.suffix.lower() == ".msh":
        for table in ("column", "baffle", "body"):
            if getattr(scene, table):
                wrong = "a mesh of a file is taken as it is, with nothing in it"
                remedy = "Give the shape of the tank as a solid, *.step or *.brep"
                yield problem_at((table, 0), None, wrong, remedy=remedy)
                return
    outlines = [column.outline(middle) for column in scene.column]
    for index, (column, outline) in enumerate(zip(scene.column, outlines, strict=True)):
        key = "size" if column.radius is None else "radius"
        if not _is_inside(plan, bounds_of(outline), isinstance(outline, Disc)):
            yield problem_at(("column", index, key), getattr(column, key), "the column does not lie inside the tank")
        for earlier in outlines[:index]:
            if outlines_touch(outline, earlier, 0.0):
                yield problem_at(("column", index, key), getattr(column, key), "the column touches another one")
                break


def shaped_beds_are_simple(scene: LevelTankParts) -> Iterator[InitErrorDetails]:
    """A bed through points moves the nodes of a level tank, which would stretch what is in the liquid."""
    bed = scene.tank.bed
    if bed is None or bed.slope is not None:
        return
    inside = {"the float": scene.floats, "the baffle": scene.baffle, "the interface": scene.liquid[1:]}
    for what, given in inside.items():
        if given:
            wrong = f"a bed through points would stretch {what} too"
            yield problem_at(("tank", "bed"), None, wrong, allowed="a slope, or a level bed")


def volumes_are_of_plates(scene: LevelTankParts) -> Iterator[InitErrorDetails]:
    """Beams side by side have no model in a volume."""
    for index, body in enumerate(scene.body):
        if needs_volume(scene) and body.kind == "beam":
            yield problem_at(
                ("body", index, "kind"),
                body.kind,
                "beams side by side need a tank with a level bed",
                remedy='Take a plate, kind = "plate" with outline = "strip", in its place',
            )


def floats_lie_in_the_tank(scene: LevelTankParts) -> Iterator[InitErrorDetails]:
    """Floats can be at rest as given, are stable, and touch nothing; in two liquids they are in the upper one."""
    plan, depth = physical_plan(scene), scene.liquid[-1].depth or scene.depth
    middle, first = middle_of(plan), len(scene.plates)
    if any(isinstance(body, VolumeFloat) for body in scene.body[:first]):
        remedy = "Move it to the end of the scene"
        place = next(index for index, body in enumerate(scene.body) if isinstance(body, VolumeFloat))
        yield problem_at(("body", place, "kind"), "float", "a float comes before a plate", remedy=remedy)
        return
    solids = []
    for index, body in enumerate(scene.floats, first):
        try:
            solids.append((index, body, body.solid(middle, scene.density, scene.folder)))
        except UnfloatableError as error:
            value = getattr(body, error.key)
            yield problem_at(("body", index, error.key), str(value) if error.key == "file" else value, str(error))
            return
    columns = [column.outline(middle) for column in scene.column]
    for index, body, solid in solids:
        if not is_at_most(solid.draught, depth * (1.0 - LEAST_DEPTH)):
            most = f"up to {shown_most(depth * (1.0 - LEAST_DEPTH))} m"
            below = "below" if len(scene.liquid) == 1 else "of the upper one below"
            yield problem_at(("body", index, "draught"), solid.draught, f"it leaves no liquid {below}", allowed=most)
        if min(solid.draught, *solid.size) < LEAST_FLOAT * plan.unit:
            key = "draught" if body.draught is not None else "mass" if body.mass is not None else body.shape_key
            value = getattr(body, key)
            wrong = (
                f"the float has a draught or a side of {min(solid.draught, *solid.size):.3g} m, too little to be meshed"
            )
            most = f"{LEAST_FLOAT * plan.unit:g} m at least"
            yield problem_at(("body", index, key), str(value) if key == "file" else value, wrong, allowed=most)
        if not _is_inside(plan, solid.bounds, solid.shape in ("cylinder", "sphere", "revolved")):
            key = body.shape_key
            value = getattr(body, key)
            value = str(value) if key == "file" else value
            yield problem_at(("body", index, key), value, "the float does not lie inside the tank")
        unstable = _unstable_motion(solid)
        if unstable:
            yield problem_at(
                ("body", index, "vertical_centre_of_gravity"),
                solid.centre_of_gravity,
                f"the float is unstable in {unstable}",
                remedy="Lower its centre of gravity",
            )
        if any(_touch(solid, column) for column in columns):
            yield problem_at(("body", index, body.shape_key), None, "the float touches a column")
    for (earlier, _, one), (index, body, other) in combinations(solids, 2):
        if _touch(one, other):
            wrong = f"the float overlaps or touches [[body]] number {earlier + 1}"
            yield problem_at(("body", index, body.shape_key), None, wrong, remedy="Leave a gap between them")


def _unstable_motion(solid: SolidFloat) -> str:
    """The motion with the largest part of a displacement that lowers the energy; "" of a stable float."""
    # Turns are counted by the displacement of the rim.
    reach = 0.5 * max(solid.size)
    units = np.array([1.0 / reach if motion in ("roll", "pitch", "yaw") else 1.0 for motion in solid.motions])
    values, vectors = np.linalg.eigh(solid.stiffness() * np.outer(units, units))
    if values[0] >= -_ROUNDING * abs(values).max():
        return ""
    return solid.motions[int(np.argmax(np.abs(vectors[:, 0])))]


def outlines_touch(one: Outline, other: Outline, negligible: float) -> bool:
    """Whether two outlines overlap, or are closer than something negligible."""
    if isinstance(one, Disc) and isinstance(other, Disc):
        away = hypot(one.position[0] - other.position[0], one.position[1] - other.position[1])
        smaller, larger = sorted((one, other), key=lambda disc: disc.radius)
        apart = max(away - smaller.radius - larger.radius, larger.inner_radius - away - smaller.radius)
        return apart <= negligible
    if any(
        low > upper + negligible or lower > high + negligible
        for (low, high), (lower, upper) in zip(bounds_of(one), bounds_of(other), strict=True)
    ):
        return False
    if isinstance(one, Rectangle | Strip) and isinstance(other, Rectangle | Strip):
        return True
    first, second = (outline_region(outline, "") for outline in (one, other))
    return first.gap(second) <= negligible or first.contains(second) or second.contains(first)


def _touch(one: SolidFloat, other: SolidFloat | Rectangle | Disc) -> bool:
    """Whether the wetted part of a float touches another solid: one may reach below the other, or stand inside it."""
    if not _meet(one.bounds, other.bounds if isinstance(other, SolidFloat) else bounds_of(other)):
        return False
    # gmsh is slow to import, and few scenes have bodies so close.
    from hydroelastic.meshes.volume_solids import gap_of_solids

    return gap_of_solids(one, other) <= _TOUCHING * max(one.size)


def _meet(one: Bounds, other: Bounds) -> bool:
    return all(low <= upper and lower <= high for (low, high), (lower, upper) in zip(one, other, strict=True))


def _is_inside(plan: Plan, bounds: Bounds, is_round: bool) -> bool:
    (left, right), (front, back) = bounds
    if isinstance(plan, Box):
        return left > 0.0 and right < plan.length and front > 0.0 and back < plan.width
    if isinstance(plan, Cylinder):
        reach = 0.5 * (right - left if is_round else hypot(right - left, back - front))
        away = hypot(0.5 * (left + right), 0.5 * (front + back))
        return (not plan.inner_radius or plan.inner_radius < away - reach) and away + reach < plan.radius
    # Of other plans gmsh tells.
    return True
