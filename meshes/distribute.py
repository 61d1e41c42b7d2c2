"""From plain arrays on one process to a tagged dolfinx mesh spread over all."""

from __future__ import annotations

from dataclasses import dataclass

import basix.ufl
import numpy as np
from dolfinx import graph
from dolfinx.mesh import Mesh, MeshTags, create_mesh, meshtags_from_entities
from mpi4py import MPI

from hydroelastic.meshes.compat import distribute_entity_data
from hydroelastic.meshes.tagged_mesh import TaggedMesh


@dataclass(frozen=True, kw_only=True)
class TankMesh:
    """A distributed mesh of straight triangles with named groups of facets.

    Attributes:
        mesh: the dolfinx mesh.
        facet_tags: tags of the boundary facets.
        facet_names: physical name → tag.
    """

    mesh: Mesh
    facet_tags: MeshTags
    facet_names: dict[str, int]

    def facets(self, name: str) -> np.ndarray:
        """This process's facets of one group."""
        return self.facet_tags.find(self.facet_names[name])

    @property
    def cell_count(self) -> int:
        """Number of cells over all processes."""
        return int(self.mesh.topology.index_map(self.mesh.topology.dim).size_global)


def distribute_mesh(comm: MPI.Comm, tagged: TaggedMesh | None) -> TankMesh:
    """Spread a mesh over the processes of ``comm``.

    Args:
        comm: communicator.
        tagged: the whole mesh on rank 0; ``None`` on the others.

    Returns:
        The distributed mesh (collective).
    """
    if comm.rank == 0:
        assert tagged is not None
        points, cells = tagged.points, tagged.cells
        facets, tags = tagged.facets, tagged.facet_tags.astype(np.int32)
        names = tagged.facet_names
    else:
        points, cells = np.empty((0, 2)), np.empty((0, 3), dtype=np.int64)
        facets, tags, names = np.empty((0, 2), dtype=np.int64), np.empty(0, dtype=np.int32), {}
    names = comm.bcast(names, root=0)
    coordinates = basix.ufl.element("Lagrange", "triangle", 1, shape=(2,))
    mesh = create_mesh(
        comm,
        cells=cells,
        x=points,
        e=coordinates,
    )
    facet_dim = mesh.topology.dim - 1
    mesh.topology.create_entities(facet_dim)
    mesh.topology.create_connectivity(facet_dim, mesh.topology.dim)
    mesh.topology.create_connectivity(facet_dim, 0)
    local, values = distribute_entity_data(mesh, facet_dim, facets, tags)
    facet_tags = meshtags_from_entities(mesh, facet_dim, graph.adjacencylist(local), values)
    return TankMesh(mesh=mesh, facet_tags=facet_tags, facet_names=names)
