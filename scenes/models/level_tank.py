"""The scene of a tank in three dimensions: its model with all checks."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from itertools import combinations
from math import hypot, isfinite
from typing import Any, TypeAlias

import numpy as np
from pydantic import ValidationError, model_validator
from pydantic_core import InitErrorDetails

from hydroelastic.physics.level_tank import Box, Cylinder, Plan, middle_of
from hydroelastic.physics.plate import Bounds, Disc, Polygon, bounds_of
from hydroelastic.physics.point_contours import polygon_contour
from hydroelastic.physics.tank import ROUND_OFF
from hydroelastic.scenes.models.float_checks import contour_is_simple, sides_are_long
from hydroelastic.scenes.models.level_tank_parts import SOLID_FORMATS, LevelTankParts
from hydroelastic.scenes.models.level_tank_physics import (
    bed_points,
    depth_of,
    physical_outline,
    physical_plan,
    shape_file,
)
from hydroelastic.scenes.models.limits import is_at_least, is_at_most, is_within, shown_least, shown_most, shown_range
from hydroelastic.scenes.models.problems import problem_at, require_fit
from hydroelastic.scenes.models.tank_checks import DEPTH_TO_LENGTH, MASS_GROUP, SHORTEST_BEAM, STIFFNESS_GROUP
from hydroelastic.scenes.models.tank_kinds import PLAN_KEYS
from hydroelastic.scenes.models.volume_checks import (
    LEAST_DEPTH,
    columns_lie_in_the_tank,
    floats_lie_in_the_tank,
    liquids_are_layered,
    outlines_touch,
    shaped_beds_are_simple,
    volumes_are_of_plates,
)

LEAST_INNER_RADIUS = 1e-3
"""Part of the outer radius: around a thinner column no fewer digits are lost than without it."""

_AGREED = 1e-2
"""Relative difference of the depths of a mesh and a scene that is accepted: a mesh may have no node at the deepest
point."""


class LevelTankScene(LevelTankParts):
    """A tank in three dimensions, with plates on its surface or none (sloshing).

    Raises:
        SceneError: if a value is not allowed or the parts do not fit together.
    """

    @model_validator(mode="before")
    @classmethod
    def _bodies_are_plates(cls, given: Any) -> Any:
        parts = given if isinstance(given, dict) else {}
        bodies, tank = parts.get("body", ()), parts.get("tank", {})
        keys = [key for key in PLAN_KEYS if isinstance(tank, dict) and key in tank]
        kinds = [
            (index, body.get("kind", "plate"))
            for index, body in enumerate(bodies if isinstance(bodies, list | tuple) else ())
            if isinstance(body, dict)
        ]
        if keys or not isinstance(tank, dict):
            problems = [
                problem_at(
                    ("body", index, "kind"),
                    kind,
                    "in three dimensions bodies are plates, beams or solids; others are of tanks per metre of width",
                    allowed='"plate", "beam" or "float"',
                    remedy=f"Leave out {' and '.join(keys)} of [tank] for a tank per metre of width" if keys else "",
                )
                for index, kind in kinds
                if kind not in ("plate", "beam", "float")
            ]
        else:
            problems = [
                problem_at(
                    ("body", index, "kind"),
                    kind,
                    "a plate is of a tank in three dimensions, and [tank] has no plan",
                    remedy='Did you mean "beam"? Otherwise give [tank] the width of a box, the radius of a cylinder, '
                    "or plan",
                )
                for index, kind in kinds
                if kind == "plate"
            ]
        if problems:
            raise ValidationError.from_exception_data(cls.__name__, problems)
        return given

    @model_validator(mode="after")
    def _parts_fit(self) -> LevelTankScene:
        require_fit(self, STAGES)
        return self


def _plan_is_complete(scene: LevelTankParts) -> Iterator[InitErrorDetails]:
    tank = scene.tank
    given = [key for key in ("length", *PLAN_KEYS) if getattr(tank, key) is not None]
    box, round_ = {"length", "width"}, {"radius", "inner_radius"}
    kinds = [bool(box & set(given)), bool(round_ & set(given)), "plan" in given, "shape" in given]
    allowed = "length and width of a box, radius (and inner_radius) of a cylinder, plan, or shape"
    if sum(kinds) != 1:
        said = " and ".join(given)
        wrong = f"{said} are of different plans" if given else "the plan of the tank is missing"
        yield problem_at(("tank", given[-1] if given else "width"), None, wrong, allowed=allowed)
        return
    for keys, needed in ((box, ("length", "width")), (round_, ("radius",))):
        for key in needed:
            if keys & set(given) and key not in given:
                yield problem_at(("tank", key), None, "it is missing", allowed=allowed)
    if tank.radius is not None and tank.inner_radius is not None:
        least, most = (part * tank.radius for part in (LEAST_INNER_RADIUS, 1.0 - LEAST_INNER_RADIUS))
        if not is_within(tank.inner_radius, least, most):
            yield problem_at(
                ("tank", "inner_radius"),
                tank.inner_radius,
                "it leaves no ring that can be resolved beside radius",
                allowed=f"{shown_range(least, most)} m",
            )


def _depths_are_given(scene: LevelTankParts) -> Iterator[InitErrorDetails]:
    if scene.tank.shape is not None and scene.tank.shape.suffix.lower() == ".msh":
        return
    for index, liquid in enumerate(scene.liquid):
        if liquid.depth is None:
            yield problem_at(("liquid", index, "depth"), None, "it is missing", allowed="the depth in m")


def _polygons_are_simple(scene: LevelTankParts) -> Iterator[InitErrorDetails]:
    given = [(("body", index, "points"), body.points) for index, body in enumerate(scene.body) if body.kind == "plate"]
    for location, points in ((("tank", "plan"), scene.tank.plan), *given):
        if points is not None:
            # It takes SciPy, whose import is slow.

            short = list(sides_are_long(location, points))
            yield from short or contour_is_simple(location, polygon_contour(points))


def _files_can_be_read(scene: LevelTankParts) -> Iterator[InitErrorDetails]:
    tank = scene.tank
    if tank.bed is not None and tank.shape is not None:
        yield problem_at(
            ("tank", "bed"), None, "the bed of a tank of a file is part of the file", remedy="Leave it out"
        )
    if tank.bed is not None and tank.bed.file is not None:
        try:
            points = bed_points(scene)
            if len(points) < 3:
                raise ValueError(f"it holds {len(points)} points; three are a bed at least")
        except (ValueError, OSError) as error:
            yield problem_at(("tank", "bed", "file"), str(tank.bed.file), str(error))
    if tank.shape is None:
        return
    allowed = (*SOLID_FORMATS, ".msh")
    if tank.shape.suffix.lower() not in allowed:
        yield problem_at(
            ("tank", "shape"), str(tank.shape), "it is not a known format", allowed=", ".join(f"*{s}" for s in allowed)
        )
    elif not shape_file(scene).is_file():
        yield problem_at(("tank", "shape"), str(tank.shape), f"there is no file {shape_file(scene)}")
    else:
        from hydroelastic.meshes.tagged_mesh import MeshError

        try:
            plan = physical_plan(scene)
        except MeshError as error:
            yield problem_at(("tank", "shape"), str(tank.shape), str(error))
            return
        depth = depth_of(plan, scene)
        if scene.depth and abs(scene.depth - depth) > _AGREED * depth:
            yield problem_at(
                ("liquid", 0, "depth"),
                scene.depth,
                f"the liquid in {tank.shape.name} is {depth:g} m deep, as its lengths are taken in metres",
                allowed=f"{depth:g}, or no depth",
                remedy="Correct it, or the unit of the mesh",
            )


def _bed_is_below_the_surface(scene: LevelTankParts) -> Iterator[InitErrorDetails]:
    bed = scene.tank.bed
    if bed is None:
        return
    depth, plan = scene.depth, physical_plan(scene)
    if bed.slope is not None:
        x, y = middle_of(plan)
        (low, high), (lower, upper) = _plan_bounds(plan)
        rise = abs(bed.slope[0]) * max(high - x, x - low) + abs(bed.slope[1]) * max(upper - y, y - lower)
    else:
        points = np.array(bed_points(scene))
        places, heights = points[:, :2], points[:, 2]
        wrong = "two of its points are in one place" if len(np.unique(places, axis=0)) < len(places) else ""
        if np.linalg.matrix_rank(places - places[0]) < 2:
            wrong = "its points lie on a line"
        if wrong:
            yield problem_at(("tank", "bed"), None, wrong, allowed="different places over all of the plan")
            return
        rise = float(np.ptp(heights))
    if not is_at_most(rise, depth * (1.0 - LEAST_DEPTH)):
        yield problem_at(
            ("tank", "bed"),
            None,
            f"it rises by {rise:g} m, and leaves less than {LEAST_DEPTH:g} of the depth of {depth:g} m",
            remedy="A beach is drawn as a solid of CAD, with key shape",
        )


def _outlines_fit_the_plan(scene: LevelTankParts) -> Iterator[InitErrorDetails]:
    for index, plate in enumerate(scene.plates):
        if plate.outline == "strip" and scene.tank.width is None:
            yield problem_at(
                ("body", index, plate.shape_key),
                getattr(plate, plate.shape_key),
                "a strip of plate or beams reaches from side to side of a box",
                allowed='"disc" or "ring" in a cylinder',
            )


def _edges_can_be_held(scene: LevelTankParts) -> Iterator[InitErrorDetails]:
    for index, plate in enumerate(scene.plates):
        straight = plate.outline == "polygon" or (plate.outline == "rectangle" and scene.tank.width is None)
        if plate.edge != "free" and straight:
            yield problem_at(
                ("body", index, "edge"),
                plate.edge,
                "walls hold edges of rectangles and strips in a box, of discs and rings about the axis of a cylinder",
                allowed='"free"',
            )


def _depth_fits_the_plan(scene: LevelTankParts) -> Iterator[InitErrorDetails]:
    plan = physical_plan(scene)
    unit, depth = plan.unit, depth_of(plan, scene)
    least, most = DEPTH_TO_LENGTH
    if not is_within(depth, least * unit, most * unit):
        yield problem_at(
            ("liquid", 0, "depth"),
            depth,
            f"it is {depth / unit:g} of the tank's extent, too {'thin' if depth < unit else 'deep'} to resolve",
            allowed=f"{shown_range(least * unit, most * unit)} m",
        )


def _plates_lie_in_the_tank(scene: LevelTankParts) -> Iterator[InitErrorDetails]:
    plan = physical_plan(scene)
    reach = 1.0 + ROUND_OFF
    for index, plate in enumerate(scene.plates):
        outline = physical_outline(scene, plate)
        if isinstance(plan, Box):
            bounds = bounds_of(outline)
            sides = (plan.length, plan.width)
            inside = all(
                low >= -ROUND_OFF * side and high <= side * reach
                for (low, high), side in zip(bounds, sides, strict=True)
            )
            said = f"{plan.length:g} m × {plan.width:g} m"
        elif isinstance(plan, Cylinder) and isinstance(outline, Disc):
            away = hypot(*outline.position)
            inside = away + outline.radius <= plan.radius * reach
            # An inner cylinder stands in the hole of a ring, or beside the plate.
            room = max(outline.inner_radius - away, away - outline.radius)
            inside = inside and (not plan.inner_radius or room >= plan.inner_radius * (1.0 - ROUND_OFF))
            said = f"radius {plan.radius:g} m" + (
                f" about a cylinder of {plan.inner_radius:g} m" * bool(plan.inner_radius)
            )
        else:
            continue
        if not inside:
            key = {"strip": "length", "rectangle": "size"}.get(plate.outline, "radius")
            yield problem_at(
                ("body", index, key), getattr(plate, key), f"the plate does not lie inside the tank of {said}"
            )


def _plates_keep_apart(scene: LevelTankParts) -> Iterator[InitErrorDetails]:
    unit = physical_plan(scene).unit
    outlines = [physical_outline(scene, plate) for plate in scene.plates]
    for (first, one), (second, other) in combinations(enumerate(outlines), 2):
        if outlines_touch(one, other, ROUND_OFF * unit):
            yield problem_at(
                ("body", second, scene.body[second].shape_key),
                getattr(scene.body[second], scene.body[second].shape_key),
                f"the plate overlaps or touches [[body]] number {first + 1}",
                remedy="Leave a gap between them",
            )


def _plan_bounds(plan: Plan) -> Bounds:
    if isinstance(plan, Box):
        return (0.0, plan.length), (0.0, plan.width)
    if isinstance(plan, Cylinder):
        return (-plan.radius, plan.radius), (-plan.radius, plan.radius)
    assert isinstance(plan, Polygon)
    return bounds_of(plan)


def _groups_are_in_range(scene: LevelTankParts) -> Iterator[InitErrorDetails]:
    density, gravity = scene.density, scene.tank.gravity
    unit = physical_plan(scene).unit
    for index, plate in enumerate(scene.plates):
        outline = physical_outline(scene, plate)
        (low, high), (lower, upper) = bounds_of(outline)
        extent = min(high - low, upper - lower)
        if isinstance(outline, Disc) and outline.inner_radius:
            extent = outline.radius - outline.inner_radius
        if not is_at_least(extent, SHORTEST_BEAM * unit):
            yield problem_at(
                ("body", index, plate.shape_key),
                getattr(plate, plate.shape_key),
                "the plate is too narrow beside the tank to resolve both",
                allowed=f"at least {shown_least(SHORTEST_BEAM * unit)} m",
            )
            continue
        stiffness = plate.whole_rigidity / (density * gravity * extent**4)
        if isfinite(stiffness) and not is_within(stiffness, *STIFFNESS_GROUP):
            key = "flexural_rigidity" if plate.flexural_rigidity is not None else "youngs_modulus"
            yield problem_at(
                ("body", index, key),
                getattr(plate, key),
                f"D/(ρ g l⁴) = {stiffness:g} is beyond the resolution of double precision",
                allowed=f"a group of {STIFFNESS_GROUP[0]:g} to {STIFFNESS_GROUP[1]:g}",
            )
        if not is_at_most(plate.whole_mass, MASS_GROUP[1] * density * extent):
            yield problem_at(
                ("body", index, plate.mass_key),
                plate.whole_mass,
                "the liquid is lost in the rounding of the plate",
                allowed=f"up to {shown_most(MASS_GROUP[1] * density * extent)}",
            )


def _something_moves(scene: LevelTankParts) -> Iterator[InitErrorDetails]:
    if not scene.body and scene.tank.top != "free" and len(scene.liquid) == 1:
        yield problem_at(
            ("tank", "top"), scene.tank.top, "nothing moves: there are no plates and no waves", allowed='"free"'
        )


_Check: TypeAlias = Callable[[LevelTankParts], Iterator[InitErrorDetails]]
STAGES: tuple[tuple[_Check, ...], ...] = (
    (_plan_is_complete, _depths_are_given, _polygons_are_simple, _something_moves, volumes_are_of_plates),
    (_files_can_be_read,),
    (_outlines_fit_the_plan, _edges_can_be_held, _depth_fits_the_plan, _bed_is_below_the_surface),
    (liquids_are_layered, columns_lie_in_the_tank, shaped_beds_are_simple),
    (_plates_lie_in_the_tank, floats_lie_in_the_tank),
    (_plates_keep_apart, _groups_are_in_range),
)
"""Each stage is made when those before found nothing, so that one wrong length is one message."""
