"""Cutting tetrahedra open along faces: the cells on both sides get nodes of their own.

Around each node the cells form parts that are connected through faces that are not cut; every part has its own node.
The edge of a baffle in the liquid stays one node, a face that divides the liquid doubles all of its own.
"""

from __future__ import annotations

from dataclasses import replace

import basix
import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from hydroelastic.meshes.distribute import NodedMesh
from hydroelastic.meshes.geometry import LIQUID
from hydroelastic.meshes.tagged_mesh import MeshError

_DIM = 3


def cut_volume(mesh: NodedMesh, names: tuple[str, ...], kept: tuple[str, ...]) -> NodedMesh:
    """Double the nodes of named faces.

    Args:
        mesh: tetrahedra, whose named faces are part of it.
        names: those that are cut.
        kept: those of them that keep their names, on both sides.
    """
    element = basix.create_element(
        basix.ElementFamily.P, basix.CellType.tetrahedron, mesh.degree, basix.LagrangeVariant.gll_warped
    )
    # The closure of each of the four faces: its corners first.
    places = np.array(element.entity_closure_dofs[_DIM - 1])
    corners = np.sort(mesh.cells[:, basix.topology(basix.CellType.tetrahedron)[_DIM - 1]], axis=2)
    faces, number = np.unique(corners.reshape(-1, _DIM), axis=0, return_inverse=True)
    number = number.reshape(-1, 4)
    tagged = _find(faces, np.sort(mesh.facets, axis=1))
    cut = np.isin(mesh.facet_tags, [mesh.facet_names[name] for name in names])
    open_ = ~np.isin(number, tagged[cut])
    part = _parts(mesh.cells, places, number, open_)
    # The first part around a node keeps its number.
    _, first, part = np.unique(part, return_index=True, return_inverse=True)
    nodes = mesh.cells.ravel()[first]
    order = np.lexsort((first, nodes))
    again = np.zeros(len(order), dtype=bool)
    again[order[1:]] = nodes[order[1:]] == nodes[order[:-1]]
    numbers = nodes.copy()
    numbers[again] = len(mesh.points) + np.arange(np.count_nonzero(again))
    cells = numbers[part].reshape(mesh.cells.shape)
    tags = np.full(len(faces), -1)
    left = np.isin(mesh.facet_tags, [number for name, number in mesh.facet_names.items() if name in kept]) | ~cut
    tags[tagged[left]] = mesh.facet_tags[left]
    cell, place = np.nonzero(tags[number] >= 0)
    # A face inside the liquid that is not cut has two cells, and one pair of nodes.
    facets = cells[cell[:, None], np.array(basix.topology(basix.CellType.tetrahedron)[_DIM - 1])[place]]
    _, single = np.unique(np.sort(facets, axis=1), axis=0, return_index=True)
    return replace(
        mesh,
        points=np.concatenate([mesh.points, mesh.points[nodes[again]]]),
        cells=cells,
        facets=facets[single],
        facet_tags=tags[number[cell, place]][single].astype(np.int32),
        facet_names={name: number for name, number in mesh.facet_names.items() if name not in names or name in kept},
    )


def with_regions(mesh: NodedMesh) -> NodedMesh:
    """Name the parts of one liquid that share no node ``liquid_1``, ``liquid_2``, …; leave a single one as it is.

    Raises:
        MeshError: if nothing moves in a part, or there are two liquids and more parts.
    """
    count, part = connected_parts(mesh.cells)
    if count == len(mesh.cell_names):
        return mesh
    if len(mesh.cell_names) > 1:
        raise MeshError("baffles divide one of two liquids, which is not modelled")
    moving = [number for name, number in mesh.facet_names.items() if not name.startswith("mirror")]
    surface = np.isin(mesh.cells, mesh.facets[np.isin(mesh.facet_tags, moving)]).any(axis=1)
    if len(np.unique(part[surface])) < count:
        raise MeshError("baffles close in a part of the liquid that has no still surface")
    return replace(
        mesh,
        cell_tags=(part + 1).astype(np.int32),
        cell_names={f"{LIQUID}_{number}": number for number in range(1, count + 1)},
    )


def connected_parts(cells: NDArray[np.int64]) -> tuple[int, NDArray[np.int32]]:
    """Return the number of parts of some cells that share no node, and the part of each cell."""
    size = len(cells) + int(cells.max()) + 1
    rows = np.repeat(np.arange(len(cells)), cells.shape[1])
    links = coo_array((np.ones(cells.size, np.int8), (rows, len(cells) + cells.ravel())), shape=(size, size))
    _, part = connected_components(links, directed=False)
    found, part = np.unique(part[: len(cells)], return_inverse=True)
    return len(found), part.astype(np.int32)


def _find(faces: NDArray[np.int64], wanted: NDArray[np.int64]) -> NDArray[np.int64]:
    """Where each of some faces stands among all."""
    width = int(faces.max()) + 1
    powers = np.array([width**2, width, 1])
    found: NDArray[np.int64] = np.searchsorted(faces @ powers, wanted @ powers)
    return found


def _parts(
    cells: NDArray[np.int64], places: NDArray[np.int64], faces: NDArray[np.int64], open_: NDArray[np.bool_]
) -> NDArray[np.int32]:
    """The part around its node of each node of each cell, shape (cells times nodes,)."""
    corner = np.arange(cells.size).reshape(cells.shape)
    sides = np.broadcast_to(faces[:, :, None], (len(cells), *places.shape))[open_]
    ends, linked = cells[:, places][open_], corner[:, places][open_]
    key = (sides * (int(cells.max()) + 1) + ends).ravel()
    order = np.argsort(key, kind="stable")
    key, linked = key[order], linked.ravel()[order]
    same = key[1:] == key[:-1]
    one, other = linked[:-1][same], linked[1:][same]
    links = coo_array((np.ones(len(one), np.int8), (one, other)), shape=(cells.size, cells.size))
    _, part = connected_components(links, directed=False)
    return np.asarray(part)
