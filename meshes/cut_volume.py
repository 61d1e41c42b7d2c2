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
from scipy.spatial import cKDTree

from hydroelastic.meshes.geometry import INTERFACE, LOWER_LIQUID
from hydroelastic.meshes.tagged_mesh import MisplacedError, NodedMesh

_DIM = 3


def cut_volume(mesh: NodedMesh, names: tuple[str, ...], kept: tuple[str, ...]) -> NodedMesh:
    """Double the nodes of named faces."""
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
    _, first, places_of_parts = np.unique(part, return_index=True, return_inverse=True)
    nodes = mesh.cells.ravel()[first]
    order = np.lexsort((first, nodes))
    again = np.zeros(len(order), dtype=bool)
    again[order[1:]] = nodes[order[1:]] == nodes[order[:-1]]
    numbers = nodes.copy()
    numbers[again] = len(mesh.points) + np.arange(np.count_nonzero(again))
    cells = numbers[places_of_parts].reshape(mesh.cells.shape)
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
    """Name the parts of a liquid that share no node ``liquid_1``, ``liquid_2``, …, where there are several.

    The interface of two of them is then named ``interface:lower_liquid_1:upper_liquid_2``, say.
    """
    count, part = connected_parts(mesh.cells)
    if count == len(mesh.cell_names):
        return mesh
    moving = [number for name, number in mesh.facet_names.items() if not name.startswith("mirror")]
    surface = np.isin(mesh.cells, mesh.facets[np.isin(mesh.facet_tags, moving)]).any(axis=1)
    if len(np.unique(part[surface])) < count:
        raise MisplacedError("baffles close in a part of the liquid that has no still surface")
    liquids = {number: name for name, number in mesh.cell_names.items()}
    _, first = np.unique(part, return_index=True)
    names = [f"{liquids[mesh.cell_tags[cell]]}_{number}" for number, cell in enumerate(first, 1)]
    parted = replace(
        mesh,
        cell_tags=(part + 1).astype(np.int32),
        cell_names={name: number for number, name in enumerate(names, 1)},
    )
    return _with_interfaces(parted, names, part) if INTERFACE in mesh.facet_names else parted


def _with_interfaces(mesh: NodedMesh, names: list[str], part: NDArray[np.int32]) -> NodedMesh:
    """Name the faces of the interface by the parts of the liquids on both sides."""
    part_of_node = np.zeros(len(mesh.points), np.int32)
    part_of_node[mesh.cells] = part[:, None]
    (faces,) = np.nonzero(mesh.facet_tags == mesh.facet_names[INTERFACE])
    owner = part_of_node[mesh.facets[faces, 0]]
    is_lower = np.array([name.startswith(LOWER_LIQUID) for name in names])[owner]
    middles = mesh.points[mesh.facets[faces]].mean(axis=1)
    beyond = np.empty_like(owner)
    for side in (is_lower, ~is_lower):
        beyond[side] = owner[~side][cKDTree(middles[~side]).query(middles[side])[1]]
    below, above = np.where(is_lower, owner, beyond), np.where(is_lower, beyond, owner)
    facet_names = {name: number for name, number in mesh.facet_names.items() if name != INTERFACE}
    tags, last = mesh.facet_tags.copy(), max(mesh.facet_names.values())
    for number, (one, other) in enumerate(sorted(set(zip(below.tolist(), above.tolist(), strict=True))), last + 1):
        facet_names[f"{INTERFACE}:{names[one]}:{names[other]}"] = number
        tags[faces[(below == one) & (above == other)]] = number
    return replace(mesh, facet_tags=tags, facet_names=facet_names)


def connected_parts(cells: NDArray[np.int64]) -> tuple[int, NDArray[np.int32]]:
    """Return the number of parts of some cells that share no node, and the part of each cell."""
    size = len(cells) + int(cells.max()) + 1
    rows = np.repeat(np.arange(len(cells)), cells.shape[1])
    links = coo_array((np.ones(cells.size, np.int8), (rows, len(cells) + cells.ravel())), shape=(size, size))
    _, part = connected_components(links, directed=False)
    found, part = np.unique(part[: len(cells)], return_inverse=True)
    return len(found), part.astype(np.int32)


def _find(faces: NDArray[np.int64], wanted: NDArray[np.int64]) -> NDArray[np.int64]:
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
    ends: NDArray[np.int64] = cells[:, places][open_].ravel()
    linked: NDArray[np.int64] = corner[:, places][open_].ravel()
    key = sides.ravel() * (int(cells.max()) + 1) + ends
    order = np.argsort(key, kind="stable")
    key = key[order]
    linked = linked[order]
    same = key[1:] == key[:-1]
    one, other = linked[:-1][same], linked[1:][same]
    links = coo_array((np.ones(len(one), np.int8), (one, other)), shape=(cells.size, cells.size))
    _, part = connected_components(links, directed=False)
    return np.asarray(part)
