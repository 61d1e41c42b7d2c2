"""Orthonormal Legendre polynomials on an interval, and their combinations that satisfy edge conditions."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from hydroelastic.physics.plate import Edge

# Essential conditions: which derivatives of w vanish. A free edge has none.
_VANISHING: dict[Edge, tuple[int, ...]] = {"free": (), "hinged": (0,), "clamped": (0, 1), "sliding": (1,)}


def legendre_table(count: int, points: NDArray[np.float64], derivative: int = 0) -> NDArray[np.float64]:
    """Return √(n + ½) P_n or a derivative of it at points of [−1, 1], shape (count, points)."""
    coefficients = np.polynomial.legendre.legder(np.diag(np.sqrt(np.arange(count) + 0.5)), derivative, axis=0)
    return np.asarray(np.polynomial.legendre.legval(points, coefficients), dtype=np.float64)


@lru_cache(maxsize=64)
def gauss(count: int) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return the points and weights of Gauss' quadrature on [−1, 1]; not to be written to."""
    points, weights = np.polynomial.legendre.leggauss(count)
    return points, weights


def edge_basis(count: int, edges: tuple[Edge, Edge]) -> NDArray[np.float64]:
    """Return orthonormal combinations of the first polynomials that satisfy the conditions at −1 and 1.

    Returns:
        Their coefficients as rows, shape (count − conditions, count), with those that do not bend first: the constant
        and the straight line, as far as the edges allow them. Even and odd ones are apart where the edges are alike.
    """
    rows = [
        legendre_table(count, np.array([place]), derivative)[:, 0]
        for place, edge in zip((-1.0, 1.0), edges, strict=True)
        for derivative in _VANISHING[edge]
    ]
    if not rows:
        return np.eye(count)
    if edges[0] != edges[1]:
        return _null_space(np.array(rows))
    # Conditions on even polynomials are the sums, on odd ones the differences.
    both = np.array(rows).reshape(2, -1, count)
    parts = []
    for parity in (0, 1):
        own = _null_space(both[1][:, parity::2])
        parts.append(np.zeros((len(own), count)))
        parts[-1][:, parity::2] = own
    return np.concatenate(parts)


def _null_space(rows: NDArray[np.float64]) -> NDArray[np.float64]:
    scaled = rows / np.linalg.norm(rows, axis=1)[:, None]
    basis, _ = np.linalg.qr(scaled.T, mode="complete")
    return np.asarray(basis[:, len(rows) :].T)
