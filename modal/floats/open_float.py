"""What the thin-float theory says of a float in open water, in SI units: to be set beside the field solution."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from hydroelastic.modal.estimate import NoEstimateError
from hydroelastic.modal.floats.thin_float import thin_float_mass, thin_float_stiffness
from hydroelastic.modal.floats.thin_float_decay import FreeMotion, crossover_time, free_motion
from hydroelastic.modal.floats.thin_float_radiation import HeaveRadiation, is_deep, natural_rate, thin_float_radiation
from hydroelastic.modal.floats.thin_float_resonance import heave_pole
from hydroelastic.modal.liquid.two_layer import TwoLayers
from hydroelastic.physics.profiles import Profile
from hydroelastic.physics.tank import Tank


@dataclass(frozen=True, kw_only=True)
class OpenFloatEstimate:
    """Heave of a thin float in open water; relative errors O(τ) in a, b and γ, O(τ²) in Re ω."""

    mass: float  # m, kg/m, that of the displaced liquids
    stiffness: float  # c, N/m²
    radiation: HeaveRadiation  # added mass and damping at the given frequencies
    resonance: complex | None  # ω − iγ, rad/s, of motions e^{−iωt}; ``None`` where there is none, see the note
    # t, s, after which the motion of a released float is the tail −(4/π) b/(g*t²); ``None`` at finite depth, and where
    # the tail exceeds the oscillation at all times
    crossover_time: float | None
    note: str  # what the method neglects, and why a value is missing


def open_float_estimate(profile: Profile, layers: TwoLayers, omega: npt.ArrayLike) -> OpenFloatEstimate:
    """Return added mass, damping and resonance of a thin float in open water, deep or not.

    Args:
        profile: the section, at rest with its level y = 0 at the interface or surface.
        layers: the liquids; two need a rigid lid or an infinite depth above.
        omega: ω > 0, rad/s, at which a and b are wanted; may be empty.

    Source: open water, docs, thin float.
    """
    radiation = thin_float_radiation(profile, layers, omega)
    notes = ["Thin float in open water, with waves: neglects the float's thickness."]
    resonance = crossover = None
    try:
        resonance = _resonance(profile, layers)
        crossover = crossover_time(profile) / natural_rate(profile, layers)
    except NoEstimateError as reason:
        notes.append(f"Incomplete: {reason}.")
    return OpenFloatEstimate(
        mass=thin_float_mass(profile, layers.density_below, layers.density_above),
        stiffness=thin_float_stiffness(profile, layers.density_below, layers.density_above, layers.gravity),
        radiation=radiation,
        resonance=resonance,
        crossover_time=crossover,
        note=" ".join(notes),
    )


def released_float(profile: Profile, layers: TwoLayers, time: npt.ArrayLike) -> FreeMotion:
    """Return s(t)/s₀ of a thin float released from rest in deep open water at rest.

    Args:
        layers: the liquids; two need a rigid lid or an infinite depth above.
        time: t ≥ 0, s.
    """
    _require_deep(layers)
    return free_motion(profile, np.asarray(time, dtype=np.float64) * natural_rate(profile, layers))


def _resonance(profile: Profile, layers: TwoLayers) -> complex:
    _require_deep(layers)
    # e^{pt} = e^{−iωt}: of both poles the one with Im p < 0.
    return 1j * heave_pole(profile).frequency.conjugate() * natural_rate(profile, layers)


def _require_deep(layers: TwoLayers) -> None:
    if not is_deep(layers):
        raise NoEstimateError("free motions are known in infinitely deep liquids only")


def lone_profile(tank: Tank) -> Profile | None:
    """Return the section of a lone float that heaves about its level; ``None`` of others, which have no such theory."""
    if len(tank.bodies) > 1 or not tank.floats:
        return None
    (body,) = tank.floats.values()
    hull = body.hull
    lies_there = body.level == ("surface" if len(tank.layers) == 1 else "interface")
    return hull.profile if lies_there and "heave" in body.motions and hull.reference_level == hull.height else None
