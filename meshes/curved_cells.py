"""Cells with a curved edge: polynomial geometry that follows the exact curve, all other cells staying straight.

On the edge from a to b the curve is a graph over the chord: with s = 0 … 1 along it, γ = (1 − s) a + s b + δ(s), where
δ is normal to the chord. The polynomial δ_k of degree k that interpolates δ at the edge's nodes is s (1 − s) e(s), and

    x = Σ λ_i v_i + λ_a λ_b e((1 + λ_b − λ_a)/2)

is of degree k in the cell, has δ_k on the edge and vanishes on the other two. Source: the blending of Zlámal, SIAM J.
Numer. Anal. 10 (1973) 229, and Lenoir, SIAM J. Numer. Anal. 23 (1986) 562.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import permutations
from typing import TYPE_CHECKING

import numpy as np
from numpy.polynomial.chebyshev import chebder, chebval, chebvander
from numpy.typing import NDArray

from hydroelastic.meshes.outline import Curve
from hydroelastic.meshes.sign_changes import sign_changes
from hydroelastic.meshes.tagged_mesh import CurvedCells, Deviation

# Imported here: meshes of straight cells are made without dolfinx, to which basix belongs.
if TYPE_CHECKING:
    import basix

# Smaller deviations, in parts of the largest coordinate, are rounding of the curve's points.
_ROUNDING = 1e-15
# Additional degrees of the polynomial that represents the exact curve between the nodes in measures of deviation.
_MORE_DEGREES = 6


@dataclass(frozen=True, kw_only=True)
class CurvedEdges:
    """Elements of one curved piece."""

    curve: Curve  # the piece
    parameters: NDArray[np.float64]  # of the elements' ends, in order, shape (elements + 1,)
    points: NDArray[np.float64]  # the elements' ends, shape (elements + 1, 2)

    @property
    def chords(self) -> NDArray[np.float64]:
        """From the start to the end of each element, shape (elements, 2)."""
        return np.diff(self.points, axis=0)

    @property
    def normals(self) -> NDArray[np.float64]:
        """Unit normals to the left of the chords, shape (elements, 2)."""
        chords = self.chords
        normals: NDArray[np.float64] = np.column_stack([-chords[:, 1], chords[:, 0]]) / np.hypot(*chords.T)[:, None]
        return normals

    def blend(self, fractions: NDArray[np.float64]) -> NDArray[np.float64]:
        """e·n in Chebyshev polynomials of 2s - 1, by interpolation of δ at the inner nodes s of each chord.

        Shape (elements, inner nodes); without inner nodes δ is taken to be zero.
        """
        if not len(fractions):
            return np.zeros((len(self.points) - 1, 1))
        heights = self._heights(fractions)
        heights[np.abs(heights).max(axis=1) < _ROUNDING * np.abs(self.points).max()] = 0.0
        values = heights / (fractions * (1.0 - fractions))
        polynomials = chebvander(2.0 * fractions - 1.0, len(fractions) - 1)
        return np.asarray(np.linalg.solve(polynomials, values.T).T, dtype=np.float64)

    def _heights(self, fractions: NDArray[np.float64]) -> NDArray[np.float64]:
        """δ·n at parts s of each chord, shape (elements, len(fractions))."""
        starts, chords = self.points[:-1, None], self.chords[:, None]
        squares = (chords**2).sum(axis=2)
        shape = (len(self.points) - 1, len(fractions))

        def away(parameters: NDArray[np.float64]) -> NDArray[np.float64]:
            return self.curve.at(parameters.ravel()).reshape(*shape, 2) - starts

        found = sign_changes(
            lambda parameters: (away(parameters) * chords).sum(axis=2) - fractions * squares,
            np.broadcast_to(self.parameters[:-1, None], shape),
            np.broadcast_to(self.parameters[1:, None], shape),
        )
        heights: NDArray[np.float64] = (away(found) * self.normals[:, None]).sum(axis=2)
        return heights


@dataclass(frozen=True, kw_only=True)
class Sides:
    """Cells at the elements of a curve, one for each side that has a cell."""

    cells: NDArray[np.int64]  # indices, shape (sides,)
    elements: NDArray[np.int64]  # index of the element at each, shape (sides,)
    starts: NDArray[np.int64]  # which corner of the cell is the element's start, shape (sides,)
    ends: NDArray[np.int64]  # which corner is its end, shape (sides,)


def curve_cells(
    corners: NDArray[np.float64], pieces: list[tuple[CurvedEdges, Sides]], degree: int
) -> CurvedCells | None:
    """Curve the cells at curved pieces."""
    reference = geometry_element(degree).points
    barycentric = np.column_stack([1.0 - reference.sum(axis=1), reference])
    chosen, moves = [], []
    for edges, sides in pieces:
        blend, normals = edges.blend(_inner_nodes(degree)), edges.normals
        bent = np.any(blend != 0.0, axis=1)[sides.elements]
        for start, end in permutations(range(3), 2):
            here = bent & (sides.starts == start) & (sides.ends == end)
            elements = sides.elements[here]
            first, second = barycentric[:, start], barycentric[:, end]
            heights = first * second * chebval(second - first, blend[elements].T)
            chosen.append(sides.cells[here])
            moves.append(heights[:, :, None] * normals[elements][:, None])
    cells, place = np.unique(np.concatenate(chosen), return_inverse=True)
    if not len(cells):
        return None
    nodes = barycentric @ corners[cells]
    np.add.at(nodes, place, np.concatenate(moves))
    nodes[:, :3] = corners[cells]
    return CurvedCells(degree=degree, cells=cells, nodes=nodes)


def smallest_jacobian(curved: CurvedCells) -> float:
    """Smallest determinant of the Jacobian in units of the straight cell's, over a fine set of points of all cells."""
    import basix

    points = basix.create_lattice(basix.CellType.triangle, 2 * curved.degree + 3, basix.LatticeType.equispaced, True)
    _, by_x, by_y = geometry_element(curved.degree).tabulate(1, points)[..., 0]
    along, across = by_x @ curved.nodes, by_y @ curved.nodes
    determinants = _cross(along, across)
    first, second = curved.nodes[:, 1] - curved.nodes[:, 0], curved.nodes[:, 2] - curved.nodes[:, 0]
    return float((determinants / _cross(first, second)[:, None]).min())


def largest_deviation(pieces: list[CurvedEdges], degree: int) -> Deviation:
    """Largest distance between the elements' polynomial edges and the exact curves, and of their normals.

    Between the elements' nodes the exact curve is taken to be a polynomial of some degrees more.
    """
    between = np.linspace(-1.0, 1.0, 4 * degree + 9, dtype=np.float64)
    distance = angle = 0.0
    for edges in pieces:
        lengths = np.hypot(*edges.chords.T)[:, None]
        exact, polynomial = (edges.blend(_inner_nodes(order)).T for order in (degree + _MORE_DEGREES, degree))
        apart = _heights_at(between, exact) - _heights_at(between, polynomial)
        turned = np.arctan(_slopes_at(between, exact) / lengths) - np.arctan(_slopes_at(between, polynomial) / lengths)
        distance, angle = max(distance, float(np.abs(apart).max())), max(angle, float(np.abs(turned).max()))
    return Deviation(distance=distance, angle=angle)


def _heights_at(x: NDArray[np.float64], blend: NDArray[np.float64]) -> NDArray[np.float64]:
    """s (1 - s) e(s) at x = 2s - 1, shape (elements, len(x))."""
    heights: NDArray[np.float64] = 0.25 * (1.0 - x**2) * chebval(x, blend)
    return heights


def _slopes_at(x: NDArray[np.float64], blend: NDArray[np.float64]) -> NDArray[np.float64]:
    slopes: NDArray[np.float64] = -x * chebval(x, blend) + 0.5 * (1.0 - x**2) * chebval(x, chebder(blend))
    return slopes


def _cross(one: NDArray[np.float64], other: NDArray[np.float64]) -> NDArray[np.float64]:
    result: NDArray[np.float64] = one[..., 0] * other[..., 1] - one[..., 1] * other[..., 0]
    return result


def _inner_nodes(degree: int) -> NDArray[np.float64]:
    """Parts of an edge at which its inner nodes lie: Gauss-Lobatto points, shape (degree - 1,)."""
    element = geometry_element(degree)
    # Edge 2 leads from corner 0 to corner 1.
    return np.asarray(element.points[np.array(element.entity_dofs[1][2], dtype=np.int64), 0])


def geometry_element(degree: int) -> basix.finite_element.FiniteElement:
    """The element of curved cells' geometry, whose inner nodes on edges are Gauss-Lobatto points."""
    import basix

    return basix.create_element(
        basix.ElementFamily.P, basix.CellType.triangle, degree, basix.LagrangeVariant.gll_warped
    )
