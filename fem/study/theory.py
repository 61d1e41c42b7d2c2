"""Theoretical rates of convergence of frequencies, from the singularity of ψ at ends of beams and corners.

With ψ ~ r^α, or r^α ln r, at the sharpest singular point, polynomials of degree p on n elements along each length give
a relative error of order (1/n)^q with

    q = min(2p, 2αβ)        on meshes graded like r_i = R (i/n)^β; β = 1 is a uniform mesh,

so that β > p/α brings the full order 2p. On geometric rings of ratio σ the error falls by a factor with each degree.
Along a ray it is ((1 + √σ)/(1 − √σ))²: r^α on σ < r < 1 is analytic but at r = 0, which lies on the Bernstein ellipse
of sum of half axes (1 + √σ)/(1 − √σ), and the error of a frequency is the square of that of ψ (W. Gui and I. Babuška,
Numer. Math. 49 (1986) 577). On triangles of a given angle the factor is smaller, and decreases slowly with the degree;
it follows from the error of the best polynomials on one ring. See docs, theory of the aquarium, § 5.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import ceil, pi, sqrt

import numpy as np

from hydroelastic.fem.ring_approximation import remaining_energy
from hydroelastic.fem.study.singular_points import sharpest_of
from hydroelastic.meshes.grading import Grading
from hydroelastic.physics.symmetry import Parity
from hydroelastic.physics.tank import Tank

# Largest angle of the sectors of rings, rad.
_WIDEST_SECTOR = pi / 3.0


def expected_order(tank: Tank, degree: int, grading: float = 1.0, parity: Parity | None = None) -> float:
    """Return the order q of frequencies with degree p on meshes graded with β; 1 is a uniform mesh.

    β is that of the sharpest singular point; the others are graded for the same order.
    """
    alpha = sharpest_of(tank, parity if grading == 1.0 else None)
    return 2.0 * degree if alpha is None else min(2.0 * degree, 2.0 * alpha * grading)


def gain_along_a_ray(ring_ratio: float) -> float:
    """Return the factor by which each degree reduces the error on rings of ratio σ: ((1 + √σ)/(1 − √σ))²."""
    root = sqrt(ring_ratio)
    return ((1.0 + root) / (1.0 - root)) ** 2


def expected_remainders(tank: Tank, degrees: Sequence[int], parity: Parity | None = None) -> np.ndarray | None:
    """Return relative errors of a frequency, up to a common factor, on the geometric rings of the meshes."""
    alpha = sharpest_of(tank, parity)
    if alpha is None:
        return None
    # The liquid's angle is π/α; where ψ = 0 on one side it is half of that, and the sectors are nearly as wide.
    angle = pi / alpha
    sector = angle / ceil(angle / _WIDEST_SECTOR - 1e-6)
    left: np.ndarray = remaining_energy(Grading.ring_ratio, sector, alpha, max(degrees))[list(degrees)]
    return left
