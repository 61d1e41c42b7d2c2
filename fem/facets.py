"""Facets of named surfaces seen from their cells: where quadrature or sampling points of a facet lie."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import basix
import numpy as np

from hydroelastic.fem.liquid import LiquidSpace
from hydroelastic.meshes.compat import geometry_dofmap


@dataclass(frozen=True, kw_only=True)
class FacetGroup:
    """Facets of this process that have the same place in their cells (straight simplices).

    Attributes:
        cells: the cells, shape (facets,).
        cell_nodes: coordinates of the cells' nodes, shape (facets, nodes, gdim).
        reference_corners: the facet's corners on the reference cell, shape (corners, dim).
        facet_type: shape of the facet.
    """

    cells: np.ndarray
    cell_nodes: np.ndarray
    reference_corners: np.ndarray
    facet_type: basix.CellType

    def reference_points(self, local: np.ndarray) -> np.ndarray:
        """Points of the reference cell for points ``local`` of the reference facet, shape (points, dim)."""
        origin = self.reference_corners[0]
        points: np.ndarray = origin + local @ (self.reference_corners[1:] - origin)
        return points

    def physical_points(self, reference: np.ndarray) -> np.ndarray:
        """Coordinates of points of the reference cell in every cell, shape (facets, points, gdim)."""
        # Barycentric coordinates are the same in every straight simplex.
        barycentric = np.column_stack([1.0 - reference.sum(axis=1), reference])
        points: np.ndarray = np.einsum("qn,fnd->fqd", barycentric, self.cell_nodes)
        return points

    def edges(self) -> np.ndarray:
        """Edge vectors from each facet's first corner to the others, shape (facets, corners - 1, gdim)."""
        corners = self.physical_points(self.reference_corners)
        vectors: np.ndarray = corners[:, 1:] - corners[:, :1]
        return vectors


def facet_groups(liquid: LiquidSpace, name: str) -> Iterator[FacetGroup]:
    """Facets of a named surface on this process, group by group."""
    mesh = liquid.tank.mesh
    dim = mesh.topology.dim
    mesh.topology.create_connectivity(dim, dim - 1)
    facets = liquid.tank.facets(name)
    facet_to_cell = mesh.topology.connectivity(dim - 1, dim)
    cell_to_facet = mesh.topology.connectivity(dim, dim - 1)
    cells = np.array([facet_to_cell.links(facet)[0] for facet in facets], dtype=np.int64)
    places = np.array(
        [np.flatnonzero(cell_to_facet.links(cell) == facet)[0] for cell, facet in zip(cells, facets, strict=True)],
        dtype=np.int64,
    )
    cell_type = basix.CellType[mesh.topology.cell_type.name]
    nodes = mesh.geometry.x[geometry_dofmap(mesh)][:, :, : mesh.geometry.dim]
    for place in np.unique(places):
        chosen = cells[places == place]
        yield FacetGroup(
            cells=chosen,
            cell_nodes=nodes[chosen],
            reference_corners=basix.geometry(cell_type)[basix.topology(cell_type)[dim - 1][place]],
            facet_type=basix.cell.subentity_types(cell_type)[dim - 1][place],
        )
