"""Checks of each float of a scene, alone in the tank: section, size, equilibrium, place."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, TypeAlias

from pydantic_core import InitErrorDetails

from hydroelastic.physics.contours import Contour
from hydroelastic.physics.point_contours import self_crossing, shortest_side
from hydroelastic.scenes.models.bodies import SUBSTITUTES, THIN_SHAPES
from hydroelastic.scenes.models.body_kinds import AnyFloat
from hydroelastic.scenes.models.floats import float_contour, level_at_rest, placed_float
from hydroelastic.scenes.models.limits import is_at_least, is_at_most, is_within, shown_least, shown_most, shown_range
from hydroelastic.scenes.models.open_checks import depths_can_be_meshed, length_scale_of_bodies
from hydroelastic.scenes.models.problems import problem_at

# Contours need NumPy and SciPy, whose import is slow: they are imported by the functions that are called for floats.
if TYPE_CHECKING:
    from hydroelastic.physics.floats import RigidFloat
    from hydroelastic.physics.revolution import SolidOfRevolution
    from hydroelastic.scenes.models.tank_parts import TankParts

SLENDERNESS = {"exact": (1e-3, 1e3), "thin": (1e-9, 1e3)}
"""Width over height of a section: one mesh follows both, but for thin floats, whose width is not meshed."""

SMALLEST_FLOAT = 1e-4
"""Part of the tank's length: with a smaller float, by width and height, the lengths of one mesh lie too far apart."""

SHORTEST_SIDE = 1e-5
"""Part of the section's size: the mesh is graded towards both ends of each side."""

SMALLEST_GAP = 1e-3
"""Part of the section's size that stays between it and what is around it: elements in a gap are as wide as it."""

SMALLEST_PART = 1e-6
"""Part of the section's height on either side of the still level: with less a float hardly floats."""

LONGEST_ARM = 1e3
"""Sizes of the section: a centre of mass or a radius of gyration beyond it leaves nothing of the section's own."""

AGREEMENT = 1e-3
"""Relative difference up to which two keys for the same quantity agree: what is given twice is rounded."""

Box: TypeAlias = tuple[float, float, float, float]


def floats_are_in_equilibrium(scene: TankParts) -> Iterator[InitErrorDetails]:
    """Yield the first problem of each float, alone in the tank: its section, its equilibrium, its place."""
    for index, body in scene.floats:
        found = next(_problems_of(scene, index, body), None)
        if found is not None:
            yield found


def _problems_of(scene: TankParts, index: int, body: AnyFloat) -> Iterator[InitErrorDetails]:
    if body.vertices is not None:
        yield from sides_are_long(("body", index, body.shape_key), body.vertices)
    shape = ("body", index, body.shape_key)
    try:
        contour = float_contour(body, scene.folder)
    except ValueError as error:
        yield problem_at(
            shape,
            str(body.file),
            str(error),
            allowed="a text file with two columns, x and y in metres, of points all around the section; "
            "close enough to be joined smoothly, and three in a line for a straight side",
        )
        return
    if shape[-1] in ("vertices", "file", "outline"):
        yield from contour_is_simple(shape, contour if isinstance(contour, Contour) else contour.contour)
    yield from _sizes_fit(scene, index, body, contour)
    densities = scene.densities_at(scene.level_of(body))
    try:
        level = level_at_rest(body, contour, densities, scene.tank.gravity)
    except ValueError:
        yield _floats_elsewhere(scene, index, body, contour)
        return
    force = body.vertical_force or 0.0
    if body.mass is None and force < 0.0:
        displaced = _displaced(contour, level, densities)
        if displaced * scene.tank.gravity + force <= 0.0:
            yield problem_at(
                ("body", index, "vertical_force"),
                force,
                "it pulls down with more than the weight of the liquid that the float displaces, which leaves no mass",
                allowed=f"more than {-displaced * scene.tank.gravity:.6g} {_unit_of_force(scene)}",
            )
            return
    yield from _parts_on_both_sides(index, body, contour, level)
    try:
        placed = placed_float(scene, index)
    except ValueError as error:
        yield problem_at(
            ("body", index, next((key for key in ("mass", "draught") if getattr(body, key)), body.shape_key)),
            body.mass or body.draught,
            f"{error}; that level is y = {level:g} m in the float's frame",
            allowed="a section that the still level cuts once, into one part below and one above",
        )
        return
    yield from _keys_agree(index, body, placed, _closing_force(scene, body, contour, densities))
    yield from _has_room(scene, index, body, placed.hull.bounds)
    yield from _arms_fit(index, body, placed.hull.bounds)


def sides_are_long(
    location: tuple[str | int, ...], vertices: tuple[tuple[float, float], ...]
) -> Iterator[InitErrorDetails]:
    """Yield a side of a polygon that is too short to be resolved, or of no length."""
    length, size, number = shortest_side(vertices)
    if length == 0.0 or not is_at_least(length, SHORTEST_SIDE * size):
        yield problem_at(
            location,
            None,
            f"the side that begins with vertex {number + 1} is {length:g} m long, too short beside the whole",
            allowed=f"at least {shown_least(SHORTEST_SIDE * size)} m; the first vertex is not repeated at the end",
        )


def contour_is_simple(location: tuple[str | int, ...], contour: Contour) -> Iterator[InitErrorDetails]:
    """Yield a place where a contour meets itself."""
    crossing = self_crossing(contour)
    if crossing is not None:
        x, y = crossing
        yield problem_at(
            location,
            None,
            f"the contour crosses, touches or folds back on itself near ({x:g}, {y:g})",
            allowed="points in their order around it, in either sense",
        )


def _sizes_fit(
    scene: TankParts, index: int, body: AnyFloat, contour: Contour | SolidOfRevolution
) -> Iterator[InitErrorDetails]:
    width, height = extents(contour.bounds)
    least, most = SLENDERNESS[body.boundary]
    if not is_within(width / height, least, most):
        yield problem_at(
            ("body", index, body.shape_key),
            body.half_width,
            f"the section is {width:g} m wide and {height:g} m high, too "
            f"{'slender' if width < height else 'flat'} for one mesh to resolve both",
            allowed=f"a width of {least:g} to {most:g} heights",
            remedy=_other_models(body) if width < height else "A beam is flat",
        )
    smallest = SMALLEST_FLOAT * length_scale_of_bodies(scene)
    beside, of_what = (
        ("the other bodies", "the length they take up") if scene.is_open else ("the tank", "the tank's length")
    )
    if not is_at_least(max(width, height), smallest):
        yield problem_at(
            ("body", index, body.shape_key),
            body.half_width,
            f"the float is too small beside {beside} for one mesh to resolve both",
            allowed=f"a width or height of at least {shown_least(smallest)} m ({SMALLEST_FLOAT:g} of {of_what})",
        )
    if scene.is_open:
        yield from depths_can_be_meshed(scene, max(width, height))


def _other_models(body: AnyFloat) -> str:
    return 'boundary = "thin" takes it' if body.boundary == "exact" and body.shape in THIN_SHAPES else ""


def _displaced(contour: Contour | SolidOfRevolution, level: float, densities: tuple[float, float]) -> float:
    """Mass of the liquids that a float displaces, kg/m, or kg of a solid."""
    immersed = contour.moments(level).area
    return densities[0] * immersed + densities[1] * (contour.moments().area - immersed)


def _unit_of_force(scene: TankParts) -> str:
    return "N" if scene.is_revolved else "N/m"


def _closing_force(
    scene: TankParts, body: AnyFloat, contour: Contour | SolidOfRevolution, densities: tuple[float, float]
) -> str:
    """The force of moorings that brings a mass to a draught, or nothing where one of both is not given."""
    if body.mass is None or body.draught is None:
        return ""
    displaced = _displaced(contour, contour.bounds[2] + body.draught, densities)
    force = (body.mass - displaced) * scene.tank.gravity
    return f", or set vertical_force = {force:.6g} {_unit_of_force(scene)}, that of moorings which hold it so"


def _floats_elsewhere(
    scene: TankParts, index: int, body: AnyFloat, contour: Contour | SolidOfRevolution
) -> InitErrorDetails:
    below, above = densities = scene.densities_at(scene.level_of(body))
    area, held = contour.moments().area, (body.vertical_force or 0.0) / scene.tank.gravity
    size, unit = (f"volume of {area:g} m³", "kg") if scene.is_revolved else (f"section of {area:g} m²", "kg/m")
    heavy = (body.mass or 0.0) - held >= below * area
    moored = f" and vertical_force = {body.vertical_force:g} {_unit_of_force(scene)}" if body.vertical_force else ""
    return problem_at(
        ("body", index, "mass"),
        body.mass,
        f"with a {size}{moored} it {'sinks' if heavy else 'rises to the top of the upper liquid'}",
        allowed=f"between {shown_least(above * area + held)} and {shown_most(below * area + held)} {unit} (Archimedes)",
        remedy="Leave it out for the mass that floats with the reference level at the still level"
        + _closing_force(scene, body, contour, densities),
    )


def _parts_on_both_sides(
    index: int, body: AnyFloat, contour: Contour | SolidOfRevolution, level: float
) -> Iterator[InitErrorDetails]:
    _, _, low, high = contour.bounds
    least = SMALLEST_PART * (high - low)
    if body.mass is None and body.draught is not None and not is_at_most(level, high - least, beside=high - low):
        yield problem_at(
            ("body", index, "draught"),
            body.draught,
            f"the section is {high - low:g} m high",
            allowed=f"up to {shown_most(high - low - least)} m",
        )
    elif body.mass is not None and not is_within(level, low + least, high - least, beside=max(abs(low), abs(high))):
        yield problem_at(
            ("body", index, "mass"),
            body.mass,
            f"only {min(level - low, high - level):.3g} m of its height of {high - low:g} m lie "
            f"{'below' if level < low + least else 'above'} the still level",
            allowed=f"a mass that leaves {shown_least(least)} m on either side",
        )


def _keys_agree(index: int, body: AnyFloat, placed: RigidFloat, closing: str) -> Iterator[InitErrorDetails]:
    """Yield values at rest that contradict those in whose place they may stand.

    `closing` tells the force that brings mass and draught together.
    """
    rest, (_, _, low, high) = placed.hydrostatics, placed.hull.bounds
    found = {
        "draught": (rest.level - low, high - low),
        "vertical_centre_of_gravity": (rest.centre_of_mass[1] - rest.level, high - low),
        "inertia": (rest.inertia[2], rest.inertia[2]),
    }
    for key, (value, scale) in found.items():
        given = getattr(body, key)
        if given is not None and abs(given - value) > AGREEMENT * scale:
            yield problem_at(
                ("body", index, key),
                given,
                f"it contradicts {SUBSTITUTES[key]}, with which it is {value:.6g}",
                remedy=f"Leave out {key} or {SUBSTITUTES[key]}" + (closing if key == "draught" else ""),
            )


def _has_room(scene: TankParts, index: int, body: AnyFloat, bounds: Box) -> Iterator[InitErrorDetails]:
    left, right, low, high = bounds
    gap = SMALLEST_GAP * max(extents(bounds))
    length = scene.tank.length
    if scene.is_open:
        yield from _lies_in_the_stretch(scene, index, body)
    elif scene.is_revolved:
        if not is_at_most(right, length - gap, beside=length):
            yield problem_at(
                ("body", index, body.shape_key),
                body.half_width,
                f"the float has a radius of {right:g} m, and the tank one of {length:g} m",
                allowed=f"{shown_least(gap)} m of liquid beside it",
            )
    elif not is_at_most(right - left, length - 2 * gap, beside=length):
        yield problem_at(
            ("body", index, body.shape_key),
            body.half_width,
            f"the float is {right - left:g} m wide, and the tank {length:g} m long",
            allowed=f"{shown_least(gap)} m of liquid on either side",
        )
    elif not (is_at_least(left, gap, beside=length) and is_at_most(right, length - gap, beside=length)):
        yield problem_at(
            ("body", index, "position"),
            body.position,
            f"the float reaches from {left:g} to {right:g} m, and touches or leaves a wall of the tank",
            allowed=f"{shown_range(body.position - left + gap, length - gap - right + body.position)} m for this float",
        )
    floor, ceiling = _limits(scene, body)
    key = next((key for key in ("draught", "half_height") if getattr(body, key) is not None), None)
    location, value = ("body", index, key or body.shape_key), key and getattr(body, key)
    if not is_at_least(low, floor + gap, beside=floor):
        yield problem_at(
            location,
            value,
            f"the float reaches down to y = {low:g} m, and the liquid below it ends at y = {floor:g} m",
            allowed=f"a draught that leaves {shown_least(gap)} m",
            remedy="Make the liquid deeper, the float less high or its mass smaller",
        )
    elif ceiling is not None and not is_at_most(high, ceiling - gap, beside=ceiling):
        yield problem_at(
            location,
            value,
            f"the float reaches up to y = {high:g} m, and the layer above its level ends at y = {ceiling:g} m",
            allowed=f"a height that leaves {shown_least(gap)} m",
            remedy="Make that layer deeper, the float less high or its mass greater",
        )


def _lies_in_the_stretch(scene: TankParts, index: int, body: AnyFloat) -> Iterator[InitErrorDetails]:
    if scene.kind == "tank" and body.position > scene.tank.length:
        yield problem_at(
            ("body", index, "position"),
            body.position,
            f"the float lies outside the stretch that is drawn, of {scene.tank.length:g} m",
            allowed=f"0 to {shown_most(scene.tank.length)} m",
        )


def _limits(scene: TankParts, body: AnyFloat) -> tuple[float, float | None]:
    """Ordinates between which a float must stay, m: the layers on either side of its level, air included."""
    if len(scene.layers) == 2 and scene.level_of(body) == "surface":
        return 0.0, None
    return -scene.liquid[0].depth, scene.liquid[1].depth if len(scene.liquid) == 2 else None


def _arms_fit(index: int, body: AnyFloat, bounds: Box) -> Iterator[InitErrorDetails]:
    longest = LONGEST_ARM * max(extents(bounds))
    for key, least in (("centre_of_mass", 0.0), ("radius_of_gyration", longest * 1e-9)):
        value = getattr(body, key)
        if value is not None and not is_within(abs(value), least, longest):
            yield problem_at(
                ("body", index, key),
                value,
                "it is beyond what double precision can tell from zero or from the section's own size",
                allowed=f"{shown_range(least or -longest, longest)} m for this section",
            )


def extents(bounds: Box) -> tuple[float, float]:
    """Return width and height of a box."""
    left, right, low, high = bounds
    return right - left, high - low
