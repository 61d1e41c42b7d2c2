"""Heave of a thin float at the interface of two unbounded liquids: its constants, corrected."""

from __future__ import annotations

import math
from dataclasses import dataclass

from hydroelastic.modal.floats.thin_shapes import area_factor, inertia_factor
from hydroelastic.physics.profiles import Profile


@dataclass(frozen=True, kw_only=True)
class ThinConstants:
    """Dimensionless constants of a thin float in unbounded liquids; lengths in h, time in √(h/g*).

    g* = g (ρ₂ − ρ₁)/(ρ₂ + ρ₁). Neither the densities nor the mass, which is that of the displaced liquids, enter.
    """

    slenderness: float  # τ = b/h, half-width over half-height, to which the theory is an expansion
    area_factor: float  # S = ∫ω dy/(b h) over the upper half
    inertia_factor: float  # J/b²
    frequency_squared: float  # Ω² h/g* = 1/(S + τJ/(πb²))
    coupling: float  # ε = (2τ/π) Ω² h/g*, the strength of the waves that the float makes


def thin_constants(profile: Profile) -> ThinConstants:
    """Return the dimensionless constants of a thin float."""
    slenderness = profile.half_width / profile.half_height
    area, inertia = area_factor(profile), inertia_factor(profile)
    frequency_squared = 1 / (area + slenderness * inertia / math.pi)
    return ThinConstants(
        slenderness=slenderness,
        area_factor=area,
        inertia_factor=inertia,
        frequency_squared=frequency_squared,
        coupling=2 * slenderness / math.pi * frequency_squared,
    )


def thin_float_mass(profile: Profile, density_below: float, density_above: float) -> float:
    """Return m = (ρ₁ + ρ₂) 2bhS, kg/m, with which the float rests with its level y = 0 at the interface.

    Args:
        density_below: ρ₂, kg/m³.
        density_above: ρ₁, kg/m³; 0 for a single liquid.
    """
    area = 2 * profile.half_width * profile.half_height * area_factor(profile)
    return (density_below + density_above) * area


def thin_float_added_mass(profile: Profile, density_below: float, density_above: float) -> float:
    """Return a_∞ = (2/π)(ρ₁ + ρ₂) J, kg/m, the added mass in heave far above the frequencies of the waves.

    Arguments as in `thin_float_mass`.
    """
    inertia = profile.half_width**2 * inertia_factor(profile)
    return 2 / math.pi * (density_below + density_above) * inertia


def thin_float_stiffness(profile: Profile, density_below: float, density_above: float, gravity: float) -> float:
    """Return c = 2b (ρ₂ − ρ₁) g, N/m², the hydrostatic stiffness in heave between levels of unlimited length.

    Args:
        density_below: ρ₂, kg/m³.
        density_above: ρ₁, kg/m³.
        gravity: g, m/s².
    """
    return 2 * profile.half_width * (density_below - density_above) * gravity
