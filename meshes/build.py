"""From an outline to its mesh: rings at the corners, gmsh between them, then cut open and curved."""

from __future__ import annotations

from dataclasses import replace
from math import pi

from hydroelastic.meshes.assembly import assemble
from hydroelastic.meshes.curved_cells import Sides, curve_cells, largest_deviation, smallest_jacobian
from hydroelastic.meshes.filling import fill
from hydroelastic.meshes.layout import Layout, lay_out
from hydroelastic.meshes.outline import Outline
from hydroelastic.meshes.tagged_mesh import MeshError, TaggedMesh

# Largest number of halvings of elements on curved pieces that are too long for their cells.
_REFINEMENTS = 4
# Smallest Jacobian of an accepted curved cell, relative to the straight cell.
_SMALLEST_JACOBIAN = 0.1


def build_mesh(
    outline: Outline,
    *,
    bulk_size: float,
    growth: float = 0.7,
    ring_ratio: float = 0.3,
    geometry_degree: int = 1,
    largest_turn: float = pi / 6.0,
) -> TaggedMesh:
    """Triangulate a domain.

    The groups are the names of regions for the cells and those of curves for the edges. All ends of curves are nodes.
    Along curves that are `cut` both sides have nodes of their own, of the same coordinates, and each edge has a facet
    for either side. Where a curved piece is too coarse for its cells its elements are halved.
    """
    # Elements on straight lines are made by gmsh: only curved ones can be refined here.
    refinements = _REFINEMENTS if any(curve.path is not None for curve in outline.curves) else 0
    for halvings in range(refinements + 1):
        turn = largest_turn * 0.5**halvings
        try:
            layout, size = lay_out(
                outline, bulk_size=bulk_size, growth=growth, ring_ratio=ring_ratio, largest_turn=turn
            )
            layout.check_crossings()
            filling = fill(layout.points(), layout.loops(), size)
            mesh, sides = assemble(layout, filling)
            return _curved(mesh, layout, sides, geometry_degree)
        except MeshError:
            if halvings == refinements:
                raise
    raise AssertionError


def _curved(mesh: TaggedMesh, layout: Layout, sides: list[Sides], degree: int) -> TaggedMesh:
    """Curve the cells at curved pieces and measure how far their edges are from these."""
    pieces = [(edges, side) for number, side in enumerate(sides) if (edges := layout.curved_edges(number)) is not None]
    if not pieces:
        return mesh
    curved = curve_cells(mesh.points[mesh.cells], pieces, degree) if degree > 1 else None
    if curved is not None and smallest_jacobian(curved) < _SMALLEST_JACOBIAN:
        raise MeshError("a cell at a curved piece is too narrow to follow it: ask for smaller elements there")
    return replace(mesh, curved=curved, deviation=largest_deviation([edges for edges, _ in pieces], degree))
