"""The older theories' estimates of a tank: one floating beam, and the waves of one or two layers."""

from __future__ import annotations

from math import inf

from hydroelastic.modal.beam.estimates import all_estimates, estimates_of_jointed_beams
from hydroelastic.modal.beam.floating_beam import FloatingBeam
from hydroelastic.modal.estimate import Estimate
from hydroelastic.modal.liquid.sloshing import guided_cover_frequencies, sloshing_frequencies
from hydroelastic.modal.liquid.two_layer import InterfacePlate, TwoLayers, tank_modes
from hydroelastic.physics.tank import Tank


def floating_beam(tank: Tank, body: int = 0) -> FloatingBeam:
    """One beam of a tank, alone in it, as the estimates take it."""
    beam, piece = tank.beams[body], tank.piece_of(body)
    return FloatingBeam(
        tank_length=tank.length,
        depth=tank.layers[0].depth,
        density=tank.layers[0].density,
        gravity=tank.gravity,
        # Ends within rounding of a wall lie on it, here as in the field model.
        start=piece.start,
        length=piece.length,
        flexural_rigidity=beam.flexural_rigidity,
        mass_per_length=beam.mass_per_length,
        hydrostatic=beam.hydrostatic,
    )


def tone_estimates(tank: Tank) -> dict[str, Estimate]:
    """Every estimate of the first elastic tone of one beam with free ends beside free water.

    Returns:
        Estimates by name; none where the theories, which know one beam in a tank with an open top, do not apply.
    """
    plain = len(tank.layers) == 1 and not tank.floats
    if not plain or len(tank.bodies) != 1 or tank.top != "free" or tank.beams[0].ends != "free":
        return {}
    return all_estimates(floating_beam(tank)) if tank.beams[0].is_uniform else estimates_of_jointed_beams()


def exact_frequencies(tank: Tank, count: int) -> tuple[str, tuple[float, ...]]:
    """The formula and the lowest frequencies of tanks with a closed form: sloshing, a guided beam from wall to wall.

    Returns:
        What the formula is and ω in rad/s, ascending; an empty tuple elsewhere.
    """
    if tank.floats:
        return "", ()
    if len(tank.layers) == 2:
        return _exact_of_two_layers(tank, count)
    if not tank.bodies and tank.top == "free":
        frequencies = sloshing_frequencies(tank.length, tank.layers[0].depth, tank.gravity, count)
        return "ω² = g k tanh kH, k = nπ/L", tuple(map(float, frequencies))
    if len(tank.beams) == 1 and tank.beams[0].ends == "guided":
        frequencies = guided_cover_frequencies(floating_beam(tank), count)
        return "ω² = (EI k⁴ + s ρ g)/(m + ρ/(k tanh kH)), k = nπ/L", tuple(map(float, frequencies))
    return "", ()


def two_layers(tank: Tank) -> TwoLayers:
    """The liquids of a tank as the theories take them; without an upper one its density is 0."""
    lower, upper = tank.layers[0], tank.layers[-1]
    return TwoLayers(
        density_below=lower.density,
        density_above=upper.density if len(tank.layers) == 2 else 0.0,
        depth_below=lower.depth,
        depth_above=upper.depth if len(tank.layers) == 2 else inf,
        gravity=tank.gravity,
        top=tank.top,
    )


def _exact_of_two_layers(tank: Tank, count: int) -> tuple[str, tuple[float, ...]]:
    """Waves of two layers, without a body or under a guided plate that covers the interface."""
    plates = [beam for beam in tank.beams.values() if beam.ends == "guided" and beam.level == "interface"]
    if len(tank.bodies) != len(plates):
        return "", ()
    plate = None
    if plates:
        plate = InterfacePlate(
            flexural_rigidity=plates[0].flexural_rigidity,
            mass_per_length=plates[0].mass_per_length,
            hydrostatic=plates[0].hydrostatic,
        )
    modes = tank_modes(two_layers(tank), tank.length, count, plate)
    return "waves of two layers, k = nπ/L", tuple(mode.omega for mode in modes)
