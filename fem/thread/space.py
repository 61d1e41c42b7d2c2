"""Function spaces of a thread: positions, axial force, curvature, and data at nodes.

Positions are continuous polynomials of degree p, the axial force discontinuous ones of degree p − 1 (a displacement
form with p ≥ 2 locks), the curvature κ = r_ss of a thread that bends again continuous of degree p.
"""

from __future__ import annotations

from typing import Any

import basix.ufl
import numpy as np
import ufl
from dolfinx import fem
from dolfinx import mesh as dolfinx_mesh
from mpi4py import MPI
from numpy.typing import NDArray

from hydroelastic.meshes.line import line_mesh


class ThreadSpace:
    """Spaces on one mesh of a thread.

    Args:
        nodes: s of the nodes from 0 to the length, increasing, the same on all processes.
        degree: p of the positions, at least 1.
        dimension: of the positions, 2 or 3.
        bends: whether there is a curvature.

    Attributes:
        nodes: as given.
        degree: as given.
        dimension: as given.
        mesh: intervals in s.
        mixed: space of (r, S) or (r, S, κ).
        scalars: linear functions, for data at nodes.
        vectors: linear vectors.
        quadrature_degree: of all forms.
        end_tags: 1 for the node of end A, 2 for that of end B.
        ds: measure of the two ends, by these tags.
        dx: measure of the elements.
        dS: measure of the nodes between elements.
    """

    def __init__(
        self, comm: MPI.Comm, nodes: NDArray[np.float64], degree: int, dimension: int, bends: bool = False
    ) -> None:
        self.nodes, self.degree, self.dimension, self.bends = nodes, degree, dimension, bends
        self.mesh = line_mesh(comm, nodes, ghosts=True)
        position = basix.ufl.element("Lagrange", "interval", degree, shape=(dimension,))
        force = basix.ufl.element("Lagrange", "interval", degree - 1, discontinuous=True)
        parts = [position, force, position] if bends else [position, force]
        self.mixed = fem.functionspace(self.mesh, basix.ufl.mixed_element(parts))
        self.scalars = fem.functionspace(self.mesh, ("Lagrange", 1))
        self.vectors = fem.functionspace(self.mesh, ("Lagrange", 1, (dimension,)))
        # The load is no polynomial: its error of quadrature stays below that of the nodes, of order 2p.
        self.quadrature_degree = 2 * degree + 2
        metadata = {"quadrature_degree": self.quadrature_degree}
        self.end_tags = self._tag_ends()
        self.dx = ufl.Measure("dx", self.mesh, metadata=metadata)
        self.dS = ufl.Measure("dS", self.mesh, metadata={"quadrature_degree": 1})
        self.ds = ufl.Measure("ds", self.mesh, subdomain_data=self.end_tags, metadata={"quadrature_degree": 1})

    def _tag_ends(self) -> Any:
        def at(s: float) -> Any:
            return dolfinx_mesh.locate_entities_boundary(self.mesh, 0, lambda x: np.isclose(x[0], s))

        ends = [at(self.nodes[0]), at(self.nodes[-1])]
        facets = np.concatenate(ends).astype(np.int32)
        values = np.concatenate([np.full(len(end), tag, dtype=np.int32) for tag, end in enumerate(ends, start=1)])
        order = np.argsort(facets)
        return dolfinx_mesh.meshtags(self.mesh, 0, facets[order], values[order])

    def at_nodes(self, values: dict[float, Any], space: Any) -> Any:
        """A linear function with given values at some nodes and zero at the others."""
        function = fem.Function(space)
        size = space.dofmap.bs
        places = space.tabulate_dof_coordinates()[:, 0]
        for s, value in values.items():
            found = np.isclose(places, s, rtol=0.0, atol=1e-12 * self.nodes[-1])
            function.x.array.reshape(-1, size)[: len(places)][found] += value
        return function
