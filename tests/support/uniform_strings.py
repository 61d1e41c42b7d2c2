"""Uniform strings by what their motion depends on alone: length, damping and gravity."""

from hydroelastic.physics.string import HangingString


def uniform_string(length: float = 1.0, damping: float = 0.0, gravity: float = 9.81) -> HangingString:
    """Return a string of length l, m, of damping α = λ/ρ, 1/s, under gravity g, m/s², with ρ = 1 kg/m."""
    return HangingString(length=length, linear_density=1.0, gravity=gravity, resistance=(damping, damping))
