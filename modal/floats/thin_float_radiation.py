"""Added mass and damping of a thin float in open water, whose waves leave to both sides."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from hydroelastic.modal.floats.channel_radiation import channel_inertia, channel_radiation
from hydroelastic.modal.floats.complex_moments import ComplexArray
from hydroelastic.modal.floats.thin_float import thin_float_added_mass
from hydroelastic.modal.floats.thin_shapes import inertia_factor, wave_moment
from hydroelastic.modal.floats.wave_integral import wave_integral
from hydroelastic.modal.liquid.two_layer import TwoLayers
from hydroelastic.physics.arrays import FloatArray
from hydroelastic.physics.profiles import Profile


@dataclass(frozen=True, kw_only=True)
class HeaveRadiation:
    """What the liquids oppose to a heave s = Re ŝ e^{−iωt}: the force is ω²(a + ib/ω) ŝ."""

    added_mass: FloatArray  # a, kg/m, in the shape of the frequencies
    damping: FloatArray  # b ≥ 0, kg/(m s), of the same shape
    infinite_added_mass: float  # a at ω → ∞, kg/m


def thin_float_radiation(profile: Profile, layers: TwoLayers, omega: npt.ArrayLike) -> HeaveRadiation:
    """Return added mass and damping of heave, with κ = ω²h/g* in deep liquids

        a = (ρ₁ + ρ₂) b² (2/π) [J/b² + 2 Re G(i√κ)],     b = 4 (ρ₁ + ρ₂) ω R(κ)²,

    and by `channel_radiation` where bottom or lid are at a finite depth. Right to relative O(τ) for a float of
    slenderness τ.

    Args:
        layers: the liquids; two need a rigid lid or an infinite depth above.
        omega: ω > 0, rad/s; may be empty.

    Source: open water, docs, thin float.
    """
    frequency = np.asarray(omega, dtype=np.float64)
    if not np.all(np.isfinite(frequency) & (frequency > 0)):
        raise ValueError("frequencies must be finite and positive")
    deep = is_deep(layers)
    if deep:
        infinite = thin_float_added_mass(profile, layers.density_below, layers.density_above)
    else:
        infinite = channel_inertia(profile, layers)
    added_mass: FloatArray = np.empty(0)
    damping: FloatArray = np.empty(0)
    if frequency.size:
        radiation = _deep_radiation if deep else channel_radiation
        added_mass, damping = radiation(profile, layers, frequency.ravel())
    return HeaveRadiation(
        added_mass=added_mass.reshape(frequency.shape),
        damping=damping.reshape(frequency.shape),
        infinite_added_mass=infinite,
    )


def complex_added_mass(profile: Profile, layers: TwoLayers, rate: npt.ArrayLike) -> ComplexArray:
    """Return H(p) = (ρ₁ + ρ₂) b² (2/π) [J/b² + 2 G(p √(h/g*))] in deep liquids, kg/m, for motions e^{pt}.

    On p = −iω it is a + ib/ω, on p = iω its conjugate; to the left of the imaginary axis it is continued, so that
    (m + H) p² + c = 0 at the resonances.

    Args:
        layers: the liquids; their depths are not used.
        rate: p, 1/s, as z in `wave_integral`.
    """
    z = np.asarray(rate, dtype=np.complex128) / natural_rate(profile, layers)
    value: ComplexArray = (
        _inertia_unit(profile, layers) * (2 / math.pi) * (inertia_factor(profile) + 2 * wave_integral(profile, z))
    )
    return value


def is_deep(layers: TwoLayers) -> bool:
    """Whether neither bottom nor lid is at a finite depth."""
    return math.isinf(layers.depth_below) and (not layers.density_above or math.isinf(layers.depth_above))


def natural_rate(profile: Profile, layers: TwoLayers) -> float:
    """Return √(g*/h), rad/s, g* = g (ρ₂ − ρ₁)/(ρ₂ + ρ₁): the unit of frequencies of the thin-float theory."""
    total = layers.density_below + layers.density_above
    reduced_gravity = layers.gravity * (layers.density_below - layers.density_above) / total
    return math.sqrt(reduced_gravity / profile.half_height)


def _deep_radiation(profile: Profile, layers: TwoLayers, frequency: FloatArray) -> tuple[FloatArray, FloatArray]:
    scaled = frequency / natural_rate(profile, layers)
    inertia = _inertia_unit(profile, layers)
    waves = 2 * wave_integral(profile, 1j * scaled).real
    added_mass = inertia * (2 / math.pi) * (inertia_factor(profile) + waves)
    return added_mass, 4 * inertia * frequency * wave_moment(profile, scaled**2) ** 2


def _inertia_unit(profile: Profile, layers: TwoLayers) -> float:
    return (layers.density_below + layers.density_above) * profile.half_width**2
