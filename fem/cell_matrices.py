"""Matrices of Laplace's equation on single cells, with the unknowns inside of the cells condensed.

On a straight cell all integrals are those of the reference cell, up to dim² numbers:

    A_e = Σ_ab G_ab R_ab,    G = |det J| J⁻¹J⁻ᵀ,    R_ab = ∫∂_aφ ∂_bφ over the reference cell

On a curved one, and in the geometries of `physics.geometry` with a weight w or a term m² ψq, they are integrated by
quadrature. No load acts on an unknown inside (i) of a cell: it follows from
those on the cell's boundary (o), which alone remain in the matrix (static condensation):

    ψ_i = E ψ_o,    E = −A_ii⁻¹A_io,    A = A_oo + A_oi E
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property, lru_cache

import basix
import basix.ufl
import numpy as np

from hydroelastic.fem.cells import CURVED_QUADRATURE, cell_jacobians, cell_positions, is_straight, owned_cells
from hydroelastic.fem.numbering import Numbering
from hydroelastic.physics.geometry import PLANE, Geometry

# The term m² ψq has two degrees more than ∇ψ·∇q, and 1/r is no polynomial; beside the axis ψq/r is one.
_TRANSVERSE_QUADRATURE = 4

# Triangles are similar if ratios of their sides agree to so many digits; small ones are to the rounding of coordinates.
_DIGITS = 12
# With more shapes than this part of the cells the copies for all cells take longer than they save.
_FEW_SHAPES = 0.9

TOGETHER = 512
"""Number of cells that are integrated at once."""


@dataclass(frozen=True, kw_only=True)
class CellMatrices:
    """∫∇ψ·∇q on the cells that this process owns.

    Attributes:
        numbering: of the unknowns, which says what is condensed.
        geometry: what the plane of the mesh stands for.
    """

    numbering: Numbering
    geometry: Geometry = PLANE

    @property
    def laplace(self) -> np.ndarray:
        """A on the unknowns of each cell, shape (cells, unknowns, unknowns)."""
        return self._condensed[0]

    @property
    def extension(self) -> np.ndarray:
        """E, from the unknowns of each cell to ψ inside of it, shape (cells, inside, unknowns)."""
        return self._condensed[1]

    @cached_property
    def _condensed(self) -> tuple[np.ndarray, np.ndarray]:
        numbering, (cells, alike) = self.numbering, self._shapes()
        outside, inside = len(numbering.outside), len(numbering.inside)
        laplace, extension = np.empty((len(cells), outside, outside)), np.empty((len(cells), inside, outside))
        for first in range(0, len(cells), TOGETHER):
            some = slice(first, first + TOGETHER)
            laplace[some], extension[some] = condensed(self._full(cells[some]), outside)
        if not self.geometry.transverse:
            # A constant has no energy. Long waves over a thin layer, with little in each cell, keep their digits.
            laplace[:, range(outside), range(outside)] -= laplace.sum(axis=2)
        return laplace[alike], extension[alike]

    def _shapes(self) -> tuple[np.ndarray, np.ndarray | slice]:
        """Owned cells of different matrices, and the index among them for every owned cell.

        In the plane similar triangles have the same G, as most of those in the rings around a tip.
        """
        mesh = self.numbering.space.mesh
        cells = owned_cells(mesh)
        if self._more or mesh.topology.dim != 2:
            return cells, slice(None)
        x, y = np.moveaxis(self.straight[0], 2, 0)
        sides = x + 1j * y
        ratios = np.round(sides[:, 1] / sides[:, 0], _DIGITS)
        _, first, alike = np.unique(ratios, return_index=True, return_inverse=True)
        return (cells[first], alike) if len(first) < _FEW_SHAPES * len(cells) else (cells, slice(None))

    def _full(self, cells: np.ndarray) -> np.ndarray:
        weights = self.geometry.weight(cell_positions(self.numbering.space.mesh, cells, self.points)[..., 0])
        transverse = (self.geometry.transverse / weights,) if self.geometry.transverse else ()
        gradient = (weights,) * self.numbering.space.mesh.topology.dim
        return self.integrals(cells, np.stack([*gradient, *transverse], axis=-1))

    @property
    def points(self) -> np.ndarray:
        """Points of the reference cell at which `integrals` takes its weights, shape (points, dim): one of them where
        weights are constant in each cell."""
        element = self.numbering.space.element.basix_element
        points = _points(element.cell_type, element.degree, self._more)[0]
        return points[:1] if self.geometry.kind == "plane" else points

    @property
    def _more(self) -> int:
        straight, plane = is_straight(self.numbering.space.mesh), self.geometry.kind == "plane"
        return (0 if straight else CURVED_QUADRATURE) + (0 if plane else _TRANSVERSE_QUADRATURE)

    @cached_property
    def straight(self) -> tuple[np.ndarray, np.ndarray]:
        """J⁻¹ of each cell, shape (cells, dim, dim), and |det J|; of straight cells."""
        mesh = self.numbering.space.mesh
        jacobian = cell_jacobians(mesh, owned_cells(mesh), np.zeros((1, mesh.topology.dim)))[:, 0]
        return np.linalg.inv(jacobian), np.abs(np.linalg.det(jacobian))

    def integrals(self, cells: np.ndarray, weights: np.ndarray) -> np.ndarray:
        """Return ∫(Σᵢ wᵢ ∂ᵢψ ∂ᵢq + w ψq) over some cells, the unknowns before those inside."""
        mesh, element, more = self.numbering.space.mesh, self.numbering.space.element.basix_element, self._more
        order, dim = tuple(map(int, (*self.numbering.outside, *self.numbering.inside))), mesh.topology.dim
        if not more:
            reference = _reference_laplace(element.cell_type, element.degree, order)
            inverse, measure = (part[cells] for part in self.straight)
            metric = measure[:, None, None] * (inverse * weights @ inverse.transpose(0, 2, 1))
            full = metric.reshape(len(cells), -1) @ reference
            return full.reshape(len(cells), len(order), len(order))
        slopes, shares = _slopes(element.cell_type, element.degree, order, more)
        points = _points(element.cell_type, element.degree, more)[0]
        jacobians = cell_jacobians(mesh, cells, points)
        measures = (shares * np.abs(np.linalg.det(jacobians)))[..., None] * weights
        gradients = np.linalg.inv(jacobians).transpose(0, 1, 3, 2) @ slopes
        weighted = (measures[..., :dim, None] * gradients).reshape(len(cells), -1, len(order))
        product: np.ndarray = gradients.reshape(weighted.shape).transpose(0, 2, 1) @ weighted
        if measures.shape[-1] > dim:
            basis = element.tabulate(0, points)[0, :, order, 0].T
            product += basis.T @ (measures[..., dim:] * basis)
        return product


def condensed(matrices: np.ndarray, outside: int) -> tuple[np.ndarray, np.ndarray]:
    """Condense the last unknowns of symmetric matrices."""
    extension = -np.linalg.solve(matrices[:, outside:, outside:], matrices[:, outside:, :outside])
    return matrices[:, :outside, :outside] + matrices[:, :outside, outside:] @ extension, extension


def _points(cell_type: basix.CellType, degree: int, more: int) -> tuple[np.ndarray, np.ndarray]:
    """Points and weights on the reference cell, exact for ∇ψ·∇q on straight cells and ``more`` degrees."""
    points, weights = basix.make_quadrature(cell_type, 2 * degree - 2 + more)
    return points, weights


@lru_cache(maxsize=16)
def _slopes(cell_type: basix.CellType, degree: int, order: tuple[int, ...], more: int) -> tuple[np.ndarray, np.ndarray]:
    """Reference gradients of the basis at the points, shape (points, dim, functions), and the weights."""
    points, weights = _points(cell_type, degree, more)
    table = basix.ufl.element("Lagrange", cell_type.name, degree).basix_element.tabulate(1, points)
    return np.ascontiguousarray(table[1:, :, order, 0].transpose(1, 0, 2)), weights


@lru_cache(maxsize=16)
def _reference_laplace(cell_type: basix.CellType, degree: int, order: tuple[int, ...]) -> np.ndarray:
    slopes, weights = _slopes(cell_type, degree, order, 0)
    tensor = np.einsum("q,qan,qbm->abnm", weights, slopes, slopes, optimize=True)
    return tensor.reshape(slopes.shape[1] ** 2, -1)
