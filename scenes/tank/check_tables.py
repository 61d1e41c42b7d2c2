"""The model of a scene in tables: boundaries, unknown fields, dimensionless groups, floats at rest."""

from __future__ import annotations

from collections.abc import Iterator
from math import isinf

from hydroelastic.output.open_water.bodies import bodies_at_rest_section
from hydroelastic.output.sections import Row, Section
from hydroelastic.physics.rigid_motions import heave_is_excluded
from hydroelastic.physics.tank import Piece, StillLevel
from hydroelastic.scenes.models.body_kinds import AnyFloat
from hydroelastic.scenes.models.physical import physical_tank
from hydroelastic.scenes.models.round_plates import SeaPlate
from hydroelastic.scenes.models.tank_parts import TankParts
from hydroelastic.scenes.tank.beam_words import BeamWords
from hydroelastic.scenes.tank.body_words import BodyWords
from hydroelastic.scenes.tank.float_words import FloatWords
from hydroelastic.scenes.tank.plate_words import PlateWords
from hydroelastic.scenes.tank.symbols import Group, potential_of

SURFACE_NAMES = {
    "free": "free surface",
    "rigid": "rigid lid",
    "pressure_release": "pressure release",
    "interface": "interface",
}


def boundary_table(scene: TankParts) -> Section:
    """Return the boundaries of the liquids, from the top down and from left to right, with their conditions."""
    several = len(scene.layers) == 2
    title = "Boundaries of the liquids (levels" if several else "Boundary of the liquid (top"
    on_levels = [
        (
            _surface_name(scene, level, piece),
            f"{piece.start:g}",
            f"{piece.end:g}",
            _open_condition(scene, level) if piece.body is None else _words_of(scene, piece.body).condition(),
        )
        for level in physical_tank(scene).levels_from_top
        for piece in level.pieces
    ]
    return Section(
        title=f"{title} from left to right)",
        headings=("surface", "from, m", "to, m", "condition"),
        rows=[*on_levels, *(_open_ends(scene) if scene.is_open else _walls(scene))],
    )


def _walls(scene: TankParts) -> Iterator[tuple[str, str, str, str]]:
    length = f"{scene.tank.length:g}"
    slopes = " = ".join(f"∂{potential_of(scene, layer)}/∂x" for layer in reversed(range(len(scene.layers))))
    yield "walls", "0", length, f"{slopes} = 0"
    yield f"bottom, y = {-scene.liquid[0].depth:g} m", "0", length, f"∂{potential_of(scene, 0)}/∂y = 0"


def _open_ends(scene: TankParts) -> Iterator[tuple[str, str, str, str]]:
    start = "0" if scene.is_revolved else "-inf"
    yield "open ends", start, "inf", "outgoing waves only"
    potential = potential_of(scene, 0)
    if isinf(scene.liquid[0].depth):
        yield "deep below", start, "inf", f"∇{potential} → 0 as y → −∞"
    else:
        yield f"bottom, y = {-scene.liquid[0].depth:g} m", start, "inf", f"∂{potential}/∂y = 0"
    if len(scene.layers) == 2 and isinf(scene.layers[1].depth):
        yield "high above", start, "inf", f"∇{potential_of(scene, 1)} → 0 as y → ∞"


def _surface_name(scene: TankParts, level: StillLevel, piece: Piece) -> str:
    if piece.body is not None:
        return f"{scene.body[piece.body].kind.replace('_', ' ')} {piece.body + 1}"
    name = SURFACE_NAMES[level.kind]
    return f"{name}, y = {level.height:g} m" if len(scene.layers) == 2 else name


def _open_condition(scene: TankParts, level: StillLevel) -> str:
    if level.kind == "interface":
        return "∂ψᵤ/∂y = ∂ψₗ/∂y = η, (ρₗ − ρᵤ) g η = ω² (ρₗ ψₗ − ρᵤ ψᵤ)"
    potential, elevation = potential_of(scene, len(scene.layers) - 1), _surface_elevation(scene)
    return {
        "free": f"∂{potential}/∂y = {elevation}, g {elevation} = ω² {potential}",
        "rigid": f"∂{potential}/∂y = 0",
        "pressure_release": f"{potential} = 0",
    }[level.kind]


def _surface_elevation(scene: TankParts) -> str:
    return "η" if len(scene.layers) == 1 else "ηᵤ"


def unknown_table(scene: TankParts) -> Section:
    """Return the unknown fields, with their domain and the reason for them."""
    return Section(title="Unknown fields", headings=("field", "where", "why"), rows=tuple(_unknowns(scene)))


def _unknowns(scene: TankParts) -> Iterator[Row]:
    why = "displacement potential, ∇ψ is the displacement: Laplace's equation, pressure ω² ρ ψ"
    if len(scene.layers) == 1:
        yield "ψ", "liquid", why
    else:
        yield "ψᵤ", f"upper liquid, 0 < y < {scene.layers[1].depth:g} m", why
        yield "ψₗ", f"lower liquid, {-scene.layers[0].depth:g} m < y < 0", "the same"
    tank = physical_tank(scene)
    for level in tank.levels_from_top:
        yield _elevation_row(scene, level)
    for index in range(len(scene.body)):
        words = _words_of(scene, index)
        name = f"{words.name} {index + 1}"
        yield f"{words.symbol} of {name}", name, words.basis(is_held=heave_is_excluded(tank, index))


def _elevation_row(scene: TankParts, level: StillLevel) -> tuple[str, str, str]:
    if not level.is_open:
        return "η: none", "–", "the beam covers the whole liquid"
    spans = "" if scene.is_open else "; with the bodies it spans the eigenproblem"
    if level.above is not None:
        return "η", "interface", f"internal waves{spans}"
    name, potential = _surface_elevation(scene), potential_of(scene, len(scene.layers) - 1)
    reasons = {
        "free": (
            name,
            "free surface",
            f"gravity waves, {name} = ω² {potential}/g{spans}",
        ),
        "rigid": (f"{name}: none", "rigid lid", "a lid: no gravity waves"),
        "pressure_release": (
            f"{name}: none",
            "pressure release",
            "ψ = 0: no gravity waves",
        ),
    }
    return reasons[scene.top]


def group_table(scene: TankParts) -> Section:
    """Return the dimensionless groups that determine the scene."""
    return Section(
        title="Dimensionless groups",
        headings=("group", "value", "meaning"),
        rows=[(group, f"{value:.4g}", meaning) for group, value, meaning in _groups(scene)],
    )


def _groups(scene: TankParts) -> Iterator[Group]:
    length = scene.tank.length
    if len(scene.layers) == 2:
        lower, upper = scene.layers
        yield "ρᵤ/ρₗ", upper.density / lower.density, "density of the upper liquid over that of the lower"
        if not isinf(lower.depth) and not isinf(upper.depth):
            yield "hᵤ/hₗ", upper.depth / lower.depth, "depth of the upper liquid over that of the lower"
    # Results of open water do not depend on the length of its pictures.
    if not scene.is_open:
        name = "H/L" if len(scene.layers) == 1 else "hₗ/L"
        what = "depth" if len(scene.layers) == 1 else "depth of the lower liquid"
        yield name, scene.layers[0].depth / length, f"{what} over length of the tank"
    for index in range(len(scene.body)):
        yield from _words_of(scene, index).groups()


def hydrostatics_table(scene: TankParts) -> Section:
    """Return hydrostatics and stiffness of each float, or of each solid of revolution; no rows without floats."""
    if scene.is_revolved:
        return bodies_at_rest_section(physical_tank(scene))
    columns = {index: found for index in range(len(scene.body)) if (found := _words_of(scene, index).at_rest())}
    quantities = next(iter(columns.values()), {})
    return Section(
        title="Floats at rest, per metre of width",
        headings=("quantity", *(f"float {index + 1}" for index in columns)),
        rows=[(quantity, *(column[quantity] for column in columns.values())) for quantity in quantities],
    )


def _words_of(scene: TankParts, index: int) -> BodyWords:
    body = scene.body[index]
    if isinstance(body, AnyFloat):
        return FloatWords(scene=scene, index=index, body=body)
    if isinstance(body, SeaPlate):
        return PlateWords(scene=scene, index=index, plate=body)
    return BeamWords(scene=scene, index=index, beam=body)
