"""Distribution of a mesh in plain arrays on one process as a tagged dolfinx mesh."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import lru_cache

import basix.ufl
import numpy as np
from dolfinx import graph
from dolfinx.mesh import Mesh, MeshTags, create_mesh, meshtags, meshtags_from_entities
from mpi4py import MPI
from numpy.typing import NDArray

from hydroelastic.meshes.bisection import bisected
from hydroelastic.meshes.compat import distribute_entity_data, given_partition
from hydroelastic.meshes.geometry_nodes import geometry_nodes
from hydroelastic.meshes.tagged_mesh import TaggedMesh


@dataclass(frozen=True, kw_only=True)
class TankMesh:
    """A distributed mesh of simplices with named groups of cells and facets."""

    mesh: Mesh  # the dolfinx mesh
    facet_tags: MeshTags  # tags of the facets on named curves
    facet_names: dict[str, int]  # physical name → tag, of facets
    cell_tags: MeshTags  # tags of this process's own cells
    cell_names: dict[str, int]  # physical name → tag, of cells
    deviation: float = 0.0  # of the edges from the curves meshed, in units of length; zero where that is not known

    def facets(self, name: str) -> np.ndarray:
        """This process's facets of one group."""
        return self.facet_tags.find(self.facet_names[name])

    def cells(self, name: str) -> np.ndarray:
        """This process's own cells of one group."""
        return self.cell_tags.find(self.cell_names[name])

    @property
    def cell_count(self) -> int:
        """Number of cells over all processes."""
        return int(self.mesh.topology.index_map(self.mesh.topology.dim).size_global)


@dataclass(frozen=True, kw_only=True)
class NodedMesh:
    """A mesh of simplices of one degree in plain arrays, with its nodes in the order of dolfinx."""

    cell: str  # "triangle" or "tetrahedron"
    degree: int  # of the geometry
    points: NDArray[np.float64]  # nodes, m or dimensionless, shape (nodes, dim)
    # numbers of each cell's nodes in the order of ``basix.ufl.element("Lagrange", cell, degree)``, the corners first,
    # shape (cells, nodes per cell)
    cells: NDArray[np.int64]
    cell_tags: NDArray[np.int32]  # group of each cell, shape (cells,)
    facets: NDArray[np.int64]  # numbers of the corners of the tagged facets, shape (facets, dim)
    facet_tags: NDArray[np.int32]  # group of each of them, shape (facets,)
    cell_names: dict[str, int]  # physical name → tag, of cells
    facet_names: dict[str, int]  # physical name → tag, of facets
    deviation: float = 0.0  # see `TankMesh`


def distribute_mesh(comm: MPI.Comm, tagged: TaggedMesh | None) -> TankMesh:
    """Distribute a mesh of triangles over the processes of ``comm``."""
    noded = None
    if comm.rank == 0:
        assert tagged is not None
        points, cells, degree = geometry_nodes(tagged)
        noded = NodedMesh(
            cell="triangle",
            degree=degree,
            points=points,
            cells=cells,
            cell_tags=tagged.cell_tags.astype(np.int32),
            facets=tagged.facets,
            facet_tags=tagged.facet_tags.astype(np.int32),
            cell_names=tagged.cell_names,
            facet_names=tagged.facet_names,
            deviation=tagged.deviation.distance,
        )
    return distribute_nodes(comm, noded)


def distribute_nodes(comm: MPI.Comm, noded: NodedMesh | None) -> TankMesh:
    """Distribute a mesh of any simplices; the whole of it is on rank 0, ``None`` on the others (collective)."""
    # Its large arrays but the tags of cells stay on rank 0; others have arrays of the same widths without rows.
    own = noded or comm.bcast(None, root=0)
    if noded is not None and comm.size > 1:
        comm.bcast(
            replace(
                noded,
                points=noded.points[:0],
                cells=noded.cells[:0],
                facets=noded.facets[:0],
                facet_tags=noded.facet_tags[:0],
            ),
            root=0,
        )
    dim = own.points.shape[1]
    element = _geometry_element(own.cell, own.degree, dim)
    partitioner = None
    if comm.size > 1:
        partitioner = given_partition(bisected(own.points[own.cells[:, : dim + 1]].mean(axis=1), comm.size))
    mesh = create_mesh(comm, cells=own.cells, x=own.points, e=element, partitioner=partitioner)
    mesh.topology.create_entities(dim - 1)
    mesh.topology.create_connectivity(dim - 1, dim)
    mesh.topology.create_connectivity(dim - 1, 0)
    local, values = distribute_entity_data(mesh, dim - 1, own.facets, own.facet_tags)
    cells = np.arange(mesh.topology.index_map(dim).size_local, dtype=np.int32)
    # All cells came from rank 0, so that their numbers there are their original ones.
    return TankMesh(
        mesh=mesh,
        facet_tags=meshtags_from_entities(mesh, dim - 1, graph.adjacencylist(local), values),
        facet_names=own.facet_names,
        cell_tags=meshtags(mesh, dim, cells, own.cell_tags[mesh.topology.original_cell_index[: len(cells)]]),
        cell_names=own.cell_names,
        deviation=own.deviation,
    )


@lru_cache(maxsize=16)
def _geometry_element(cell: str, degree: int, dim: int) -> basix.ufl._ElementBase:
    return basix.ufl.element("Lagrange", cell, degree, shape=(dim,))
