"""Geometry of the cells of this process: positions and Jacobians of straight or curved simplices at reference
points."""

from __future__ import annotations

from functools import lru_cache
from typing import Any

import basix.ufl
import numpy as np
from dolfinx.mesh import Mesh

from hydroelastic.meshes.compat import coordinate_degree, geometry_dofmap

CURVED_QUADRATURE = 6
"""On curved cells integrands are no polynomials: so many degrees more leave less than the geometry does."""

# Steps to the nearest point of a cell: Newton's method converges in a few where the point is inside.
_NEAREST_STEPS = 20


def cell_positions(mesh: Mesh, cells: np.ndarray, reference: np.ndarray) -> np.ndarray:
    """Coordinates of points of the reference cell in some cells."""
    basis = _coordinate_basis(mesh, reference, 0)[0]
    nodes = cell_nodes(mesh, cells)
    # Relative to a corner, so that rounding is that of the cell's distance from the origin.
    corner = nodes[:, :1]
    points: np.ndarray = corner + basis @ (nodes - corner)
    return points


def cell_jacobians(mesh: Mesh, cells: np.ndarray, reference: np.ndarray) -> np.ndarray:
    """Derivatives of the coordinates with respect to those of the reference cell (columns)."""
    if is_straight(mesh):
        reference = reference[:1]
    slopes = _coordinate_basis(mesh, reference, 1)[1:]
    dim, points, nodes = slopes.shape
    products = slopes.reshape(-1, nodes) @ cell_nodes(mesh, cells)
    # In full, because −1 stands for nothing where a process has none of the cells.
    jacobians: np.ndarray = products.reshape(len(cells), dim, points, products.shape[2]).transpose(0, 2, 3, 1)
    return jacobians


def nearest_in_cells(mesh: Mesh, cells: np.ndarray, points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The points of triangles of which each is nearest to a point of its own, straight or curved.

    Points outside of their cells have a nearest point too: Gauss-Newton steps that stay in the reference triangle, of
    which only those are taken that come nearer.
    """
    nodes = cell_nodes(mesh, cells)

    def tabulated(reference: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        table = _coordinate_element(mesh.topology.cell_name(), coordinate_degree(mesh)).tabulate(1, reference)[..., 0]
        offsets = np.einsum("pn,png->pg", table[0], nodes) - points
        return offsets, np.einsum("dpn,png->pgd", table[1:], nodes)

    reference = np.full(points.shape, 1.0 / 3.0)
    offsets, slopes = tabulated(reference)
    length: np.ndarray = np.ones(len(points))
    for _ in range(_NEAREST_STEPS):
        step = np.linalg.solve(slopes, offsets[..., None])[..., 0]
        tried = _in_reference_triangle(reference - length[:, None] * step)
        moved, tried_slopes = tabulated(tried)
        nearer = np.linalg.norm(moved, axis=1) < np.linalg.norm(offsets, axis=1)
        reference[nearer], offsets[nearer], slopes[nearer] = tried[nearer], moved[nearer], tried_slopes[nearer]
        length = np.where(nearer, 1.0, 0.5 * length)
    return reference, np.linalg.norm(offsets, axis=1)


def _in_reference_triangle(points: np.ndarray) -> np.ndarray:
    """The nearest points of the triangle 0 ≤ x, 0 ≤ y, x + y ≤ 1."""
    along = np.clip(0.5 * (1.0 + points[:, 0] - points[:, 1]), 0.0, 1.0)
    on_slope = np.column_stack([along, 1.0 - along])
    clipped = np.maximum(points, 0.0)
    return np.where(clipped.sum(axis=1, keepdims=True) > 1.0, on_slope, clipped)


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


@lru_cache(maxsize=8)
def _coordinate_element(cell_name: str, degree: int) -> Any:
    return basix.ufl.element("Lagrange", cell_name, degree).basix_element


@lru_cache(maxsize=64)
def _tabulated(cell_name: str, degree: int, derivatives: int, points: bytes, shape: tuple[int, ...]) -> np.ndarray:
    element = _coordinate_element(cell_name, degree)
    table: np.ndarray = element.tabulate(derivatives, np.frombuffer(points).reshape(shape))[..., 0]
    return table


def cells_at(mesh: Mesh, points: np.ndarray) -> np.ndarray:
    """Which owned cells have a corner exactly at one of some points (points, gdim): shape (cells,)."""
    corners = cell_corners(mesh, owned_cells(mesh))
    there = np.zeros(len(corners), dtype=bool)
    for point in points:
        there |= np.all(corners == point, axis=2).any(axis=1)
    return there
