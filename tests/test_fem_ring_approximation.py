"""What polynomials leave of a singularity on a ring of triangles falls as the theory of extremal functions says."""

from __future__ import annotations

from math import cos, pi, sin, sqrt

import numpy as np
import pytest
from scipy.optimize import minimize

from hydroelastic.fem.ring_approximation import remaining_energy
from hydroelastic.fem.study.theory import gain_along_a_ray


def limit_of_triangles(ratio: float, sector: float) -> float:
    """ρ² of a ring's worse triangle: ρ = t + √(t² − 1), t the smallest Σ|λ_j| on the complex line y = i x."""
    inner, outer = ratio * np.eye(2), np.eye(2)
    rays = np.array([[1.0, 0.0], [cos(sector), sin(sector)]])
    squares = []
    for corners in ([rays[0] @ inner, rays[0] @ outer, rays[1] @ outer], [rays[0] @ inner, rays[1], rays[1] @ inner]):
        barycentric = np.linalg.inv(np.vstack([np.transpose(corners), np.ones(3)]))

        def total(s: np.ndarray, barycentric: np.ndarray = barycentric) -> float:
            point = complex(s[0], s[1])
            return float(np.abs(barycentric @ np.array([point, 1j * point, 1.0])).sum())

        # The sum of moduli of linear functions is convex: any start finds its minimum.
        t = minimize(total, [0.3, 0.2], method="Nelder-Mead", options={"xatol": 1e-10, "fatol": 1e-12}).fun
        squares.append((t + sqrt(t * t - 1.0)) ** 2)
    return min(squares)


@pytest.mark.parametrize(("ratio", "degrees"), [(0.3, 60.0), (0.3, 45.0), (0.15, 60.0)])
@pytest.mark.parametrize("exponent", [0.5, 1.0])
def test_gains_tend_to_the_extremal_function_of_the_triangles(ratio: float, degrees: float, exponent: float) -> None:
    left = remaining_energy(ratio, degrees * pi / 180.0, exponent, 21)
    gain = left[:-1] / left[1:]
    # Slowly, for a power of p stands before the exponential: gain = ρ² (1 + c/p + …); two degrees take c out.
    # Measured within 1.5 %.
    assert (20.0 * gain[20] - 10.0 * gain[10]) / 10.0 == pytest.approx(
        limit_of_triangles(ratio, degrees * pi / 180), rel=0.03
    )


def test_thin_sectors_gain_what_a_ray_does() -> None:
    # ((1 + √0.3)/(1 − √0.3))²
    assert gain_along_a_ray(0.3) == pytest.approx(11.7105, rel=1e-5)
    assert limit_of_triangles(0.3, 1e-4) == pytest.approx(gain_along_a_ray(0.3), rel=1e-3)
    # The sectors of the tank meshes.
    assert limit_of_triangles(0.3, pi / 3) == pytest.approx(6.4, abs=0.05)
    assert limit_of_triangles(0.3, pi / 4) == pytest.approx(8.0, abs=0.05)
