"""Checks of floats where they rest, when that is known to be in the tank."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np
from pydantic_core import InitErrorDetails

from hydroelastic.physics.dofs import PLACES
from hydroelastic.physics.point_contours import closed_polyline, gap_between
from hydroelastic.scenes.models.body_kinds import AnyBody, AnyFloat
from hydroelastic.scenes.models.float_checks import SMALLEST_GAP, Box, extents
from hydroelastic.scenes.models.floats import held_float, placed_float
from hydroelastic.scenes.models.limits import is_at_least, shown_least, shown_most
from hydroelastic.scenes.models.problems import problem_at

if TYPE_CHECKING:
    from hydroelastic.physics.contours import Array
    from hydroelastic.scenes.models.tank_parts import TankParts

# Relative rounding of a number that is printed with six digits.
_PRINTED = 1e-5


def _bodies_keep_apart(scene: TankParts) -> Iterator[InitErrorDetails]:
    boxes = [_box(scene, index, body) for index, body in enumerate(scene.body)]
    for first, second in _neighbours(scene, boxes):
        gap = SMALLEST_GAP * max(max(extents(boxes[index])) for index in (first, second) if _is_float(scene, index))
        # A gap of exactly the smallest, as it is printed, is one.
        if _nearer_than(gap, boxes[first], boxes[second]) and _gap(scene, first, second) < gap * (1.0 - _PRINTED):
            left, right, _, _ = boxes[first]
            key = "position" if _is_float(scene, second) else "start"
            yield problem_at(
                ("body", second, *(() if scene.is_revolved else (key,))),
                None if scene.is_revolved else scene.body[second].start,
                f"the body overlaps or touches [[body]] number {first + 1}, which reaches from {left:g} to {right:g} m",
                remedy=f"Leave a gap of at least {shown_least(gap)} m between them",
            )


def _neighbours(scene: TankParts, boxes: list[Box]) -> list[tuple[int, int]]:
    """Pairs of bodies, at least one of them a float, that overlap in x or nearly so, by a sweep from left to right."""
    if not scene.floats:
        return []
    widest_gap = SMALLEST_GAP * max(max(extents(boxes[index])) for index, _ in scene.floats)
    pairs, beside = [], list[int]()
    for index in sorted(range(len(boxes)), key=lambda index: boxes[index][0]):
        beside = [other for other in beside if boxes[other][1] + widest_gap > boxes[index][0]]
        pairs += [
            (min(index, other), max(index, other))
            for other in beside
            if _is_float(scene, index) or _is_float(scene, other)
        ]
        beside.append(index)
    return sorted(pairs)


def _is_float(scene: TankParts, index: int) -> bool:
    return isinstance(scene.body[index], AnyFloat)


def _box(scene: TankParts, index: int, body: AnyBody) -> Box:
    if not isinstance(body, AnyFloat):
        height = scene.height_of(scene.level_of(body))
        return body.start, body.end, height, height

    return placed_float(scene, index).hull.bounds


def _gap(scene: TankParts, first: int, second: int) -> float:
    """Least distance of two bodies: one may reach below the other, as a heave plate does."""
    return gap_between(_polyline(scene, first), _polyline(scene, second))


def _polyline(scene: TankParts, index: int) -> Array:

    if _is_float(scene, index):
        return closed_polyline(placed_float(scene, index).hull.contour)
    left, right, height, _ = _box(scene, index, scene.body[index])
    return np.array([[left, height], [right, height]])


def _nearer_than(gap: float, one: Box, other: Box) -> bool:
    """Whether two boxes overlap or come nearer than a gap, in both directions."""
    beside = max(one[0], other[0]) - min(one[1], other[1])
    over = max(one[2], other[2]) - min(one[3], other[3])
    size = max(map(abs, (*one, *other)))
    return not (is_at_least(beside, gap, beside=size) or is_at_least(over, gap, beside=size))


def _floats_are_stable(scene: TankParts) -> Iterator[InitErrorDetails]:
    for index, body in scene.floats:
        placed = placed_float(scene, index)
        at_rest, stiffness = placed.hydrostatics, placed.roll_stiffness
        found = {"roll", "pitch"} & {*body.motions}
        if not found or body.unstable == "solve" or stiffness >= 0.0:
            continue
        # Height of the centre of mass at which the roll stiffness is zero.
        arm = stiffness / (at_rest.displaced_mass * scene.tank.gravity)
        keys = ("centre_of_mass", "vertical_centre_of_gravity")
        given = next((key for key in keys if getattr(body, key) is not None), None)
        above_water = given == keys[1] or keys[0] not in type(body).model_fields
        height = at_rest.centre_of_mass[1] - (at_rest.level if above_water else at_rest.reference_level)
        yield problem_at(
            ("body", index, given or "motions"),
            getattr(body, given) if given else ", ".join(body.motions),
            f"the float capsizes: its centre of mass lies {height:g} m above "
            f"{'the still level' if above_water else 'its reference level'}, and the metacentre {-arm:.3g} m lower",
            allowed=f"a {keys[above_water]} of at most {shown_most(height + arm)} m",
            remedy=f'Leave {found.pop()} out of the motions, or set unstable = "solve"',
        )


def _springs_let_floats_rest(scene: TankParts) -> Iterator[InitErrorDetails]:
    """A negative stiffness, as of a mechanism, must be less than that of gravity and of the other springs."""
    for index, body in scene.floats:
        held = held_float(scene, index, placed_float(scene, index))
        if held.springs and body.unstable != "solve":
            for motion in body.motions:
                stiffness = held.stiffness[PLACES[motion], PLACES[motion]]
                if stiffness < 0.0:
                    yield problem_at(
                        ("body", index, "motions"),
                        motion,
                        "its springs push the float away from its rest: with that of gravity the stiffness is "
                        f"{stiffness:.4g}",
                        remedy='Make the stiffness of [[attachment]] larger, or set unstable = "solve"',
                    )


def _thin_floats_have_free_liquid(scene: TankParts) -> Iterator[InitErrorDetails]:
    """The liquid of a thin float is split by the vertical through it, which must not meet another section."""
    thin = [(index, body.position) for index, body in scene.floats if body.boundary == "thin"]
    for other, section in scene.floats:
        if section.boundary == "thin" or not thin:
            continue
        # The import of SciPy is slow, and most scenes have no float.

        left, right = placed_float(scene, other).hull.bounds[:2]
        for index, position in thin:
            if left < position < right:
                yield problem_at(
                    ("body", index, "position"),
                    position,
                    f"the thin float lies straight above or below [[body]] number {other + 1}, which reaches from "
                    f"{left:g} to {right:g} m",
                    allowed=f"below {shown_most(left)} or above {shown_least(right)} m",
                    remedy='Move it, or set boundary = "exact"',
                )


CHECKS_OF_FLOATS_AT_REST = (
    _bodies_keep_apart,
    _thin_floats_have_free_liquid,
    _floats_are_stable,
    _springs_let_floats_rest,
)
