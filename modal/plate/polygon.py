"""Dry modes of a free polygonal plate by Ritz' method in polynomials and the singular functions of its corners.

    a(w, w) = ∫ w_xx² + w_yy² + 2ν w_xx w_yy + 2(1 − ν) w_xy²

Products of Legendre polynomials of the box around the polygon, up to a degree in x and y together, and
`corner_functions` are made orthonormal on the polygon. Convex or not, the error falls exponentially with the degree:
that of the first frequency of a free square is 1e-7 at degree 8 and 1e-10 at 12, of an L 3e-7 and 1e-8.

Functions r^{λ+1} F(θ) with which the bending of a free plate begins at a corner (M. L. Williams, J. Appl. Mech. 19
(1952) 526).

With z = x + iy from the corner, x along the bisector of its angle α, a biharmonic function that is even or odd in y is

    w = Re or Im of  a z^{λ+1} + c z̄ z^λ

Both sides θ = ±α/2 are free, M_n = V_n = 0, where sin λα = ±λ sin α (1 − ν)/(3 + ν). At whole λ these are polynomials.
Polynomials with all others of λ < 5 converge exponentially, up to the first exponent that is left out.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import lru_cache
from itertools import product
from math import cos, pi, sin

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import eigh, qr, solve_triangular
from scipy.optimize import brentq

from hydroelastic.modal.plate.legendre import gauss, legendre_table
from hydroelastic.modal.plate.rectangle import ClassParity
from hydroelastic.physics.plate import Point, Polygon

# r = uᵍ from a corner: r^{2λ − 2} r dr of λ > 1/2 becomes u^{2g λ − 1} du.
_CORNER_POWER = 4
# Of a function's norm, the part that others of the basis may leave of it.
_INDEPENDENT = 1e-10
# Areas below this part of a triangle's longest side squared are rounding.
_NEGLIGIBLE = 1e-12

_LARGEST, _STEP = 5.0, 0.01
# An exponent this close to a whole number is one.
_WHOLE = 1e-4


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
    parity: ClassParity  # even (0) or odd (1) about the middle along x and y, or both (``None``)
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
    points: tuple[Point, ...], poisson_ratio: float, degree: int, parity: ClassParity = (None, None)
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


@dataclass(frozen=True, kw_only=True)
class CornerFunction:
    """One of the functions."""

    corner: NDArray[np.float64]  # shape (2,)
    direction: float  # angle of the bisector, from the x axis
    cut: float  # angle of the branch cut from the bisector: a ray from the corner that does not meet the plate
    exponent: float
    even: bool  # whether it is even about the bisector
    coefficients: tuple[float, float]  # a and c

    def value(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return w at points (2, n)."""
        z, power = self._local(points)
        a, c = self.coefficients
        return self._part(a * z * power + c * np.conj(z) * power)

    def curvatures(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return w_xx, w_yy and w_xy at points other than the corner, shape (3, n)."""
        z, power = self._local(points)
        (a, c), λ = self.coefficients, self.exponent
        turn = np.exp(-2j * self.direction)
        twice = λ * power / z * (a * (λ + 1.0) + c * (λ - 1.0) * np.conj(z) / z) * turn
        mixed = 2.0 * c * λ * power / z
        return np.array([self._part(mixed + twice), self._part(mixed - twice), self._part(1j * twice)])

    def _part(self, values: NDArray[np.complex128]) -> NDArray[np.float64]:
        return values.real if self.even else values.imag

    def _local(self, points: NDArray[np.float64]) -> tuple[NDArray[np.complex128], NDArray[np.complex128]]:
        """z and z^λ."""
        x, y = points - self.corner[:, None]
        z = (x + 1j * y) * np.exp(-1j * self.direction)
        angle = self.cut - (self.cut - np.angle(z)) % (2.0 * pi)
        return z, np.abs(z) ** self.exponent * np.exp(1j * self.exponent * angle)


def corner_functions(corners: NDArray[np.float64], poisson_ratio: float) -> list[CornerFunction]:
    """Return those of all corners of a free plate from which a ray leaves it for good.

    Args:
        corners: of the polygon, anticlockwise, shape (corners, 2).
        poisson_ratio: ν.
    """
    found = []
    for number, corner in enumerate(corners):
        behind, ahead = corners[number - 1] - corner, corners[(number + 1) % len(corners)] - corner
        start = float(np.arctan2(ahead[1], ahead[0]))
        angle = (float(np.arctan2(behind[1], behind[0])) - start) % (2.0 * pi)
        direction = start + 0.5 * angle
        cut = _cut(corners, number, direction, 0.5 * angle)
        if cut is not None:
            found += [
                CornerFunction(
                    corner=corner, direction=direction, cut=cut, exponent=exponent, even=even, coefficients=coefficients
                )
                for exponent, even, coefficients in _exponents(angle, poisson_ratio)
            ]
    return found


def _cut(corners: NDArray[np.float64], number: int, direction: float, half: float) -> float | None:
    """An angle between α/2 and 2π − α/2 at which a ray from a corner does not meet the polygon, if there is one."""
    others = np.roll(corners, -number, axis=0) - corners[number]
    first, second = others[1:-1], others[2:]
    parts = np.array([0.5, 0.3, 0.7, 0.1, 0.9, 0.03, 0.97, 0.01, 0.99])
    for cut in half + parts * 2.0 * (pi - half):
        along = np.array([np.cos(direction + cut), np.sin(direction + cut)])
        # Sides whose ends lie on both sides of the ray, where it is ahead.
        left, right = (along[0] * ends[:, 1] - along[1] * ends[:, 0] for ends in (first, second))
        crossing = left * right <= 0.0
        part = left / np.where(crossing & (left != right), left - right, 1.0)
        ahead = ((first + part[:, None] * (second - first)) @ along) > 0.0
        if not np.any(crossing & ahead):
            return float(cut)
    return None


def _exponents(angle: float, poisson_ratio: float) -> list[tuple[float, bool, tuple[float, float]]]:
    """All real λ < 5 that are not whole numbers, with the parity of their function and its coefficients."""
    found = []
    for even in (True, False):

        def determinant(exponent: float, even: bool = even) -> float:
            (a, b), (c, d) = _edge(exponent, 0.5 * angle, poisson_ratio, even=even)
            return a * d - b * c

        places = np.arange(0.05, _LARGEST, _STEP) + 0.1 * _STEP
        values = np.array([determinant(place) for place in places])
        for place in np.flatnonzero(values[:-1] * values[1:] < 0.0):
            exponent = float(brentq(determinant, places[place], places[place + 1], xtol=1e-14))
            if abs(exponent - round(exponent)) > _WHOLE:
                _, _, rows = np.linalg.svd(np.array(_edge(exponent, 0.5 * angle, poisson_ratio, even=even)))
                found.append((exponent, even, (float(rows[-1, 0]), float(rows[-1, 1]))))
    return found


def _edge(λ: float, θ: float, ν: float, *, even: bool) -> tuple[tuple[float, float], tuple[float, float]]:
    """M_n and V_n at an edge per a and c, but for powers of r and factors of both of one row."""
    outer, inner = (λ + 1.0) * θ, (λ - 1.0) * θ
    moments = -λ * (λ + 1.0) * (1.0 - ν), -((λ - 1.0) ** 2) + (λ + 1.0) * (1.0 + ν * λ)
    forces = (1.0 - ν) * (λ + 1.0), 4.0 + (1.0 - ν) * (λ - 1.0)
    if even:
        return (moments[0] * cos(outer), moments[1] * cos(inner)), (-forces[0] * sin(outer), -forces[1] * sin(inner))
    return (moments[0] * sin(outer), moments[1] * sin(inner)), (forces[0] * cos(outer), forces[1] * cos(inner))
