"""Added mass and damping of a thin float in open water, whose waves leave to both sides."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from hydroelastic.modal.estimate import NoEstimateError
from hydroelastic.modal.floats.box_inertia import interface_moment, layer_inertia, layer_wave_moment
from hydroelastic.modal.floats.complex_moments import ComplexArray
from hydroelastic.modal.floats.thin_float import thin_float_added_mass
from hydroelastic.modal.floats.thin_shapes import check_pointed, inertia_factor, wave_moment
from hydroelastic.modal.floats.wave_integral import wave_integral
from hydroelastic.modal.liquid.two_layer import TwoLayers
from hydroelastic.physics.arrays import FloatArray
from hydroelastic.physics.profiles import Profile

_STEP = 0.08
_REACH = 40
_CHUNK = 64
_NEWTON_STEPS = 60


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


def channel_radiation(profile: Profile, layers: TwoLayers, frequency: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return added mass a, kg/m, and damping b, kg/(m s), of a thin float in a channel open at both ends:

        b = 4 Δρ g ω R_e²/(dσ²/dk) at σ(k₀) = ω,     a = a_∞ + (4/π) Δρ g PV∫₀^∞ R_e²/(σ² − ω²) dk.

    The principal value needs no subtraction: the trapezoidal rule in ln k with k₀ midway between two of its nodes errs
    exponentially little, since all is analytic in Re k > 0.

    Args:
        layers: the liquids; two need a rigid lid. One of the depths may be infinite.
        frequency: ω > 0, rad/s, shape (n,).

    Source: open water, docs, thin float.
    """
    check_channel(profile, layers)
    numbers = _wavenumbers(layers, frequency)
    chunks = np.array_split(np.arange(numbers.size), max(1, math.ceil(numbers.size / _CHUNK)))
    integral = np.concatenate([_principal_value(profile, layers, numbers[chunk]) for chunk in chunks])
    slope = _squared(layers, numbers)[1]
    restoring = _restoring(layers)
    damping = 4 * restoring * frequency * interface_moment(profile, layers, numbers) ** 2 / slope
    added_mass = channel_inertia(profile, layers) + 4 / math.pi * restoring * integral
    return added_mass, damping


def channel_inertia(profile: Profile, layers: TwoLayers) -> float:
    """Return a_∞, kg/m, the added mass of heave far above the frequencies of the waves:

        a_∞ = (2/π) Σ_j ρ_j J_j + (4/π) ∫₀^∞ ρ₁ρ₂C₁C₂ (R₁ − R₂)²/(k (ρ₁C₁ + ρ₂C₂)) dk,     C_j = coth kh_j.

    Arguments and errors as in `channel_radiation`.
    """
    check_channel(profile, layers)
    liquids = [(layers.density_below, layers.depth_below)]
    if layers.density_above:
        liquids.append((layers.density_above, layers.depth_above))
    inertia = 2 / math.pi * sum(density * _layer_inertia(profile, depth) for density, depth in liquids)
    if len(liquids) == 1:
        return inertia
    k = np.exp(_STEP * np.arange(-_REACH / _STEP, _REACH / _STEP)) / min(profile.half_height, profile.extent)
    loads = [density / np.tanh(k * depth) for density, depth in liquids]
    moments = [layer_wave_moment(profile, depth, k) for _, depth in liquids]
    # dk/k is the step of the rule.
    shear = loads[0] * loads[1] / (loads[0] + loads[1]) * (moments[0] - moments[1]) ** 2
    return inertia + 4 / math.pi * _STEP * float(shear.sum())


def check_channel(profile: Profile, layers: TwoLayers) -> None:
    """Refuse what the theory of the channel does not hold for."""
    check_pointed(profile)
    two = bool(layers.density_above)
    clearance = min(layers.depth_below, layers.depth_above) if two else layers.depth_below
    if not profile.extent < clearance:
        raise NoEstimateError(f"the float reaches {profile.extent} m from y = 0, as far as {clearance} m")
    if two and layers.top != "rigid" and math.isfinite(layers.depth_above):
        raise NoEstimateError("the top over the two liquids is not a rigid lid")


def _restoring(layers: TwoLayers) -> float:
    return (layers.density_below - layers.density_above) * layers.gravity


def _layer_inertia(profile: Profile, depth: float) -> float:
    if math.isinf(depth):
        return profile.half_width**2 * inertia_factor(profile)
    return layer_inertia(profile, depth)


def _squared(layers: TwoLayers, k: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return σ² = Δρ g k/(ρ₁C₁ + ρ₂C₂) and dσ²/dk; dC/dk = −h/sinh² kh."""
    load, decrease = np.zeros_like(k), np.zeros_like(k)
    for density, depth in ((layers.density_below, layers.depth_below), (layers.density_above, layers.depth_above)):
        if density and math.isfinite(depth):
            # e^{−kh} keeps sinh from overflowing.
            decay = np.exp(-k * depth)
            load += density / np.tanh(k * depth)
            decrease += density * k * depth * (2 * decay / -np.expm1(-2 * k * depth)) ** 2
        else:
            load += density
    squared = _restoring(layers) * k / load
    return squared, squared / k * (1 + decrease / load)


def _wavenumbers(layers: TwoLayers, omega: FloatArray) -> FloatArray:
    """Return k₀ > 0 of σ(k₀) = ω, shape (n,), by Newton's method in ln k: ln σ² has a slope between 1 and 2."""
    # That of deep liquids lies below: waves of a given k are slower where the bottom is near.
    logarithm = np.log(omega**2 * (layers.density_below + layers.density_above) / _restoring(layers))
    for _ in range(_NEWTON_STEPS):
        k = np.exp(logarithm)
        squared, slope = _squared(layers, k)
        step = (np.log(squared) - 2 * np.log(omega)) * squared / (k * slope)
        logarithm = logarithm - step
        if np.all(np.abs(step) < 1e-15 * (1 + np.abs(logarithm))):
            break
    return np.exp(logarithm)


def _principal_value(profile: Profile, layers: TwoLayers, numbers: FloatArray) -> FloatArray:
    scale = min(profile.half_height, profile.extent)
    low = math.floor((min(math.log(scale * numbers.min()), 0) - _REACH - math.log(scale * numbers.min())) / _STEP)
    high = math.ceil((max(math.log(scale * numbers.max()), 0) + _REACH - math.log(scale * numbers.max())) / _STEP)
    k = numbers[:, None] * np.exp(_STEP * (np.arange(low, high + 1) + 0.5))
    moment = interface_moment(profile, layers, k.ravel()).reshape(k.shape)
    at_pole = _squared(layers, numbers)[0]
    distance = _squared(layers, k.ravel())[0].reshape(k.shape) - at_pole[:, None]
    value: FloatArray = _STEP * np.sum(k * moment**2 / distance, axis=1)
    return value
