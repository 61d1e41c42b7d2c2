"""Nodes of a mesh whose cells are all of one polynomial degree, as dolfinx wants them; each shared node once."""

from __future__ import annotations

import basix
import numpy as np
from numpy.typing import NDArray

from hydroelastic.meshes.curved_cells import geometry_element
from hydroelastic.meshes.edges import edges_of
from hydroelastic.meshes.tagged_mesh import TaggedMesh


def geometry_nodes(mesh: TaggedMesh) -> tuple[NDArray[np.float64], NDArray[np.int64], int]:
    """Nodes and cells of the geometry's degree: straight cells get straight nodes."""
    if mesh.curved is None:
        return mesh.points, mesh.cells, 1
    degree = mesh.curved.degree
    element = geometry_element(degree)
    barycentric = np.column_stack([1.0 - element.points.sum(axis=1), element.points])
    positions = barycentric @ mesh.points[mesh.cells]
    positions[mesh.curved.cells] = mesh.curved.nodes
    edges = edges_of(mesh.cells)
    numbers = np.empty((len(mesh.cells), len(barycentric)), dtype=np.int64)
    numbers[:, :3] = mesh.cells
    count = len(mesh.points)
    for place, (first, second) in enumerate(basix.topology(basix.CellType.triangle)[1]):
        # From the edge's smaller node to the larger one, whichever comes first in the cell.
        along = np.arange(degree - 1)
        onwards = mesh.cells[:, first] < mesh.cells[:, second]
        order = np.where(onwards[:, None], along, along[::-1])
        numbers[:, element.entity_dofs[1][place]] = count + (degree - 1) * edges.places[:, [place]] + order
    count += (degree - 1) * len(edges.nodes)
    inner = element.entity_dofs[2][0]
    numbers[:, inner] = count + np.arange(len(mesh.cells) * len(inner)).reshape(len(mesh.cells), len(inner))
    points = np.empty((count + len(inner) * len(mesh.cells), 2))
    points[numbers] = positions
    # The nodes of an edge are those of its curved cell, not of a straight neighbour.
    points[numbers[mesh.curved.cells]] = mesh.curved.nodes
    points[: len(mesh.points)] = mesh.points
    return points, numbers, degree
