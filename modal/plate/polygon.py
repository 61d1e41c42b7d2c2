"""Dry modes of a free polygonal plate by Ritz' method in polynomials and the singular functions of its corners.

    a(w, w) = ∫ w_xx² + w_yy² + 2ν w_xx w_yy + 2(1 − ν) w_xy²

Products of Legendre polynomials of the box around the polygon, up to a degree in x and y together, and
`corner_functions` are made orthonormal on the polygon. Convex or not, the error falls exponentially with the degree:
that of the first frequency of a free square is 1e-7 at degree 8 and 1e-10 at 12, of an L 3e-7 and 1e-8.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import lru_cache
from itertools import product

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import eigh, qr, solve_triangular

from hydroelastic.modal.plate.corner_functions import CornerFunction, corner_functions
from hydroelastic.modal.plate.legendre import gauss, legendre_table
from hydroelastic.modal.plate.rectangle import AxisParity
from hydroelastic.physics.plate import Point, Polygon

# r = uᵍ from a corner: r^{2λ − 2} r dr of λ > 1/2 becomes u^{2g λ − 1} du.
_CORNER_POWER = 4
# Of a function's norm, the part that others of the basis may leave of it.
_INDEPENDENT = 1e-10
# Areas below this part of a triangle's longest side squared are rounding.
_NEGLIGIBLE = 1e-12


@dataclass(frozen=True, kw_only=True)
class PolygonModes:
    """Dry modes of a polygon of unit flexural rigidity, with ∫w² = 1."""

    basis: PolygonBasis  # the functions of which the modes consist
    coefficients: NDArray[np.float64]  # of the functions, shape (modes, functions)
    rigid: int  # number of rigid motions, which come first
    stiffness: NDArray[np.float64]  # κ = a(w, w), exactly 0 of the rigid motions, shape (modes,)
    # coefficients of the functions made orthonormal one after the other, shape (functions, functions)
    orthonormal: NDArray[np.float64]
    bending: NDArray[np.float64]  # a between those, shape (functions, functions)

    def deflection(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return all shapes at points (2, n), shape (modes, n)."""
        return np.asarray(self.coefficients @ self.basis.values(points))


@dataclass(frozen=True, kw_only=True)
class PolygonBasis:
    """Functions of one symmetry on a polygon: rigid motions, those of the corners, polynomials by ascending degree."""

    middle: NDArray[np.float64]  # centre of the box around it, shape (2,)
    half: NDArray[np.float64]  # half its sides, shape (2,)
    degree: int  # of the polynomials
    parity: tuple[AxisParity, AxisParity]  # even (0) or odd (1) about the middle along x and y, or both (``None``)
    corners: tuple[CornerFunction, ...]  # functions of the corners that are kept

    @property
    def _powers(self) -> list[tuple[int, int]]:
        return [
            (total - n, n)
            for total in range(self.degree + 1)
            for n in range(total + 1)
            if all(own is None or own == power % 2 for own, power in zip(self.parity, (total - n, n), strict=True))
        ]

    @property
    def rigid(self) -> int:
        """Number of rigid motions: of 1, x and y."""
        return sum(sum(powers) < 2 for powers in self._powers)

    @property
    def degrees(self) -> NDArray[np.int64]:
        """The degree of each function, 0 of the corners'."""
        totals = [sum(powers) for powers in self._powers]
        return np.array([*totals[: self.rigid], *(0 for _ in self.corners), *totals[self.rigid :]])

    def values(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return all functions at points (2, n), shape (functions, n)."""
        singular = [self._folded(points, one.value) for one in self.corners]
        return self._ordered(self._products(points, 0, 0), singular)

    def curvatures(self, points: NDArray[np.float64]) -> list[NDArray[np.float64]]:
        """Return their second derivatives with respect to xx, yy and xy, each of shape (functions, n)."""
        singular = [self._folded(points, one.curvatures) for one in self.corners]
        found = []
        for number, (along, across) in enumerate(((2, 0), (0, 2), (1, 1))):
            scale = self.half[0] ** along * self.half[1] ** across
            found.append(
                self._ordered(self._products(points, along, across) / scale, [one[number] for one in singular])
            )
        return found

    def _ordered(self, products: NDArray[np.float64], singular: list[NDArray[np.float64]]) -> NDArray[np.float64]:
        return np.concatenate([products[: self.rigid], *(one[None] for one in singular), products[self.rigid :]])

    def _products(self, points: NDArray[np.float64], along: int, across: int) -> NDArray[np.float64]:
        local = (points - self.middle[:, None]) / self.half[:, None]
        first, second = (
            legendre_table(self.degree + 1, places, order) for places, order in zip(local, (along, across), strict=True)
        )
        return np.array([first[m] * second[n] for m, n in self._powers])

    def _folded(
        self, points: NDArray[np.float64], evaluate: Callable[[NDArray[np.float64]], NDArray[np.float64]]
    ) -> NDArray[np.float64]:
        """A function and its images, so that it has the parity: values (n,), or derivatives xx, yy and xy (3, n)."""
        total: NDArray[np.float64] = np.zeros((1, points.shape[1]))[0]
        middle = self.middle[:, None]
        for images in product(*((False,) if own is None else (False, True) for own in self.parity)):
            signs = np.where(images, -1.0, 1.0)
            values = evaluate(middle + signs[:, None] * (points - middle))
            if values.ndim == 2:
                values = values * np.array([1.0, 1.0, signs.prod()])[:, None]
            odd = sum(image and own == 1 for image, own in zip(images, self.parity, strict=True))
            total = np.asarray(total + (-1.0) ** odd * values, dtype=np.float64)
        return total


@lru_cache(maxsize=64)
def polygon_modes(
    points: tuple[Point, ...], poisson_ratio: float, degree: int, parity: tuple[AxisParity, AxisParity] = (None, None)
) -> PolygonModes:
    """Return all Ritz modes of a free plate of one symmetry.

    Args:
        points: corners of the polygon.
        poisson_ratio: ν.
        degree: of the polynomials in x and y together.
        parity: even (0) or odd (1) about the middle along x and y of a polygon that is symmetric about it.
    """
    corners: NDArray[np.float64] = np.asarray(Polygon(points=points).corners, dtype=np.float64)
    low, high = corners.min(axis=0), corners.max(axis=0)
    middle = 0.5 * (low + high)
    # Of a symmetric polygon the corners on one side, for the functions of the others are their images.
    kept = [
        one
        for one in corner_functions(corners, poisson_ratio)
        if all(own is None or place > mean - 1e-9 for own, place, mean in zip(parity, one.corner, middle, strict=True))
    ]
    basis = PolygonBasis(middle=middle, half=0.5 * (high - low), degree=degree, parity=parity, corners=tuple(kept))
    places, weights = polygon_quadrature(corners, degree + 1)
    root = np.sqrt(weights)
    values = basis.values(places) * root
    norms = np.linalg.norm(values, axis=1)
    # Of a corner on a plane of symmetry those of the other parity are zero, and some are nearly polynomials.
    scaled = values / np.where(norms > 0.0, norms, 1.0)[:, None]
    parts = np.abs(np.diagonal(qr(scaled.T, mode="r")[0]))
    independent = (norms > _INDEPENDENT * norms.max()) & (parts > _INDEPENDENT)
    inner = independent[basis.rigid : basis.rigid + len(kept)]
    basis = replace(basis, corners=tuple(one for one, is_new in zip(kept, inner, strict=True) if is_new))
    independent[basis.rigid + len(kept) :] = independent[: basis.rigid] = True
    _, triangle = qr(values[independent].T, mode="economic")
    # The rigid motions are the first functions, and orthonormal to each other.
    xx, yy, xy = (solve_triangular(triangle, table * root, trans=1) for table in basis.curvatures(places))
    bending = sum(
        part @ part.T
        for part in (
            np.sqrt(0.5 * (1.0 + poisson_ratio)) * (xx + yy),
            np.sqrt(0.5 * (1.0 - poisson_ratio)) * (xx - yy),
            np.sqrt(2.0 * (1.0 - poisson_ratio)) * xy,
        )
    )
    rigid = basis.rigid
    bending[:rigid] = bending[:, :rigid] = 0.0
    # Of the inverse problem the softest modes are the most exact.
    elastic = bending[rigid:, rigid:]
    inverses, turn = eigh(np.eye(len(elastic)), elastic)
    vectors = np.zeros((len(bending), len(bending)))
    vectors[:rigid, :rigid] = np.eye(rigid)
    vectors[rigid:, rigid:] = (turn / np.sqrt(inverses))[:, ::-1]
    orthonormal = solve_triangular(triangle, np.eye(len(triangle)))
    return PolygonModes(
        basis=basis,
        coefficients=(orthonormal @ vectors).T,
        rigid=rigid,
        stiffness=np.concatenate([np.zeros(rigid), 1.0 / inverses[::-1]]),
        orthonormal=orthonormal,
        bending=bending,
    )


def polygon_quadrature(corners: NDArray[np.float64], count: int) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return points (2, n) and weights for polynomials of degree 2·count − 2 and functions of the corners.

    Each triangle of it is cut in four, so that it has one corner of the polygon at most; it is the image of a square,
    one side of which becomes that corner, with nodes denser towards it.
    """
    reference, parts = gauss(count)
    across, across_weights = 0.5 * (1.0 + reference), 0.5 * parts
    denser, denser_parts = gauss(2 * count + 8)
    u = 0.5 * (1.0 + denser)
    towards = u**_CORNER_POWER
    towards_weights = 0.5 * denser_parts * _CORNER_POWER * u ** (_CORNER_POWER - 1)
    points, weights = [], []
    for triangle in _triangles(corners):
        middles = 0.5 * (triangle + np.roll(triangle, -1, axis=0))
        cut = [np.array([triangle[place], middles[place], middles[place - 1]]) for place in range(3)]
        for number, (first, second, third) in enumerate([*cut, middles]):
            along, along_weights = (towards, towards_weights) if number < 3 else (across, across_weights)
            edge, other = second - first, third - second
            places = (
                first[:, None, None]
                + edge[:, None, None] * along[:, None]
                + other[:, None, None] * (along[:, None] * across)
            )
            points.append(places.reshape(2, -1))
            area = abs(edge[0] * other[1] - edge[1] * other[0])
            weights.append((np.outer(along_weights * along, across_weights) * area).ravel())
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
    """Whether the triangle at a corner has no other corner in it or, but for rounding, on its sides."""
    ear = first, second, third = corners[number - 1], corners[number], corners[(number + 1) % len(corners)]
    negligible = _NEGLIGIBLE * float(np.ptp(ear, axis=0).max()) ** 2
    if _turn(first, second, third) <= negligible:
        return False
    others = [corner for corner in corners if not any(corner is own for own in ear)]
    sides = ((first, second), (second, third), (third, first))
    return not any(all(_turn(*side, other) >= -negligible for side in sides) for other in others)
