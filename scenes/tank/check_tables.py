"""What a scene will be modelled as, in tables: boundaries, unknown fields, dimensionless groups, floats at rest."""

from __future__ import annotations

from collections.abc import Iterator
from math import isinf

from hydroelastic.physics.rigid_motions import heave_is_held
from hydroelastic.physics.tank import Piece, StillLevel
from hydroelastic.scenes.models.bodies import Float, Level
from hydroelastic.scenes.models.body_kinds import AnyBeam
from hydroelastic.scenes.models.floats import placed_float
from hydroelastic.scenes.models.physical import physical_tank
from hydroelastic.scenes.models.tank import TankScene
from hydroelastic.scenes.output.sections import Row, Section

SURFACE_NAMES = {
    "free": "free surface",
    "rigid": "rigid lid",
    "pressure_release": "pressure release",
    "interface": "interface",
}
BEAM_ENDS = {"free": "w″ = w‴ = 0 at its ends", "guided": "w′ = w‴ = 0 at its ends"}


def potential_of(scene: TankScene, layer: int) -> str:
    """Return the name of the potential in a layer: as the liquids, 1 is above and 2 below."""
    return "ψ" if len(scene.layers) == 1 else ("ψ₂", "ψ₁")[layer]


def jump_of(scene: TankScene, level: Level) -> str:
    """Return the name of the difference of density that restores a level."""
    if len(scene.layers) == 1:
        return "ρ"
    return "(ρ₂ − ρ₁)" if level == "interface" else "ρ₁"


def boundary_table(scene: TankScene) -> Section:
    """Return what bounds the liquids, from the top down and from left to right, with the condition there."""
    several = len(scene.layers) == 2
    title = "Boundaries of the liquids (levels" if several else "Boundary of the liquid (top"
    on_levels = [
        (
            _surface_name(scene, level, piece),
            f"{piece.start:g}",
            f"{piece.end:g}",
            _surface_condition(scene, level, piece),
        )
        for level in physical_tank(scene).levels_from_top
        for piece in level.pieces
    ]
    return Section(
        title=f"{title} from left to right)",
        headings=("surface", "from, m", "to, m", "condition"),
        rows=[*on_levels, *(_open_ends(scene) if scene.is_open else _walls(scene))],
    )


def _walls(scene: TankScene) -> Iterator[tuple[str, str, str, str]]:
    length = f"{scene.tank.length:g}"
    slopes = " = ".join(f"∂{potential_of(scene, layer)}/∂x" for layer in reversed(range(len(scene.layers))))
    yield "walls", "0", length, f"{slopes} = 0"
    yield f"bottom, y = {-scene.liquid[0].depth:g} m", "0", length, f"∂{potential_of(scene, 0)}/∂y = 0"


def _open_ends(scene: TankScene) -> Iterator[tuple[str, str, str, str]]:
    yield "open ends", "-inf", "inf", "waves leave, none comes back"
    potential = potential_of(scene, 0)
    if isinf(scene.liquid[0].depth):
        yield "deep below", "-inf", "inf", f"∇{potential} → 0 as y → −∞"
    else:
        yield f"bottom, y = {-scene.liquid[0].depth:g} m", "-inf", "inf", f"∂{potential}/∂y = 0"
    if len(scene.layers) == 2 and isinf(scene.layers[1].depth):
        yield "high above", "-inf", "inf", f"∇{potential_of(scene, 1)} → 0 as y → ∞"


def _surface_name(scene: TankScene, level: StillLevel, piece: Piece) -> str:
    if piece.body is not None:
        return f"{scene.body[piece.body].kind.replace('_', ' ')} {piece.body + 1}"
    name = SURFACE_NAMES[level.kind]
    return f"{name}, y = {level.height:g} m" if len(scene.layers) == 2 else name


def _surface_condition(scene: TankScene, level: StillLevel, piece: Piece) -> str:
    if piece.body is None:
        return _open_condition(scene, level)
    body = scene.body[piece.body]
    if not isinstance(body, Float):
        return _beam_condition(scene, level.name, body)
    return _float_condition(scene, level.name, body)


def _open_condition(scene: TankScene, level: StillLevel) -> str:
    if level.kind == "interface":
        return "∂ψ₁/∂y = ∂ψ₂/∂y = η, (ρ₂ − ρ₁) g η = ω² (ρ₂ ψ₂ − ρ₁ ψ₁)"
    potential, elevation = potential_of(scene, len(scene.layers) - 1), _surface_elevation(scene)
    return {
        "free": f"∂{potential}/∂y = {elevation}, g {elevation} = ω² {potential}",
        "rigid": f"∂{potential}/∂y = 0",
        "pressure_release": f"{potential} = 0",
    }[level.kind]


def _surface_elevation(scene: TankScene) -> str:
    return "η" if len(scene.layers) == 1 else "η₁"


def _beam_condition(scene: TankScene, level: Level, beam: AnyBeam) -> str:
    jump = jump_of(scene, level)
    restoring = f" + {jump} g w" if beam.hydrostatic else ""
    if level == "interface":
        slopes, pressure = "∂ψ₁/∂y = ∂ψ₂/∂y", "(ρ₂ ψ₂ − ρ₁ ψ₁)"
    else:
        potential = potential_of(scene, len(scene.layers) - 1)
        slopes, pressure = f"∂{potential}/∂y", f"{jump} {potential}"
    bending = "EI w⁗" if not beam.sections else "(EI w″)″"
    joints = "".join(f"; {what}" for what in _joint_conditions(beam))
    return f"{slopes} = w, {bending}{restoring} − ω² m w = ω² {pressure}; {BEAM_ENDS[beam.ends]}{joints}"


def _joint_conditions(beam: AnyBeam) -> Iterator[str]:
    """What holds at the hinges and at the other joints of a beam."""
    if beam.hinges:
        yield "w″ = 0 at its hinges"
    if len(beam.hinges) < len(beam.joints):
        yield "k Δw′ = EI w″ at its joints"


def _float_condition(scene: TankScene, level: Level, body: Float) -> str:
    layers = (1, 0) if level == "interface" else (len(scene.layers) - 1,)
    normal, across = (
        " = ".join(f"∂{potential_of(scene, layer)}/∂{direction}" for layer in layers) for direction in ("n", "x")
    )
    if body.boundary == "thin":
        what = (
            "∓ω′(y) s on the right and left"
            if body.motions == ("heave",)
            else "what the contour displaces, on both sides"
        )
        return f"{across} = {what} of x = {body.position:g} m; s: {', '.join(body.motions)}"
    part = "" if level == "interface" else " below the level"
    return f"{normal} = n · s on its contour{part}; s: {', '.join(body.motions)}"


def unknown_table(scene: TankScene) -> Section:
    """Return the fields that are solved for, where they live and why they are there."""
    return Section(title="Unknown fields", headings=("field", "where", "why"), rows=tuple(_unknowns(scene)))


def _unknowns(scene: TankScene) -> Iterator[Row]:
    why = "displacement potential, ∇ψ is the displacement: Laplace's equation, pressure ω² ρ ψ"
    if len(scene.layers) == 1:
        yield "ψ", "liquid", why
    else:
        yield "ψ₁", f"upper liquid, 0 < y < {scene.layers[1].depth:g} m", why
        yield "ψ₂", f"lower liquid, {-scene.layers[0].depth:g} m < y < 0", "the same"
    tank = physical_tank(scene)
    for level in tank.levels_from_top:
        yield _elevation_row(scene, level)
    for index, body in enumerate(scene.body):
        is_held = heave_is_held(tank, index)
        if isinstance(body, Float):
            yield f"s of float {index + 1}", f"float {index + 1}", _float_basis(body, is_held=is_held)
        else:
            yield f"a of beam {index + 1}", f"beam {index + 1}", _beam_basis(body, is_held=is_held)


def _elevation_row(scene: TankScene, level: StillLevel) -> tuple[str, str, str]:
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
        "rigid": (f"{name}: none", "rigid lid", "the lid holds the liquid, so no gravity waves"),
        "pressure_release": (
            f"{name}: none",
            "pressure release",
            "the liquid moves freely without weight: no gravity waves",
        ),
    }
    return reasons[scene.top]


def _beam_basis(beam: AnyBeam, *, is_held: bool) -> str:
    if beam.ends == "guided":
        return "w = Σ aᵢ φᵢ: elastic shapes cos(nπx/L), n ≥ 1; heave is held by the liquid's volume"
    hinges = ", a turn about each hinge" if beam.hinges else ""
    if is_held:
        return f"w = Σ aᵢ φᵢ: pitch{hinges} and elastic shapes free in vacuum; heave is held by the liquid's volume"
    return f"w = Σ aᵢ φᵢ: heave, pitch{hinges} and elastic shapes free in vacuum"


def _float_basis(body: Float, *, is_held: bool) -> str:
    motions = ", ".join("roll about its centre of mass" if motion == "roll" else motion for motion in body.motions)
    held = "; heave is held by the liquid's volume" if "heave" in body.motions and is_held else ""
    return f"rigid motions: {motions}{held}"


def group_table(scene: TankScene) -> Section:
    """Return the dimensionless groups that tell one scene from another."""
    return Section(
        title="Dimensionless groups",
        headings=("group", "value", "meaning"),
        rows=[(group, f"{value:.4g}", meaning) for group, value, meaning in _groups(scene)],
    )


def _groups(scene: TankScene) -> Iterator[tuple[str, float, str]]:
    length = scene.tank.length
    if len(scene.layers) == 2:
        lower, upper = scene.layers
        yield "ρ₁/ρ₂", upper.density / lower.density, "density of the upper liquid over that of the lower"
        if not isinf(lower.depth) and not isinf(upper.depth):
            yield "h₁/h₂", upper.depth / lower.depth, "depth of the upper liquid over that of the lower"
    # Nothing in open water depends on the length that is drawn.
    if not scene.is_open:
        name = "H/L" if len(scene.layers) == 1 else "h₂/L"
        what = "depth" if len(scene.layers) == 1 else "depth of the lower liquid"
        yield name, scene.layers[0].depth / length, f"{what} over length of the tank"
    for index, body in enumerate(scene.body):
        yield from (
            _beam_groups(scene, index, body) if not isinstance(body, Float) else _float_groups(scene, index, body)
        )


def _beam_groups(scene: TankScene, index: int, beam: AnyBeam) -> Iterator[tuple[str, float, str]]:
    level = scene.level_of(beam)
    below, above = scene.densities_at(level)
    weight = (below - above) * scene.tank.gravity
    of_beam = f"beam {index + 1}: "
    density = "ρ₁" if len(scene.layers) == 2 and level == "surface" else "ρ" if len(scene.layers) == 1 else "ρ₂"
    for number, part in enumerate(beam.parts, 1):
        of_part = f"{of_beam}section {number}, " if beam.sections else of_beam
        stiffness = part.flexural_rigidity / (weight * beam.length**4)
        yield f"EI/({jump_of(scene, level)} g l⁴)", stiffness, of_part + "bending over gravity"
        yield (
            f"m/({density} l)",
            part.mass_per_length / (below * beam.length),
            of_part + f"its mass over that of {density} l²",
        )
        if beam.sections:
            yield "lᵢ/l", part.length / beam.length, of_part + "part of the beam"
    for number, joint in enumerate(beam.joints, 1):
        of_joint = f"{of_beam}joint {number}, "
        yield "x/l", joint.at / beam.length, of_joint + "place"
        stiffness = joint.rotational_stiffness / (weight * beam.length**3)
        yield f"k/({jump_of(scene, level)} g l³)", stiffness, of_joint + "its stiffness over gravity"
    if scene.is_open:
        yield from _depth_group(scene, "l", beam.length, of_beam + "depth of the lowest liquid over its length")
        return
    yield "l/L", beam.length / scene.tank.length, of_beam + "part of the tank that it covers"
    yield "x₁/L", beam.start / scene.tank.length, of_beam + "left end"


def _float_groups(scene: TankScene, index: int, body: Float) -> Iterator[tuple[str, float, str]]:
    placed = placed_float(scene, index)
    left, right, low, high = placed.hull.bounds
    below, _ = scene.densities_at(scene.level_of(body))
    of_float = f"float {index + 1}: "
    if body.half_width is not None and body.half_height is not None:
        yield "b/h", body.half_width / body.half_height, of_float + "half width over half height"
    else:
        yield "b/h", (right - left) / (high - low), of_float + "width over height"
    breadth = placed.hydrostatics.waterplane[1] - placed.hydrostatics.waterplane[0]
    if scene.is_open:
        yield from _depth_group(scene, "B", breadth, of_float + "depth of the lowest liquid over its waterplane")
    else:
        yield "B/L", breadth / scene.tank.length, of_float + "part of the tank that its waterplane covers"
    area = sum(placed.hydrostatics.areas)
    density = jump_of(scene, "surface") if scene.level_of(body) == "surface" else "ρ₂"
    yield (
        f"m/({density} A)",
        placed.hydrostatics.mass / (below * area),
        of_float + "its mean density over that below it",
    )
    if not scene.is_open:
        yield "x₀/L", body.position / scene.tank.length, of_float + "position"


def _depth_group(scene: TankScene, name: str, length: float, meaning: str) -> Iterator[tuple[str, float, str]]:
    depth = scene.layers[0].depth
    if not isinf(depth):
        yield ("H/" if len(scene.layers) == 1 else "h₂/") + name, depth / length, meaning


def hydrostatics_table(scene: TankScene) -> Section:
    """Return how each float rests, and what restores it."""
    columns = [_rest(scene, index, body) for index, body in scene.floats]
    return Section(
        title="Floats at rest, per metre of width",
        headings=("quantity", *(f"float {index + 1}" for index, _ in scene.floats)),
        rows=[(quantity, *(column[quantity] for column in columns)) for quantity in columns[0]],
    )


def _rest(scene: TankScene, index: int, body: Float) -> dict[str, str]:
    placed = placed_float(scene, index)
    rest = placed.hydrostatics
    _, _, low, high = placed.hull.bounds
    left, right = rest.waterplane
    displaced = [
        density * area for density, area in zip(scene.densities_at(scene.level_of(body)), rest.areas, strict=True)
    ]
    return {
        "mass, kg/m": f"{rest.mass:.6g}",
        "displaced below + above, kg/m": f"{displaced[0]:.6g} + {displaced[1]:.6g}",
        "reference level above the still level, m": f"{rest.reference_level - rest.level:.6g}",
        "draught, height above the level, m": f"{rest.level - low:.6g}, {high - rest.level:.6g}",
        "waterplane, m": f"{left:.6g} to {right:.6g}",
        "centre of mass x, y, m": f"{rest.centre_of_mass[0]:.6g}, {rest.centre_of_mass[1]:.6g}",
        "radius of gyration, m": f"{rest.radius_of_gyration:.6g}",
        "c33 heave, N/m²": f"{rest.heave_stiffness:.6g}",
        "c35 heave and roll, N/m": f"{rest.coupling_stiffness:.6g}",
        "c55 roll, N": f"{rest.roll_stiffness:.6g}",
        "at rest": _stability(body, placed.roll_stiffness),
    }


def _stability(body: Float, stiffness: float) -> str:
    if stiffness > 0.0:
        return "stable"
    found = "neutral" if stiffness == 0.0 else "unstable"
    return f"{found} in roll" if "roll" in body.motions else f"stable; {found} if it could roll"
