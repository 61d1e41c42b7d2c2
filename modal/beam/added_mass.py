"""Closed forms and series for the added mass of a dry shape."""

from __future__ import annotations

import math

import numpy as np

from hydroelastic.modal.beam.cosine_moments import cosine_moments, tip_values
from hydroelastic.modal.beam.dry_modes import free_free_shape, free_free_wavenumber
from hydroelastic.modal.beam.floating_beam import FloatingBeam
from hydroelastic.physics.arrays import FloatArray

_TERMS_PER_WAVE = 4000
_MOST_TERMS = 1_000_000
_ZETA_3 = 1.2020569031595942
# An integrand analytic in |t| < 2π has errors of 5.8⁻²ⁿ on [0, π] with n points.
_POINTS, _WEIGHTS = np.polynomial.legendre.leggauss(12)


def lid_added_mass(beam: FloatingBeam, index: int = 2) -> float:
    """Return the added mass under a rigid lid (η = 0 around the beam), also the limit ω → 0 and g → ∞:

        m_a = (2ρ/(L l)) Σ c_n² / (k_n tanh k_n H).

    The terms fall like n⁻³ because the surface jumps at the tips. That part, S_n²/k_n³ with
    S_n = [W sin k_n x]_{x₁}^{x₂}, is summed exactly through Σ cos(nα)/n³, and the rest is summed until it is below
    about 1e-12.

    Args:
        index: shape of `free_free_shape`, without volume: 1 (pitch) or an elastic one.

    Returns:
        Added mass per length for ∫W² dz = l, kg/m².

    Source: theory of the aquarium, docs, § 2 (lid).
    """
    if index == 0:
        raise ValueError("heave under a rigid lid has no added mass: its volume is not conserved")
    scaled = beam.dimensionless()
    waves = max(free_free_wavenumber(index), math.pi) * scaled.tank_length / math.pi
    decaying = 19 * scaled.tank_length / (math.pi * scaled.depth)
    count = min(_MOST_TERMS, math.ceil(max(_TERMS_PER_WAVE * waves, decaying)))
    k = np.arange(1, count + 1) * np.pi / scaled.tank_length
    moments = cosine_moments(scaled, index, k)
    value, _ = tip_values(index)
    jump = value[1] * np.sin(k * (scaled.start + 1)) - value[0] * np.sin(k * scaled.start)
    total = np.sum(moments**2 / (k * np.tanh(k * scaled.depth)) - jump**2 / k**3)
    total += _jump_series(scaled, value)
    return float(beam.density * beam.length * 2 / scaled.tank_length * total)


def _jump_series(scaled: FloatingBeam, value: FloatArray) -> float:
    """Return Σ (W₂ sin k_n x₂ − W₁ sin k_n x₁)²/k_n³ over all n."""
    turn = math.pi / scaled.tank_length
    left, right = scaled.start * turn, (scaled.start + 1) * turn
    unit = turn**-3
    squares = sum(
        v**2 / 2 * (cosine_cube_sum(0.0) - cosine_cube_sum(2 * x)) for v, x in zip(value, (left, right), strict=True)
    )
    product = value[0] * value[1] * (cosine_cube_sum(right - left) - cosine_cube_sum(right + left))
    return float(unit * (squares - product))


def cosine_cube_sum(angle: float) -> float:
    """Return Σ_{n ≥ 1} cos(nα)/n³ to rounding.

    With Σ cos(nt)/n = −ln(2 sin(t/2)), integrated twice, it is on [0, π], to which α is first brought,

        ζ(3) − (α²/2)(3/2 − ln α) + ∫₀^α (α − t) ln((2/t) sin(t/2)) dt.

    Args:
        angle: α, rad, any.

    Source: L. Lewin, "Polylogarithms and Associated Functions", North Holland, 1981, on Clausen's functions.
    """
    folded = math.fmod(abs(angle), 2 * math.pi)
    folded = min(folded, 2 * math.pi - folded)
    if folded == 0:
        return _ZETA_3
    t = folded / 2 * (1 + _POINTS)
    smooth = folded / 2 * _WEIGHTS @ ((folded - t) * np.log(np.sinc(t / (2 * math.pi))))
    return float(_ZETA_3 - folded**2 / 2 * (1.5 - math.log(folded)) + smooth)


def strip_added_mass(beam: FloatingBeam, index: int = 2) -> float:
    """Return ρ/(κ tanh κH), the added mass per length of a travelling wave of the dry wavenumber.

    Args:
        index: elastic shape of `free_free_shape`.

    Returns:
        Added mass per length, kg/m². In deep water it is 65 % above the true value for the first shape.

    Source: theory of the aquarium, docs, § 2 (strip).
    """
    kappa = free_free_wavenumber(index) / beam.length
    return beam.density / (kappa * math.tanh(kappa * beam.depth))


def deep_open_constant(index: int = 2) -> float:
    """Return C in m_a = C ρ l for deep water, no walls, ψ = 0 around the beam: 0.12787 for the first dry mode.

        C = Σ_j β_j² / (2π (j+1)),   β_j = ∫ W √(1−t²) U_j dt, t = 2s − 1.

    Args:
        index: shape of `free_free_shape`; heave gives π/8 and pitch 3π/64 (for ∫W² dz = l).

    Source: theory of the aquarium, docs, § 2.
    """
    points = 160 + 8 * index
    angle = np.arange(1, points + 1) * np.pi / (points + 1)
    orders = np.arange(points // 2)
    shape = free_free_shape(index, (1 + np.cos(angle)) / 2)
    beta = np.sin(np.outer(orders + 1, angle)) @ (np.sin(angle) * shape) * (np.pi / (points + 1))
    return float(np.sum(beta**2 / (2 * np.pi * (orders + 1))))


def deep_open_added_mass(beam: FloatingBeam, index: int = 2) -> float:
    """Return C ρ l, kg/m², with the `deep_open_constant` of the shape."""
    return deep_open_constant(index) * beam.density * beam.length


def shallow_constant(index: int = 2) -> float:
    """Return s = σ b (σ b − 2)/b⁴ in m_a = s ρ l²/H for H ≪ l with ψ = 0 around the beam: 0.024578 for mode 1.

    Args:
        index: elastic shape of `free_free_shape`; b = κ l.

    Source: theory of the aquarium, docs, § 2 (shallow).
    """
    b = free_free_wavenumber(index)
    if b == 0:
        raise ValueError("the shallow constant is given for elastic shapes only")
    _, slope = tip_values(index)
    sigma_b = -float(slope[0]) / 2
    return sigma_b * (sigma_b - 2) / b**4


def shallow_added_mass(beam: FloatingBeam, index: int = 2) -> float:
    """Return s ρ l²/H, kg/m², with the `shallow_constant` of the shape.

    The end correction O(H/l) vanishes with the shear force at the tips, so the relative error is O((H/l)²).
    """
    return shallow_constant(index) * beam.density * beam.length**2 / beam.depth
