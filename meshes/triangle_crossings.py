"""Triangles in space that pass through each other, of which gmsh makes no mesh."""

from __future__ import annotations

import basix.ufl
import numpy as np
import ufl
from dolfinx import geometry
from dolfinx.mesh import create_mesh
from mpi4py import MPI

from hydroelastic.physics.arrays import FloatArray
from hydroelastic.physics.wetted_hulls import Triangles


def crossing_place(surface: Triangles) -> FloatArray | None:
    """Return a place near which one side of a triangle passes through another triangle, shape (3,); ``None`` if none
    does. Triangles with a common corner are not looked at."""
    element = basix.ufl.element("Lagrange", "triangle", 1, shape=(3,))
    mesh = create_mesh(MPI.COMM_SELF, cells=surface.corners, x=surface.points, e=ufl.Mesh(element))
    mesh.topology.create_entities(1)
    tree = geometry.bb_tree(mesh, 2)
    boxes = np.asarray(geometry.compute_collisions_trees(tree, tree)).reshape(-1, 2)
    pairs = mesh.topology.original_cell_index[boxes]
    own, other = surface.corners[pairs[:, 0]], surface.corners[pairs[:, 1]]
    apart = ~(own[:, :, None] == other[:, None, :]).any(axis=(1, 2))
    own, other = own[apart], other[apart]
    one, two, three = (surface.points[other[:, corner]] for corner in range(3))
    for corner in range(3):
        start, end = surface.points[own[:, corner]], surface.points[own[:, (corner + 1) % 3]]
        through = _volumes(one, two, three, start) * _volumes(one, two, three, end) < 0.0
        around = [_volumes(start, end, *pair) > 0.0 for pair in ((one, two), (two, three), (three, one))]
        found = np.flatnonzero(through & np.isin(np.sum(around, axis=0), (0, 3)))
        if len(found):
            place: FloatArray = 0.5 * (start[found[0]] + end[found[0]])
            return place
    return None


def _volumes(one: FloatArray, two: FloatArray, three: FloatArray, four: FloatArray) -> FloatArray:
    """Six times the volumes of tetrahedra with their signs, corners of shape (n, 3) → (n,)."""
    volumes: FloatArray = np.einsum("na,na->n", np.cross(two - one, three - one), four - one)
    return volumes
