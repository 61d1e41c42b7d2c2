"""Poles of the depth: the liquid under a level surface over a level bed as a few problems on the plan.

In an upright tank with a level bed ψ separates in z. On the still surface a flux ζ of wavenumber k gives

    ψ = f(k²) ζ,    f(k²) = 1/(k tanh kH) = 1/(H k²) + (2/H) Σ_m 1/(k² + (mπ/H)²)        (a Stieltjes function of k²)

Galerkin's method in depth, with the constant and a few profiles cosh κ_j(z + H), gives

    f(k²) ≈ Σ_j c_j/(k² + d_j),    c_j > 0,  d_0 = 0 < d_1 < …

It is exact to first order at each κ_j and never exceeds f, so that frequencies stay upper bounds. The wavenumbers κ_j
are in geometric progression, from the depth's to that beyond which a jump of ζ has no more energy than the tolerance:
nothing is fitted.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from math import ceil, log, pi, sqrt

import numpy as np

from hydroelastic.physics.arrays import FloatArray

# κ₁H at least, for below it f is 1/(Hk²) + H/3; and κ₁ in lowest wavenumbers of the plan.
_LONGEST, _OF_LOWEST = 1.5, 0.7
# The last κ in wavenumbers of interest, times √tolerance.
_SHORTEST = 0.12
_MOST_POLES = 48
_SAMPLES = 800
# Vertical eigenfunctions that are kept one by one; beyond them, as many again are replaced by a few, this often.
_EIGENFUNCTIONS, _REPLACED_BY, _DOUBLINGS = 64, 10, 28


@dataclass(frozen=True, kw_only=True)
class VerticalPoles:
    """f(k²) ≈ Σ c_j/(k² + d_j) for one depth."""

    weights: FloatArray  # c_j, positive; the first one is 1/H
    shifts: FloatArray  # d_j, ascending; the first one is 0
    wavenumber: float  # k_w of the shortest wave of interest
    error: float  # ε, with f − Σ c_j/(k² + d_j) ≤ ε (1 + (k/k_w)²) f for all k from the lowest one on

    def values(self, wavenumbers: FloatArray) -> FloatArray:
        """Return Σ c_j/(k² + d_j) for some k > 0, shape (k,)."""
        sums: FloatArray = (self.weights / (wavenumbers[:, None] ** 2 + self.shifts)).sum(axis=1)
        return sums


def surface_response(wavenumbers: FloatArray, depth: float) -> FloatArray:
    """Return f = 1/(k tanh kH), the ψ of a unit flux through the still surface, for some k > 0."""
    response: FloatArray = 1.0 / (wavenumbers * np.tanh(wavenumbers * depth))
    return response


@lru_cache(maxsize=32)
def vertical_poles(depth: float, wavenumber: float, tolerance: float, *, lowest: float) -> VerticalPoles:
    """Return as many poles as a tolerance needs, or those of the smallest error that double precision allows.

    Args:
        depth: H.
        wavenumber: k_w of the shortest wave of interest. Beyond it the relative error may grow like (k/k_w)², for the
            energy of a jump of ζ in wavenumbers beyond k falls like k⁻².
        tolerance: largest ε that is accepted.
        lowest: the smallest wavenumber of the plan, but for its constant.
    """
    waves = max(wavenumber * depth, 1.0)
    bottom = max(_LONGEST, _OF_LOWEST * lowest * depth)
    top = max(waves, bottom) * max(_SHORTEST / sqrt(tolerance), 3.0)
    # Beyond the last sample the relative error is nearly one, and its bound grows.
    samples = np.geomspace(lowest * depth, 1e3 * top, _SAMPLES)
    exact = surface_response(samples, 1.0)
    allowed = exact * (1.0 + (samples / waves) ** 2)
    # Newman's rate for one over a root: the logarithm of the range times that of the error.
    first = max(2, ceil(log(top / bottom) * log(1.0 / tolerance) / pi**2) - 2)
    best: VerticalPoles | None = None
    for count in range(first, _MOST_POLES):
        weights, shifts = _compressed(np.geomspace(bottom, top, count))
        error = float(np.abs((exact - (1.0 / (samples[:, None] ** 2 + shifts)) @ weights) / allowed).max())
        if best is None or error < best.error:
            best = VerticalPoles(
                weights=weights / depth, shifts=shifts / depth**2, wavenumber=waves / depth, error=error
            )
        if error <= tolerance:
            break
    assert best is not None
    return best


def _compressed(wavenumbers: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Galerkin's method in the constant and the profiles of some wavenumbers, for unit depth: c_j and d_j.

    In vertical eigenfunctions, A = diag((mπ)²), and the profile of κ is (A + κ²)⁻¹ times the load. With a basis Q
    orthonormal in A + 1, the eigenvalues of QᵀQ are 1/(d + 1), largest for the smallest d.
    """
    squares, parts = _eigenfunctions()
    roots = np.sqrt(squares + 1.0)
    profiles = (np.sqrt(parts) * roots)[:, None] / (squares[:, None] + wavenumbers**2)
    basis, _ = np.linalg.qr(profiles / np.linalg.norm(profiles, axis=0))
    inverses, turn = np.linalg.eigh(basis.T @ (basis / (squares + 1.0)[:, None]))
    loads = turn.T @ (basis.T @ (np.sqrt(parts) / roots))
    weights, shifts = (loads**2 / inverses)[::-1], (1.0 / inverses - 1.0)[::-1]
    return np.concatenate([[1.0], weights]), np.concatenate([[0.0], shifts])


@lru_cache(maxsize=1)
def _eigenfunctions() -> tuple[FloatArray, FloatArray]:
    """(mπ)² and the weight 2 of the vertical eigenfunctions of unit depth, the higher ones replaced by fewer.

    The N integers from N + 1 to 2N are replaced by the nodes of Gauss' quadrature for sums over them, whose error is
    that of polynomials of degree 2n − 1: 5.8⁻²ⁿ. Their recurrence has β_k = k² (N² − k²)/(4 (4k² − 1)) (discrete
    Chebyshev polynomials, Gautschi, Orthogonal Polynomials, 2004, § 1.4).
    """
    numbers: list[FloatArray] = [np.arange(1.0, _EIGENFUNCTIONS + 1)]
    weights: list[FloatArray] = [np.full(_EIGENFUNCTIONS, 2.0)]
    order = np.arange(1.0, _REPLACED_BY)
    for doubling in range(_DOUBLINGS):
        count = float(_EIGENFUNCTIONS * 2**doubling)
        beside = np.sqrt(order**2 * (count**2 - order**2) / (4.0 * (4.0 * order**2 - 1.0)))
        nodes, vectors = np.linalg.eigh(np.diag(beside, 1) + np.diag(beside, -1))
        numbers.append(1.5 * count + 0.5 + nodes)
        weights.append(2.0 * count * vectors[0] ** 2)
    return (pi * np.concatenate(numbers)) ** 2, np.concatenate(weights)
