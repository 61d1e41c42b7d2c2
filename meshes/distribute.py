"""Distribution of a mesh in plain arrays on one process as a tagged dolfinx mesh.

Parts of a mesh for processes, by recursive bisection of its cells' middles along their longest extent.

Where a whole mesh is on one process its coordinates are known, and bisection takes a sort; the partition of its graph,
dolfinx's default, costs two processes several times what the rest of the mesh does (M. J. Berger, S. H. Bokhari, IEEE
Trans. Comput. C-36 (1987) 570).
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import lru_cache

import basix.ufl
import numpy as np
from dolfinx import graph
from dolfinx.mesh import Mesh, MeshTags, create_mesh, meshtags, meshtags_from_entities
from mpi4py import MPI
from numpy.typing import NDArray

from hydroelastic.meshes.compat import distribute_entity_data, given_partition
from hydroelastic.meshes.curved_cells import geometry_element
from hydroelastic.meshes.edges import edges_of
from hydroelastic.meshes.tagged_mesh import NodedMesh, TaggedMesh
from hydroelastic.physics.arrays import FloatArray


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


def bisected(places: FloatArray, parts: int) -> NDArray[np.int32]:
    """Return the part of each place; all have as many, but for one at most from each division."""
    part_of = np.zeros(len(places), dtype=np.int32)
    if parts == 1 or not len(places):
        return part_of
    lower = parts // 2
    first = len(places) * lower // parts
    axis = np.ptp(places, axis=0).argmax()
    # Stable: places in one plane are divided alike on any machine.
    order = np.argsort(places[:, axis], kind="stable")
    part_of[order[:first]] = bisected(places[order[:first]], lower)
    part_of[order[first:]] = lower + bisected(places[order[first:]], parts - lower)
    return part_of


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
