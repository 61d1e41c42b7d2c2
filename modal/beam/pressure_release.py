"""Added mass with ψ = 0 on the water around the beam: the limit of frequencies far above the gravity waves."""

from __future__ import annotations

import functools
import math
from dataclasses import replace

import numpy as np
from numpy.polynomial.legendre import leggauss

from hydroelastic.modal.beam.dry_modes import free_free_shapes
from hydroelastic.modal.beam.floating_beam import FloatingBeam
from hydroelastic.modal.estimate import NoEstimateError
from hydroelastic.physics.arrays import FloatArray

MOST_TERMS = 420
"""Above this length of the expansion the gap or the depth is refused as too small against the beam."""

_DIGITS = 34.0
_MOST_DEPTH_TERMS = 40_000


def pressure_release_added_mass(
    beam: FloatingBeam, count: int, terms: int | None = None, *, most: int = MOST_TERMS
) -> FloatArray:
    """Return the added-mass matrix of dry shapes when ψ = 0 on the free surface (`ChebPsi0`).

    With x = x_c + a t and ψ = Σ c_j √(1−t²) U_j(t) under the beam,

        m = ρ bᵀ G⁻¹ b / l,   b_ji = a ∫ W_i √(1−t²) U_j dt,
        G_ij = (j+1)(π/2) δ_ij + a² ∫∫ ψ_i [ −(π/4L²)(1/sin²(u/2) − 4/u² + 1/sin²(v/2))
                                           + (2/L) Σ k (tanh kH − 1) cos kx cos kx' ] ψ_j,

    u = π(x−x')/L, v = π(x+x')/L. It converges exponentially. A beam that touches a wall is half of a symmetric beam
    across that wall, so only even j are kept on the doubled interval; a slope at the wall is then a kink, the error
    falls like terms⁻⁴ only, and one Richardson step (terms, 2·terms) removes it.

    Args:
        beam: the problem; some surface must be free.
        count: number of shapes of `free_free_shape`, heave and pitch included.
        terms: length of the expansion; if ``None``, from the gaps, the depth and ``count``, so that it is right to
            rounding unless the beam touches a wall.

    Returns:
        Added mass per length for ∫W² dz = l, kg/m², shape (count, count), symmetric positive definite.

    Source: theory of the aquarium, docs, § 2 (psi0) and § 3 (method D).
    """
    if beam.covers_tank:
        raise NoEstimateError("no surface is free where the pressure could be released")
    wanted = _terms_needed(beam, count) if terms is None else terms
    longest = 2 * wanted if beam.touches_wall else wanted
    if longest > most:
        raise NoEstimateError(f"{longest} terms would be needed for the gap or the depth; at most {most} are used")
    if _depth_terms(beam) > _MOST_DEPTH_TERMS:
        raise NoEstimateError("the water is too shallow against the length of the tank for the cosine series")
    # What does not touch the liquid is left out of the key of the cache.
    alike = replace(beam.dimensionless(), flexural_rigidity=1.0, mass_per_length=1.0, hydrostatic=True)
    added = dimensionless_added_mass(alike, count, wanted)
    if beam.touches_wall:
        finer = dimensionless_added_mass(alike, count, 2 * wanted)
        added = finer + (finer - added) / 15
    return beam.density * beam.length * added


def _terms_needed(beam: FloatingBeam, count: int) -> int:
    """Bernstein-ellipse estimate: the nearest singularities are the depth image and the wall image of the beam."""
    half = beam.length if beam.touches_wall else beam.length / 2
    gaps = [gap for gap in (beam.left_gap, beam.right_gap) if gap > 0]
    image = 2 * min(gaps) / half
    rate = min(math.asinh(2 * beam.depth / half), math.acosh(1 + image))
    return math.ceil(_DIGITS / (2 * rate) + 12 + 1.7 * count) + (32 if beam.touches_wall else 0)


def _depth_terms(beam: FloatingBeam) -> int:
    """Return after how many cosines 1 − tanh k_n H is below rounding."""
    return math.ceil(20 * beam.tank_length / (math.pi * beam.depth)) + 1


def _mirrored(beam: FloatingBeam) -> tuple[float, float, bool]:
    """Return centre and half-width of the expansion interval, and whether it is doubled across a wall at x = 0."""
    if beam.touches_wall:
        return 0.0, beam.length, True
    return beam.start + beam.length / 2, beam.length / 2, False


@functools.lru_cache(maxsize=4)
def dimensionless_added_mass(beam: FloatingBeam, count: int, terms: int) -> FloatArray:
    """Return the added mass of a dimensionless problem; EI, m and hydrostatics do not enter."""
    centre, half, doubled = _mirrored(beam)
    orders, angle, expansion = _expansion(terms, doubled)
    share = 0.5 if doubled else 1.0
    kernel = _regular_kernel(beam, centre + half * np.cos(angle), doubled)
    weights = share * (orders + 1) * np.pi / 2
    system = np.diag(weights) + (share * half) ** 2 * expansion @ kernel @ expansion.T
    load = half * (_half_loads(beam, count, orders) if doubled else _loads(terms, count))
    added: FloatArray = load.T @ np.linalg.solve(system, load)
    return (added + added.T) / 2


@functools.lru_cache(maxsize=16)
def _expansion(terms: int, doubled: bool) -> tuple[np.ndarray, FloatArray, FloatArray]:
    """Orders j, angles φ of the points, and √(1−t²) U_j there times their weights, shape (terms, points)."""
    orders = np.arange(0, 2 * terms, 2) if doubled else np.arange(terms)
    points = int(orders[-1]) + 33
    angle = np.arange(1, points + 1) * np.pi / (points + 1)
    # √(1−t²) U_j = sin (j+1)φ, and dt = sin φ dφ: the Gauss rule of the second kind.
    return orders, angle, np.sin(np.outer(orders + 1, angle)) * np.sin(angle) * (np.pi / (points + 1))


@functools.lru_cache(maxsize=16)
def _loads(terms: int, count: int) -> FloatArray:
    """Return ∫ W_i √(1−t²) U_j dt over a beam between free water, shape (terms, count)."""
    _, angle, expansion = _expansion(terms, doubled=False)
    # The rule has points enough for the shapes too, as the number of terms grows with theirs.
    loads: FloatArray = expansion @ free_free_shapes(count, (1 + np.cos(angle)) / 2).T
    return loads


def _half_loads(beam: FloatingBeam, count: int, orders: np.ndarray) -> FloatArray:
    """Return ∫ W_i √(1−t²) U_j dt over a beam at a wall, shape (terms, count), by Gauss–Legendre points in the
    angle."""
    nodes, weights = leggauss(2 * len(orders) + 2 * count + 32)
    angle = np.pi / 4 * (nodes + 1)
    t = np.cos(angle)
    shapes = free_free_shapes(count, t if beam.left_gap == 0 else 1 - t)
    loads: FloatArray = (np.sin(np.outer(orders + 1, angle)) * np.sin(angle) * weights * np.pi / 4) @ shapes.T
    return loads


def _regular_kernel(beam: FloatingBeam, x: FloatArray, doubled: bool) -> FloatArray:
    length = beam.tank_length
    u = np.pi * (x[:, None] - x[None, :]) / length
    kernel = _inverse_square_difference(u)
    image = kernel if doubled else 1 / np.sin(np.pi * (x[:, None] + x[None, :]) / (2 * length)) ** 2
    kernel = kernel + image
    kernel = -np.pi / (4 * length**2) * kernel
    wavenumbers = np.arange(1, _depth_terms(beam) + 1) * np.pi / length
    factors = 2 / length * wavenumbers * (-2) / (np.exp(np.minimum(2 * wavenumbers * beam.depth, 700.0)) + 1)
    waves = np.cos(np.outer(x, wavenumbers))
    regular: FloatArray = kernel + (waves * factors) @ waves.T
    return regular


def _inverse_square_difference(u: FloatArray) -> FloatArray:
    """Return 1/sin²(u/2) − 4/u², by its series where the two cancel."""
    small = np.abs(u) < 0.05
    safe = np.where(small, 1.0, u)
    square = u * u
    series = 1 / 3 + square * (1 / 60 + square * (1 / 1512 + square / 43200))
    difference: FloatArray = np.where(small, series, 1 / np.sin(safe / 2) ** 2 - 4 / (safe * safe))
    return difference
