"""Impulse response functions of radiation, as sums of decaying exponentials.

The force of the waves that bodies radiate on these is −a∞ ξ″ − ∫₀ᵗ K(t − u) ξ′(u) du (W. E. Cummins 1962). With p for
d/dt, H = a + i b/ω at p = −iω, and a∞ = lim H for p → ∞,

    K̂(p) = ∫₀^∞ K e^{−pt} dt = p (H(p) − a∞),      b(ω) = ∫ K cos ωt dt,   a(ω) = a∞ − (1/ω) ∫ K sin ωt dt

(T. F. Ogilvie 1964). Bromwich's integral of K̂ turned into the left half plane, to the rays arg p = ±θ, is by the
trapezoidal rule in ln |p|

    K(t) = Re Σ cₖ e^{pₖt},      pₖ = |pₖ| e^{iθ},      cₖ = −i (h/π) pₖ K̂(pₖ),

with an error e^{−2πδ/h} in a and b where K̂ is analytic within an angle δ of the ray. Poles of K̂ before it add
exponentials with twice their residues. The exponentials are states of
a linear system, and K(t) = 0 before t = 0 by construction. K̂ ~ C/p for p → ∞, C = K(0), has two exponentials of its
own, C (2 e^{−2βt} − e^{−βt}) with the transform Cp/((p + β)(p + 2β)), so that what is left is negligible beyond both
ends of the ray.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import pi
from typing import TypeAlias

import numpy as np
import numpy.typing as npt

Floats: TypeAlias = npt.NDArray[np.float64]
Complexes: TypeAlias = npt.NDArray[np.complex128]

# Singular values of a least squares problem that are left out, relative to the largest.
_DEPENDENT = 1e-10


@dataclass(frozen=True, kw_only=True)
class RadiationMemory:
    """K of m motions as k exponentials, SI units.

    Attributes:
        infinite_frequency_added_mass: a∞, shape (m, m).
        rates: p, 1/s, with Re p < 0 and Im p ≥ 0, shape (k,).
        weights: c, shape (k, m, m).
    """

    infinite_frequency_added_mass: Floats
    rates: Complexes
    weights: Complexes

    def scaled(self, factor: float) -> RadiationMemory:
        """Return the memory of a multiple of H."""
        return replace(
            self,
            infinite_frequency_added_mass=factor * self.infinite_frequency_added_mass,
            weights=factor * self.weights,
        )

    def impulse_response(self, times: Floats) -> Floats:
        """K at times t ≥ 0, s, shape (n,): shape (n, m, m)."""
        values: Floats = np.real(np.tensordot(np.exp(np.outer(times, self.rates)), self.weights, axes=1))
        return values

    def transform(self, omega: Floats) -> Complexes:
        """∫ K e^{iωt} dt = b − iω (a − a∞) at real ω, rad/s, shape (n,): shape (n, m, m)."""
        p = -1j * np.asarray(omega)[:, None]
        upper, lower = (
            np.tensordot(1.0 / (p - rates), weights, axes=1)
            for rates, weights in ((self.rates, self.weights), (self.rates.conj(), self.weights.conj()))
        )
        return np.asarray(0.5 * (upper + lower), dtype=complex)

    def radiation_damping(self, omega: Floats) -> Floats:
        """b = ∫ K cos ωt dt, shape (n, m, m)."""
        return np.real(self.transform(omega))

    def added_mass(self, omega: Floats) -> Floats:
        """a = a∞ − (1/ω) ∫ K sin ωt dt at ω > 0, shape (n, m, m): Ogilvie's relation."""
        sines: Floats = self.transform(omega).imag / np.asarray(omega)[:, None, None]
        return self.infinite_frequency_added_mass - sines

    def hydrodynamic(self, omega: Floats) -> Complexes:
        """a + i b/ω at ω > 0, shape (n, m, m)."""
        values: Complexes = self.infinite_frequency_added_mass + 1j * self.transform(omega) / omega[:, None, None]
        return values

    def completed(self, omega: Floats, hydrodynamic: Complexes, rates: Complexes) -> RadiationMemory:
        """Return the memory with further exponentials, by least squares of what it lacks of H at real frequencies.

        Args:
            omega: frequencies, rad/s, shape (n,).
            hydrodynamic: H = a + i b/ω there, shape (n, m, m).
            rates: p of the exponentials, 1/s, shape (k,).
        """
        upper, lower = (0.5 / (-1j * omega[:, None] - own) for own in (rates, rates.conj()))
        columns = 1j / omega[:, None] * np.hstack([upper + lower, 1j * (upper - lower)])
        lacking = (hydrodynamic - self.hydrodynamic(omega)).reshape(len(omega), -1)
        known, wanted = (np.vstack([part.real, part.imag]) for part in (columns, lacking))
        sizes = np.linalg.norm(known, axis=0)
        found = np.linalg.lstsq(known / sizes, wanted, rcond=_DEPENDENT)[0] / sizes[:, None]
        added = (found[: len(rates)] + 1j * found[len(rates) :]).reshape(len(rates), *self.weights.shape[1:])
        return replace(self, rates=np.concatenate([self.rates, rates]), weights=np.concatenate([self.weights, added]))


def ray_radii(lowest: float, highest: float, angle: float, error: float) -> Floats:
    """|p| of the nodes of a ray.

    Args:
        lowest: smallest |p|.
        highest: largest |p|.
        angle: δ, rad, between the ray and the imaginary axis, and between it and the next singularity.
        error: relative error e^{−2πδ/h} of the trapezoidal rule.
    """
    step = -2.0 * pi * angle / np.log(error)
    radii: Floats = np.exp(np.arange(np.log(lowest), np.log(highest), step))
    return radii


def memory_on_ray(
    beyond_limit: Complexes,
    limit: Floats,
    radii: Floats,
    angle: float,
    *,
    start: Floats,
    quickest: float,
    poles: Complexes,
    residues: Complexes,
) -> RadiationMemory:
    """Return the memory of H along a ray.

    Args:
        beyond_limit: H − a∞ at ω = |p| e^{−iδ}, shape (k, m, m).
        limit: a∞, shape (m, m).
        radii: |p|, 1/s, from `ray_radii`, shape (k,).
        angle: δ, rad.
        start: C = lim p K̂ for p → ∞, shape (m, m).
        quickest: β, 1/s, about the highest frequency of the bodies.
        poles: p of the resonances of the water between the imaginary axis and the ray, Im p > 0, shape (r,).
        residues: twice the residues of K̂ there, shape (r, m, m).
    """
    rates = radii * np.exp(1j * (0.5 * pi + angle))
    along = rates[:, None, None]
    # H at the conjugate of p = −iω is that at −ω̄.
    rest = along * (beyond_limit.conj() - start / ((along + quickest) * (along + 2.0 * quickest)))
    step = np.log(radii[1] / radii[0])
    return RadiationMemory(
        infinite_frequency_added_mass=limit,
        rates=np.concatenate([rates, [-quickest, -2.0 * quickest], poles]),
        weights=np.concatenate([-1j * step / pi * along * rest, [-start, 2.0 * start], residues]),
    )
