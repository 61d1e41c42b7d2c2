"""Dry modes of a rectangular plate by Ritz' method in Legendre polynomials, with any edge conditions.

    a(w, w) = ∫ w_xx² + w_yy² + 2ν w_xx w_yy + 2(1 − ν) w_xy²       on [−a/2, a/2] × [−b/2, b/2]

Free edges need no condition; at held ones the polynomials are combined so that w, w_n or both vanish.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, TypeAlias

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import eigh

from hydroelastic.modal.plate.legendre import edge_basis, gauss, legendre_table
from hydroelastic.physics.plate import Edge

AxisParity: TypeAlias = Literal[0, 1] | None
"""Even (0) or odd (1) about the middle of the plate along one axis, or both kinds (``None``)."""
ClassParity: TypeAlias = tuple[AxisParity, AxisParity]
"""Symmetry along x and along y."""


@dataclass(frozen=True, kw_only=True)
class RectangleModes:
    """Dry modes of a rectangle of unit flexural rigidity, w = Σ c_mn p_m(x) p_n(y), with ∫w² = 1."""

    size: tuple[float, float]  # its sides a and b
    stiffness: NDArray[np.float64]  # κ = a(w, w), ascending, exactly 0 of rigid motions, shape (modes,)
    coefficients: NDArray[np.float64]  # c in orthonormal Legendre polynomials of the sides, shape (modes, m, n)

    def deflection(self, x: NDArray[np.float64], y: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return all shapes at points, in coordinates from the centre, shape (modes, points)."""
        along, across = (
            polynomials_of(count, places, side)
            for count, places, side in zip(self.coefficients.shape[1:], (x, y), self.size, strict=True)
        )
        # Of one symmetry half of the polynomials along each side have no part.
        used = np.abs(self.coefficients).max(axis=0, initial=0.0) > 0.0
        first, second = np.nonzero(used)
        shapes: NDArray[np.float64] = self.coefficients[:, used] @ (along[first] * across[second])
        return shapes


def polynomials_of(count: int, places: NDArray[np.float64], side: float) -> NDArray[np.float64]:
    """Return Legendre polynomials that are orthonormal on a side, at coordinates from its middle, (count, places)."""
    # Places at the ends may miss them by rounding.
    return legendre_table(count, np.clip(2.0 * places / side, -1.0, 1.0)) * np.sqrt(2.0 / side)


def rectangle_modes(
    size: tuple[float, float],
    poisson_ratio: float,
    polynomials: int,
    *,
    edges: tuple[tuple[Edge, Edge], tuple[Edge, Edge]] = (("free", "free"), ("free", "free")),
    parities: ClassParity = (None, None),
) -> RectangleModes:
    """Return all Ritz modes of one symmetry.

    Args:
        size: the sides a and b.
        poisson_ratio: ν.
        polynomials: number of Legendre polynomials along each side, of both parities together.
        edges: what holds the edges at both ends of x and of y.
        parities: along x and along y; both kinds unless the two ends are held alike.
    """
    bases = [_of_parity(edge_basis(polynomials, pair), parity) for pair, parity in zip(edges, parities, strict=True)]
    (mass_x, slope_x, bend_x, mixed_x), (mass_y, slope_y, bend_y, mixed_y) = (
        _side_matrices(basis, side) for basis, side in zip(bases, size, strict=True)
    )
    stiffness = (
        np.kron(bend_x, mass_y) + np.kron(mass_x, bend_y) + 2.0 * (1.0 - poisson_ratio) * np.kron(slope_x, slope_y)
    )
    mixed = np.kron(mixed_x, mixed_y.T)
    stiffness += poisson_ratio * (mixed + mixed.T)
    rigid = _rigid_motions(stiffness, bases)
    # eigh is exact to rounding of the largest eigenvalue only, and so of the inverse: that of the softest mode. Scaled
    # to unit stiffness, the polynomials are nearly orthogonal in it.
    shift = 1.0 / max(size) ** 4
    shifted = stiffness + shift * np.eye(len(stiffness))
    scale = 1.0 / np.sqrt(np.diagonal(shifted))
    inverses, vectors = eigh(np.diag(scale**2), shifted * np.outer(scale, scale))
    vectors = scale[:, None] * vectors / np.sqrt(inverses)
    values = np.maximum(1.0 / inverses[::-1] - shift, 0.0)
    values[:rigid] = 0.0
    shapes = vectors.T[::-1].reshape(-1, len(bases[0]), len(bases[1]))
    return RectangleModes(
        size=size, stiffness=values, coefficients=np.einsum("sij,im,jn->smn", shapes, *bases, optimize=True)
    )


def _of_parity(basis: NDArray[np.float64], parity: AxisParity) -> NDArray[np.float64]:
    """The even or the odd ones of a basis, in polynomials of both parities."""
    if parity is None:
        return basis
    return basis[np.abs(basis[:, 1 - parity :: 2]).max(axis=1) == 0.0]


def _side_matrices(basis: NDArray[np.float64], side: float) -> tuple[NDArray[np.float64], ...]:
    """∫uv, ∫u'v', ∫u''v'' and ∫u''v over a side, for a basis in orthonormal polynomials of [−1, 1]."""
    count = basis.shape[1]
    points, weights = gauss(count)
    value, slope, bend = (basis @ legendre_table(count, points, order) * (2.0 / side) ** order for order in range(3))
    return tuple(
        (first * weights) @ second.T for first, second in ((value, value), (slope, slope), (bend, bend), (bend, value))
    )


def _rigid_motions(stiffness: NDArray[np.float64], bases: list[NDArray[np.float64]]) -> int:
    """Number of motions a + bx + cy that the edges allow: those of 1, x and y that the bases can make."""
    # Coefficients of 1 and x in a basis, and what of them the edges take away: nothing, or a part of order one.
    wanted = np.zeros((3, bases[0].shape[1], bases[1].shape[1]))
    wanted[0, 0, 0] = wanted[1, 1, 0] = wanted[2, 0, 1] = 1.0
    held = np.einsum("smn,im,jn->sij", wanted, *bases, optimize=True)
    overlap = np.einsum("sij,tij->st", held, held)
    return int(np.sum(np.linalg.eigvalsh(overlap) > 1.0 - 1e-8))
