"""Piecewise polynomials on an interval: hats and integrated Legendre functions, whose products are a plan's ψ.

On [−1, 1] the functions of a cell are (1 ∓ ξ)/2 and (P_k − P_{k−2})/√(2(2k − 1)), k = 2 … p.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import eigh, solve

from hydroelastic.modal.plate.legendre import gauss
from hydroelastic.modal.plate.rectangle import polynomials_of


@dataclass(frozen=True, kw_only=True)
class IntervalSpace:
    """Continuous polynomials of one degree on the cells of an interval.

    Attributes:
        nodes: ends of the cells, ascending, shape (cells + 1,).
        degree: p.
        zero_at_end: whether the functions vanish at the last node, as odd ones do on the plane of symmetry.
    """

    nodes: NDArray[np.float64]
    degree: int
    zero_at_end: bool = False

    @property
    def size(self) -> int:
        """Number of functions."""
        return self.hats + (self.degree - 1) * (len(self.nodes) - 1)

    @cached_property
    def _dofs(self) -> NDArray[np.int64]:
        """Number of each function of each cell, −1 for the one left out, shape (cells, p + 1)."""
        cells = np.arange(len(self.nodes) - 1)
        right = cells + 1
        if self.zero_at_end:
            right[-1] = -1
        inner = self.hats + (self.degree - 1) * cells[:, None] + np.arange(self.degree - 1)
        return np.concatenate([cells[:, None], right[:, None], inner], axis=1)

    def table(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the functions at points of the interval, shape (functions, points)."""
        cells = np.clip(np.searchsorted(self.nodes, points, side="right") - 1, 0, len(self.nodes) - 2)
        left, right = self.nodes[cells], self.nodes[cells + 1]
        values = _reference(self.degree, (2.0 * points - left - right) / (right - left))
        table = np.zeros((self.size + 1, len(points)))
        table[self._dofs[cells].T, np.arange(len(points))] = values
        return table[:-1]

    def slopes(self, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return their slopes at points that are no nodes, shape (functions, points)."""
        cells = np.clip(np.searchsorted(self.nodes, points, side="right") - 1, 0, len(self.nodes) - 2)
        left, right = self.nodes[cells], self.nodes[cells + 1]
        values = _reference(self.degree, (2.0 * points - left - right) / (right - left), slope=True)
        table = np.zeros((self.size + 1, len(points)))
        table[self._dofs[cells].T, np.arange(len(points))] = values * (2.0 / (right - left))
        return table[:-1]

    @property
    def hats(self) -> int:
        """Number of functions at nodes; they come first, and their sum is 1."""
        return len(self.nodes) - int(self.zero_at_end)

    def between(self, start: float, end: float) -> NDArray[np.bool_]:
        """Return which cells lie between two nodes."""
        middles = 0.5 * (self.nodes[:-1] + self.nodes[1:])
        return np.asarray((middles > start) & (middles < end))

    def quadrature(self, chosen: NDArray[np.bool_], more: int = 0) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Return points and weights on some cells, exact for products of two functions.

        Args:
            chosen: which cells.
            more: degree of another factor beside two functions.
        """
        points, weights = gauss(self.degree + 1 + more // 2)
        left, right = self.nodes[:-1][chosen, None], self.nodes[1:][chosen, None]
        half = 0.5 * (right - left)
        return (left + half * (1.0 + points)).ravel(), (half * weights).ravel()

    @cached_property
    def stiffness(self) -> NDArray[np.float64]:
        """∫u'v', shape (functions, functions)."""
        points, weights = self.quadrature(np.full(len(self.nodes) - 1, True))
        slopes = self.slopes(points)
        return np.asarray((slopes * weights) @ slopes.T)

    @cached_property
    def mass(self) -> NDArray[np.float64]:
        """∫uv, shape (functions, functions)."""
        return self.mass_on(np.full(len(self.nodes) - 1, True))

    def mass_on(self, chosen: NDArray[np.bool_]) -> NDArray[np.float64]:
        """Return ∫uv over some cells, shape (functions, functions)."""
        points, weights = self.quadrature(chosen)
        values = self.table(points)
        return np.asarray((values * weights) @ values.T)

    def moments(self, start: float, end: float, middle: float, side: float, count: int) -> NDArray[np.float64]:
        """Return ∫u p_m between two nodes, for the orthonormal Legendre polynomials of a side about its middle.

        Returns:
            Shape (functions, count).
        """
        points, weights = self.quadrature(self.between(start, end), more=count)
        return np.asarray((self.table(points) * weights) @ polynomials_of(count, points - middle, side).T)

    def embedding(self, coarser: IntervalSpace) -> NDArray[np.float64]:
        """Return the matrix that gives functions of a space contained in this one, shape (functions, coarser ones)."""
        points, weights = self.quadrature(np.full(len(self.nodes) - 1, True))
        mixed = (self.table(points) * weights) @ coarser.table(points).T
        return np.asarray(solve(self.mass, mixed, assume_a="pos"))

    @cached_property
    def waves(self) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """k² and V with ∫u'v' = k² ∫uv and ∫v² = 1: the standing waves, shape (waves,) and (functions, waves).

        That of k = 0, if there is one, is exact. Of ∫uv and ∫u'v' + σ∫uv rounding spoils the shortest waves only.
        """
        mass = self.mass
        shift = 1.0 / (self.nodes[-1] - self.nodes[0]) ** 2
        inverses, vectors = eigh(mass, self.stiffness + shift * mass)
        squares = 1.0 / inverses[::-1] - shift
        if not self.zero_at_end:
            squares[0] = 0.0
        return squares, vectors[:, ::-1] / np.sqrt(inverses[::-1])


def _reference(degree: int, points: NDArray[np.float64], *, slope: bool = False) -> NDArray[np.float64]:
    """The functions of a cell, or their slopes, at points of [−1, 1], shape (p + 1, points)."""
    legendre = np.polynomial.legendre.legvander(points, degree).T
    order = np.arange(2, degree + 1)[:, None]
    if slope:
        ones = np.full((1, len(points)), 0.5)
        return np.concatenate([-ones, ones, np.sqrt(order - 0.5) * legendre[1:degree]])
    inner = (legendre[2:] - legendre[:-2]) / np.sqrt(2.0 * (2.0 * order - 1.0))
    return np.concatenate([[0.5 * (1.0 - points), 0.5 * (1.0 + points)], inner])


def graded_nodes(
    start: float,
    end: float,
    edges: tuple[float, ...],
    *,
    largest: float,
    layers: int,
    ratio: float = 0.2,
) -> NDArray[np.float64]:
    """Return nodes of an interval that are graded geometrically towards edges inside it.

    Args:
        start: its start.
        end: its end; it may be one of the edges, and the layers are then on one side.
        edges: places of the edges.
        largest: size of the largest cell.
        layers: number of layers beside each edge, on either side; 0 leaves the edge as a node.
        ratio: ratio of the distances of successive nodes from an edge.
    """
    inside = sorted({place for place in edges if start < place < end} | {start, end})
    graded = set(edges)
    nodes = [start]
    for left, right in pairwise(inside):
        length = right - left
        both = (left in graded) + (right in graded)
        # The outermost layer is as large as its neighbours.
        outermost = min(largest, length / (both + 1)) if both and layers else 0.0
        distances = outermost * ratio ** np.arange(layers)[::-1] if layers else np.empty(0)
        from_left = left + distances if left in graded else np.empty(0)
        from_right = right - distances[::-1] if right in graded else np.empty(0)
        low = from_left[-1] if len(from_left) else left
        high = from_right[0] if len(from_right) else right
        cells = max(1, int(np.ceil((high - low) / largest - 1e-9)))
        nodes += [
            *from_left,
            *np.linspace(low, high, cells + 1)[1:-1],
            *([high] if len(from_right) else []),
            *from_right[1:],
            right,
        ]
    return np.array(nodes)
