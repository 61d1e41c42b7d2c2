"""Facets of named surfaces in the reference coordinates of their cells."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import lru_cache

import basix
import numpy as np
from dolfinx.mesh import Mesh

from hydroelastic.fem.cells import cell_jacobians, cell_positions
from hydroelastic.fem.liquid import LiquidSpace


@dataclass(frozen=True, kw_only=True)
class FacetGroup:
    """Facets of this process that have the same local number in their cells.

    Attributes:
        mesh: the mesh.
        cells: the cells, shape (facets,).
        place: number of the facet in each of them.
        reference_corners: the facet's corners on the reference cell, shape (corners, dim).
        reference_normal: outward normal there, as long as the facet's measure over that of the reference facet.
        facet_type: shape of the facet.
    """

    mesh: Mesh
    cells: np.ndarray
    place: int
    reference_corners: np.ndarray
    reference_normal: np.ndarray
    facet_type: basix.CellType

    def reference_points(self, local: np.ndarray) -> np.ndarray:
        """Points of the reference cell for points ``local`` of the reference facet, shape (points, dim)."""
        origin = self.reference_corners[0]
        points: np.ndarray = origin + local @ (self.reference_corners[1:] - origin)
        return points

    def physical_points(self, reference: np.ndarray) -> np.ndarray:
        """Coordinates of points of the reference cell in every cell, shape (facets, points, gdim)."""
        return cell_positions(self.mesh, self.cells, reference)

    def normals(self, reference: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Outward unit normals of the cells, and the measure of the facets over that of the reference facet."""
        jacobians = self.jacobians(reference)
        # Nanson's formula: n ds = det J J⁻ᵀ n₀ ds₀.
        areas = np.abs(np.linalg.det(jacobians))[..., None] * (self.reference_normal @ np.linalg.inv(jacobians))
        measures = np.linalg.norm(areas, axis=-1)
        return areas / measures[..., None], measures

    def jacobians(self, reference: np.ndarray) -> np.ndarray:
        """See `cells.cell_jacobians`."""
        return cell_jacobians(self.mesh, self.cells, reference)

    def subset(self, chosen: np.ndarray) -> FacetGroup:
        """Some of the facets, by a mask."""
        return replace(self, cells=self.cells[chosen])

    @property
    def longest(self) -> float:
        """Length of the longest edge between corners of these facets; 0 without facets."""
        corners = self.physical_points(self.reference_corners)
        return float(np.linalg.norm(corners[:, 1:] - corners[:, :1], axis=2).max(initial=0.0))


def facet_groups(liquid: LiquidSpace, name: str, layer: int | None = None) -> Iterator[FacetGroup]:
    """Facets of a named surface on this process, group by group; those of one layer's cells, or all."""
    mesh = liquid.tank.mesh
    dim = mesh.topology.dim
    mesh.topology.create_connectivity(dim, dim - 1)
    facets = liquid.tank.facets(name)
    facet_to_cell = mesh.topology.connectivity(dim - 1, dim)
    cell_to_facet = mesh.topology.connectivity(dim, dim - 1)
    cells = facet_to_cell.array[facet_to_cell.offsets[facets]].astype(np.int64)
    places = np.argmax(cell_to_facet.array.reshape(-1, dim + 1)[cells] == facets[:, None], axis=1)
    if layer is not None:
        inside = liquid.layer_of[liquid.space.dofmap.list[cells, 0]] == layer
        cells, places = cells[inside], places[inside]
    cell_type = basix.CellType[mesh.topology.cell_type.name]
    for place in np.unique(places):
        corners, normal, facet_type = _reference_facet(cell_type, int(place))
        yield FacetGroup(
            mesh=mesh,
            cells=cells[places == place],
            place=int(place),
            reference_corners=corners,
            reference_normal=normal,
            facet_type=facet_type,
        )


@lru_cache(maxsize=16)
def _reference_facet(cell_type: basix.CellType, place: int) -> tuple[np.ndarray, np.ndarray, basix.CellType]:
    """Corners, normal and type of a facet of the reference cell, see `FacetGroup`."""
    facets = len(basix.topology(cell_type)) - 2
    corners = basix.geometry(cell_type)[basix.topology(cell_type)[facets][place]]
    edges = corners[1:] - corners[0]
    normal = basix.cell.facet_outward_normals(cell_type)[place] * np.sqrt(np.linalg.det(edges @ edges.T))
    return corners, normal, basix.cell.subentity_types(cell_type)[facets][place]
