"""The older theories' estimates of a scene, and the tone they lead one to expect."""

from __future__ import annotations

from math import pi

from hydroelastic.modal.beam.estimates import all_estimates, estimates_of_jointed_beams
from hydroelastic.modal.beam.floating_beam import FloatingBeam
from hydroelastic.modal.estimate import Estimate
from hydroelastic.modal.liquid.sloshing import guided_cover_frequencies, sloshing_frequencies
from hydroelastic.modal.liquid.two_layer import InterfacePlate, TwoLayers, tank_modes
from hydroelastic.scenes.models.tank import TankScene, top_segments
from hydroelastic.scenes.tank.beam_shapes import first_bending
from hydroelastic.scenes.tank.scaled_tank import ScaledTank

# Added mass per ρ l of dry mode 1 and of heave, and between them, on deep open water with ψ = 0 beside the beam.
_DEEP_ELASTIC = 0.12787
_DEEP_HEAVE = 0.39270
_DEEP_COUPLING = 0.114
# Added mass of a float's heave in ρ times the square of its waterplane's width: that of any half-immersed ellipse.
_FLOAT_HEAVE = pi / 8.0

FAR_ENOUGH = 1.5
"""Modes up to this many times the λ that a float's motion has far above the waves hold its mode."""


def floating_beam(scene: TankScene, body: int = 0) -> FloatingBeam:
    """One beam of a scene, alone in its tank, as the estimates take it."""
    beam = dict(scene.beams)[body]
    # Ends within rounding of a wall lie on it, here as in the field model.
    start, end = next((piece.start, piece.end) for piece in top_segments(scene) if piece.body == body)
    return FloatingBeam(
        tank_length=scene.tank.length,
        depth=scene.liquid[0].depth,
        density=scene.liquid[0].density,
        gravity=scene.tank.gravity,
        start=start,
        length=end - start,
        flexural_rigidity=beam.flexural_rigidity,
        mass_per_length=beam.mass_per_length,
        hydrostatic=beam.hydrostatic,
    )


def scene_estimates(scene: TankScene) -> dict[str, Estimate]:
    """Every estimate of a scene's first elastic tone, for a scene with one beam with free ends beside free water.

    Returns:
        Estimates by name; none where the theories, which know one beam in a tank with an open top, do not apply.
    """
    plain = len(scene.layers) == 1 and not scene.floats
    if not plain or len(scene.body) != 1 or scene.top != "free" or scene.beams[0][1].ends != "free":
        return {}
    if not scene.beams[0][1].is_uniform:
        return estimates_of_jointed_beams()
    return all_estimates(floating_beam(scene))


def exact_frequencies(scene: TankScene) -> tuple[str, tuple[float, ...]]:
    """The formula and the frequencies of scenes with a closed form: sloshing, and a guided beam from wall to wall.

    Returns:
        What the formula is and ω in rad/s, ascending, as many as modes are asked for; an empty tuple elsewhere.
    """
    count = scene.accuracy.modes
    if scene.floats:
        return "", ()
    if len(scene.layers) == 2:
        return _exact_of_two_layers(scene)
    if not scene.body and scene.top == "free":
        frequencies = sloshing_frequencies(scene.tank.length, scene.liquid[0].depth, scene.tank.gravity, count)
        return "ω² = g k tanh kH, k = nπ/L", tuple(map(float, frequencies))
    if len(scene.beams) == 1 and scene.beams[0][1].ends == "guided":
        frequencies = guided_cover_frequencies(floating_beam(scene), count)
        return "ω² = (EI k⁴ + s ρ g)/(m + ρ/(k tanh kH)), k = nπ/L", tuple(map(float, frequencies))
    return "", ()


def two_layers(scene: TankScene) -> TwoLayers:
    """The liquids of a scene as the theories take them; without an upper one its density is 0."""
    lower, upper = scene.layers[0], scene.layers[-1]
    return TwoLayers(
        density_below=lower.density,
        density_above=upper.density if len(scene.layers) == 2 else 0.0,
        depth_below=lower.depth,
        depth_above=upper.depth,
        gravity=scene.tank.gravity,
        top=scene.top,
    )


def _exact_of_two_layers(scene: TankScene) -> tuple[str, tuple[float, ...]]:
    """Waves of two layers, without a body or under a guided plate that covers the interface."""
    plates = [beam for _, beam in scene.beams if beam.ends == "guided" and scene.level_of(beam) == "interface"]
    if len(scene.body) != len(plates):
        return "", ()
    plate = None
    if plates:
        plate = InterfacePlate(
            flexural_rigidity=plates[0].flexural_rigidity,
            mass_per_length=plates[0].mass_per_length,
            hydrostatic=plates[0].hydrostatic,
        )
    modes = tank_modes(two_layers(scene), scene.tank.length, scene.accuracy.modes, plate)
    return "waves of two layers, k = nπ/L", tuple(mode.omega for mode in modes)


def expected_tones(tank: ScaledTank) -> tuple[float, ...]:
    """About the (dimensionless) λ of the first elastic tone of each beam.

    Dry mode 1 with the recoil in heave, on deep open liquids that move freely beside the beam: enough to choose a mesh.
    """
    tones = []
    for index, beam in tank.beams.items():
        level = tank.level_of(index)
        liquid = beam.length * sum(
            tank.layers[layer].density for layer in (level.below, level.above) if layer is not None
        )
        elastic = beam.mass_per_length + _DEEP_ELASTIC * liquid
        heave = beam.mass_per_length + _DEEP_HEAVE * liquid
        inertia = elastic - (_DEEP_COUPLING * liquid) ** 2 / heave
        stiffness = first_bending(beam) + float(beam.hydrostatic) * level.jump
        tones.append(stiffness / inertia)
    return tuple(tones)


def ends_of_float_motions(tank: ScaledTank) -> tuple[float, ...]:
    """Up to which (dimensionless) λ modes are looked at for each motion of a float that gravity restores."""
    ends = []
    for index, body in tank.floats.items():
        level = tank.level_of(index)
        density = sum(tank.layers[layer].density for layer in (level.below, level.above) if layer is not None)
        width = body.stiffness[0, 0] / level.jump
        for place, motion in enumerate(("heave", "sway", "roll")):
            if motion in body.motions and body.stiffness[place, place] > 0.0:
                added = _FLOAT_HEAVE * density * width**2 if motion == "heave" else 0.0
                expected = float(body.stiffness[place, place] / (body.inertia[place] + added))
                ends.append(FAR_ENOUGH * expected)
    return tuple(ends)
