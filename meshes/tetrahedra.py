"""Tetrahedra of gmsh as plain arrays, of any degree, with nodes in the order of dolfinx; their volume and Jacobians."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from itertools import combinations
from math import comb

import basix
import gmsh
import numpy as np
from numpy.typing import NDArray

from hydroelastic.meshes.geometry import LIQUID
from hydroelastic.meshes.surfaces import Surface
from hydroelastic.meshes.tagged_mesh import MeshError, NodedMesh

_TETRAHEDRON, _TRIANGLE = "tetrahedron", "triangle"
# Smallest Jacobian of an accepted cell over that of the straight cell.
_SMALLEST_JACOBIAN = 0.05
# In which cells are straightened, and then their neighbours.
_PASSES = 4
# Corners, edges, faces and cells after a division of each edge in two, of each face in four, of each cell in eight.
_DIVIDED = np.array([[1, 1, 0, 0], [0, 2, 3, 1], [0, 0, 4, 8], [0, 0, 0, 8]])


@dataclass(frozen=True, kw_only=True)
class VolumeMesh:
    """The mesh of a volume with what tells its geometry's error."""

    noded: NodedMesh  # the mesh
    volume: float  # the exact volume, of the part that is meshed
    # of a mesh to be refined, the surface on which nodes of a group of facets lie, or of several groups
    surfaces: dict[tuple[str, ...], Surface] = field(default_factory=dict)
    curved: bool = False  # of a mesh to be refined, whether any of them is curved
    straightened: float = 0.0  # volume by which straightened cells changed


def read_gmsh(degree: int, faces: dict[int, str], layers: dict[int, str] | None = None) -> NodedMesh:
    """The mesh of the current model, with nodes in the order of dolfinx."""
    tags, coordinates, _ = gmsh.model.mesh.getNodes()
    order = np.zeros(int(tags.max()) + 1, dtype=np.int64)
    order[tags.astype(np.int64)] = np.arange(len(tags))
    kind = gmsh.model.mesh.getElementType(_TETRAHEDRON, degree)
    named = layers or {-1: LIQUID}
    parts = [gmsh.model.mesh.getElementsByType(kind, tag)[1].astype(np.int64) for tag in named]
    places = np.array(gmsh.model.mesh.getElementProperties(kind)[4]).reshape(-1, 3)
    cells = order[np.concatenate(parts)].reshape(-1, len(places))
    layer_names = {name: number for number, name in enumerate(dict.fromkeys(named.values()), 1)}
    layer_tags = [layer_names[name] for name in named.values()]
    even, warped = (
        basix.create_element(basix.ElementFamily.P, basix.CellType.tetrahedron, degree, variant)
        for variant in (basix.LagrangeVariant.equispaced, basix.LagrangeVariant.gll_warped)
    )
    # gmsh numbers the nodes of a cell otherwise; they are found by their places.
    cells = cells[:, np.linalg.norm(places[None] - even.points[:, None], axis=2).argmin(axis=1)]
    points = coordinates.reshape(-1, 3)
    if degree > 2:
        # gmsh's nodes on an edge are evenly spaced; those of dolfinx are not, from three on.
        positions = even.tabulate(0, warped.points)[0, :, :, 0] @ points[cells]
        points = points.copy()
        points[cells] = positions
    names = {name: number for number, name in enumerate(sorted(set(faces.values())), 1)}
    triangle = gmsh.model.mesh.getElementType(_TRIANGLE, degree)
    facets, marks = [np.empty((0, 3), np.int64)], [np.empty(0, np.int32)]
    for tag, name in faces.items():
        _, nodes = gmsh.model.mesh.getElementsByType(triangle, tag)
        corners = order[nodes.astype(np.int64)].reshape(-1, (degree + 1) * (degree + 2) // 2)[:, :3]
        facets.append(corners)
        marks.append(np.full(len(corners), names[name], np.int32))
    return _renumbered(
        NodedMesh(
            cell=_TETRAHEDRON,
            degree=degree,
            points=points,
            cells=cells,
            cell_tags=np.repeat(layer_tags, [len(part) // len(places) for part in parts]).astype(np.int32),
            facets=np.concatenate(facets),
            facet_tags=np.concatenate(marks),
            cell_names=layer_names,
            facet_names=names,
        )
    )


def _renumbered(mesh: NodedMesh) -> NodedMesh:
    used = np.unique(mesh.cells)
    order = np.full(len(mesh.points), -1)
    order[used] = np.arange(len(used))
    return replace(mesh, points=mesh.points[used], cells=order[mesh.cells], facets=order[mesh.facets])


class FoldedError(MeshError):
    """A cell at a curved wall is inverted: smaller ones there help."""


def checked(mesh: NodedMesh, *, straighten: bool = True) -> tuple[NodedMesh, float]:
    """Straighten cells that a curved wall inverts, as it does in holes and at tips; or refuse them."""
    if not len(mesh.facets):
        raise MeshError("the liquid has no still surface at z = 0")
    changed = 0.0
    for _ in range(_PASSES):
        (folded,) = np.nonzero(smallest_jacobians(mesh) < _SMALLEST_JACOBIAN)
        if not len(folded):
            return mesh, changed
        if not straighten:
            break
        places = _element(mesh).points
        corners = np.column_stack([1.0 - places.sum(axis=1), places])
        points = mesh.points.copy()
        points[mesh.cells[folded]] = corners @ mesh.points[mesh.cells[folded, :4]]
        straight = replace(mesh, points=points)
        changed += float(np.abs(_volumes(straight, folded) - _volumes(mesh, folded)).sum())
        mesh = straight
    raise FoldedError("a cell at a curved wall is inverted: ask for a smaller tolerance, or leave a wider gap")


def _volumes(mesh: NodedMesh, cells: NDArray[np.int64]) -> NDArray[np.float64]:
    """∫det J over some cells, negative where they are inverted."""
    points, weights = basix.make_quadrature(basix.CellType.tetrahedron, 3 * mesh.degree + 3)
    return np.asarray(_determinants(replace(mesh, cells=mesh.cells[cells]), points) @ weights)


def smallest_jacobians(mesh: NodedMesh) -> NDArray[np.float64]:
    """Return the smallest det J of each cell over that of the straight cell between its corners, shape (cells,)."""
    straight = _jacobians(replace(mesh, degree=1, cells=mesh.cells[:, :4]), 1)[:, :1]
    return np.asarray((_jacobians(mesh, 2 * mesh.degree if mesh.degree > 1 else 1) / straight).min(axis=1))


def _jacobians(mesh: NodedMesh, lattice: int) -> NDArray[np.float64]:
    points = basix.create_lattice(basix.CellType.tetrahedron, lattice, basix.LatticeType.equispaced, True)
    return _determinants(mesh, points)


def mesh_volume(mesh: NodedMesh) -> float:
    """Return ∫1 over the cells."""
    return mesh_integral(mesh, lambda places: np.ones(len(places)))


def mesh_integral(mesh: NodedMesh, function: Callable[[NDArray[np.float64]], NDArray[np.float64]]) -> float:
    """∫f over the cells of f at places (n, 3)."""
    points, weights = basix.make_quadrature(basix.CellType.tetrahedron, 3 * mesh.degree + 3)
    table = _element(mesh).tabulate(0, points)[0, :, :, 0]
    places = np.einsum("qn,cnd->cqd", table, mesh.points[mesh.cells], optimize=True)
    values = function(places.reshape(-1, 3)).reshape(places.shape[:2])
    return float(((values * np.abs(_determinants(mesh, points))) @ weights).sum())


def _determinants(mesh: NodedMesh, points: NDArray[np.float64]) -> NDArray[np.float64]:
    slopes = _element(mesh).tabulate(1, points)[1:, :, :, 0]
    frames = np.einsum("dqn,cng->cqgd", slopes, mesh.points[mesh.cells], optimize=True)
    return np.asarray(np.linalg.det(frames))


def _element(mesh: NodedMesh) -> basix.finite_element.FiniteElement:
    return basix.create_element(
        basix.ElementFamily.P, basix.CellType.tetrahedron, mesh.degree, basix.LagrangeVariant.gll_warped
    )


def unknown_count(mesh: NodedMesh, degree: int, refinements: int = 0) -> int:
    """Return the number of continuous polynomials of a degree: by the corners, edges, faces and cells."""
    corners = np.sort(mesh.cells[:, :4], axis=1)
    faces, edges = (
        len(np.unique(corners[:, list(combinations(range(4), size))].reshape(-1, size), axis=0)) for size in (3, 2)
    )
    parts = np.array([len(np.unique(corners)), edges, faces, len(corners)])
    for _ in range(refinements):
        parts = _DIVIDED @ parts
    inner = [comb(degree - 1, dim) for dim in range(4)]
    return int(np.dot(inner, parts))
