"""Continuous polynomials of one degree on a line, in integrated Legendre functions, and their Laplacian.

On each element the functions are (1 ∓ ξ)/2 at its ends and (P_i − P_{i−2})/√(2(2i − 1)), i = 2 … p, inside.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.polynomial import legendre
from scipy.linalg import eigh

from hydroelastic.fem.level_bed.separation import Separation
from hydroelastic.physics.arrays import FloatArray

# Gauss points beyond those that integrate the products of two functions: n²/r² is no polynomial.
_SPARE_POINTS = 8


@dataclass(frozen=True, kw_only=True)
class Line:
    """A space on the line of one order; its unknowns are the nodes, from the left, then those inside the elements.

    Attributes:
        nodes: ends of the elements, ascending, shape (elements + 1,).
        degree: p.
        separation: the tank's.
        order: n.
    """

    nodes: FloatArray
    degree: int
    separation: Separation
    order: int

    @property
    def is_zero_at_axis(self) -> bool:
        """Whether ψ = 0 on the axis, as for n ≥ 1 without an inner cylinder."""
        return self.separation.round and self.order > 0 and self.nodes[0] == 0.0

    @cached_property
    def unknowns(self) -> np.ndarray:
        """Numbers of the functions of each element, shape (elements, p + 1); −1 of the one that is zero at the axis."""
        count = len(self.nodes) - 1
        ends = np.arange(count)[:, None] + np.array([0, 1]) - int(self.is_zero_at_axis)
        inner = len(self.nodes) - int(self.is_zero_at_axis) + np.arange(count * (self.degree - 1))
        return np.hstack([ends, inner.reshape(count, self.degree - 1)])

    @property
    def node_count(self) -> int:
        """Number of unknowns at nodes."""
        return len(self.nodes) - int(self.is_zero_at_axis)

    @property
    def size(self) -> int:
        """Number of unknowns."""
        return self.node_count + (len(self.nodes) - 1) * (self.degree - 1)

    def within(self, start: float, end: float) -> np.ndarray:
        """Return the numbers of the elements between two nodes."""
        middles = 0.5 * (self.nodes[1:] + self.nodes[:-1])
        return np.flatnonzero((middles > start) & (middles < end))

    def unknowns_of(self, elements: np.ndarray) -> np.ndarray:
        """Return the unknowns that are not zero on some elements, ascending."""
        numbers = np.unique(self.unknowns[elements])
        return numbers[numbers >= 0]

    def quadrature(self, elements: np.ndarray, points: int) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Return Gauss points on some elements.

        Args:
            elements: their numbers.
            points: how many on each.

        Returns:
            The points, and weights with the factor of the order and the weight r, shape (elements, points), and the
            functions there, shape (points, p + 1).
        """
        local, weights = np.polynomial.legendre.leggauss(points)
        left, right = self.nodes[elements], self.nodes[elements + 1]
        half = 0.5 * (right - left)
        places = 0.5 * (left + right)[:, None] + half[:, None] * local
        measure = half[:, None] * weights * self.separation.factor(self.order)
        return places, measure * (places if self.separation.round else 1.0), self.functions(local)

    def functions(self, local: FloatArray, derivative: int = 0) -> FloatArray:
        """Return the functions of the reference element, or their first derivatives, shape (points, p + 1)."""
        powers = legendre.legvander(local, self.degree)
        degrees = np.arange(2, self.degree + 1)
        if derivative:
            ends = np.broadcast_to([-0.5, 0.5], (len(local), 2))
            return np.hstack([ends, np.sqrt(degrees - 0.5) * powers[:, 1:-1]])
        ends = np.column_stack([0.5 * (1.0 - local), 0.5 * (1.0 + local)])
        return np.hstack([ends, (powers[:, 2:] - powers[:, :-2]) / np.sqrt(2.0 * (2.0 * degrees - 1.0))])

    def mass(self, elements: np.ndarray) -> FloatArray:
        """Return ∫ψq over some elements, shape (N, N)."""
        _, weights, table = self.quadrature(elements, self.degree + _SPARE_POINTS)
        return self._assembled(elements, np.einsum("eq,qi,qj->eij", weights, table, table, optimize=True))

    @cached_property
    def stiffness(self) -> FloatArray:
        """∫∇ψ·∇q over the plan, shape (N, N)."""
        elements = np.arange(len(self.nodes) - 1)
        points = self.degree + _SPARE_POINTS
        places, weights, table = self.quadrature(elements, points)
        slopes = self.functions(np.polynomial.legendre.leggauss(points)[0], 1)
        lengths = np.diff(self.nodes)
        across = weights * self.separation.transverse(self.order) ** 2
        across = across / places**2 if self.separation.round else across
        blocks = np.einsum("eq,qi,qj->eij", weights * (2.0 / lengths[:, None]) ** 2, slopes, slopes, optimize=True)
        return self._assembled(elements, blocks + np.einsum("eq,qi,qj->eij", across, table, table, optimize=True))

    def _assembled(self, elements: np.ndarray, blocks: FloatArray) -> FloatArray:
        whole = np.zeros((self.size + 1, self.size + 1))
        numbers = self.unknowns[elements]
        # The function that is zero at the axis has the number −1: the last row and column.
        np.add.at(whole, (numbers[:, :, None], numbers[:, None, :]), blocks)
        return whole[:-1, :-1]

    def load(self, elements: np.ndarray, places: FloatArray, values: FloatArray) -> FloatArray:
        """Return ∫φq of functions φ.

        Args:
            elements: those on which they are not zero.
            places: as by `quadrature`, shape (elements, points).
            values: φ there times the weights, shape (functions, elements, points).

        Returns:
            Loads, shape (functions, N).
        """
        table = self.functions(np.polynomial.legendre.leggauss(places.shape[1])[0])
        loads = np.zeros((self.size + 1, len(values)))
        np.add.at(loads, self.unknowns[elements].ravel(), np.moveaxis(values @ table, 0, -1).reshape(-1, len(values)))
        return loads[:-1].T

    def evaluated(self, coefficients: FloatArray, places: FloatArray) -> FloatArray:
        """Return functions of the space at places on the line.

        Args:
            coefficients: shape (N, functions).
            places: shape (points,).

        Returns:
            Their values, shape (points, functions).
        """
        elements = np.clip(np.searchsorted(self.nodes, places) - 1, 0, len(self.nodes) - 2)
        left, right = self.nodes[elements], self.nodes[elements + 1]
        table = self.functions(np.clip((2.0 * places - left - right) / (right - left), -1.0, 1.0))
        padded = np.vstack([coefficients, np.zeros((1, coefficients.shape[1]))])
        return np.einsum("qi,qij->qj", table, padded[self.unknowns[elements]])

    @cached_property
    def eigenpairs(self) -> tuple[FloatArray, FloatArray]:
        """The k² and the functions v of K₂v = k²M₂v, shape (N,) and (N, N), ascending, vᵀM₂v = 1.

        On graded elements the largest k² exceed the lowest by 10¹⁵: the inverse problem keeps the digits of the latter,
        and norms of the vectors those of the former.
        """
        mass = self.mass(np.arange(len(self.nodes) - 1))
        _, vectors = eigh(mass, self.stiffness + mass)
        vectors = vectors[:, ::-1]
        norms = np.einsum("ij,ij->j", vectors, mass @ vectors)
        squares = np.einsum("ij,ij->j", vectors, self.stiffness @ vectors) / norms
        return squares, vectors / np.sqrt(norms)
