"""Closed-form modes of a thread about rest, in water at rest: strings, chains, beams and sagging cables.

``mass`` is that of the motion, m + m_a per length where the motion is across the thread.
"""

from __future__ import annotations

import math

import numpy as np
from scipy.special import j0, j1, y0, y1

from hydroelastic.modal.bessel_zeros import bessel_zeros
from hydroelastic.modal.bracketed_roots import bracketed_roots, sign_change_roots
from hydroelastic.physics.arrays import FloatArray

# Samples of the determinant of a chain between two roots, which are π apart in travel time.
_PLACES_PER_ROOT = 16


def _positive(**values: float) -> None:
    for name, value in values.items():
        if not (math.isfinite(value) and value > 0):
            raise ValueError(f"{name} is {value}: it must be finite and positive")


def _numbers(count: int) -> FloatArray:
    if count < 1:
        raise ValueError(f"count is {count}: it must be 1 or more")
    return np.arange(1, count + 1, dtype=float)


def tensioned_beam_frequencies(
    length: float, tension: float, mass: float, count: int, flexural_rigidity: float = 0.0
) -> FloatArray:
    """Return ω_n = k √((T + EI k²)/m), k = nπ/L: a pinned beam under tension, without EI a taut string.

    Args:
        length: L, m.
        tension: T, N.
        mass: m, with the added mass, kg/m.
        count: how many, from 1.
        flexural_rigidity: EI, N m².

    Returns:
        ω_n, 1/s, increasing, shape (count,).
    """
    _positive(length=length, tension=tension, mass=mass)
    if not (math.isfinite(flexural_rigidity) and flexural_rigidity >= 0):
        raise ValueError(f"flexural_rigidity is {flexural_rigidity}: it must be finite and not negative")
    wavenumbers = _numbers(count) * math.pi / length
    return np.asarray(wavenumbers * np.sqrt((tension + flexural_rigidity * wavenumbers**2) / mass))


def chain_frequencies(
    length: float, weight: float, mass: float, count: int, tip_weight: float = 0.0, tip_mass: float = 0.0
) -> FloatArray:
    """Return ω_n of a chain that hangs from its end A, with a body at its lower end or without.

    Without: ω_n = (j₀ₙ/2)√(w/(mL)). With: v = a J₀(β) + b Y₀(β), β = 2ω√(mT)/w, with T = W + wζ at the height ζ above
    the tip, v = 0 at A and M ω² v = W dv/ds at the tip.

    Args:
        length: L, m.
        weight: w, submerged, N/m.
        mass: m, with the added mass, kg/m.
        count: how many, from 1.
        tip_weight: W, submerged, N; positive with a tip mass.
        tip_mass: M, kg.

    Returns:
        ω_n, 1/s, increasing, shape (count,).
    """
    _positive(length=length, weight=weight, mass=mass)
    if not (math.isfinite(tip_mass) and tip_mass >= 0):
        raise ValueError(f"tip_mass is {tip_mass}: it must be finite and not negative")
    if not (math.isfinite(tip_weight) and (tip_weight > 0 or tip_weight == tip_mass == 0)):
        raise ValueError(f"tip_weight is {tip_weight}: it must be positive with a body at the tip, 0 without")
    numbers = _numbers(count)
    if tip_weight == 0:
        return np.asarray(0.5 * bessel_zeros(count) * math.sqrt(weight / (mass * length)))
    top, tip = (2 * math.sqrt(mass * tension) / weight for tension in (tip_weight + weight * length, tip_weight))
    pull = math.sqrt(mass * tip_weight)

    def determinant(omega: FloatArray) -> FloatArray:
        first = tip_mass * omega * j0(omega * tip) - pull * j1(omega * tip)
        second = tip_mass * omega * y0(omega * tip) - pull * y1(omega * tip)
        return np.asarray(j0(omega * top) * second - y0(omega * top) * first)

    # √T of the top less that of the tip, without the cancellation of a heavy body.
    travel = 2 * math.sqrt(mass) * length / (math.sqrt(tip_weight + weight * length) + math.sqrt(tip_weight))
    # One more root than is wanted fits below, and the lowest is not below a pendulum's of all the mass.
    knots = np.arange(1, _PLACES_PER_ROOT * (len(numbers) + 1)) * math.pi / (_PLACES_PER_ROOT * travel)
    lowest = 0.1 * math.sqrt(tip_weight / ((tip_mass + mass * length) * length))
    knots = np.concatenate([[min(lowest, 0.5 * knots[0])], knots])
    return sign_change_roots(determinant, knots, determinant(knots))[:count]


def irvine_parameter(span: float, weight: float, level_tension: float, axial_rigidity: float) -> float:
    """Return λ² = (wc/H)² (EA/H) c/L_e, with L_e = c(1 + (wc/H)²/8), of a cable with little sag.

    Args:
        span: c, m, between level supports.
        weight: w, submerged, N/m.
        level_tension: H, N.
        axial_rigidity: EA, N; infinite if the cable does not stretch.

    Source: Irvine and Caughey, Proc. R. Soc. A 341 (1974).
    """
    _positive(span=span, weight=weight, level_tension=level_tension)
    if not axial_rigidity > 0:
        raise ValueError(f"axial_rigidity is {axial_rigidity}: it must be positive")
    slope = weight * span / level_tension
    return slope**2 * axial_rigidity / level_tension / (1 + slope**2 / 8)


def sagging_cable_frequencies(
    span: float, level_tension: float, mass: float, irvine: float, count: int, out_of_plane: bool = False
) -> FloatArray:
    """Return ω_n of a cable with little sag, leading order as sag/span tends to 0.

    Ω = ω c √(m/H): in the plane tan(Ω/2) = Ω/2 − (4/λ²)(Ω/2)³ for the symmetric modes and 2nπ for the others; nπ out of
    the plane. At a sag of 0.02 of the span, and λ² = 10, the lowest frequency is 4e-4 too small.

    Args:
        span: c, m, between level supports.
        level_tension: H, N.
        mass: m, with the added mass, kg/m.
        irvine: λ², from 0; infinite if the cable does not stretch.
        count: how many, from 1.
        out_of_plane: whether those out of the plane of the cable are wanted.

    Returns:
        ω_n, 1/s, increasing, shape (count,).

    Source: Irvine and Caughey, Proc. R. Soc. A 341 (1974).
    """
    _positive(span=span, level_tension=level_tension, mass=mass)
    if not irvine >= 0:
        raise ValueError(f"irvine is {irvine}: it must not be negative")
    numbers = _numbers(count)
    speed = math.sqrt(level_tension / mass) / span
    if out_of_plane:
        return np.asarray(numbers * math.pi * speed)
    share = 1 / (1 + irvine)
    rigid = 1.0 - share if math.isfinite(irvine) else 1.0

    def mismatch(half: FloatArray) -> FloatArray:
        branch = np.round(half / math.pi)
        return np.asarray(half - branch * math.pi - np.arctan2(rigid * half - 4 * share * half**3, rigid))

    # One root between two poles of the tangent: without stretch the arc tangent stays away from both, with little
    # sag it comes near the lower one.
    left, right = ((numbers + half) * math.pi for half in (-0.5, 0.5))
    if irvine == 0:
        symmetric = 2 * left
    else:
        inside = 1e-15 * right
        left, right = left + inside, right - inside
        low, high = mismatch(left), mismatch(right)
        symmetric = 2 * np.where(low < 0, bracketed_roots(mismatch, left, right, np.minimum(low, -1e-300), high), left)
    return np.asarray(np.sort(np.concatenate([symmetric, 2 * math.pi * numbers]))[:count] * speed)
