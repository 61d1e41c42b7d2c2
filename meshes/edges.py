"""Edges of triangles, each counted once."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

# Corners of a triangle's three edges; edge i lies opposite corner i.
EDGE_CORNERS = np.array([[1, 2], [2, 0], [0, 1]])


@dataclass(frozen=True, kw_only=True)
class Edges:
    """The edges of some triangles."""

    nodes: NDArray[np.int64]  # the two nodes of each edge, the smaller first, in ascending order, shape (edges, 2)
    places: NDArray[np.int64]  # the edge opposite each corner of each triangle, shape (triangles, 3)

    def find(self, wanted: NDArray[np.int64]) -> NDArray[np.int64]:
        """Where each pair of nodes of shape (n, 2) stands among the edges; every one must be there."""
        width = int(self.nodes.max()) + 1
        wanted = np.sort(wanted, axis=1)
        rows: NDArray[np.int64] = np.searchsorted(self.nodes @ [width, 1], wanted @ [width, 1])
        if np.any(rows == len(self.nodes)) or np.any(self.nodes[rows] != wanted):
            raise KeyError("a pair of nodes is no edge of a triangle")
        return rows


def edges_of(cells: NDArray[np.int64]) -> Edges:
    """The edges of triangles given by their nodes, shape (triangles, 3)."""
    width = int(cells.max()) + 1
    sides = np.sort(cells[:, EDGE_CORNERS], axis=2).reshape(-1, 2)
    keys, places = np.unique(sides @ [width, 1], return_inverse=True)
    return Edges(nodes=np.column_stack(np.divmod(keys, width)), places=places.reshape(-1, 3))
