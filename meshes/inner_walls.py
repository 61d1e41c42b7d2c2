"""Walls inside of the liquid in a mesh that a user brings, and parts of the liquid that are not connected.

A face of the boundary that has liquid beyond it is a wall without thickness. A forgotten ``fragment`` leaves such
walls, with nodes of their own on both sides, matching or not; those that are meant are declared by a physical group.
"""

from __future__ import annotations

from dataclasses import replace
from math import factorial

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from hydroelastic.meshes.cut_volume import connected_parts
from hydroelastic.meshes.cutting import cut_open
from hydroelastic.meshes.edges import EDGE_CORNERS, edges_of
from hydroelastic.meshes.geometry import BAFFLE
from hydroelastic.meshes.tagged_mesh import MeshError, TaggedMesh

# Distance beyond a face at which liquid is looked for, in units of the face.
_BEYOND = 1e-4
# Places this close, in units of the extent, are one; files may hold single precision.
_SAME_PLACE = 1e-6
# Of a coordinate inside of a cell.
_ROUNDING = 1e-9
_MOST_NAMED = 3


def opened_along_baffles(mesh: TaggedMesh, file: str) -> TaggedMesh:
    """Double the nodes of the edges in the group ``baffle``, where they are not doubled yet."""
    edges = edges_of(mesh.cells)
    try:
        tagged = edges.find(mesh.facets)
    except KeyError as error:
        raise MeshError(f"{file} has tagged edges that are no edges of its triangles") from error
    is_baffle = mesh.facet_tags == mesh.facet_names.get(BAFFLE, -1)
    declared = mesh.facets[is_baffle]
    cells, origin = cut_open(mesh.cells, edges, tagged[is_baffle])
    # One of the triangles at each tagged edge, and the opposite corner.
    sides, place = np.unique(edges.places, return_index=True)
    cell, opposite = np.divmod(place[np.searchsorted(sides, tagged)], 3)
    opened = replace(mesh, points=mesh.points[origin], cells=cells, facets=cells[cell[:, None], EDGE_CORNERS[opposite]])
    require_declared_walls(opened.points, cells, declared, file)
    parts = connected_parts(cells)[0]
    if parts > 1:
        raise MeshError(
            f'the walls of group "{BAFFLE}" in {file} divide the liquid into {parts} parts: solve each as a scene of '
            "its own"
        )
    return opened


def require_declared_walls(
    points: NDArray[np.float64], cells: NDArray[np.int64], declared: NDArray[np.int64], file: str
) -> float:
    """Return the length or area of the declared walls inside of the liquid, m or m²."""
    facets, opposite = boundary_facets(cells)
    middles, edges = points[facets].mean(axis=1), points[facets[:, 1:]] - points[facets[:, :1]]
    sizes = np.linalg.norm(edges, axis=2).max(axis=1)
    bases = np.linalg.qr(edges.transpose(0, 2, 1))[0]
    outward = middles - points[opposite]
    outward -= np.einsum("nij,nkj,nk->ni", bases, bases, outward)
    outward *= (_BEYOND * sizes / np.linalg.norm(outward, axis=1))[:, None]
    inside = _are_inside(middles + outward, points[cells])
    extent = np.ptp(points, axis=0).max()
    known = np.zeros(len(facets), dtype=bool)
    if len(declared):
        known = cKDTree(points[declared].mean(axis=1)).query(middles)[0] < _SAME_PLACE * extent
    # Each wall has faces on both of its sides.
    areas = 0.5 * np.linalg.det(edges @ edges.transpose(0, 2, 1)) ** 0.5 / factorial(edges.shape[1])
    wrong = inside & ~known
    # Of the nodes at one place one is taken.
    _, place = np.unique(np.round(points / (_SAME_PLACE * extent)), axis=0, return_inverse=True)
    if wrong.any():
        count, wall = connected_parts(place.ravel()[facets[wrong]])
        unit, places = ("m", "m²")[points.shape[1] - 2], points[facets[wrong]]
        named = [
            f"{areas[wrong][wall == one].sum():.4g} {unit} at {_box(places[wall == one], extent)}"
            for one in range(count)
        ]
        parts = connected_parts(cells)[0]
        raise MeshError(
            f"{file} has walls inside of the liquid, where nodes are doubled or do not match: {_listed(named)}"
            + (f"; they divide it into {parts} parts" if parts > 1 else "")
            + f". Join the regions before they are meshed (fragment, in gmsh), or declare walls that are meant by the "
            f'physical group "{BAFFLE}"'
        )
    count, part = connected_parts(place.ravel()[cells])
    if count > 1:
        named = [_box(points[cells[part == one]], extent) for one in range(count)]
        raise MeshError(
            f"{file} holds {count} parts of the liquid that are not connected: {_listed(named)}. Join them, or solve "
            "each as a scene of its own"
        )
    return float(areas[inside].sum())


def boundary_facets(cells: NDArray[np.int64]) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Return the facets that only one cell has, with its opposite corner."""
    corners = np.arange(cells.shape[1])
    facets = np.concatenate([np.delete(cells, corner, axis=1) for corner in corners])
    _, first, count = np.unique(np.sort(facets, axis=1), axis=0, return_index=True, return_counts=True)
    if count.max() > 2:
        raise MeshError("more than two cells share one face: cells overlap")
    alone = first[count == 1]
    return facets[alone], cells.T.ravel()[alone]


def _are_inside(places: NDArray[np.float64], corners: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Whether each place lies in any of the cells with these corners."""
    inside = np.zeros(len(places), dtype=bool)
    middles = corners.mean(axis=1)
    frames = np.linalg.inv(corners[:, 1:] - corners[:, :1])
    # Cells of one size are looked up together.
    sizes = np.frexp(np.linalg.norm(corners - middles[:, None], axis=2).max(axis=1))[1]
    for size in np.unique(sizes):
        (cells,) = np.nonzero(sizes == size)
        near = cKDTree(middles[cells]).query_ball_point(places, np.ldexp(1.0, size))
        place = np.repeat(np.arange(len(places)), [len(one) for one in near])
        cell = cells[np.concatenate(near).astype(np.int64)]
        local = np.einsum("ni,nij->nj", places[place] - corners[cell, 0], frames[cell])
        inside[place[(local.min(axis=1) > -_ROUNDING) & (local.sum(axis=1) < 1.0 + _ROUNDING)]] = True
    return inside


def _box(points: NDArray[np.float64], extent: float) -> str:
    ranges = zip("xyz", *(f(points.reshape(-1, points.shape[-1]), axis=0) for f in (np.min, np.max)), strict=False)
    return ", ".join(
        f"{axis} = {low:.4g} m" if high - low < _SAME_PLACE * extent else f"{low:.4g} < {axis} < {high:.4g} m"
        for axis, low, high in ranges
    )


def _listed(named: list[str]) -> str:
    more = len(named) - _MOST_NAMED
    return "; ".join(named[:_MOST_NAMED]) + (f"; and {more} more" if more > 0 else "")
