"""Panels with polynomials along a line, and the operators of a plate on them: integrals and a kernel with a logarithm.

Nothing of the package is imported.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise

import numpy as np

Kernel = Callable[[np.ndarray], np.ndarray]


@dataclass(frozen=True)
class Panels:
    """Panels with Gauss nodes of one order.

    Attributes:
        edges: shape (panels + 1,), m.
        order: nodes in each panel.
    """

    edges: np.ndarray
    order: int

    @cached_property
    def rule(self) -> tuple[np.ndarray, np.ndarray]:
        """Gauss nodes and weights on −1…1."""
        nodes, weights = np.polynomial.legendre.leggauss(self.order)
        return nodes, weights

    @cached_property
    def nodes(self) -> np.ndarray:
        """m."""
        half = np.diff(self.edges)[:, None] / 2
        return np.asarray((self.edges[:-1, None] + half * (1 + self.rule[0])).ravel())

    @cached_property
    def weights(self) -> np.ndarray:
        """m."""
        return np.asarray((np.diff(self.edges)[:, None] / 2 * self.rule[1]).ravel())

    def interpolation(self, t: np.ndarray) -> np.ndarray:
        """From the nodes of a panel to the points −1 <= t <= 1 of it, shape (points, order)."""
        return legendre(t, self.order) @ self._to_legendre

    def at(self, values: np.ndarray, points: np.ndarray) -> np.ndarray:
        """Values at points between the first edge and the last one from values at the nodes."""
        panel = np.clip(np.searchsorted(self.edges, points, side="right") - 1, 0, len(self.edges) - 2)
        low, high = self.edges[panel], self.edges[panel + 1]
        rows = self.interpolation(2 * (points - low) / (high - low) - 1)
        return np.asarray(np.sum(rows * values.reshape(-1, self.order)[panel], axis=1))

    @cached_property
    def _to_legendre(self) -> np.ndarray:
        nodes, weights = self.rule
        return np.asarray((2 * np.arange(self.order)[:, None] + 1) / 2 * legendre(nodes, self.order).T * weights)

    @cached_property
    def integral(self) -> np.ndarray:
        """From nodes to the integral from the first edge to the nodes, the last row to the last edge."""
        nodes = np.append(self.rule[0], 1.0)
        series = np.polynomial.legendre.legint(np.eye(self.order), lbnd=-1)
        local = legendre(nodes, self.order + 1) @ series @ self._to_legendre
        halves = np.diff(self.edges) / 2
        size = len(self.nodes)
        matrix = np.zeros((size + 1, size))
        for panel, half in enumerate(halves):
            own = slice(panel * self.order, (panel + 1) * self.order)
            matrix[own, own] = half * local[:-1]
            matrix[own.stop :, own] = half * local[-1]
        return matrix


def legendre(t: np.ndarray, count: int) -> np.ndarray:
    """The first Legendre polynomials, shape (points, count)."""
    return np.polynomial.legendre.legvander(t, count - 1)


def graded_edges(length: float, longest: float, smallest: float) -> np.ndarray:
    """Edges of panels on 0…length that shrink threefold towards both ends."""
    levels = max(1, math.ceil(math.log(0.25 / smallest) / math.log(3)))
    near = length / 4 * 3.0 ** -np.arange(levels, -1, -1.0)
    middle = np.linspace(length / 4, 3 * length / 4, 1 + math.ceil(length / 2 / longest))
    edges = np.concatenate([[0], near[:-1], middle, (length - near[:-1])[::-1], [length]])
    pieces = [np.linspace(low, high, 1 + math.ceil((high - low) / longest))[:-1] for low, high in pairwise(edges)]
    return np.append(np.concatenate(pieces), length)


def layer_matrix(panels: Panels, kernel: Kernel) -> np.ndarray:
    """∫ kernel(|x_i − ξ|) p(ξ) dξ from values of p at the nodes; the kernel may have a logarithm and a kink at 0."""
    x, edges, order = panels.nodes, panels.edges, panels.order
    graded, graded_weights = graded_rule(14)
    distance = np.abs(x[:, None] - x)
    np.fill_diagonal(distance, 1.0)
    matrix = kernel(distance) * panels.weights
    for panel, (low, high) in enumerate(pairwise(edges)):
        own = slice(panel * order, (panel + 1) * order)
        near = np.flatnonzero((x > low - (high - low)) & (x < high + (high - low)))
        for i in near:
            ends = [end - x[i] for end in (low, high)]
            if ends[0] < 0 < ends[1]:
                parts = [(0.0, ends[0]), (0.0, ends[1])]
            else:
                ends.sort(key=abs)
                parts = [(ends[0], ends[1])]
            row = np.zeros(order, complex)
            for start, stop in parts:
                offset = start + (stop - start) * graded
                values = kernel(np.abs(offset)) * graded_weights * abs(stop - start)
                t = 2 * (x[i] + offset - low) / (high - low) - 1
                row += values @ panels.interpolation(t)
            matrix[i, own] = row
    return np.asarray(matrix)


def graded_rule(order: int) -> tuple[np.ndarray, np.ndarray]:
    """On 0…1, for functions with a logarithm at or beyond 0."""
    nodes, weights = np.polynomial.legendre.leggauss(order)
    edges = np.append(0.0, 4.0 ** np.arange(-24.0, 1.0))
    half = np.diff(edges)[:, None] / 2
    return (edges[:-1, None] + half * (1 + nodes)).ravel(), (half * weights).ravel()
