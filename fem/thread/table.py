"""Fields along a line as plain tables on all processes: polynomials of each element, in order of s."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import basix
import numpy as np
from mpi4py import MPI
from numpy.typing import NDArray

from hydroelastic.meshes.compat import collapsed, geometry_dofmap


@dataclass(frozen=True)
class LineTable:
    """A field that is a polynomial on each element."""

    nodes: NDArray[np.float64]  # s of the nodes, increasing, shape (n + 1,)
    element: Any  # Lagrange element of basix, of one component
    values: NDArray[np.float64]  # at the element's points, shape (n, points, components)

    def at(self, s: NDArray[np.float64], derivative: int = 0) -> NDArray[np.float64]:
        """Values, or derivatives by s; at nodes between elements those of the next element."""
        s = np.asarray(s, dtype=np.float64)
        cells = np.clip(np.searchsorted(self.nodes, s, side="right") - 1, 0, len(self.nodes) - 2)
        sizes = np.diff(self.nodes)[cells]
        points = (s - self.nodes[cells]) / sizes
        basis = self.element.tabulate(derivative, points[:, None])[derivative, :, :, 0]
        result: NDArray[np.float64] = np.einsum("mi,mik->mk", basis, self.values[cells])
        return result / sizes[:, None] ** derivative

    def at_ends(self, derivative: int = 0) -> NDArray[np.float64]:
        """Values, or derivatives by s, at both nodes of each element, shape (n, 2, components)."""
        basis = self.element.tabulate(derivative, np.array([[0.0], [1.0]]))[derivative, :, :, 0]
        result: NDArray[np.float64] = np.einsum("ei,nik->nek", basis, self.values)
        return result / np.diff(self.nodes)[:, None, None] ** derivative

    def times(self, factor: float) -> LineTable:
        """The field in other units."""
        return LineTable(self.nodes, self.element, factor * self.values)


def line_table(function: Any, nodes: NDArray[np.float64], component: int | None = None) -> LineTable:
    """Gather a function, or a part of one in a mixed space."""
    space, places = function.function_space, None
    if component is not None:
        space, places = collapsed(space, component)
    array = function.x.array if places is None else function.x.array[places]
    size = space.dofmap.bs
    mesh = space.mesh
    owned = mesh.topology.index_map(1).size_local
    local = array.reshape(-1, size)[space.dofmap.list[:owned]]
    element = _scalar_element(space)
    return LineTable(nodes, element, gather_elements(mesh, local, element.points))


def gather_elements(mesh: Any, local: NDArray[np.float64], points: NDArray[np.float64]) -> NDArray[np.float64]:
    """Values of all elements in order of s, points of an element in the order of s too if `points` are."""
    ends = mesh.geometry.x[geometry_dofmap(mesh)[: len(local)], 0]
    backwards = ends[:, 0] > ends[:, 1]
    # The points in the order from the other end.
    mirrored = np.argmin(np.abs(points[:, 0][None, :] - (1.0 - points[:, 0])[:, None]), axis=1)
    local = np.where(backwards[:, None, None], local[:, mirrored], local)
    comm: MPI.Comm = mesh.comm
    pieces = comm.allgather((ends.min(axis=1), local))
    order = np.argsort(np.concatenate([piece[0] for piece in pieces]))
    return np.concatenate([piece[1] for piece in pieces])[order]


def _scalar_element(space: Any) -> Any:
    element = space.ufl_element().basix_element
    return basix.create_element(
        basix.ElementFamily.P,
        basix.CellType.interval,
        element.degree,
        element.lagrange_variant,
        dpc_variant=element.dpc_variant,
        discontinuous=element.discontinuous,
    )
