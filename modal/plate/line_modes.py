"""Dry modes of a plate of one order by Ritz's method: W(x) cos k_y y of a strip, W(r) cos nθ of a disc or ring.

Shapes are polynomials, on a disc r^n times polynomials of r², which keep the conditions of held edges. The bending
energy is D/2 times ∫(Δw)² − 2(1 − ν)(w_xx w_yy − w_xy²), of one order

    strip:  ∫(W'' − k²W)² + 2(1 − ν)k²(WW'' + W'²) dx
    disc:   ∫[(Δₙf)² − 2(1 − ν)(f''(f'/r − n²f/r²) − n²(f'/r − f/r²)²)] r dr

so moments and Kirchhoff shears vanish at free edges. Eigenvalues come from above, and reach rounding with about twice
as many shapes as half waves.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property, lru_cache
from math import comb, perm

import numpy as np
from numpy.polynomial import legendre
from scipy.linalg import eigh, qr
from scipy.special import eval_jacobi

from hydroelastic.modal.plate.legendre import gauss
from hydroelastic.physics.arrays import FloatArray
from hydroelastic.physics.plate import Edge

FEW_MODES = 12
"""Shapes that give the lowest dry mode of an order to rounding."""
# Orders, at least, among which the lowest dry mode is sought: heave and pitch of the first two are no dry modes.
_ORDERS = 4


@dataclass(frozen=True, kw_only=True)
class PlateLine:
    """A plate of one order on its line, dimensionless."""

    start: float  # its left or inner edge; 0 of a disc
    end: float  # its right or outer edge
    round: bool  # whether the line is a radius
    transverse: float  # n of a disc or ring, k_y of a strip
    poisson_ratio: float
    edges: tuple[Edge, Edge]  # what holds both edges; the first one of a disc is not used
    rigidity: float = 1.0  # factor of the bending energy
    tension: float = 0.0  # T of a further energy ∫T|∇w|²

    @property
    def is_disc(self) -> bool:
        """Whether the line starts at the axis."""
        return self.round and self.start == 0.0

    def raw(self, count: int, places: FloatArray, derivative: int) -> FloatArray:
        """Return polynomials, orthogonal but for the weight r of a ring, or derivatives, shape (points, count)."""
        if not self.is_disc:
            middle, half = 0.5 * (self.end + self.start), 0.5 * (self.end - self.start)
            chosen = np.eye(count)
            values = legendre.legval((places - middle) / half, legendre.legder(chosen, derivative))
            return values.T / half**derivative
        return _zernike(int(self.transverse), count, places / self.end, derivative) / self.end**derivative

    @cached_property
    def conditions(self) -> tuple[tuple[float, int], ...]:
        """Place and derivative of everything that is zero at held edges."""
        zeros: dict[Edge, tuple[int, ...]] = {"free": (), "hinged": (0,), "clamped": (0, 1), "sliding": (1,)}
        ends = ((self.end, self.edges[1]),) if self.is_disc else zip((self.start, self.end), self.edges, strict=True)
        return tuple((place, derivative) for place, edge in ends for derivative in zeros[edge])

    def admissible(self, count: int) -> FloatArray:
        """Return combinations of `raw` polynomials that keep the conditions, of ascending degree, as columns."""
        conditions = self.conditions
        more = len(conditions)
        rows = np.array([self.raw(count + more + 1, np.array([place]), order)[0] for place, order in conditions])
        columns = []
        # Only slopes are zero: a constant is admissible, and has no part in the other combinations.
        has_constant = not self.is_disc or self.transverse_is_zero
        constant = bool(conditions) and has_constant and all(order for _, order in conditions)
        if constant:
            columns.append(np.eye(count + more + 1)[0])
        for first in range(int(constant), max(count, 2)):
            column = np.zeros(count + more + 1)
            column[first + more] = 1.0
            if more:
                column[first : first + more] = np.linalg.solve(rows[:, first : first + more], -rows[:, first + more])
            columns.append(column)
        if self.round and not self.is_disc and self.rigid_count and not self.transverse_is_zero:
            # The rigid motion of a ring of order 1 is r.
            middle, half = 0.5 * (self.end + self.start), 0.5 * (self.end - self.start)
            columns[:2] = [middle * columns[0] + half * columns[1], columns[0]]
        return np.array(columns[:count]).T

    @property
    def transverse_is_zero(self) -> bool:
        """Whether the order is 0."""
        return self.transverse == 0.0

    @property
    def rigid_count(self) -> int:
        """Number of rigid motions that the edges allow: heave and pitch of order 0, pitch of order 1 of a disc."""
        held = self.conditions
        if self.round and self.transverse == 1.0:
            return int(not held and not self.tension)
        if not self.transverse_is_zero:
            return 0
        if self.round:
            return int(all(derivative for _, derivative in held))
        # 1 and x: each condition, but a repeated one, takes one of them.
        rows = np.array([[1.0 - order, place if order == 0 else 1.0] for place, order in held]).reshape(-1, 2)
        return 2 - int(np.linalg.matrix_rank(rows)) if held else 2


def _zernike(order: int, count: int, s: FloatArray, derivative: int) -> FloatArray:
    """The sⁿ P_i^{(0,n)}(2s² − 1), or a derivative with respect to s, shape (points, count)."""
    degrees = np.arange(count)
    u = (2.0 * s**2 - 1.0)[:, None]

    def jacobi(order_of_derivative: int) -> FloatArray:
        values = np.ones((len(s), count))
        for step in range(order_of_derivative):
            values = values * 0.5 * (degrees + order + 1.0 + step)
        lowered = degrees - order_of_derivative
        found = eval_jacobi(np.maximum(lowered, 0), order_of_derivative, order + order_of_derivative, u)
        result: FloatArray = np.where(lowered >= 0, values * found, 0.0)
        return result

    x = s[:, None]
    # Of P(2s² − 1) with respect to s.
    inner: tuple[Callable[[], FloatArray], ...] = (
        lambda: jacobi(0),
        lambda: 4.0 * x * jacobi(1),
        lambda: 4.0 * jacobi(1) + 16.0 * x**2 * jacobi(2),
        lambda: 48.0 * x * jacobi(2) + 64.0 * x**3 * jacobi(3),
    )
    powers = (comb(derivative, k) * perm(order, k) * x ** max(order - k, 0) for k in range(min(derivative, order) + 1))
    parts = (power * inner[derivative - k]() for k, power in enumerate(powers))
    return sum(parts, np.zeros((len(s), count)))


@dataclass(frozen=True, kw_only=True)
class LineModes:
    """Dry modes of one order: rigid motions, then elastic ones; orthogonal in mass and in bending energy.

    Rigid motions have unit mean square. Elastic ones are scaled to the bending energy of the first one at unit mean
    square, so that the high ones, whose κ⁴ exceed the first by 10¹², keep their digits.
    """

    plate: PlateLine
    coefficients: FloatArray  # of `PlateLine.raw`, shape (polynomials, modes)
    rigid: int  # number of rigid motions
    squares: FloatArray  # ∫W² over the line, with weight r of a radius, shape (modes,)
    bending: FloatArray  # bending energy ∫(ΔW)² … likewise, zero of rigid motions; κ⁴ = bending/squares; shape (modes,)

    @property
    def count(self) -> int:
        """Number of modes."""
        return self.coefficients.shape[1]

    @property
    def eigenvalues(self) -> FloatArray:
        """The κ⁴ of the modes, shape (modes,)."""
        values: FloatArray = self.bending / self.squares
        return values

    def values(self, places: FloatArray, derivative: int = 0) -> FloatArray:
        """Return the shapes W, or derivatives, at places on the line, shape (points, modes)."""
        return self.plate.raw(len(self.coefficients), places, derivative) @ self.coefficients


@lru_cache(maxsize=256)
def dry_modes(plate: PlateLine, count: int) -> LineModes:
    """Return the dry modes in the polynomials of the lowest degrees.

    Args:
        plate: the plate of one order.
        count: number of polynomials, and of modes.
    """
    admissible = plate.admissible(count)
    points, weights = _gauss(plate, len(admissible) + 4)
    values, first, second = (plate.raw(len(admissible), points, order) @ admissible for order in range(3))
    # Orthonormal polynomials; the first ones are the rigid motions, whose bending is zero.
    _, triangle = qr(np.sqrt(weights)[:, None] * values, mode="economic")
    combined = np.linalg.solve(triangle.T, admissible.T).T
    values, first, second = (np.linalg.solve(triangle.T, table.T).T for table in (values, first, second))
    rigid = plate.rigid_count
    energy = _bending(plate, points, weights, values, first, second)[rigid:, rigid:]
    squares, vectors = eigh(np.eye(count - rigid), energy) if count > rigid else (np.empty(0), np.empty((0, 0)))
    squares, vectors = squares[::-1], vectors[:, ::-1]
    largest = squares[0] if len(squares) else 1.0
    elastic = combined[:, rigid:] @ vectors / np.sqrt(largest)
    return LineModes(
        plate=plate,
        coefficients=np.hstack([combined[:, :rigid], elastic]) if rigid else elastic,
        rigid=rigid,
        squares=np.concatenate([np.ones(rigid), squares / largest]),
        bending=np.concatenate([np.zeros(rigid), np.full(len(squares), 1.0 / largest)]),
    )


def lowest_dry(line: Callable[[int], PlateLine]) -> tuple[int, float]:
    """Return the order of the lowest elastic dry mode of a plate, and its κ⁴.

    Args:
        line: returns the plate on the line of an order. Its lowest mode rises with the order from the second one on;
            that of slats is the same in all.
    """
    found: list[float] = []
    while len(found) < _ORDERS or found[-1] < min(found[:-1]):
        modes = dry_modes(line(len(found)), FEW_MODES)
        found.append(float(modes.eigenvalues[modes.rigid]))
    return found.index(min(found)), min(found)


def _gauss(plate: PlateLine, polynomials: int) -> tuple[FloatArray, FloatArray]:
    """Gauss points and weights on the line, with the weight r of a radius."""
    degree = 2 * polynomials + int(plate.transverse) + 2 if plate.is_disc else polynomials + 4
    local, weights = gauss(degree)
    half = 0.5 * (plate.end - plate.start)
    points = 0.5 * (plate.end + plate.start) + half * local
    return points, half * weights * (points if plate.round else 1.0)


def _bending(
    plate: PlateLine, points: FloatArray, weights: FloatArray, value: FloatArray, first: FloatArray, second: FloatArray
) -> FloatArray:
    """The energy of bending and tension of each pair of shapes, over the factor of the order."""
    square, rest = plate.transverse**2, 1.0 - plate.poisson_ratio
    # Curvatures along the line and across it, and twist: (Δw)² − 2(1 − ν)(w_xx w_yy − w_xy²).
    if plate.round:
        r = points[:, None]
        across = first / r - square * value / r**2
        twist = plate.transverse * (first / r - value / r**2)
    else:
        across, twist = -square * value, plate.transverse * first
    parts = (
        (plate.rigidity * plate.poisson_ratio, second + across),
        (plate.rigidity * rest, second),
        (plate.rigidity * rest, across),
        (plate.rigidity * 2.0 * rest, twist),
        (plate.tension, first),
        (plate.tension, plate.transverse * value / (points[:, None] if plate.round else 1.0)),
    )
    return sum((factor * (part.T * weights) @ part for factor, part in parts), np.zeros((value.shape[1],) * 2))
