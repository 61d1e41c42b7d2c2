"""About where the tones of beams and the motions of floats lie: enough to choose a mesh and a number of modes."""

from __future__ import annotations

from math import pi

from hydroelastic.modal.beam.beam_shapes import first_bending
from hydroelastic.physics.motions import MOTIONS
from hydroelastic.physics.tank import Tank

# Added mass per ρ l of dry mode 1 and of heave, and between them, on deep open water with ψ = 0 beside the beam.
_DEEP_ELASTIC = 0.12787
_DEEP_HEAVE = 0.39270
_DEEP_COUPLING = 0.114
# Added mass of a float's heave in ρ times the square of its waterplane's width: that of any half-immersed ellipse.
_FLOAT_HEAVE = pi / 8.0

FAR_ENOUGH = 1.5
"""Modes up to this many times the λ that a float's motion has far above the waves hold its mode."""


def expected_tones(tank: Tank) -> tuple[float, ...]:
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


def ends_of_float_motions(tank: Tank) -> tuple[float, ...]:
    """Up to which (dimensionless) λ modes are looked at for each motion of a float that gravity restores."""
    ends = []
    for index, body in tank.floats.items():
        level = tank.level_of(index)
        density = sum(tank.layers[layer].density for layer in (level.below, level.above) if layer is not None)
        width = body.stiffness[0, 0] / level.jump
        for place, motion in enumerate(MOTIONS):
            if motion in body.motions and body.stiffness[place, place] > 0.0:
                added = _FLOAT_HEAVE * density * width**2 if motion == "heave" else 0.0
                expected = float(body.stiffness[place, place] / (body.inertia[place] + added))
                ends.append(FAR_ENOUGH * expected)
    return tuple(ends)
