"""Dry modes of a free polygonal plate by Ritz' method in polynomials of x and y.

    a(w, w) = ∫ w_xx² + w_yy² + 2ν w_xx w_yy + 2(1 − ν) w_xy²

Products of Legendre polynomials of the box around the polygon, up to a degree in x and y together, are made orthonormal
on the polygon. At corners of less than half a turn the modes are smooth enough for the error to fall like a high power
of the degree; at re-entrant ones it falls slowly, and the estimate of the error tells so.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import eigh, qr, solve_triangular

from hydroelastic.modal.plate.legendre import gauss, legendre_table


@dataclass(frozen=True, kw_only=True)
class PolygonModes:
    """Dry modes of a polygon of unit flexural rigidity, with ∫w² = 1.

    Attributes:
        middle: centre of the box around it, shape (2,).
        half: half its sides, shape (2,).
        degree: of the polynomials.
        coefficients: of the products of Legendre polynomials, by ascending degree, shape (modes, products).
        stiffness: κ = a(w, w), exactly 0 of the three rigid motions, which come first, shape (modes,).
        orthonormal: coefficients of the polynomials made orthonormal, by ascending degree, shape (products, products).
        bending: a between those, shape (products, products).
    """

    middle: NDArray[np.float64]
    half: NDArray[np.float64]
    degree: int
    coefficients: NDArray[np.float64]
    stiffness: NDArray[np.float64]
    orthonormal: NDArray[np.float64]
    bending: NDArray[np.float64]

    def deflection(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return all shapes at points (2, n), shape (modes, n)."""
        return np.asarray(
            self.coefficients @ _products(self.degree, (points - self.middle[:, None]) / self.half[:, None])
        )


def polygon_modes(corners: NDArray[np.float64], poisson_ratio: float, degree: int) -> PolygonModes:
    """Return all Ritz modes of a free plate.

    Args:
        corners: of the polygon, anticlockwise, shape (corners, 2).
        poisson_ratio: ν.
        degree: of the polynomials in x and y together.
    """
    low, high = corners.min(axis=0), corners.max(axis=0)
    middle, half = 0.5 * (low + high), 0.5 * (high - low)
    points, weights = polygon_quadrature(corners, degree + 1)
    local = (points - middle[:, None]) / half[:, None]
    values = _products(degree, local)
    # The first three columns are 1, x and y, so that the rigid motions are the first three orthonormal polynomials.
    _, triangle = qr((values * np.sqrt(weights)).T, mode="economic")
    xx, yy, xy = (
        solve_triangular(
            triangle, _products(degree, local, along, across) / (half[0] ** along * half[1] ** across), trans=1
        )
        for along, across in ((2, 0), (0, 2), (1, 1))
    )
    mixed = (xx * weights) @ yy.T
    bending = (xx * weights) @ xx.T + (yy * weights) @ yy.T + poisson_ratio * (mixed + mixed.T)
    bending += 2.0 * (1.0 - poisson_ratio) * (xy * weights) @ xy.T
    bending[:3] = bending[:, :3] = 0.0
    # Of the inverse problem the softest modes are the most exact.
    elastic = bending[3:, 3:]
    inverses, turn = eigh(np.eye(len(elastic)), elastic)
    vectors = np.zeros((len(bending), len(bending)))
    vectors[:3, :3] = np.eye(3)
    vectors[3:, 3:] = (turn / np.sqrt(inverses))[:, ::-1]
    orthonormal = solve_triangular(triangle, np.eye(len(triangle)))
    return PolygonModes(
        middle=middle,
        half=half,
        degree=degree,
        coefficients=(orthonormal @ vectors).T,
        stiffness=np.concatenate([np.zeros(3), 1.0 / inverses[::-1]]),
        orthonormal=orthonormal,
        bending=bending,
    )


def _products(degree: int, local: NDArray[np.float64], along: int = 0, across: int = 0) -> NDArray[np.float64]:
    """Products of Legendre polynomials up to a degree, or derivatives, at points of [−1, 1]², (products, points)."""
    first, second = legendre_table(degree + 1, local[0], along), legendre_table(degree + 1, local[1], across)
    return np.array([first[total - n] * second[n] for total in range(degree + 1) for n in range(total + 1)])


def polygon_quadrature(corners: NDArray[np.float64], count: int) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return points (2, n) and weights, exact for polynomials of degree 2·count − 2 on a polygon.

    Each triangle of it is the image of a square, one side of which becomes a corner.
    """
    reference, parts = gauss(count)
    u, v = 0.5 * (1.0 + reference[:, None]), 0.5 * (1.0 + reference[None, :])
    weight = 0.25 * np.outer(parts * u[:, 0], parts)
    points, weights = [], []
    for first, second, third in _triangles(corners):
        edge, other = second - first, third - second
        places = first[:, None, None] + edge[:, None, None] * u + other[:, None, None] * (u * v)
        points.append(places.reshape(2, -1))
        weights.append(weight.ravel() * abs(edge[0] * other[1] - edge[1] * other[0]))
    return np.concatenate(points, axis=1), np.concatenate(weights)


def _triangles(corners: NDArray[np.float64]) -> list[NDArray[np.float64]]:
    """Cut a polygon into triangles: ears with the largest smallest angle first."""
    left = [np.asarray(corner) for corner in corners]
    triangles = []
    while len(left) > 3:
        ears = [number for number in range(len(left)) if _is_ear(left, number)]
        best = max(ears, key=lambda number: _quality(left[number - 1], left[number], left[(number + 1) % len(left)]))
        triangles.append(np.array([left[best - 1], left[best], left[(best + 1) % len(left)]]))
        del left[best]
    return [*triangles, np.array(left)]


def _turn(first: NDArray[np.float64], second: NDArray[np.float64], third: NDArray[np.float64]) -> float:
    a, b = second - first, third - first
    return float(a[0] * b[1] - a[1] * b[0])


def _quality(first: NDArray[np.float64], second: NDArray[np.float64], third: NDArray[np.float64]) -> float:
    sides = sum(float(((a - b) ** 2).sum()) for a, b in ((first, second), (second, third), (third, first)))
    return _turn(first, second, third) / sides


def _is_ear(corners: list[NDArray[np.float64]], number: int) -> bool:
    first, second, third = corners[number - 1], corners[number], corners[(number + 1) % len(corners)]
    if _turn(first, second, third) <= 0.0:
        return False
    others = [corner for corner in corners if not any(corner is own for own in (first, second, third))]
    return not any(
        _turn(first, second, other) >= 0.0 and _turn(second, third, other) >= 0.0 and _turn(third, first, other) >= 0.0
        for other in others
    )
