"""Series of meshes that differ in element size alone: every triangle cut into four, and nodes drawn towards corners.

A series starts from elements of one size, with one fan of triangles around each corner. After k halvings a fan of
radius R holds n = 2ᵏ rings of equal width; drawing its nodes to the corner,

    x − x_corner  →  t^{β−1} (x − x_corner),        t = 0 at the corner, 1 on the fan's outer edges,

gives the algebraically graded rings r_i = R (i/n)^β: elements of size ~ β (r/R)^{1−1/β} R/n. Source: Babuška, Kellogg
and Pitkäranta, Numer. Math. 33 (1979) 447; theory of the aquarium, docs, § 5.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import partial
from math import inf

import numpy as np
from numpy.typing import NDArray

from hydroelastic.meshes.build import build_mesh
from hydroelastic.meshes.edges import edges_of
from hydroelastic.meshes.geometry import TankGeometry
from hydroelastic.meshes.grading import Grading, tip_rings
from hydroelastic.meshes.outline import GradedPoint, Outline, Point
from hydroelastic.meshes.tagged_mesh import MeshError, TaggedMesh
from hydroelastic.meshes.tank import build_tank_mesh

# Nodes on the outer edges of a fan are at t = 1 but for rounding.
_AT_EDGE = 1e-9


@dataclass(frozen=True, kw_only=True)
class NestedMeshes:
    """The meshes of one domain with straight boundaries."""

    make: Callable[[], TaggedMesh]  # creates the first mesh, of straight triangles: those at a corner are its fan
    # the corners, each with the radius of its fan, or a larger one, as the outer one; no two fans touch
    graded_points: tuple[GradedPoint, ...]

    def mesh(self, halvings: int, exponents: tuple[float, ...] | None = None) -> TaggedMesh:
        """One mesh of the series, on the calling process only."""
        first = self.make()
        mesh = first
        for _ in range(halvings):
            mesh = halved(mesh)
        for graded, exponent in zip(self.graded_points, exponents or (), strict=exponents is not None):
            mesh = replace(mesh, points=_drawn(mesh, first, graded.point, exponent))
        return mesh

    def innermost_ring(self, halvings: int, exponents: tuple[float, ...] | None = None) -> float:
        """Radius of the smallest ring of a mesh, or a little more; infinite without corners."""
        powers = exponents or (1.0,) * len(self.graded_points)
        return min(
            (
                graded.outer * 2.0 ** (-halvings * exponent)
                for graded, exponent in zip(self.graded_points, powers, strict=True)
            ),
            default=inf,
        )


def rectangle_meshes(geometry: TankGeometry, *, size: float, bulk_size: float) -> NestedMeshes:
    """The meshes of a tank of one liquid without floats."""
    # A single ring.
    grading = Grading(surface_sizes=(size,) * len(geometry.segments), bulk_size=bulk_size, tip_size=inf)
    graded_points = tuple(
        GradedPoint(point=(ring.centre, 0.0), inner=inf, outer=float(ring.radii[-1]))
        for ring in tip_rings(geometry, grading)
    )
    return NestedMeshes(make=partial(build_tank_mesh, geometry, grading), graded_points=graded_points)


def outline_meshes(outline: Outline, *, bulk_size: float) -> NestedMeshes:
    """The meshes of an outline of straight curves with their sizes, cut open where it says so."""
    return NestedMeshes(make=partial(build_mesh, outline, bulk_size=bulk_size), graded_points=outline.graded_points)


def halved(mesh: TaggedMesh) -> TaggedMesh:
    """Cut every straight triangle into four of half its size, one after the other in place of their parent.

    A mesh that is cut open stays so: edges on both sides of a cut have nodes of their own.
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


def _drawn(mesh: TaggedMesh, first: TaggedMesh, graded: Point, exponent: float) -> NDArray[np.float64]:
    """Draw the nodes of a corner's fan towards the corner; all others stay.

    t is the sum of a node's barycentric coordinates at the outer edge of the fan's triangle of the first mesh in which
    it lies.
    """
    place = np.array(graded)
    at_corner = np.all(first.points[first.cells] == place, axis=2)
    fan = np.flatnonzero(at_corner.any(axis=1))
    if not len(fan):
        raise MeshError(f"no triangle of the first mesh is at the corner ({graded[0]:g}, {graded[1]:g})")
    tip = np.argmax(at_corner[fan], axis=1)
    others = (tip[:, None] + [1, 2]) % 3
    outer = first.points[np.take_along_axis(first.cells[fan], others, axis=1)] - place
    # Children follow each other in place of their parent.
    within = mesh.cells.reshape(len(first.cells), -1)[fan]
    away = mesh.points[within] - place
    t = np.einsum("fnx,fxk->fn", away, np.linalg.inv(outer))
    points = mesh.points.copy()
    inside = (t > 0.0) & (t < 1.0 - _AT_EDGE)
    points[within[inside]] = place + t[inside, None] ** (exponent - 1.0) * away[inside]
    return points
