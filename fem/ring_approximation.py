"""How well polynomials resolve a singularity on a ring of triangles around it.

On the triangles between two rings, r = σ and 1, the gradient of ψ = Re z^α, or Re z^α ln z where α is whole, with
z = x + iy, is written in orthonormal polynomials. The energy that those of degree p − 1 leave is a lower bound of what
ψ of degree p leaves. In the end the error falls by a factor ρ² a degree: a triangle of barycentric coordinates λ has

    ρ = t + √(t² − 1),    t = min Σ|λ_j|    on the complex lines x ± iy = 0, where ψ is singular

(the extremal function of a simplex, by Baran; see L. Bos, J.-P. Calvi and N. Levenberg, Ark. Mat. 39 (2001) 245). For
σ = 0.3 and sectors of 60° ρ² is 6.4, for 45° 8.0, and on the ray alone, a sector of no angle, 11.7.
"""

from __future__ import annotations

import basix
import numpy as np

from hydroelastic.meshes.grading import TipRings

# Number of further degrees that hold the remainder up to a few per cent.
_BEYOND = 12


def remaining_energy(ratio: float, sector: float, exponent: float, highest: int) -> np.ndarray:
    """Energy of r^α that polynomials leave on the triangles of one ring."""
    ring = TipRings(centre=0.0, radii=np.array([ratio, 1.0]), angles=np.array([0.0, sector]))
    # Behind the fan of the innermost ring, which is one triangle a sector.
    corners = ring.nodes()[ring.triangles()[1:]]
    degrees = highest + _BEYOND
    points, weights = basix.make_quadrature(basix.CellType.triangle, 2 * degrees + 10)
    polynomials = basix.tabulate_polynomials(basix.PolynomialType.legendre, basix.CellType.triangle, degrees, points)
    # Ordered by degree: degree k has k + 1 polynomials.
    degree_of = np.repeat(np.arange(degrees + 1), np.arange(1, degrees + 2))
    energy = np.zeros(degrees + 1)
    for first, second, third in corners:
        edges = np.array([second - first, third - first])
        x, y = (first + points @ edges).T
        z = x + 1j * y
        slope = z ** (exponent - 1.0) * (np.log(z) if exponent == round(exponent) else 1.0)
        parts = np.abs(polynomials @ (weights * slope)) ** 2
        energy += abs(np.linalg.det(edges)) * np.bincount(degree_of, weights=parts)
    left: np.ndarray = np.cumsum(energy[::-1])[::-1]
    return left[: highest + 1]
