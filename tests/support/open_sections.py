"""Floats of polygonal section in open water of one liquid: boundary integrals on the wetted sides alone.

½ψ + ∫ ψ ∂G/∂n = ∫ G ∂ψ/∂n on the sides, n into the liquid, e^{-iωt}. G meets the free surface, the bed and the
radiation condition: with s = y + η <= 0, d = |y − η|, K = ω²/g, q = (k + K)/(k − K), E = e^{−2kH},

    G = (ln r − ln r')/2π − (F(z) + F(z̄))/2π − (1/2π) ∫ cos k(x − ξ) E/(1 − qE) φ(y) φ(η) dk/k,

φ(y) = q e^{ky} + e^{−ky}, z = −s + i(x − ξ) and F of `open_circle`. The last integral, along a path below the pole, is
a product of matrices. Panels shrink towards corners and the waterline. The method fails near irregular frequencies,
where the section filled with liquid would have sloshing modes that vanish on its sides.

Nothing of the package is imported.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from open_circle import wave_integral
from open_levels import one_liquid
from open_panels import Panels, graded_edges, graded_rule


@dataclass(frozen=True, kw_only=True)
class Water:
    """One liquid at one frequency.

    Attributes:
        omega: ω, rad/s.
        density: ρ, kg/m³.
        depth: H, m, may be infinite.
        gravity: g, m/s².
    """

    omega: float
    density: float
    depth: float
    gravity: float = 9.81


@dataclass(frozen=True, kw_only=True)
class SectionAnswer:
    """Sway, heave and roll of a section, per metre of width.

    Attributes:
        impedance: a + ib/ω, kg/m, kg, kg m, shape (3, 3).
        flux_damping: b of each motion by the energy that the waves carry away.
        excitation: force of a wave of unit elevation e^{ikx} at x = 0, N/m² or N/m, shape (3,).
    """

    impedance: np.ndarray
    flux_damping: np.ndarray
    excitation: np.ndarray


@dataclass(frozen=True)
class _Side:
    """A straight side from its first corner, with the unit tangent and the normal into the liquid."""

    start: np.ndarray
    tangent: np.ndarray
    panels: Panels

    @property
    def normal(self) -> np.ndarray:
        return np.array([self.tangent[1], -self.tangent[0]])

    @property
    def points(self) -> np.ndarray:
        return np.asarray(self.start + self.panels.nodes[:, None] * self.tangent)


def section_answer(corners: np.ndarray, water: Water, centre: float = 0.0, order: int = 12) -> SectionAnswer:
    """Radiation and excitation of a section.

    Args:
        corners: of the wetted sides from the left end of the waterplane round to the right end, m, shape (n, 2), y = 0
            at the still surface.
        water: the liquid.
        centre: y of the axis x = 0 of the roll, m.
        order: nodes in each panel.
    """
    sides = []
    for first, last in pairwise(np.asarray(corners, float)):
        length = float(np.linalg.norm(last - first))
        sides.append(_Side(first, (last - first) / length, Panels(graded_edges(length, length / 4, 1e-8), order)))
    points = np.concatenate([side.points for side in sides])
    normals = np.concatenate([np.tile(side.normal, (len(side.points), 1)) for side in sides])
    weights = np.concatenate([side.panels.weights for side in sides])
    single, double = _deep_matrices(sides, points, water)
    if math.isfinite(water.depth):
        shallow = _bed_matrices(points, normals, water)
        single, double = single + shallow[0] * weights, double + shallow[1] * weights
    arm = points - [0.0, centre]
    motions = np.stack([normals[:, 0], normals[:, 1], arm[:, 0] * normals[:, 1] - arm[:, 1] * normals[:, 0]], axis=1)
    potential = np.linalg.solve(np.eye(len(points)) / 2 + double, single @ motions)
    wave, slope = _incident(points, normals, water)
    force = -water.density * water.omega**2 * weights
    excitation = force @ (wave[:, None] * motions - potential * slope[:, None])
    back, slope_back = _incident(points * [-1, 1], normals * [-1, 1], water)
    # Haskind: what comes from the right moves the float as much as it sends to the right.
    against = force @ (back[:, None] * motions - potential * slope_back[:, None])
    flux = water.omega / 4 / _level_residue(water)
    return SectionAnswer(
        impedance=-water.density * (weights[:, None] * motions).T @ potential,
        flux_damping=(np.abs(excitation) ** 2 + np.abs(against) ** 2) / (8 * flux),
        excitation=excitation,
    )


def _level_residue(water: Water) -> float:
    level = one_liquid(water.omega, density=water.density, depth=water.depth, gravity=water.gravity)
    return float(level.residues[0])


def _incident(points: np.ndarray, normals: np.ndarray, water: Water) -> tuple[np.ndarray, np.ndarray]:
    """ψ and its normal derivative of a wave of unit elevation."""
    level = one_liquid(water.omega, density=water.density, depth=water.depth, gravity=water.gravity)
    k = level.wave_numbers[0]
    bed = 0.0 if math.isinf(water.depth) else math.exp(-2 * k * water.depth)
    x, y = points.T
    rising, falling = np.exp(k * y), bed * np.exp(-k * y)
    scale = np.exp(1j * k * x) / ((1 + bed) * level.deep)
    gradient = k * scale[:, None] * np.stack([1j * (rising + falling), rising - falling], axis=1)
    return scale * (rising + falling), np.sum(gradient * normals, axis=1)


def _deep_green(gap: np.ndarray, s: np.ndarray, normal: np.ndarray, square: float) -> tuple[np.ndarray, np.ndarray]:
    """G of infinite depth and its derivative along the normal at the source.

    Args:
        gap: field point less source point, shape (..., 2).
        s: y + η.
        normal: at the source, shape (..., 2).
        square: K = ω²/g.
    """
    x, y = gap[..., 0], gap[..., 1]
    direct, image = x**2 + y**2, x**2 + s**2
    above, below = (wave_integral(square, -s + 1j * sign * x) for sign in (1, -1))
    value = (np.log(direct) - np.log(image)) / 2 - (above + below)
    above_1, below_1 = (-square * f - 1 / (-s + 1j * sign * x) for f, sign in ((above, 1), (below, -1)))
    # ∂/∂ξ and ∂/∂η of z = −s + i(x − ξ) are −i and −1.
    along_x = -x / direct + x / image + 1j * (above_1 - below_1)
    along_y = -y / direct - s / image + (above_1 + below_1)
    return value / (2 * math.pi), (along_x * normal[..., 0] + along_y * normal[..., 1]) / (2 * math.pi)


def _deep_matrices(sides: list[_Side], points: np.ndarray, water: Water) -> tuple[np.ndarray, np.ndarray]:
    """∫ G σ and ∫ ∂G/∂n σ from values of σ at the nodes."""
    square = water.omega**2 / water.gravity
    count = len(points)
    single, double = np.zeros((count, count), complex), np.zeros((count, count), complex)
    first = 0
    for side in sides:
        columns = slice(first, first + len(side.panels.nodes))
        own = np.zeros(count, bool)
        own[columns] = True
        gap = points[:, None] - side.points
        gap[np.arange(count)[columns], np.arange(len(side.panels.nodes))] = 1.0
        s = points[:, None, 1] + side.points[:, 1]
        for matrix, kernel in zip((single, double), _deep_green(gap, s, side.normal, square), strict=True):
            matrix[:, columns] = kernel * side.panels.weights
        _refine(single, double, side, columns, points, own, square)
        first = columns.stop
    return single, double


def _refine(
    single: np.ndarray,
    double: np.ndarray,
    side: _Side,
    columns: slice,
    points: np.ndarray,
    own: np.ndarray,
    square: float,
) -> None:
    """Replace what points near a panel, or on it, receive from it."""
    rule, rule_weights = graded_rule(12)
    order = side.panels.order
    along = (points - side.start) @ side.tangent
    along[own] = side.panels.nodes
    across = (points - side.start) @ side.normal
    across[own] = 0.0
    for panel, (low, high) in enumerate(pairwise(side.panels.edges)):
        length = high - low
        nearest = np.clip(along, low, high)
        near = np.flatnonzero(np.hypot(along - nearest, across) < length)
        part = slice(columns.start + panel * order, columns.start + (panel + 1) * order)
        single[near, part] = double[near, part] = 0
        for end in (low, high):
            absorbing_layer = end - nearest[near]
            offset = absorbing_layer[:, None] * rule
            source = nearest[near, None] + offset
            split = along[near, None] - nearest[near, None] - offset
            gap = split[..., None] * side.tangent + across[near, None, None] * side.normal
            # A part of no length has no weight.
            gap[absorbing_layer == 0] = 1.0
            s = points[near, None, 1] + side.start[1] + source * side.tangent[1]
            values = _deep_green(gap, s, side.normal, square)
            to_nodes = side.panels.interpolation((2 * (source - low) / length - 1).ravel()).reshape(
                *source.shape, order
            )
            for matrix, kernel in zip((single, double), values, strict=True):
                weighted = kernel * (np.abs(absorbing_layer)[:, None] * rule_weights)
                matrix[near, part] += np.einsum("ij,ijk->ik", weighted, to_nodes)


def _bed_matrices(points: np.ndarray, normals: np.ndarray, water: Water) -> tuple[np.ndarray, np.ndarray]:
    """What the bed adds to G and ∂G/∂n: −(1/2π) ∫ cos k(x − ξ) E/(1 − qE) φ(y)φ(η) dk/k."""
    square, depth = water.omega**2 / water.gravity, water.depth
    x, y = points.T
    dip, end = 1 / max(np.ptp(x), depth), 20 / (depth + np.min(y))
    graded = np.concatenate([[0], dip * 2.0 ** np.arange(-24, 1)])
    edges = np.concatenate([graded * (1 - 1j), np.linspace(dip, end, 2 + int(end / dip))[1:] - 1j * dip])
    nodes, weights = np.polynomial.legendre.leggauss(16)
    halves = np.diff(edges)[:, None] / 2
    k, dk = (edges[:-1, None] + halves * (1 + nodes)).ravel(), (halves * weights).ravel()
    q = (k + square) / (k - square)
    # Each φ takes half of E = e^{−2kH}.
    rising, falling = q * np.exp(np.outer(y - depth, k)), np.exp(np.outer(-y - depth, k))
    phi, phi_y = rising + falling, k * (rising - falling)
    density = -dk / (2 * math.pi * k * (1 - q * np.exp(-2 * k * depth)))
    cosine, sine = np.cos(np.outer(x, k)), np.sin(np.outer(x, k))
    across, up = normals[:, 0, None], normals[:, 1, None]
    cosine_n, sine_n = up * phi_y * cosine - across * k * phi * sine, up * phi_y * sine + across * k * phi * cosine
    even, odd = phi * cosine * density, phi * sine * density
    return even @ (phi * cosine).T + odd @ (phi * sine).T, even @ cosine_n.T + odd @ sine_n.T
