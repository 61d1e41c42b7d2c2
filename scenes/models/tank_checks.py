"""Checks of the consistency of a scene: liquids, lengths and bodies. Each check yields the errors it finds."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from itertools import accumulate, pairwise
from typing import TypeAlias, TypeVar

from pydantic_core import InitErrorDetails

from hydroelastic.physics.rigid_motions import mode_count
from hydroelastic.physics.tank import ROUND_OFF
from hydroelastic.scenes.models.body_kinds import AnyBeam
from hydroelastic.scenes.models.float_checks import floats_are_in_equilibrium
from hydroelastic.scenes.models.float_rest_checks import CHECKS_OF_FLOATS_AT_REST
from hydroelastic.scenes.models.limits import is_at_least, is_at_most, is_within, shown_least, shown_most, shown_range
from hydroelastic.scenes.models.open_checks import (
    bodies_are_all_sections_or_all_solids,
    closed_tanks_have_no_open_water_keys,
    decaying_bodies_are_floats,
    depths_can_be_meshed,
    frequencies_and_times_can_be_resolved,
    length_scale_of_bodies,
    open_water_beams_have_free_ends,
    open_water_is_complete,
    plan_views_are_of_waves_solved_for,
    resonance_regions_are_covered_by_theory,
)
from hydroelastic.scenes.models.physical import physical_tank
from hydroelastic.scenes.models.problems import problem_at
from hydroelastic.scenes.models.round_plates import SeaPlate
from hydroelastic.scenes.models.sea_checks import air_gaps_are_over_water, sea_points_lie_on_bodies
from hydroelastic.scenes.models.tank_parts import TankParts

Spanning = TypeVar("Spanning", bound=AnyBeam | SeaPlate)
"""A body with a start and an end along the surface."""

DEPTH_TO_LENGTH = (1e-4, 1e3)
"""Below it a layer is too thin for cells that follow it along the tank; above it no motion reaches
its end (it decays as e^{-πy/L}), and the depth only adds cells and rounding."""

LIGHTEST = 1e-6
"""ρᵤ/ρₗ of two liquids: below it the upper one is lost in the rounding of the lower one."""

SMALLEST_DIFFERENCE = 1e-9
"""(ρₗ − ρᵤ)/ρₗ of two liquids: decimal densities do not tell less apart."""

SHORTEST_BEAM = 1e-4
"""Part of the tank's length: with a shorter beam the lengths of one mesh lie too far apart."""

STIFFNESS_GROUP = (1e-15, 1e15)
"""EI/(Δρ g l⁴): beyond this, bending or gravity is lost in the rounding of the other."""

SOFTEST_JOINT = 1e-15
"""k/(Δρ g l³) of a joint: below this it is lost in the rounding of gravity."""

MASS_GROUP = (1e-12, 1e12)
"""m/(ρ l): beyond this, the beam or the liquid is lost in the rounding of the other."""


def _densities_are_in_order(scene: TankParts) -> Iterator[InitErrorDetails]:
    lower = scene.liquid[0].density
    if lower == 0.0:
        yield problem_at(
            ("liquid", 0, "density"),
            lower,
            "it must be a liquid; only the upper one of two may be air, with density 0",
            allowed="a positive number",
        )
    elif len(scene.layers) == 2:
        upper = scene.liquid[1].density
        if upper >= lower:
            yield problem_at(
                ("liquid", 1, "density"),
                upper,
                f"it floats on a liquid of {lower:g} kg/m³: with the lighter liquid below, the interface overturns at "
                "every wavelength",
                allowed=f"less than {lower:g}, or 0 for air",
                remedy="List the liquids from the bottom up",
            )
        elif not is_at_least(upper, LIGHTEST * lower):
            yield problem_at(
                ("liquid", 1, "density"),
                upper,
                f"ρᵤ/ρₗ = {upper / lower:g}: the upper liquid is lost in the rounding of the lower one",
                allowed=f"0, for air, or at least {shown_least(LIGHTEST * lower)} kg/m³ over this lower liquid",
            )
        elif not is_at_least(lower - upper, SMALLEST_DIFFERENCE * lower, beside=lower):
            yield problem_at(
                ("liquid", 1, "density"),
                upper,
                f"(ρₗ − ρᵤ)/ρₗ = {(lower - upper) / lower:.3g}: their difference is lost in rounding",
                allowed=f"{shown_least(SMALLEST_DIFFERENCE * lower)} kg/m³ less than the lower liquid, at least",
            )


def _bodies_have_their_level(scene: TankParts) -> Iterator[InitErrorDetails]:
    for index, body in enumerate(scene.body):
        if body.at == "interface" and len(scene.liquid) == 1:
            yield problem_at(
                ("body", index, "at"),
                body.at,
                "there is only one liquid, so there is no interface",
                allowed='"surface"',
                remedy="Leave it out, or add a second [[liquid]] above the first",
            )
        elif body.at == "surface" and len(scene.layers) < len(scene.liquid):
            yield problem_at(
                ("body", index, "at"),
                body.at,
                "above the lower liquid there is air, and nothing floats on top of it",
                allowed='"interface", the free surface of the lower liquid',
            )


def _meshes_are_those_of_beams(scene: TankParts) -> Iterator[InitErrorDetails]:
    if scene.mesh is None or scene.is_open or (len(scene.layers) == 1 and not scene.floats):
        return
    because = "two liquids" if len(scene.layers) == 2 else "a float"
    yield problem_at(
        ("mesh", "file"),
        str(scene.mesh.file),
        f"a user mesh is for one liquid with or without beams; this scene has {because}",
        remedy="Leave [mesh] out: the built-in mesh follows the interface and the floats",
    )


def _depths_fit_the_length(scene: TankParts) -> Iterator[InitErrorDetails]:
    if scene.is_open:
        yield from _depths_fit_the_bodies(scene)
        return
    length = scene.tank.length
    least, most = DEPTH_TO_LENGTH
    for index, layer in enumerate(scene.layers):
        depth = layer.depth
        if not is_within(depth, least * length, most * length):
            yield problem_at(
                ("liquid", index, "depth"),
                depth,
                f"it is {depth / length:g} of the tank's length, too {'thin' if depth < length else 'deep'} to mesh",
                allowed=f"{shown_range(least * length, most * length)} m ({least:g} to {most:g} tank lengths)",
            )


def _depths_fit_the_bodies(scene: TankParts) -> Iterator[InitErrorDetails]:
    """The absorbing layer is as deep as needed: open water may be deep."""
    length = length_scale_of_bodies(scene)
    least = DEPTH_TO_LENGTH[0] * length
    for index, layer in enumerate(scene.layers):
        if not is_at_least(layer.depth, least):
            yield problem_at(
                ("liquid", index, "depth"),
                layer.depth,
                "the layer is too thin to mesh beside the length that the bodies take up",
                allowed=f"at least {shown_least(least)} m",
            )
    # One float alone has no length here: its section tells.
    if length:
        yield from depths_can_be_meshed(scene, length)


def _beams_lie_in_the_tank(scene: TankParts) -> Iterator[InitErrorDetails]:
    if scene.kind == "sea":
        return
    length = scene.tank.length
    place = "stretch that is drawn" if scene.is_open else "tank"
    for index, beam in scene.beams:
        if not is_at_most(beam.length, length):
            key = beam.location_of(0, "length")[0]
            yield problem_at(
                ("body", index, key), beam.length, f"the beam is longer than the {place} ({shown_most(length)} m)"
            )
        elif not is_at_most(beam.end, length):
            yield problem_at(
                ("body", index, "start"),
                beam.start,
                f"the beam ends at {beam.end:g} m, outside the {place}, of {length:g} m",
                allowed=f"0 to {shown_most(length - beam.length)} m for this beam",
            )


def _beams_keep_apart(scene: TankParts) -> Iterator[InitErrorDetails]:
    for first, left, second, right in touching(scene, scene.beams):
        yield problem_at(
            ("body", second, "start"),
            right.start,
            f"the beam overlaps or touches [[body]] number {first + 1}, which ends at {left.end:g} m",
            remedy="Leave a gap between them",
        )


def touching(
    scene: TankParts, bodies: tuple[tuple[int, Spanning], ...]
) -> Iterator[tuple[int, Spanning, int, Spanning]]:
    """Yield neighbours at one level that overlap or touch, each with its number, that of smaller start first."""
    for level in ("interface", "surface"):
        there = [(index, body) for index, body in bodies if scene.level_of(body) == level]
        for (first, left), (second, right) in pairwise(sorted(there, key=lambda numbered: numbered[1].start)):
            if right.start - left.end <= ROUND_OFF * scene.tank.length:
                yield first, left, second, right


def _beams_are_not_too_short(scene: TankParts) -> Iterator[InitErrorDetails]:
    shortest = SHORTEST_BEAM * length_scale_of_bodies(scene)
    others = "the others" if scene.is_open else "the tank"
    for index, beam in scene.beams:
        if not is_at_least(beam.length, shortest):
            yield problem_at(
                ("body", index, "length"),
                beam.length,
                f"the beam is too short beside {others} for one mesh to resolve both",
                allowed=f"at least {shown_least(shortest)} m ({SHORTEST_BEAM:g} of {_span_name(scene)})",
            )


def _span_name(scene: TankParts) -> str:
    return "the length that the bodies take up" if scene.is_open else "the tank's length"


def _groups_are_in_range(scene: TankParts) -> Iterator[InitErrorDetails]:
    for index, beam in scene.beams:
        for number, part in enumerate(beam.parts):
            for key, formula, scale, (least, most) in _groups(scene, beam):
                value = getattr(part, key)
                if not is_within(value, least * scale, most * scale):
                    yield problem_at(
                        ("body", index, *beam.location_of(number, key)),
                        value,
                        f"{formula} = {value / scale:g} is beyond the resolution of double precision",
                        allowed=f"{shown_range(least * scale, most * scale)} for this beam and liquid",
                    )
        yield from _joints_are_in_range(scene, index, beam)


def _joints_are_in_range(scene: TankParts, index: int, beam: AnyBeam) -> Iterator[InitErrorDetails]:
    below, above = scene.densities_at(scene.level_of(beam))
    least = SOFTEST_JOINT * (below - above) * scene.tank.gravity * beam.length**3
    for number, joint in enumerate(beam.joints):
        if joint.rotational_stiffness > 0.0 and not is_at_least(joint.rotational_stiffness, least):
            yield problem_at(
                ("body", index, "joints", number, "rotational_stiffness"),
                joint.rotational_stiffness,
                "it is too small to differ from zero in double precision",
                allowed=f"0 for a hinge, or at least {shown_least(least)} for this beam and liquid",
            )


def _joints_lie_in_their_beams(scene: TankParts) -> Iterator[InitErrorDetails]:
    negligible, nearest = ROUND_OFF * scene.tank.length, SHORTEST_BEAM * length_scale_of_bodies(scene)
    span = f"{SHORTEST_BEAM:g} of {_span_name(scene)}"
    for index, beam in scene.beams:
        steps = list(accumulate(part.length for part in beam.parts[:-1]))
        for number, joint in enumerate(beam.joints):
            where = ("body", index, "joints", number, "at")
            others = [other.at for other in beam.joints[:number]]
            if not negligible < joint.at < beam.length - negligible:
                yield problem_at(
                    where,
                    joint.at,
                    f"a joint lies within its beam of {beam.length:g} m, and not at an end: both are free",
                    allowed=f"more than 0 and less than {beam.length:g} m from its left end",
                )
            elif any(abs(joint.at - other) <= negligible for other in others):
                yield problem_at(
                    where, joint.at, "there is another joint at this place", remedy="Leave one of them out"
                )
            elif any(
                abs(joint.at - other) > negligible
                and not is_at_least(abs(joint.at - other), nearest, beside=beam.length)
                for other in (0.0, beam.length, *steps, *others)
            ):
                yield problem_at(
                    where,
                    joint.at,
                    "it is too close to an end, to a step of the beam or to another joint for one mesh to resolve both",
                    allowed=f"at least {shown_least(nearest)} m between them ({span})",
                )


def _sections_are_not_too_short(scene: TankParts) -> Iterator[InitErrorDetails]:
    shortest = SHORTEST_BEAM * length_scale_of_bodies(scene)
    for index, beam in scene.beams:
        for number, part in enumerate(beam.sections):
            if not is_at_least(part.length, shortest):
                yield problem_at(
                    ("body", index, "sections", number, "length"),
                    part.length,
                    "the section is too short for one mesh to resolve it together with the rest",
                    allowed=f"at least {shown_least(shortest)} m ({SHORTEST_BEAM:g} of {_span_name(scene)})",
                )


def _groups(scene: TankParts, beam: AnyBeam) -> tuple[tuple[str, str, float, tuple[float, float]], ...]:
    below, above = scene.densities_at(scene.level_of(beam))
    jump = "(ρₗ − ρᵤ)" if above else "ρ"
    weight = (below - above) * scene.tank.gravity
    return (
        ("flexural_rigidity", f"EI/({jump} g l⁴)", weight * beam.length**4, STIFFNESS_GROUP),
        ("mass_per_length", "m/(ρ l)", below * beam.length, MASS_GROUP),
    )


def _guided_beams_cover_the_tank(scene: TankParts) -> Iterator[InitErrorDetails]:
    negligible = ROUND_OFF * scene.tank.length
    for index, beam in scene.beams:
        covers = beam.start <= negligible and beam.end >= scene.tank.length - negligible
        if beam.ends == "guided" and not beam.is_uniform:
            yield problem_at(
                ("body", index, "ends"),
                beam.ends,
                f"guided ends are for uniform beams; this one has {'sections' if beam.sections else 'joints'}",
                allowed='"free"',
            )
        elif beam.ends == "guided" and not covers and not scene.is_open:
            yield problem_at(
                ("body", index, "ends"),
                beam.ends,
                "ends are guided by the walls, but this beam does not reach from wall to wall",
                allowed=f'"free", or start = 0 and length = {scene.tank.length:.12g}',
            )


def _model_has_motions(scene: TankParts) -> Iterator[InitErrorDetails]:
    if scene.is_open or mode_count(physical_tank(scene)) != 0:
        return
    if not scene.body:
        yield problem_at(
            ("tank", "top"),
            scene.top,
            "without a body and without a free surface nothing oscillates",
            remedy='Set top = "free" for sloshing, or add a [[body]]',
        )
    else:
        yield problem_at(
            ("tank", "top"),
            scene.top,
            "nothing oscillates: the floats have no motion that has stiffness and that the volume of the liquid allows",
            allowed='"free", or further motions of the floats',
        )


_Check: TypeAlias = Callable[["TankParts"], Iterator[InitErrorDetails]]

STAGES: tuple[tuple[_Check, ...], ...] = (
    (
        _densities_are_in_order,
        _bodies_have_their_level,
        _meshes_are_those_of_beams,
        closed_tanks_have_no_open_water_keys,
    ),
    (
        open_water_is_complete,
        bodies_are_all_sections_or_all_solids,
        decaying_bodies_are_floats,
        frequencies_and_times_can_be_resolved,
        plan_views_are_of_waves_solved_for,
        resonance_regions_are_covered_by_theory,
        sea_points_lie_on_bodies,
    ),
    (
        _depths_fit_the_length,
        _beams_are_not_too_short,
        _beams_lie_in_the_tank,
        _beams_keep_apart,
        _guided_beams_cover_the_tank,
        open_water_beams_have_free_ends,
        _sections_are_not_too_short,
        _joints_lie_in_their_beams,
        floats_are_in_equilibrium,
    ),
    (_groups_are_in_range, *CHECKS_OF_FLOATS_AT_REST),
    (_model_has_motions, air_gaps_are_over_water),
)
"""Each stage is made when those before found nothing, so that one wrong length is one message."""
