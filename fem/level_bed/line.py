"""The space of ψ on the line of one order, with the weight of its second direction.

Continuous polynomials of one degree on the cells of an interval: hats and integrated Legendre functions.
On [−1, 1] the functions of a cell are (1 ∓ ξ)/2 and (P_k − P_{k−2})/√(2(2k − 1)), k = 2 … p.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import eigh
from scipy.sparse import csr_matrix

from hydroelastic.fem.level_bed.separation import Separation
from hydroelastic.modal.plate.legendre import gauss
from hydroelastic.physics.arrays import FloatArray

# Gauss points beyond those of polynomials: n²/r² is none.
_SPARE_POINTS = 8


@dataclass(frozen=True, kw_only=True)
class Line:
    """A space on the line of one order: integrals are over the plan.

    Its unknowns are the nodes, from the left, then those inside the cells.

    Attributes:
        nodes: ends of the cells, ascending, shape (cells + 1,).
        degree: p.
        separation: the tank's.
        order: n.
    """

    nodes: FloatArray
    degree: int
    separation: Separation
    order: int

    @property
    def zero_at_start(self) -> bool:
        """Whether ψ = 0 on the axis, as for n ≥ 1 without an inner cylinder."""
        return self.separation.round and self.order > 0 and self.nodes[0] == 0.0

    @property
    def holds_constant(self) -> bool:
        """Whether the constant is among the functions: of order 0."""
        return self.order == 0

    def measure(self, places: FloatArray) -> FloatArray:
        """Return ∫cos² over the second direction, times r of a radius."""
        return self.separation.factor(self.order) * (places if self.separation.round else places**0)

    def transverse_squares(self, places: FloatArray) -> FloatArray:
        """Return n²/r² or k_y²."""
        return self.separation.transverse(self.order) ** 2 / (places**2 if self.separation.round else places**0)

    @property
    def hats(self) -> int:
        """Number of functions at nodes; they come first, and with those that vanish at an end their sum is 1."""
        return len(self.nodes) - int(self.zero_at_start)

    @property
    def size(self) -> int:
        """Number of functions N."""
        return self.hats + (len(self.nodes) - 1) * (self.degree - 1)

    @property
    def cells(self) -> np.ndarray:
        """Numbers of all cells."""
        return np.arange(len(self.nodes) - 1)

    @cached_property
    def unknowns(self) -> np.ndarray:
        """Numbers of the functions of each cell, −1 of one that is left out, shape (cells, p + 1)."""
        ends = self.cells[:, None] + np.array([0, 1]) - int(self.zero_at_start)
        inner = self.hats + np.arange(len(ends) * (self.degree - 1))
        return np.hstack([ends, inner.reshape(len(ends), self.degree - 1)])

    def between(self, start: float, end: float) -> np.ndarray:
        """Return the numbers of the cells between two nodes."""
        middles = 0.5 * (self.nodes[1:] + self.nodes[:-1])
        return np.flatnonzero((middles > start) & (middles < end))

    def unknowns_of(self, cells: np.ndarray) -> np.ndarray:
        """Return the unknowns that are not zero on some cells, ascending."""
        numbers = np.unique(self.unknowns[cells])
        return numbers[numbers >= 0]

    def quadrature(self, cells: np.ndarray, points: int) -> tuple[FloatArray, FloatArray]:
        """Return Gauss points on some cells, and their weights, each of shape (cells, points)."""
        local, weights = gauss(points)
        left, right = self.nodes[:-1][cells], self.nodes[1:][cells]
        half = 0.5 * (right - left)
        places = 0.5 * (left + right)[:, None] + half[:, None] * local
        return places, half[:, None] * weights * self.measure(places)

    def mass_on(self, cells: np.ndarray) -> NDArray[np.float64]:
        """Return ∫uv over some cells, by their numbers or a mask, shape (N, N)."""
        points = self.degree + _SPARE_POINTS
        _, weights = self.quadrature(cells, points)
        table = _reference(self.degree, gauss(points)[0])
        return self._assembled(cells, (weights[:, None, :] * table) @ table.T)

    @cached_property
    def mass(self) -> FloatArray:
        """∫uv, shape (N, N)."""
        return self.mass_on(self.cells)

    @cached_property
    def sparse_mass(self) -> csr_matrix:
        """∫uv, of which most entries are zero."""
        return csr_matrix(self.mass)

    @cached_property
    def stiffness(self) -> FloatArray:
        """∫∇u·∇v, with the second direction, shape (N, N)."""
        along, across = self._gradients
        return self._assembled(self.cells, along + across)

    @cached_property
    def _gradients(self) -> tuple[FloatArray, FloatArray]:
        """∫u'v' and the part of the second direction on each cell, each of shape (cells, p + 1, p + 1)."""
        points = self.degree + _SPARE_POINTS
        places, weights = self.quadrature(self.cells, points)
        table, slopes = (_reference(self.degree, gauss(points)[0], slope=slope) for slope in (False, True))
        along = weights * (2.0 / np.diff(self.nodes)[:, None]) ** 2
        across = weights * self.transverse_squares(places)
        return (along[:, None, :] * slopes) @ slopes.T, (across[:, None, :] * table) @ table.T

    def _assembled(self, cells: np.ndarray, blocks: FloatArray) -> NDArray[np.float64]:
        whole = np.zeros((self.size + 1, self.size + 1))
        numbers = self.unknowns[cells]
        # A function that is left out has the number −1: the last row and column.
        np.add.at(whole, (numbers[:, :, None], numbers[:, None, :]), blocks)
        return whole[:-1, :-1]

    def load(self, cells: np.ndarray, values: FloatArray) -> FloatArray:
        """Return ∫φv of functions φ."""
        table = _reference(self.degree, gauss(values.shape[2])[0]).T
        loads = np.zeros((self.size + 1, len(values)))
        np.add.at(loads, self.unknowns[cells].ravel(), np.moveaxis(values @ table, 0, -1).reshape(-1, len(values)))
        return loads[:-1].T

    def table(self, places: FloatArray) -> FloatArray:
        """Return the functions at places, shape (N, places)."""
        cells = np.clip(np.searchsorted(self.nodes, places, side="right") - 1, 0, len(self.nodes) - 2)
        left, right = self.nodes[cells], self.nodes[cells + 1]
        local = np.clip((2.0 * places - left - right) / (right - left), -1.0, 1.0)
        table = np.zeros((self.size + 1, len(places)))
        table[self.unknowns[cells].T, np.arange(len(places))] = _reference(self.degree, local)
        return table[:-1]

    @cached_property
    def _hierarchy(self) -> tuple[FloatArray, FloatArray]:
        """Hats as wide as intervals halved again and again: values at the kept nodes, and slopes on the cells.

        The first ones are 1 and the linear function. The others have slopes without a mean: ∫u'v' is diagonal, but for
        the weight.
        """
        nodes, last = self.nodes, len(self.nodes) - 1
        values, slopes = [], []

        def add(value: FloatArray, slope: FloatArray) -> None:
            values.append(value[int(self.zero_at_start) :])
            slopes.append(slope)

        if not self.zero_at_start:
            add(np.ones(last + 1), np.zeros(last))
        length = nodes[-1] - nodes[0]
        add((nodes - nodes[0]) / length, np.full(last, 1.0 / length))
        halved = [(0, last)]
        for first, end in halved:
            middle = (first + end) // 2
            if middle > first:
                up, down = nodes[middle] - nodes[first], nodes[end] - nodes[middle]
                value, slope = np.zeros(last + 1), np.zeros(last)
                value[first : middle + 1] = (nodes[first : middle + 1] - nodes[first]) / up
                value[middle : end + 1] = (nodes[end] - nodes[middle : end + 1]) / down
                slope[first:middle], slope[middle:end] = 1.0 / up, -1.0 / down
                add(value, slope)
                halved += [(first, middle), (middle, end)]
        return np.array(values), np.array(slopes)

    @cached_property
    def waves(self) -> tuple[FloatArray, FloatArray]:
        """k² and V with ∫∇u·∇v = k² ∫uv and ∫v² = 1: the standing waves, ascending, shape (N,) and (N, N).

        That of k = 0, if there is one, is exact. On graded cells the largest k² exceed the lowest by 10¹⁵: the inverse
        problem keeps the digits of the latter, and norms of the vectors those of the former. A cell of the size h would
        add ε/h to k² where a smooth function has nearly the same values at both its ends; in `_hierarchy` it has
        slopes of its own.
        """
        (values, slopes), (along, across) = self._hierarchy, self._gradients
        hats, lengths = self.hats, np.diff(self.nodes)

        def turned(nodal: FloatArray) -> FloatArray:
            nodal = nodal.copy()
            nodal[:hats] = values @ nodal[:hats]
            nodal[:, :hats] = nodal[:, :hats] @ values.T
            return nodal

        stiffness = self._assembled(self.cells, along)
        stiffness[:hats, :hats] = (slopes * (along[:, 1, 1] * lengths**2)) @ slopes.T
        bubbles = (slopes[:, :, None] * (along[:, 1, 2:] * lengths[:, None])).reshape(hats, -1)
        stiffness[:hats, hats:], stiffness[hats:, :hats] = bubbles, bubbles.T
        if across.any():
            stiffness += turned(self._assembled(self.cells, across))
        shift, mass = 1.0 / (self.nodes[-1] - self.nodes[0]) ** 2, turned(self.mass)
        _, vectors = eigh(mass, stiffness + shift * mass)
        vectors = vectors[:, ::-1]
        squares = (vectors * (csr_matrix(stiffness) @ vectors)).sum(axis=0)
        vectors[:hats] = values.T @ vectors[:hats]
        norms = (vectors * (self.sparse_mass @ vectors)).sum(axis=0)
        squares /= norms
        if self.holds_constant:
            squares[0] = 0.0
        return squares, vectors / np.sqrt(norms)


def _reference(degree: int, points: FloatArray, *, slope: bool = False) -> FloatArray:
    """The functions of a cell, or their slopes, at points of [−1, 1], shape (p + 1, points)."""
    legendre = np.polynomial.legendre.legvander(points, degree).T
    order = np.arange(2, degree + 1)[:, None]
    if slope:
        ones = np.full((1, len(points)), 0.5)
        return np.concatenate([-ones, ones, np.sqrt(order - 0.5) * legendre[1:degree]])
    inner = (legendre[2:] - legendre[:-2]) / np.sqrt(2.0 * (2.0 * order - 1.0))
    return np.concatenate([[0.5 * (1.0 - points), 0.5 * (1.0 + points)], inner])
