"""Impulse response functions of radiation, as sums of decaying exponentials.

The force of the waves that bodies radiate on these is −a∞ ξ″ − ∫₀ᵗ K(t − u) ξ′(u) du (W. E. Cummins 1962). With p for
d/dt, H = a + i b/ω at p = −iω, and a∞ = lim H for p → ∞,

    K̂(p) = ∫₀^∞ K e^{−pt} dt = p (H(p) − a∞),      b(ω) = ∫ K cos ωt dt,   a(ω) = a∞ − (1/ω) ∫ K sin ωt dt

(T. F. Ogilvie 1964). Bromwich's integral of K̂ turned into the left half plane, to the rays arg p = ±θ, is by the
trapezoidal rule in ln |p|

    K(t) = Re Σ cₖ e^{pₖt},      pₖ = |pₖ| e^{iθ},      cₖ = −i (h/π) pₖ K̂(pₖ),

with an error e^{−2πδ/h} in a and b where K̂ is analytic within an angle δ of the ray. Poles of K̂ before it add
exponentials with twice their residues. The exponentials are states of
a linear system, and K(t) = 0 before t = 0 by construction. The ray ends at the highest frequency of H. What is beyond
it, K̂ ~ K(0)/p for p → ∞ among it, are exponentials by least squares, of H at real frequencies, of K(0) = (2/π) ∫ b dω
and of b beyond the last frequency.

Up to the highest frequency Ω the integral of b is one of H over the arc |ω| = Ω of the upper half plane, where H is
analytic: it misses no resonance of the water, however narrow,

    ∫₀^Ω b dω = −Im ∫ ωH dω   over the arc from Ω to iΩ.

Beyond Ω, b decays like ω^−q or faster, q = 2π/α − 1 where the hull meets the level at an angle α in the water: 3 for
the surge of a wall, less where the body is above the water; heave beside a wall decays exponentially. The power is
measured over the last half octave of the band; what the band without it gives tells the error.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from itertools import pairwise
from math import pi, sqrt
from typing import Any, TypeAlias

import numpy as np
import numpy.typing as npt

Floats: TypeAlias = npt.NDArray[np.float64]
Complexes: TypeAlias = npt.NDArray[np.complex128]

# Frequencies at which b beyond the last frequency Ω is fitted, over Ω, and the least error of it, relative to K(0).
_BEYOND, _LEAST_DOUBT = np.geomspace(1.05, 100.0, 60), 1e-6

# Gauss points of the arc, which are closer to each other near the real axis.
_POINTS = 64
# Least and largest ratio of the integrals over successive half octaves: of slower decay, q < 1.5, the integral beyond Ω
# is not known.
_FASTEST, _SLOWEST = 1e-3, 0.85
# Power of 1/ω below which it hardly matters how far the mesh goes.
_HOPELESS = 2.0
# Part of what lies beyond Ω that is uncertain in any case.
_UNCERTAIN = 0.02
# From this multiple of 1/Ω on the error of K by what lies beyond Ω falls with the square of time: B and what stands for
# it beyond Ω agree at Ω.
_LATE = 3.0


@dataclass(frozen=True, kw_only=True)
class DampingTail:
    """B of m motions beyond Ω, SI units."""

    highest: float  # Ω, rad/s
    within: Floats  # (2/π) ∫₀^Ω B dω, shape (m, m)
    beyond: Floats  # (2/π) ∫_Ω^∞ B dω, shape (m, m)
    powers: Floats  # q, shape (m,)
    sizes: Floats  # diagonal of K(0), or what is negligible beside it, shape (m,)
    error: Floats  # estimated error of the diagonal of `beyond`, relative to these, shape (m,)
    has_peaks: bool  # whether resonances of the water go on beyond Ω

    @property
    def start(self) -> Floats:
        """K(0), shape (m, m)."""
        whole: Floats = self.within + self.beyond
        return whole

    @property
    def is_slow(self) -> bool:
        """Whether B decays too slowly for higher frequencies of the mesh to matter."""
        return bool((self.powers < _HOPELESS).any())

    def damping(self, omega: Floats) -> Floats:
        """B by the power law at ω > Ω, shape (n,): shape (n, m, m)."""
        q = 0.5 * (self.powers[:, None] + self.powers)
        law: Floats = 0.5 * pi * (q - 1.0) / self.highest * self.beyond * (omega[:, None, None] / self.highest) ** -q
        return law

    def errors(self, times: Floats) -> Floats:
        """Error of K by it at times, relative to K(0), shape (n,)."""
        late = np.maximum(times * self.highest / _LATE, 1.0)
        error: Floats = self.error.max() * (np.ones_like(times) if self.has_peaks else late**-2)
        return error


@dataclass(frozen=True, kw_only=True)
class RadiationMemory:
    """K of m motions as k exponentials, SI units."""

    infinite_frequency_added_mass: Floats  # a∞, shape (m, m)
    rates: Complexes  # p, 1/s, with Re p < 0 and Im p ≥ 0, shape (k,)
    weights: Complexes  # c, shape (k, m, m)

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

    def completed(
        self,
        omega: Floats,
        hydrodynamic: Complexes,
        rates: Complexes,
        tail: DampingTail,
        errors: tuple[float, float],
    ) -> RadiationMemory:
        """Return the memory with what it lacks of H at real frequencies, of K(0) and of b beyond the last frequency, as
        further exponentials, by least squares.

        Each of these is weighed by its error, and weights far above K(0), which would cancel each other, cost as much.
        """
        unit, count = tail.highest, len(rates)
        beyond = unit * _BEYOND

        def columns(frequencies: Floats) -> Complexes:
            upper, lower = (0.5 * unit / (-1j * frequencies[:, None] - own) for own in (rates, rates.conj()))
            found: Complexes = np.hstack([upper + lower, 1j * (upper - lower)])
            return found

        # Per K(0) and in units of Ω; the last unknown is the error of a∞.
        known = np.hstack([1j * unit / omega[:, None] * columns(omega), np.ones((len(omega), 1))])
        damped = np.hstack([columns(beyond).real, np.zeros((len(beyond), 1))])
        at_start = np.concatenate([np.ones(count), np.zeros(count + 1)])[None]
        of_h = unit**2 * (hydrodynamic - self.hydrodynamic(omega))
        of_b = unit * (tail.damping(beyond) - self.radiation_damping(beyond))
        of_start = tail.start - self.weights.sum(axis=0).real
        limit, starts = self.infinite_frequency_added_mass, tail.sizes
        sizes, limits = (unit * motion_sizes(h, limit, tail) for h in (hydrodynamic, limit[None]))
        found = np.zeros((2 * count + 1, *of_start.shape))
        for i, j in np.ndindex(of_start.shape):
            scale = sqrt(starts[i] * starts[j])
            whole, least = (size[:, i] * size[:, j] / scale for size in (sizes, limits))
            doubt = sqrt(tail.error[i] * tail.error[j]) + _LEAST_DOUBT
            rows: list[tuple[Floats, npt.NDArray[Any], Floats | float]] = [
                (known.real, of_h[:, i, j].real / scale, errors[0] * whole),
                (known.imag, of_h[:, i, j].imag / scale, errors[0] * whole),
                (damped, of_b[:, i, j] / scale, doubt),
                (at_start, of_start[None, i, j] / scale, doubt),
                (np.eye(2 * count, 2 * count + 1), np.zeros(2 * count), 1.0),
                (np.eye(1, 2 * count + 1, 2 * count), np.zeros(1), errors[1] * least),
            ]
            matrix, wanted = (
                np.concatenate(parts)
                for parts in zip(*((a / np.reshape(e, (-1, 1)), b / e) for a, b, e in rows), strict=True)
            )
            found[:, i, j] = scale * np.linalg.lstsq(matrix, wanted, rcond=None)[0]
        return RadiationMemory(
            infinite_frequency_added_mass=self.infinite_frequency_added_mass + found[-1] / unit**2,
            rates=np.concatenate([self.rates, rates]),
            weights=np.concatenate([self.weights, found[:count] + 1j * found[count:-1]]),
        )


def damping_tail(
    hydrodynamic: Callable[[Complexes], Complexes],
    highest: float,
    negligible: Floats,
    least_powers: Floats,
    *,
    has_peaks: bool,
) -> DampingTail:
    """Return B beyond the highest frequency."""
    nodes, gauss = np.polynomial.legendre.leggauss(_POINTS)
    places = 0.5 * (nodes + 1.0)
    angles, weights = 0.5 * pi * places**2, 0.5 * pi * places * gauss

    def integral(omega: float) -> Floats:
        along = omega * np.exp(1j * angles)
        summed = np.tensordot(1j * along**2 * weights, hydrodynamic(along), axes=1)
        return -np.asarray(summed.imag, dtype=float)

    integrals = [integral(highest * 2.0 ** (0.5 * half)) for half in (-3, -2, -1, 0)]
    halves = np.diff(np.array(integrals), axis=0)
    parts = np.maximum(np.einsum("cii->ci", halves), 0.0)
    before, last = (
        np.clip(later / np.where(earlier > 0.0, earlier, np.inf), _FASTEST, _SLOWEST)
        for earlier, later in pairwise(parts)
    )
    slowest = 2.0 ** (0.5 * (1.0 - least_powers))
    previous, ratios = np.minimum(before, slowest), np.minimum(last, slowest)
    # Of the geometric series of half octaves; positive semidefinite as B is.
    factor = ratios / (1.0 - ratios)
    within, beyond = 2.0 / pi * integrals[-1], 2.0 / pi * np.sqrt(np.outer(factor, factor)) * halves[-1]
    sizes = np.maximum(np.diag(within + beyond), negligible)
    # The same from half an octave less was off by this, and it converges as fast as B decays.
    change = parts[-1] * (1.0 + factor) - parts[-2] * previous / (1.0 - previous)
    doubt: Floats = (
        np.abs(change) * np.minimum(factor, 1.0) + np.where(ratios < _SLOWEST, _UNCERTAIN, 1.0) * factor * parts[-1]
    )
    return DampingTail(
        highest=highest,
        within=within,
        beyond=beyond,
        powers=1.0 - 2.0 * np.log2(ratios),
        sizes=sizes,
        error=np.minimum(2.0 / pi * doubt / sizes, 1.0),
        has_peaks=has_peaks,
    )


def ray_radii(lowest: float, highest: float, angle: float, error: float) -> Floats:
    """|p| of the nodes of a ray."""
    step = -2.0 * pi * angle / np.log(error)
    radii: Floats = np.exp(np.arange(np.log(lowest), np.log(highest), step))
    return radii


def memory_on_ray(
    beyond_limit: Complexes, limit: Floats, radii: Floats, angle: float, *, poles: Complexes, residues: Complexes
) -> RadiationMemory:
    """Return the memory of H along a ray, up to its end."""
    rates = radii * np.exp(1j * (0.5 * pi + angle))
    step = np.log(radii[1] / radii[0])
    # H at the conjugate of p = −iω is that at −ω̄.
    weights = -1j * step / pi * rates[:, None, None] ** 2 * beyond_limit.conj()
    return RadiationMemory(
        infinite_frequency_added_mass=limit,
        rates=np.concatenate([rates, poles]),
        weights=np.concatenate([weights, residues]),
    )


def motion_sizes(hydrodynamic: Complexes | Floats, limit: Floats, tail: DampingTail) -> Floats:
    """Return square roots of |H| of each motion at each frequency, at least of a∞ and K(0)/Ω², shape (n, m).

    Over a bed b/ω of long waves has no bound: what is small beside the largest |H| may be large beside H.
    """
    least = np.maximum(np.diag(limit), tail.sizes / tail.highest**2)
    sizes: Floats = np.sqrt(np.maximum(np.abs(np.einsum("nii->ni", hydrodynamic)), least))
    return sizes
