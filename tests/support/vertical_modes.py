"""Added mass of a thin float in a box by modes over the depth: no cosines along the tank, no closed form of J.

In x > 0, ψ = Σ A_m Z_m(y) cosh κ_m(L/2 − x) with ∂ψ/∂x = −ω' at x = 0. Z_m satisfies bottom, lid and interface at the
frequency asked for, (ρ₂Z(0−) − ρ₁Z(0+)) ω² = (ρ₂ − ρ₁) g Z'(0), and ∫ρ Z_m Z_n dy = 0. One κ is imaginary: the wave.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.polynomial.legendre import leggauss
from scipy.optimize import brentq

from hydroelastic.modal.floats.in_tank import FloatInTank
from hydroelastic.modal.liquid.two_layer import TwoLayers
from hydroelastic.physics.profiles import Profile


def added_masses(body: FloatInTank, square: float, counts: list[int]) -> list[float]:
    """a(ω²), kg/m, such that c − ω² (m + a) = 0 at the modes, with the first ``counts`` evanescent modes.

    Args:
        body: two liquids whose poles cot κh_j = ∞ are all different, or one.
        square: ω², (rad/s)².
        counts: numbers of modes, ascending.
    """
    depths, densities = _liquids(body.layers)
    difference = densities[0] - (densities[1] if len(densities) > 1 else 0.0)
    target = difference * body.layers.gravity / square
    wave = brentq(lambda k: np.sum(densities / np.tanh(k * depths)) / k - target, 1e-9, 1e4, xtol=1e-15)
    rates = _evanescent(depths, densities, target, counts[-1])
    kinds = [(np.array([wave]), np.cosh, np.sinh, 1.0), (rates, np.cos, np.sin, -1.0)]
    terms = []
    for k, even, odd, sign in kinds:
        moment, norm = np.zeros(len(k)), np.zeros(len(k))
        for side, depth, density in zip((-1.0, 1.0), depths, densities, strict=False):
            # Z of unit slope at the interface: ± cosh k(h − |y|)/(k sinh kh), or cos and −sin.
            shape = -sign * side / (k * odd(k * depth))
            norm += density * shape**2 * (depth / 2 + odd(2 * k * depth) / (4 * k))
            moment += density * shape * side * _flux_moment(body.profile, depth, k, even)
        half = k * body.tank_length / 2
        walls = -1 / (k * np.tan(half)) if sign > 0 else 1 / (k * np.tanh(half))
        terms.append(2 * moment**2 / norm * walls)
    partial = terms[0][0] + np.cumsum(terms[1])
    return [float(partial[count - 1]) for count in counts]


def _liquids(layers: TwoLayers) -> tuple[np.ndarray, np.ndarray]:
    depths, densities = [layers.depth_below], [layers.density_below]
    if layers.density_above:
        depths.append(layers.depth_above)
        densities.append(layers.density_above)
    return np.array(depths), np.array(densities)


def _evanescent(depths: np.ndarray, densities: np.ndarray, target: float, count: int) -> np.ndarray:
    """Roots of −Σ ρ_j cot(κh_j)/κ = (ρ₂ − ρ₁) g/ω²: the left side rises from pole to pole."""
    poles = np.sort(np.concatenate([np.arange(count + 1) * math.pi / depth for depth in depths]))[len(depths) - 1 :]
    low, high = poles[:count], poles[1 : count + 1]
    for _ in range(70):
        middle = (low + high) / 2
        rises = -(densities / np.tan(np.multiply.outer(middle, depths))).sum(axis=1) / middle < target
        low, high = np.where(rises, middle, low), np.where(rises, high, middle)
    return (low + high) / 2


def _flux_moment(profile: Profile, depth: float, k: np.ndarray, even: np.ufunc) -> np.ndarray:
    """∫ −ω' cosh k(h − y) dy over the upper half, or with cos."""
    panels = 4 + math.ceil(k.max() * profile.extent / 8)
    nodes, weights = leggauss(20)
    s = (np.arange(panels)[:, None] + (nodes + 1) / 2).ravel() / panels
    weights = np.tile(weights, panels) / (2 * panels)
    if profile.shape == "ellipse":
        y, flux = profile.half_height * np.sin(np.pi / 2 * s), profile.half_width * np.sin(np.pi / 2 * s) * np.pi / 2
    else:
        y, flux = profile.extent * s, -profile.slope_at(profile.extent * s) * profile.extent
    parts = np.array_split(k, max(1, len(k) // 100))
    return np.concatenate([even(np.multiply.outer(part, depth - y)) @ (weights * flux) for part in parts])
