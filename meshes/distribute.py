"""Distribution of a mesh in plain arrays on one process as a tagged dolfinx mesh."""

from __future__ import annotations

from dataclasses import dataclass

import basix.ufl
import numpy as np
from dolfinx import graph
from dolfinx.mesh import Mesh, MeshTags, create_mesh, meshtags, meshtags_from_entities
from mpi4py import MPI

from hydroelastic.meshes.compat import distribute_entity_data
from hydroelastic.meshes.geometry_nodes import geometry_nodes
from hydroelastic.meshes.tagged_mesh import TaggedMesh


@dataclass(frozen=True, kw_only=True)
class TankMesh:
    """A distributed mesh of triangles with named groups of cells and facets.

    Attributes:
        mesh: the dolfinx mesh.
        facet_tags: tags of the facets on named curves.
        facet_names: physical name → tag, of facets.
        cell_tags: tags of this process's own cells.
        cell_names: physical name → tag, of cells.
        deviation: of the edges from the curves meshed, in units of length; zero where that is not known.
    """

    mesh: Mesh
    facet_tags: MeshTags
    facet_names: dict[str, int]
    cell_tags: MeshTags
    cell_names: dict[str, int]
    deviation: float = 0.0

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
    """Distribute a mesh over the processes of ``comm``.

    Args:
        comm: communicator.
        tagged: the whole mesh on rank 0; ``None`` on the others.

    Returns:
        The distributed mesh (collective).
    """
    if comm.rank == 0:
        assert tagged is not None
        points, cells, degree = geometry_nodes(tagged)
        facets, facet_values = tagged.facets, tagged.facet_tags.astype(np.int32)
        deviation = tagged.deviation.distance
        shared = degree, tagged.facet_names, tagged.cell_names, tagged.cell_tags.astype(np.int32), deviation
    else:
        shared = None
    degree, facet_names, cell_names, cell_values, deviation = comm.bcast(shared, root=0)
    element = basix.ufl.element("Lagrange", "triangle", degree, shape=(2,))
    if comm.rank > 0:
        points, cells = np.empty((0, 2)), np.empty((0, element.dim // 2), dtype=np.int64)
        facets, facet_values = np.empty((0, 2), dtype=np.int64), np.empty(0, dtype=np.int32)
    mesh = create_mesh(comm, cells=cells, x=points, e=element)
    dim = mesh.topology.dim
    mesh.topology.create_entities(dim - 1)
    mesh.topology.create_connectivity(dim - 1, dim)
    mesh.topology.create_connectivity(dim - 1, 0)
    local, values = distribute_entity_data(mesh, dim - 1, facets, facet_values)
    own = np.arange(mesh.topology.index_map(dim).size_local, dtype=np.int32)
    # All cells came from rank 0, so that their numbers there are their original ones.
    return TankMesh(
        mesh=mesh,
        facet_tags=meshtags_from_entities(mesh, dim - 1, graph.adjacencylist(local), values),
        facet_names=facet_names,
        cell_tags=meshtags(mesh, dim, own, cell_values[mesh.topology.original_cell_index[: len(own)]]),
        cell_names=cell_names,
        deviation=deviation,
    )
