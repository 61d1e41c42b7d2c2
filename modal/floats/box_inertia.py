"""A thin float between rigid walls, bottom and lid: inertia of the liquids, and its part in the interface waves."""

from __future__ import annotations

import math

import numpy as np

from hydroelastic.modal.floats.thin_shapes import (
    LARGE_ARGUMENT,
    end_wave_moment,
    flux_rule,
    inertia_factor,
    sine_moment,
    wave_moment,
)
from hydroelastic.modal.liquid.two_layer import TwoLayers
from hydroelastic.physics.arrays import FloatArray
from hydroelastic.physics.profiles import Profile


def layer_wave_moment(profile: Profile, depth: float, wavenumbers: FloatArray) -> FloatArray:
    """Return R_j(k) = ∫ −ω' cosh k(h_j − y)/cosh kh_j dy over one half of the section, m.

    Args:
        profile: the section, bounded, extent < h_j.
        depth: h_j of the liquid, m.
        wavenumbers: k > 0, 1/m, shape (n,).
    """
    k = np.asarray(wavenumbers, dtype=np.float64)
    moment = wave_moment(profile, k * profile.half_height)
    felt = k * profile.extent < LARGE_ARGUMENT
    image = np.exp(-k[felt] * (2 * depth - profile.extent)) * end_wave_moment(profile, k[felt] * profile.half_height)
    moment[felt] += image
    total: FloatArray = profile.half_width * moment / (1 + np.exp(-2 * k * depth))
    return total


def interface_moment(profile: Profile, layers: TwoLayers, wavenumbers: FloatArray) -> FloatArray:
    """Return R_e(k) = (ρ₁C₁R₁ + ρ₂C₂R₂)/(ρ₁C₁ + ρ₂C₂), m, C_j = coth kh_j: the float's part in an interface wave.

    Arguments and errors as in `layer_wave_moment`.
    """
    moments, loads = _by_layer(profile, layers, wavenumbers)
    moment: FloatArray = (loads * moments).sum(axis=0) / loads.sum(axis=0)
    return moment


def liquid_inertia(profile: Profile, layers: TwoLayers, tank_length: float, wavenumbers: FloatArray) -> float:
    """Return M_∞ − m, kg/m, the inertia of the liquids with the interface level but for Σ R_e cos kx, h_j finite:

        M_∞ − m = 2 Σ_j ρ_j [J_j/π + (4/h_j) Σ_{m ≥ 0} Q_s(λ)²/(λ (e^{λL} − 1))]
                    + (8/L) Σ_n ρ₁ρ₂C₁C₂ (R₁ − R₂)²/(k (ρ₁C₁ + ρ₂C₂)),      λ = (m + ½)π/h_j,  k = 2nπ/L.

    Args:
        profile: the section, bounded.
        tank_length: L, m.
        wavenumbers: k_n, 1/m, up to k · extent = 50 at least, shape (n,).

    Source: two liquids, docs, § 6.
    """
    inertia = 0.0
    for density, depth in _liquids(layers):
        inertia += 2 * density * (layer_inertia(profile, depth) / math.pi + _wall_inertia(profile, depth, tank_length))
    moments, loads = _by_layer(profile, layers, wavenumbers)
    if len(loads) == 2:
        shear = np.prod(loads, axis=0) / loads.sum(axis=0) * (moments[0] - moments[1]) ** 2
        inertia += 8 / tank_length * float(np.sum(shear / wavenumbers))
    return inertia


def layer_inertia(profile: Profile, depth: float) -> float:
    """Return J_j = ∬ ω'ω' ln|tan(π(y + y')/4h_j)/tan(π(y − y')/4h_j)| dy dy' over one half of the section, m².

    It is J and the effect of a bottom (or lid) at h_j, of a tank without walls. Where the end comes near the bottom the
    integrand is nearly singular, the integral finite.

    Args:
        profile: the section, extent < h_j.
        depth: h_j, m.
    """
    relative_depth = depth / profile.half_height
    gap = (depth - profile.extent) / profile.half_height
    y, gaps, weights = flux_rule(profile, gap * profile.half_height / profile.extent)
    scale = math.pi / (4 * relative_depth)
    total = scale * np.add.outer(y, y)
    # π/2 − total, from distances to the end, which do not cancel.
    rest = scale * (2 * gap + np.add.outer(gaps, gaps))
    difference = scale * np.subtract.outer(y, y)
    ratio = np.divide(np.tan(difference), difference, out=np.ones_like(difference), where=difference != 0)
    effect = np.log(np.sin(total) / (total * np.sin(rest) * ratio))
    return profile.half_width**2 * (inertia_factor(profile) + float(weights @ effect @ weights))


def _wall_inertia(profile: Profile, depth: float, tank_length: float) -> float:
    """Return (4/h) Σ Q_s(λ)²/(λ (e^{λL} − 1)), m²: what the walls add."""
    count = math.ceil(LARGE_ARGUMENT * depth / (math.pi * tank_length)) + 1
    rate = (np.arange(count) + 0.5) * math.pi / depth
    moment = profile.half_width * sine_moment(profile, rate * profile.half_height)
    decay = np.exp(-rate * tank_length)
    return float(4 / depth * np.sum(moment**2 / rate * decay / (1 - decay)))


def _liquids(layers: TwoLayers) -> list[tuple[float, float]]:
    lower = [(layers.density_below, layers.depth_below)]
    return [(layers.density_above, layers.depth_above), *lower] if layers.density_above else lower


def _by_layer(profile: Profile, layers: TwoLayers, wavenumbers: FloatArray) -> tuple[FloatArray, FloatArray]:
    liquids = _liquids(layers)
    moments = np.array([layer_wave_moment(profile, depth, wavenumbers) for _, depth in liquids])
    loads = np.array([density / np.tanh(wavenumbers * depth) for density, depth in liquids])
    return moments, loads
