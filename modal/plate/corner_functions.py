"""Functions r^{λ+1} F(θ) with which the bending of a free plate begins at a corner (M. L. Williams, J. Appl. Mech. 19
(1952) 526).

With z = x + iy from the corner, x along the bisector of its angle α, a biharmonic function that is even or odd in y is

    w = Re or Im of  a z^{λ+1} + c z̄ z^λ

Both sides θ = ±α/2 are free, M_n = V_n = 0, where sin λα = ±λ sin α (1 − ν)/(3 + ν). At whole λ these are polynomials.
Polynomials with all others of λ < 5 converge exponentially, up to the first exponent that is left out.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, pi, sin

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq

_LARGEST, _STEP = 5.0, 0.01
# An exponent this close to a whole number is one.
_WHOLE = 1e-4


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
