"""Plans of tanks: triangles with layers along the edges of plates, graded geometrically across them.

ψ has singularities r ln r at an edge and is smooth along it, so that only the distance from it is graded. Each outline
has bands of layers on both sides, made here: between mitred parallels of a polygon, between concentric circles of a
disc. gmsh fills what is left. At circles cells are curved; those of the bands have their nodes at polar coordinates,
for layers thinner than the sagitta of their arcs would else fold.
"""

from __future__ import annotations

from math import pi, sqrt

import numpy as np
from numpy.typing import NDArray

from hydroelastic.meshes.curved_cells import geometry_element, smallest_jacobian
from hydroelastic.meshes.filling import gmsh_model
from hydroelastic.meshes.plan_bands import Band, bands_around
from hydroelastic.meshes.plan_faces import faces_between, filled
from hydroelastic.meshes.plan_grid import are_rectangles, grid_mesh
from hydroelastic.meshes.plan_loops import (
    RATIO,
    UNGRADED,
    CircleLoop,
    Loop,
    Mirrors,
    PlanRegion,
    gaps_around,
    kept_by,
    room_between,
)
from hydroelastic.meshes.tagged_mesh import CurvedCells, MeshError, TaggedMesh

# Ratio of successive nodes' distances from a re-entrant corner of a wall.
_CORNER_RATIO = 0.4

# Smallest Jacobian of an accepted curved cell, relative to the straight cell.
_SMALLEST_JACOBIAN = 0.05


def edges_of(wall: PlanRegion, plates: tuple[PlanRegion, ...]) -> tuple[Loop, ...]:
    """Return the edges of plates beside water: all, or none of a plate that covers the plan."""
    covered = any(plate.outside is wall.outside for plate in plates)
    return () if covered else tuple(loop for plate in plates for loop in plate.loops)


def plan_mesh(
    wall: PlanRegion,
    plates: tuple[PlanRegion, ...],
    *,
    size: float,
    layers: int,
    thickness: float,
    geometry_degree: int,
    mirrors: Mirrors = (None, None),
) -> TaggedMesh:
    """Triangulate a plan."""
    if are_rectangles(wall, plates):
        return grid_mesh(wall, plates, size=size, layers=layers, thickness=thickness, mirrors=mirrors)
    covered = any(plate.outside is wall.outside for plate in plates)
    edges, walls = edges_of(wall, plates), wall.loops
    thick = min(thickness, room_between(walls, edges))
    # What bands leave of the gap beside each edge: a wall has none.
    left = (gaps_around(walls, edges) - thick * np.array([1.0, 2.0])).min(axis=1, initial=np.inf)
    steps = thick * RATIO ** np.arange(layers)
    bands: list[Band] = []

    def add(loop: Loop, inside: str, outside: str, *, is_wall: bool) -> None:
        largest = size
        if isinstance(loop, CircleLoop) and not covered:
            # In what a gap leaves between bands cells are long: an arc leaves its chord at half the angle at which
            # such a cell's next side does.
            width = left.min(initial=np.inf) if is_wall else left[edges.index(loop)]
            largest = min(largest, sqrt(loop.radius * width))
        towards = UNGRADED if is_wall else thick * RATIO ** np.arange(max(layers - 2, 1))[::-1]
        bands.extend(
            bands_around(
                loop,
                sum(band.size for band in bands),
                mirrors=mirrors,
                size=largest,
                steps=steps[:0] if is_wall else steps,
                towards=towards,
                # ψ ~ r^(2/3) at a re-entrant corner of a wall; its cells are as long as they are wide.
                reentrant=0.5 * largest * _CORNER_RATIO ** np.arange(2 * layers + 2)[::-1] if is_wall else towards,
                inside=inside,
                outside=outside,
            )
        )

    water = plates[0].name if covered else wall.name
    add(wall.outside, water, "", is_wall=True)
    for hole in wall.inside:
        add(hole, "", water, is_wall=True)
    for plate in () if covered else plates:
        add(plate.outside, plate.name, wall.name, is_wall=False)
        for hole in plate.inside:
            add(hole, wall.name, plate.name, is_wall=False)
    corners = np.concatenate([loop.graded_corners for loop in walls])
    with gmsh_model():
        found = faces_between(wall, bands, mirrors)
        points, blocks = filled(found, size, corners[kept_by(mirrors, corners, 0.0)])
    named = [(face.name, block) for face, block in zip(found.faces, blocks, strict=True)]
    for band in bands:
        named += [(name, block) for name, block in zip((band.inside, band.outside), band.cells(), strict=True) if name]
    names = list(dict.fromkeys(name for name, _ in named))
    cells = np.concatenate([block for _, block in named])
    corner = points[cells]
    along, across = corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0]
    turned = along[:, 0] * across[:, 1] < along[:, 1] * across[:, 0]
    cells[turned] = cells[turned][:, ::-1]
    return TaggedMesh(
        points=points,
        cells=cells,
        cell_tags=np.concatenate([np.full(len(block), names.index(name)) for name, block in named]).astype(np.int32),
        facets=np.empty((0, 2), dtype=np.int64),
        facet_tags=np.empty(0, dtype=np.int32),
        cell_names={name: number for number, name in enumerate(names)},
        facet_names={},
        curved=curved_cells(points, cells, bands, geometry_degree),
    )


def curved_cells(
    points: NDArray[np.float64], cells: NDArray[np.int64], bands: list[Band], degree: int
) -> CurvedCells | None:
    """Return the geometry of the cells at circles; ``None`` where all cells are straight."""
    circles = [band for band in bands if isinstance(band.loop, CircleLoop)]
    if not circles:
        return None
    element = geometry_element(degree)
    barycentric = np.column_stack([1.0 - element.points.sum(axis=1), element.points])
    chosen, nodes = [], []
    for band in circles:
        loop = band.loop
        assert isinstance(loop, CircleLoop)
        columns = len(band.places)
        local = cells - band.first
        inside = (local >= 0) & (local < columns * len(band.distances))
        whole = np.flatnonzero(inside.all(axis=1))
        # A gmsh cell may have all corners on one circle; a band's have two rows.
        rows = local // columns
        in_band = whole[np.ptp(rows[whole], axis=1) == 1]
        angle = 2.0 * pi * band.places[local[in_band] % columns]
        angle = angle[:, :1] + (angle - angle[:, :1] + pi) % (2.0 * pi) - pi
        radius = loop.radius + band.distances[rows[in_band]]
        turned, away = angle @ barycentric.T, radius @ barycentric.T
        chosen.append(in_band)
        nodes.append(loop.centre + away[..., None] * np.stack([np.cos(turned), np.sin(turned)], axis=-1))
        beside = np.flatnonzero((inside.sum(axis=1) >= 2) & ~np.isin(np.arange(len(cells)), in_band))
        bent, moved = _beside_arcs(points, cells[beside], local[beside], inside[beside], band, barycentric, degree)
        chosen.append(beside[bent])
        nodes.append(moved[bent])
    # A cell that touches two circles keeps the displacement of each.
    straight = np.einsum("nb,cbd->cnd", barycentric, points[cells])
    total = straight.copy()
    for some, places in zip(chosen, nodes, strict=True):
        np.add.at(total, some, places - straight[some])
    bent_cells = np.unique(np.concatenate(chosen))
    found = CurvedCells(degree=degree, cells=bent_cells, nodes=total[bent_cells])
    if smallest_jacobian(found) < _SMALLEST_JACOBIAN:
        raise MeshError("a cell at a circle is too narrow to follow it: ask for smaller elements there")
    return found


def _beside_arcs(
    points: NDArray[np.float64],
    cells: NDArray[np.int64],
    local: NDArray[np.int64],
    inside: NDArray[np.bool_],
    band: Band,
    barycentric: NDArray[np.float64],
    degree: int,
) -> tuple[NDArray[np.bool_], NDArray[np.float64]]:
    """Nodes of cells with an edge on the outermost or innermost circle of a band; see `curved_cells`."""
    columns = len(band.places)
    element = geometry_element(degree)
    inner = np.asarray(element.points[np.array(element.entity_dofs[1][2], dtype=np.int64), 0])
    nodes = np.einsum("nb,cbd->cnd", barycentric, points[cells])
    bent = np.full(len(cells), False)
    for start, end in ((0, 1), (1, 2), (2, 0)):
        row, column = local[:, [start, end]] // columns, local[:, [start, end]] % columns
        step = np.abs(column[:, 1] - column[:, 0])
        along = (step == 1) | (band.closed & (step == columns - 1))
        here = inside[:, start] & inside[:, end] & (row[:, 0] == row[:, 1]) & along
        first, second = points[cells[here, start]], points[cells[here, end]]
        angles = 2.0 * pi * band.places[column[here]]
        sweep = (angles[:, 1] - angles[:, 0] + pi) % (2.0 * pi) - pi
        turned = angles[:, :1] + sweep[:, None] * inner
        radius = np.linalg.norm(first - band.loop.centre, axis=1)[:, None]  # type: ignore[union-attr]
        arc = band.loop.centre + radius[..., None] * np.stack([np.cos(turned), np.sin(turned)], axis=-1)  # type: ignore[union-attr]
        away = arc - first[:, None] - inner[None, :, None] * (second - first)[:, None]
        values = away / (inner * (1.0 - inner))[None, :, None]
        fit = np.linalg.inv(np.polynomial.chebyshev.chebvander(2.0 * inner - 1.0, len(inner) - 1))
        across = np.polynomial.chebyshev.chebvander(barycentric[:, end] - barycentric[:, start], len(inner) - 1)
        weight = (barycentric[:, start] * barycentric[:, end])[:, None] * (across @ fit)
        nodes[here] += np.einsum("nk,ckd->cnd", weight, values)
        bent |= here
    return bent, nodes
