"""Cutting a mesh open along edges: the cells on both sides get nodes of their own.

Around each node the cells form parts that are connected through uncut edges; every part has its own node. The tip of a
slit inside the liquid stays one node, an interface that divides the liquids doubles all of its own.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hydroelastic.meshes.edges import EDGE_CORNERS, Edges


def cut_open(
    cells: NDArray[np.int64], edges: Edges, cut: NDArray[np.int64]
) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Double nodes along edges."""
    # Slow to import, so only where there is something to cut.
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    # Of every corner of every cell: the two edges there link it to the same node's corners of the cells beyond.
    corner = np.arange(cells.size).reshape(cells.shape)
    sides = np.repeat(edges.places[:, :, None], 2, axis=2)
    ends = cells[:, EDGE_CORNERS]
    corners = corner[:, EDGE_CORNERS]
    kept = ~np.isin(sides, cut)
    # An edge and one of its nodes: two cells have both in common, or one on the boundary.
    key = sides[kept] * (int(cells.max()) + 1) + ends[kept]
    order = np.argsort(key, kind="stable")
    key, linked = key[order], corners[kept][order]
    same = key[1:] == key[:-1]
    one, other = linked[:-1][same], linked[1:][same]
    links = coo_array((np.ones(len(one), dtype=np.int8), (one, other)), shape=(cells.size, cells.size))
    _, part = connected_components(links, directed=False)
    # A node's first part keeps its number.
    _, first, part = np.unique(part, return_index=True, return_inverse=True)
    node_of_part = cells.ravel()[first]
    order = np.lexsort((first, node_of_part))
    again = np.zeros(len(order), dtype=bool)
    again[order[1:]] = node_of_part[order[1:]] == node_of_part[order[:-1]]
    count = int(cells.max()) + 1
    copies = np.flatnonzero(again)[np.argsort(first[again], kind="stable")]
    numbers = node_of_part.copy()
    numbers[copies] = count + np.arange(len(copies))
    return numbers[part].reshape(cells.shape), np.concatenate([np.arange(count), node_of_part[copies]])
