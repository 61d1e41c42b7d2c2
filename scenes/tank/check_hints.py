"""Hints on the results of a scene, of a sentence or two each."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import TypeAlias

from hydroelastic.fem.closed.discretization import expected_tone
from hydroelastic.modal.beam.beam_shapes import first_bending
from hydroelastic.physics.rigid_motions import mode_count, zero_mode_count, zero_stiffness_motions
from hydroelastic.physics.symmetry import is_mirror_image
from hydroelastic.scenes.models.physical import physical_tank
from hydroelastic.scenes.models.tank_parts import TankParts

# Half width over half height from which the thin-float condition has an error of more than some per cent.
_THICK = 0.1

# Draught of a beam over its length, or over the depth below it, from which its neglect matters.
_DEEP = 0.05


def hints(scene: TankParts) -> tuple[str, ...]:
    """Return hints on the results, of a sentence or two each."""
    return tuple(hint for find in (_HINTS_OF_OPEN_WATER if scene.is_open else _HINTS) for hint in find(scene))


def _air(scene: TankParts) -> Iterator[str]:
    if len(scene.layers) < len(scene.liquid):
        yield (
            "The upper layer has density 0: it is air, which is not modelled. The interface is an ordinary free "
            f'surface, and top = "{scene.tank.top}" has no effect.'
        )


def _symmetry(scene: TankParts) -> Iterator[str]:
    if is_mirror_image(physical_tank(scene).scaled()):
        yield (
            "The scene is its own mirror image: modes are symmetric (∂ψ/∂x = 0 in the middle) or antisymmetric "
            "(ψ = 0 there), and half the tank holds either kind."
        )


def _zero_modes(scene: TankParts) -> Iterator[str]:
    tank = physical_tank(scene)
    count = zero_mode_count(tank)
    if count == 0:
        return
    loose = zero_stiffness_motions(tank)
    names = ", ".join(f"{motion.name} of {scene.body[motion.body].kind} {motion.body + 1}" for motion in loose)
    held = len(loose) - count
    but = f"; conservation of volume excludes {held} of these or of their combinations" if held else ""
    modes = "one mode of frequency zero, which is" if count == 1 else f"{count} modes of frequency zero, which are"
    yield f"Without stiffness: {names}{but}. That leaves {modes} not reported."


def _few_modes(scene: TankParts) -> Iterator[str]:
    count = mode_count(physical_tank(scene))
    if count is not None and count < scene.accuracy.modes:
        yield (
            f"Only rigid bodies oscillate here: there {'is' if count == 1 else 'are'} {count} "
            f"{'mode' if count == 1 else 'modes'}, not {scene.accuracy.modes}."
        )


def _sloshing(scene: TankParts) -> Iterator[str]:
    if scene.body:
        return
    if len(scene.layers) == 1:
        yield "Pure sloshing has the exact solution ω² = g k tanh kH with k = nπ/L, to compare with."
    elif scene.top == "rigid":
        yield (
            "Waves of the interface alone have the exact solution ω² = (ρₗ − ρᵤ) g k/(ρᵤ coth khᵤ + ρₗ coth khₗ) with "
            "k = nπ/L, to compare with."
        )
    elif scene.top == "pressure_release":
        yield (
            "Waves of the interface alone have the exact solution ω² = (ρₗ − ρᵤ) g k/(ρᵤ tanh khᵤ + ρₗ coth khₗ) with "
            "k = nπ/L, to compare with."
        )
    else:
        yield (
            "For each k = nπ/L there are two exact solutions, a wave of the surface and a slower one of the interface: "
            "the roots of a quadratic equation for ω²."
        )


def _walls(scene: TankParts) -> Iterator[str]:
    for level in physical_tank(scene).levels_from_top:
        if not level.is_open:
            if level.above is None and scene.top != "free":
                yield f'The beam covers the whole liquid, so top = "{scene.top}" has no effect.'
            continue
        for piece, wall in ((level.pieces[0], "left"), (level.pieces[-1], "right")):
            if piece.body is not None:
                yield f"Beam {piece.body + 1} touches the {wall} wall: its end slides along it without friction."


def _shared_tone(scene: TankParts) -> Iterator[str]:
    """Yield hints on tones that couple with sloshing modes, unless they are slow or the beam is heavy (docs, aquarium,
    § 4)."""
    tank = physical_tank(scene)
    if len(tank.layers) > 1 or tank.top != "free" or not tank.levels[0].is_open:
        return
    # In units of the tank λ = ω² L/g.
    for index, beam in tank.beams.items():
        ratio = expected_tone(tank.scaled(), index) * beam.length / tank.length
        if ratio > 1 and beam.mass_per_length < tank.layers[0].density * beam.length:
            yield (
                f"Beam {index + 1}: ω² l/g of its first elastic tone is about {ratio:.2g}. Above one, the tone "
                "is shared between hybrid modes with sloshing; a run reports the extent (participation, runner-up)."
            )


def _hydrostatics(scene: TankParts) -> Iterator[str]:
    for index, beam in physical_tank(scene).beams.items():
        below, above = scene.densities_at(beam.level)
        ratio = (below - above) * scene.tank.gravity / first_bending(beam)
        jump = "(ρₗ − ρᵤ) g" if above else "ρ g"
        if beam.hydrostatic and ratio > 10:
            yield (
                f"Beam {index + 1} is soft: {jump} is {ratio:.3g} times the bending stiffness EI κ₁⁴ of its first "
                "elastic shape, so its lowest modes store little elastic energy."
            )
        elif not beam.hydrostatic and ratio > 0.1:
            yield (
                f"Beam {index + 1} is modelled without the hydrostatic restoring, {jump}, which is {ratio:.2g} times "
                "its bending stiffness EI κ₁⁴; hydrostatic = true gives higher frequencies."
            )


def draughts_left_out(scene: TankParts) -> Iterator[str]:
    """Yield hints on beams whose draught, mass over density, is not negligible; the model neglects it."""
    for index, beam in physical_tank(scene).beams.items():
        draught = beam.mass_per_length / scene.densities_at(beam.level)[0]
        depth = scene.layers[0 if beam.level == "interface" else -1].depth
        if draught > _DEEP * min(beam.length, depth):
            compared = "its length" if beam.length <= depth else "the depth below it"
            yield (
                f"Beam {index + 1} would float with a draught m/ρ of {draught:.3g} m, "
                f"{draught / min(beam.length, depth):.2g} of {compared}. It is modelled as a plate at the level, "
                "without draught: the model has errors of that order, independent of the tolerance."
            )


def _unstable(scene: TankParts) -> Iterator[str]:
    for index, body in physical_tank(scene).floats.items():
        if "roll" in body.motions and body.roll_stiffness < 0.0:
            yield f"Float {index + 1} is unstable: its roll grows instead of oscillating, a mode with ω² < 0."


def _thin(scene: TankParts) -> Iterator[str]:
    for index, body in scene.floats:
        if body.boundary == "thin" and body.half_width is not None and body.half_height is not None:
            ratio = body.half_width / body.half_height
            much = f", {ratio:.2g}, which is much" if ratio > _THICK else ""
            yield (
                f"Float {index + 1} is modelled as thin: its flux lies on x = {body.position:g} m, and the liquids "
                f"fill the whole tank. That leaves an error of the order of half width over half height{much}; "
                'boundary = "exact" has none.'
            )


_Hints: TypeAlias = Callable[[TankParts], Iterator[str]]
_HINTS: tuple[_Hints, ...] = (
    _air,
    _symmetry,
    _zero_modes,
    _few_modes,
    _sloshing,
    _walls,
    _shared_tone,
    _hydrostatics,
    draughts_left_out,
    _unstable,
    _thin,
)
_HINTS_OF_OPEN_WATER: tuple[_Hints, ...] = (_air, _hydrostatics, draughts_left_out, _unstable, _thin)
