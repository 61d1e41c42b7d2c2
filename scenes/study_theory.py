"""What theory expects of the error of a frequency, from the singularity of ψ at the ends of a beam.

With ψ ~ r^α, or r^α ln r, at the worst point, polynomials of degree p on n elements along each length give a relative
error of order (1/n)^q with

    q = min(2p, 2αβ)        on meshes graded like r_i = R (i/n)^β; β = 1 is a uniform mesh,

so that β > p/α brings the full order 2p. On geometric rings of ratio σ the error falls by a factor with each degree.
Along a ray it is ((1 + √σ)/(1 − √σ))²: r^α on σ < r < 1 is analytic but at r = 0, which lies on the Bernstein ellipse
of sum of half axes (1 + √σ)/(1 − √σ), and the error of a frequency is the square of that of ψ (W. Gui and I. Babuška,
Numer. Math. 49 (1986) 577). On triangles of a certain angle it is less, and falls slowly with the degree; what the best
polynomials leave on one ring says how much. See docs, theory of the aquarium, § 5.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import pi, sqrt

import numpy as np

from hydroelastic.fem.ring_approximation import remaining_energy
from hydroelastic.meshes.grading import Grading
from hydroelastic.scenes.models import TankScene
from hydroelastic.scenes.plan import sharpest_exponent
from hydroelastic.scenes.scaled_tank import scaled_tank

# How far β exceeds the p/α of theory: what is left of the first rings in the error then falls like (1/n)^{2α}.
# Measured: with 0.3 instead the order 4 of degree 2 still is 3.7 on the meshes where it is 3.9.
_MARGIN = 1.0


def singular_exponent(scene: TankScene) -> float | None:
    """α of the worst point of a scene; ``None`` where ψ is smooth.

    1 at a tip beside water with waves or a lid, 1/2 where ψ = 0 on the water, 2 where a free end meets a wall.
    """
    if not scene.body or any(beam.ends == "guided" for _, beam in scene.beams):
        return None
    if scene.floats:
        return sharpest_exponent(scaled_tank(scene), released=False)
    if sum(beam.length for _, beam in scene.beams) >= scene.tank.length * (1.0 - 1e-9):
        return 2.0
    return 0.5 if scene.top == "pressure_release" else 1.0


def expected_order(scene: TankScene, degree: int, grading: float = 1.0) -> float:
    """Order q of the frequencies with degree p on meshes graded with β; 1 is a uniform mesh."""
    alpha = singular_exponent(scene)
    return 2.0 * degree if alpha is None else min(2.0 * degree, 2.0 * alpha * grading)


def full_order_grading(scene: TankScene, degree: int) -> float:
    """β > p/α that brings the full order 2p.

    Raises:
        ValueError: where ψ is smooth: no grading is needed.
    """
    alpha = singular_exponent(scene)
    if alpha is None:
        raise ValueError("ψ is smooth: uniform meshes have the full order")
    return max(1.0, degree / alpha) + _MARGIN


def gain_along_a_ray(ring_ratio: float) -> float:
    """Factor by which each degree lowers the error of a frequency on rings of ratio σ: ((1 + √σ)/(1 − √σ))²."""
    root = sqrt(ring_ratio)
    return ((1.0 + root) / (1.0 - root)) ** 2


def expected_remainders(scene: TankScene, degrees: Sequence[int]) -> np.ndarray | None:
    """Relative errors of a frequency, up to a factor, that the geometric rings of our meshes leave with some degrees.

    Returns:
        One for each degree; ``None`` where ψ is smooth and rings are not what limits.
    """
    alpha = singular_exponent(scene)
    if alpha is None:
        return None
    # A tip at a wall has two sectors for a quarter of a disc, one elsewhere three for half of it.
    sector = pi / 4.0 if alpha == 2.0 else pi / 3.0
    left: np.ndarray = remaining_energy(Grading.ring_ratio, sector, alpha, max(degrees))[list(degrees)]
    return left
