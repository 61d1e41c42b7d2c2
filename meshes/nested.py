"""Series of meshes that differ in element size alone: every triangle cut into four, and nodes drawn towards the tips.

A series starts from elements of one size, with one fan of triangles around each tip. After k halvings a fan of radius
R holds n = 2ᵏ rings of equal width; drawing its nodes to the tip,

    x − x_tip  →  t^{β−1} (x − x_tip),        t = 0 at the tip, 1 on the fan's outer edges,

gives the algebraically graded rings r_i = R (i/n)^β: elements of size ~ β (r/R)^{1−1/β} R/n. Source: Babuška, Kellogg
and Pitkäranta, Numer. Math. 33 (1979) 447; theory of the aquarium, docs, § 5.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import inf

import numpy as np
from numpy.typing import NDArray

from hydroelastic.meshes.edges import edges_of
from hydroelastic.meshes.geometry import TankGeometry
from hydroelastic.meshes.grading import Grading, TipRings, tip_rings
from hydroelastic.meshes.tagged_mesh import MeshError, TaggedMesh
from hydroelastic.meshes.tank import build_tank_mesh


@dataclass(frozen=True, kw_only=True)
class NestedMeshes:
    """The meshes of one tank.

    Attributes:
        geometry: the tank.
        size: largest element at the top in the first mesh, in the geometry's unit of length.
        bulk_size: largest element anywhere in the first mesh.
    """

    geometry: TankGeometry
    size: float
    bulk_size: float

    @property
    def fans(self) -> tuple[TipRings, ...]:
        """The fan of triangles around each tip in the first mesh."""
        return tip_rings(self.geometry, self._grading)

    def mesh(self, halvings: int, exponent: float = 1.0) -> TaggedMesh:
        """One mesh of the series, on the calling process only.

        Args:
            halvings: how often all elements of the first mesh are halved.
            exponent: β ≥ 1; 1 leaves the mesh uniform. Whatever it is, the mesh has the same triangles.

        Raises:
            MeshError: if gmsh fails.
        """
        mesh = build_tank_mesh(self.geometry, self._grading)
        for _ in range(halvings):
            mesh = halved(mesh)
        for fan in self.fans:
            mesh = replace(mesh, points=_drawn(mesh.points, fan, exponent))
        return mesh

    def innermost_ring(self, halvings: int, exponent: float) -> float:
        """Radius of the smallest ring of a mesh; infinite without tips."""
        radius = min((float(fan.radii[0]) for fan in self.fans), default=inf)
        return radius * 2.0 ** (-halvings * exponent)

    @property
    def _grading(self) -> Grading:
        # No ring is to be smaller than this: there is one.
        sizes = (self.size,) * len(self.geometry.segments)
        return Grading(surface_sizes=sizes, bulk_size=self.bulk_size, tip_size=inf)


def halved(mesh: TaggedMesh) -> TaggedMesh:
    """Cut every straight triangle into four of half its size.

    Raises:
        MeshError: if cells are curved.
    """
    if mesh.curved is not None:
        raise MeshError("a mesh with curved cells is not halved: make a finer one")
    corners = mesh.cells
    edges = edges_of(corners)
    middles = len(mesh.points) + edges.places
    (a, b, c), (bc, ca, ab) = corners.T, middles.T
    cells = np.stack([[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]).transpose(2, 0, 1).reshape(-1, 3)
    start, end = mesh.facets.T
    middle = len(mesh.points) + edges.find(mesh.facets)
    facets = np.stack([[start, middle], [middle, end]]).transpose(2, 0, 1).reshape(-1, 2)
    return replace(
        mesh,
        points=np.vstack([mesh.points, mesh.points[edges.nodes].mean(axis=1)]),
        cells=cells,
        cell_tags=np.repeat(mesh.cell_tags, 4),
        facets=facets,
        facet_tags=np.repeat(mesh.facet_tags, 2),
    )


def _drawn(points: NDArray[np.float64], fan: TipRings, exponent: float) -> NDArray[np.float64]:
    """Draw the nodes of a tip's fan of one ring towards the tip; all others stay."""
    tip = np.array([fan.centre, 0.0])
    away = points - tip
    radius = np.linalg.norm(away, axis=1)
    angle = np.arctan2(np.abs(away[:, 1]), away[:, 0])
    # The outer edge of a sector is a chord: t is the distance along the sector's middle over that of the chord.
    half = 0.5 * (fan.angles[1] - fan.angles[0])
    sector = np.clip(((angle - fan.angles[0]) / (2.0 * half)).astype(int), 0, len(fan.angles) - 2)
    middle = fan.angles[0] + half * (2 * sector + 1)
    t = radius * np.cos(angle - middle) / (fan.radii[-1] * np.cos(half))
    # The tip itself has no direction, and nodes of the outer edge are at 1 but for rounding.
    factor = np.where((t > 0.0) & (t < 1.0 - 1e-9), np.abs(t), 1.0) ** (exponent - 1.0)
    drawn: NDArray[np.float64] = tip + factor[:, None] * away
    return drawn
