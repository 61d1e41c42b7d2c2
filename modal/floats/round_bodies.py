"""Closed forms and older estimates of the forces of waves on bodies of revolution, whole, in SI units.

With Z = cosh k(z + H)/cosh kH and N = ∫Z² dz = (tanh kH + kH/cosh² kH)/(2k):

- a cylinder of radius a that stands on the bed (R. C. MacCamy, R. A. Fuchs 1954), here over the depths from −d to 0:
  X_surge = 4ρg/(k H₁′(ka)) ∫Z dz,   X_pitch = −4ρg/(k H₁′(ka)) ∫(z − z₀) Z dz;
- long waves: X_heave = ρ g A_w;
- damping of order n by Haskind's relation from a force, b = π ω |X|²/(2ρ g² c_n ε_n² N): heave ω|X|²/(4ρg²N), surge and
  pitch ω|X|²/(8ρg²N);
- strips, in long waves: each horizontal slice as if it were endless, of added mass ρA, A its area;
  X_surge = 2ρ g k ∫A Z dz, the acceleration gkZ of the water times twice the mass displaced;
- a disc of radius a in deep water: beside ψ = 0 heave 4/3 ρa³, pitch 8/45 ρa⁵; beside a lid 8/3 ρa³, 4/15 ρa⁵;
- a light, limp disc or ring b < r < a follows the water: heave 2 (a J₁(ka) − b J₁(kb))/(k (a² − b²)).
"""

from __future__ import annotations

from collections.abc import Iterable
from math import cosh, exp, inf, pi, tanh

import numpy as np
from scipy.special import h1vp, j1

from hydroelastic.physics.contours import Arc, arc_quadrature

DISC_HEAVE, DISC_PITCH = 4.0 / 3.0, 8.0 / 45.0
"""Added mass over ρa³ and ρa⁵ of a disc beside ψ = 0."""
LID_HEAVE, LID_PITCH = 8.0 / 3.0, 4.0 / 15.0
"""The same beside a lid, ∂ψ/∂z = 0."""
# kH beyond which the bed is out of reach, and cosh of it still finite.
_DEEP = 300.0


def depth_integrals(wavenumber: float, depth: float, draught: float) -> tuple[float, float, float]:
    """Return ∫Z dz and ∫z Z dz from −draught to 0, and N over the whole depth.

    Args:
        wavenumber: k, 1/m.
        depth: H, m; may be infinite.
        draught: m.
    """
    k, d = wavenumber, draught
    if depth == inf or k * depth > _DEEP:
        decayed = exp(-k * d)
        return (1.0 - decayed) / k, -(1.0 - decayed * (1.0 + k * d)) / k**2, 0.5 / k
    # sinh and cosh of k(H − d) over cosh kH.
    low = k * (depth - d)
    cosine = cosh(low) / cosh(k * depth)
    sine = tanh(low) * cosine
    whole = (tanh(k * depth) - sine) / k
    first = d * sine / k - (1.0 - cosine) / k**2
    return whole, first, 0.5 * (tanh(k * depth) + k * depth / cosh(k * depth) ** 2) / k


def standing_cylinder(
    wavenumber: float, depth: float, radius: float, draught: float, weight: float, about: float = 0.0
) -> tuple[complex, complex]:
    """Return surge force, N/m, and pitch moment, N, per elevation of waves towards +x, by MacCamy and Fuchs.

    Args:
        wavenumber: k, 1/m.
        depth: H, m.
        radius: a, m.
        draught: depth to which the pressure on the cylinder is summed, m; the depth for the whole cylinder.
        weight: ρg, N/m³.
        about: height of the axis of pitch above the still level, m.
    """
    factor = 4.0 * weight / (wavenumber * h1vp(1, wavenumber * radius))
    whole, first, _ = depth_integrals(wavenumber, depth, draught)
    return complex(factor * whole), complex(-factor * (first - about * whole))


def strip_force(wet: Iterable[Arc], wavenumber: float, depth: float, weight: float) -> float:
    """Return the surge force, N/m, of long waves on a solid that the axis passes through, by strips.

    Args:
        wet: the section's contour under the still level z = 0, from left to right.
        wavenumber: k, 1/m.
        depth: H, m.
        weight: ρg, N/m³.
    """
    total = 0.0
    for arc in wet:
        x, z, _, dz = arc_quadrature(arc)
        wave = np.exp(wavenumber * z) + np.exp(-wavenumber * (z + 2.0 * depth))
        # ∫A Z dz = π∮r² Z dz by Green's theorem, of both halves of the section.
        total += 0.5 * pi * float((x * np.abs(x) * wave) @ dz)
    return 2.0 * weight * wavenumber * total / (1.0 + exp(-2.0 * wavenumber * depth))


def following_heave(wavenumber: float, inner: float, outer: float) -> float:
    """Return the mean elevation, per unit of that at the axis, of waves over a disc or ring.

    Args:
        wavenumber: k, 1/m.
        inner: b, m; 0 of a disc.
        outer: a, m.
    """
    moment = float(outer * j1(wavenumber * outer) - inner * j1(wavenumber * inner))
    return 2.0 * moment / (wavenumber * (outer**2 - inner**2))


def haskind_damping(order: int, omega: float, force: float, spread: float, density: float, gravity: float) -> float:
    """Return the damping b, kg/s, of a motion from the force of waves on it.

    Args:
        order: azimuthal order of the motion, 0 or 1.
        omega: ω, rad/s.
        force: |X|, N/m.
        spread: N, m.
        density: ρ, kg/m³.
        gravity: g, m/s².
    """
    return omega * force**2 / ((4.0 if order == 0 else 8.0) * density * gravity**2 * spread)
