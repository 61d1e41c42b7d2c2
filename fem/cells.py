"""Geometry of the cells of this process: positions and Jacobians of straight or curved simplices at reference
points."""

from __future__ import annotations

from functools import lru_cache

import basix.ufl
import numpy as np
from dolfinx.mesh import Mesh

from hydroelastic.meshes.compat import coordinate_degree, geometry_dofmap

CURVED_QUADRATURE = 6
"""On curved cells integrands are no polynomials: so many degrees more leave less than the geometry does."""


def cell_positions(mesh: Mesh, cells: np.ndarray, reference: np.ndarray) -> np.ndarray:
    """Coordinates of points of the reference cell in some cells.

    Args:
        mesh: the mesh.
        cells: local cells, shape (cells,).
        reference: points of the reference cell, shape (points, dim).

    Returns:
        Coordinates in the unit of the mesh, shape (cells, points, gdim).
    """
    basis = _coordinate_basis(mesh, reference, 0)[0]
    nodes = cell_nodes(mesh, cells)
    # Relative to a corner, so that rounding is that of the cell's distance from the origin.
    corner = nodes[:, :1]
    points: np.ndarray = corner + basis @ (nodes - corner)
    return points


def cell_jacobians(mesh: Mesh, cells: np.ndarray, reference: np.ndarray) -> np.ndarray:
    """Derivatives of the coordinates with respect to those of the reference cell (columns).

    Args:
        mesh: the mesh.
        cells: local cells, shape (cells,).
        reference: points of the reference cell, shape (points, dim).

    Returns:
        Shape (cells, points, gdim, dim); (cells, 1, gdim, dim) where all cells are straight.
    """
    if is_straight(mesh):
        reference = reference[:1]
    slopes = _coordinate_basis(mesh, reference, 1)[1:]
    dim, points, nodes = slopes.shape
    products = slopes.reshape(-1, nodes) @ cell_nodes(mesh, cells)
    # In full, because −1 stands for nothing where a process has none of the cells.
    jacobians: np.ndarray = products.reshape(len(cells), dim, points, products.shape[2]).transpose(0, 2, 3, 1)
    return jacobians


def is_straight(mesh: Mesh) -> bool:
    """Whether the cells are straight: one Jacobian holds for all of a cell."""
    return coordinate_degree(mesh) == 1


def cell_nodes(mesh: Mesh, cells: np.ndarray) -> np.ndarray:
    """Nodes that span the coordinates of some cells, corners first, shape (cells, nodes, gdim)."""
    nodes: np.ndarray = mesh.geometry.x[geometry_dofmap(mesh)[cells]][:, :, : mesh.geometry.dim]
    return nodes


def cell_corners(mesh: Mesh, cells: np.ndarray) -> np.ndarray:
    """Corners of some cells, shape (cells, dim + 1, gdim)."""
    return cell_nodes(mesh, cells)[:, : mesh.topology.dim + 1]


def owned_cells(mesh: Mesh) -> np.ndarray:
    """The cells that this process owns."""
    return np.arange(mesh.topology.index_map(mesh.topology.dim).size_local, dtype=np.int32)


def _coordinate_basis(mesh: Mesh, reference: np.ndarray, derivatives: int) -> np.ndarray:
    points = np.ascontiguousarray(reference)
    return _tabulated(mesh.topology.cell_name(), coordinate_degree(mesh), derivatives, points.tobytes(), points.shape)


@lru_cache(maxsize=64)
def _tabulated(cell_name: str, degree: int, derivatives: int, points: bytes, shape: tuple[int, ...]) -> np.ndarray:
    element = basix.ufl.element("Lagrange", cell_name, degree).basix_element
    table: np.ndarray = element.tabulate(derivatives, np.frombuffer(points).reshape(shape))[..., 0]
    return table


def cells_at(mesh: Mesh, points: np.ndarray) -> np.ndarray:
    """Which owned cells have a corner exactly at one of some points (points, gdim): shape (cells,)."""
    corners = cell_corners(mesh, owned_cells(mesh))
    there = np.zeros(len(corners), dtype=bool)
    for point in points:
        there |= np.all(corners == point, axis=2).any(axis=1)
    return there
