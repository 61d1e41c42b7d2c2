"""Plans of tanks: triangles with layers along the edges of plates, graded geometrically across them.

ψ has singularities r ln r at an edge and is smooth along it, so that only the distance from it is graded. Each outline
has bands of layers on both sides, made here: between mitred parallels of a polygon, between concentric circles of a
disc. gmsh fills what is left. At circles cells are curved; those of the bands have their nodes at polar coordinates,
for layers thinner than the sagitta of their arcs would else fold.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import pi

import gmsh
import numpy as np
from numpy.typing import NDArray

from hydroelastic.meshes.curved_cells import geometry_element, smallest_jacobian
from hydroelastic.meshes.filling import gmsh_model
from hydroelastic.meshes.interrupts import interrupts_deferred
from hydroelastic.meshes.plan_loops import RATIO, UNGRADED, CircleLoop, Loop, PlanRegion, room_between
from hydroelastic.meshes.tagged_mesh import CurvedCells, MeshError, TaggedMesh

# Smallest Jacobian of an accepted curved cell, relative to the straight cell.
_SMALLEST_JACOBIAN = 0.05
# Ratio of successive nodes' distances from a re-entrant corner of a wall, and size of cells at a distance from it.
_CORNER_RATIO, _CORNER_GROWTH = 0.4, 0.7


@dataclass(frozen=True, kw_only=True)
class _Band:
    """Nodes around a loop: rows of parallels, from the inside out.

    Attributes:
        loop: the loop.
        places: of the columns.
        distances: of the rows; one row, 0, of a wall.
        first: number of its first node; they are numbered row by row.
    """

    loop: Loop
    places: NDArray[np.float64]
    distances: NDArray[np.float64]
    first: int

    def row(self, number: int) -> NDArray[np.int64]:
        """Return the nodes of a row, number −1 being the outermost."""
        number %= len(self.distances)
        return np.asarray(self.first + number * len(self.places) + np.arange(len(self.places)))

    @property
    def points(self) -> NDArray[np.float64]:
        """Its nodes, shape (nodes, 2)."""
        return np.concatenate([self.loop.parallel(distance, self.places) for distance in self.distances])


def plan_mesh(
    wall: PlanRegion,
    plates: tuple[PlanRegion, ...],
    *,
    size: Callable[[str], float],
    layers: int,
    thickness: float,
    geometry_degree: int,
) -> TaggedMesh:
    """Triangulate a plan.

    Args:
        wall: the tank, with the name of the water; its holes are inner walls.
        plates: those beside which there is water all around, or one that covers the plan; without overlap.
        size: largest cell of a region by its name.
        layers: number of layers on each side of an edge.
        thickness: of the outermost layer; it is smaller where a band would touch another one or a wall.
        geometry_degree: of cells at circles.

    Raises:
        MeshError: if gmsh fails, or a curved cell is inverted.
    """
    covered = any(plate.outside is wall.outside for plate in plates)
    edges = () if covered else tuple(loop for plate in plates for loop in (plate.outside, *plate.inside))
    walls = (wall.outside, *wall.inside)
    room = room_between(walls, edges)
    bands: dict[int, _Band] = {}
    count = 0
    for loop in (*walls, *edges):
        is_wall = loop in walls
        thick = min(thickness, room)
        steps = np.zeros(0) if is_wall else thick * RATIO ** np.arange(layers)
        names = (
            [plates[0].name] if covered else [wall.name, *(p.name for p in plates if loop in (p.outside, *p.inside))]
        )
        largest = min(map(size, names))
        towards = UNGRADED if is_wall else thick * RATIO ** np.arange(max(layers - 2, 1))[::-1]
        # ψ ~ r^(2/3) at a re-entrant corner of a wall; its cells are as long as they are wide.
        reentrant = 0.5 * largest * _CORNER_RATIO ** np.arange(2 * layers + 2)[::-1] if is_wall else towards
        places = loop.places(largest, towards, reentrant)
        distances = np.concatenate([-steps, [0.0], steps[::-1]])
        bands[id(loop)] = _Band(loop=loop, places=places, distances=distances, first=count)
        count += len(places) * len(distances)
    points = np.concatenate([band.points for band in bands.values()])
    regions = [(plate.name, plate.outside, plate.inside) for plate in plates]
    if not covered:
        holes = tuple(hole for hole in (*wall.inside, *(plate.outside for plate in plates)))
        regions.append((wall.name, wall.outside, holes))
        regions += [
            (wall.name, hole, tuple(p.outside for p in plates if hole.contains(_a_point(p.outside))))
            for plate in plates
            for hole in plate.inside
            if not any(wall_hole == hole for wall_hole in wall.inside)
        ]
        regions = [(name, outside, _directly(outside, inside)) for name, outside, inside in regions]
    names = list(dict.fromkeys([name for name, _, _ in regions]))
    cells, tags = [], []
    if not covered:
        for loop in edges:
            for outer, block in enumerate(_band_cells(bands[id(loop)])):
                # A band's outer half belongs to the water, or to the plate around a hole of it.
                owner = next(plate for plate in plates if loop in (plate.outside, *plate.inside))
                is_plate = (loop == owner.outside) != bool(outer)
                cells.append(block)
                tags.append(np.full(len(block), names.index(owner.name if is_plate else wall.name)))
    corners = np.concatenate([loop.reentrant for loop in walls] + [np.empty((0, 2))])
    with gmsh_model():
        points, filled = _filled(points, regions, bands, walls, size, corners)
    for (name, _, _), block in zip(regions, filled, strict=True):
        cells.append(block)
        tags.append(np.full(len(block), names.index(name)))
    all_cells = np.concatenate(cells)
    corner = points[all_cells]
    turn = _cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0])
    all_cells[turn < 0.0] = all_cells[turn < 0.0][:, ::-1]
    return TaggedMesh(
        points=points,
        cells=all_cells,
        cell_tags=np.concatenate(tags).astype(np.int32),
        facets=np.empty((0, 2), dtype=np.int64),
        facet_tags=np.empty(0, dtype=np.int32),
        cell_names={name: number for number, name in enumerate(names)},
        facet_names={},
        curved=_curved(points, all_cells, bands, geometry_degree),
    )


def _cross(one: NDArray[np.float64], other: NDArray[np.float64]) -> NDArray[np.float64]:
    product: NDArray[np.float64] = one[:, 0] * other[:, 1] - one[:, 1] * other[:, 0]
    return product


def _directly(outside: Loop, inside: tuple[Loop, ...]) -> tuple[Loop, ...]:
    """The holes of a region that lie in no other hole of it."""
    own = [hole for hole in inside if hole != outside and outside.contains(_a_point(hole))]
    return tuple(hole for hole in own if not any(other != hole and other.contains(_a_point(hole)) for other in own))


def _a_point(loop: Loop) -> NDArray[np.float64]:
    return np.asarray(loop.parallel(0.0, np.array([0.0]))[0])


def _band_cells(band: _Band) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Triangles of the inner and of the outer half of a band."""
    halves = []
    middle = (len(band.distances) - 1) // 2
    for rows in (range(middle), range(middle, len(band.distances) - 1)):
        cells: list[NDArray[np.int64]] = [np.empty((0, 3), dtype=np.int64)]
        for number in rows:
            low, high = band.row(number), band.row(number + 1)
            low_next, high_next = np.roll(low, -1), np.roll(high, -1)
            cells += [np.column_stack([low, low_next, high_next]), np.column_stack([low, high_next, high])]
        halves.append(np.concatenate(cells))
    return halves[0], halves[1]


def _filled(
    points: NDArray[np.float64],
    regions: list[tuple[str, Loop, tuple[Loop, ...]]],
    bands: dict[int, _Band],
    walls: tuple[Loop, ...],
    size: Callable[[str], float],
    corners: NDArray[np.float64],
) -> tuple[NDArray[np.float64], list[NDArray[np.int64]]]:
    """All nodes, and gmsh's triangles of each region between the bands."""
    geo = gmsh.model.geo
    tags: dict[int, int] = {}

    def loop_of(nodes: NDArray[np.int64]) -> int:
        for node in nodes:
            if int(node) not in tags:
                tags[int(node)] = int(geo.addPoint(*points[node], 0.0))
        lines = [int(geo.addLine(tags[int(a)], tags[int(b)])) for a, b in zip(nodes, np.roll(nodes, -1), strict=True)]
        for line in lines:
            geo.mesh.setTransfiniteCurve(line, 2)
        return int(geo.addCurveLoop(lines))

    surfaces, largest = [], {}
    for name, outside, inside in regions:
        # Of a band around a hole the outer row faces the region.
        curves = [loop_of(bands[id(outside)].row(0)), *(loop_of(bands[id(hole)].row(-1)) for hole in inside)]
        surfaces.append(int(geo.addPlaneSurface(curves)))
        largest[surfaces[-1]] = size(name)
    geo.synchronize()
    for option, value in (("FromPoints", 0), ("ExtendFromBoundary", 1), ("FromCurvature", 0)):
        gmsh.option.setNumber(f"Mesh.MeshSize{option}", value)
    gmsh.option.setNumber("Mesh.Algorithm", 6)

    def wanted(_dim: int, tag: int, x: float, y: float, _z: float, boundary: float) -> float:
        biggest = largest.get(tag, max(largest.values()))
        near = biggest
        if len(corners):
            distance = float(np.hypot(corners[:, 0] - x, corners[:, 1] - y).min())
            near = max(_CORNER_GROWTH * distance, 1e-9)
        return min(boundary, biggest, near)

    gmsh.model.mesh.setSizeCallback(wanted)
    with interrupts_deferred():
        gmsh.model.mesh.generate(2)
    nodes, coordinates, _ = gmsh.model.mesh.getNodes()
    number_of = np.full(int(nodes.max()) + 1, -1, dtype=np.int64)
    for node, tag in tags.items():
        number_of[int(gmsh.model.mesh.getNodes(0, tag)[0][0])] = node
    fresh = nodes.astype(np.int64)[number_of[nodes.astype(np.int64)] < 0]
    number_of[fresh] = len(points) + np.arange(len(fresh))
    place = {int(node): index for index, node in enumerate(nodes)}
    added = coordinates.reshape(-1, 3)[[place[int(node)] for node in fresh], :2]
    cells = []
    for surface in surfaces:
        _, found = gmsh.model.mesh.getElementsByType(2, surface)
        cells.append(number_of[found.astype(np.int64)].reshape(-1, 3))
    return np.concatenate([points, added.reshape(-1, 2)]), cells


def _curved(
    points: NDArray[np.float64], cells: NDArray[np.int64], bands: dict[int, _Band], degree: int
) -> CurvedCells | None:
    """Geometry of the cells at circles: at polar coordinates in bands, with one arc beside them."""
    circles = [band for band in bands.values() if isinstance(band.loop, CircleLoop)]
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
    curved_cells = np.unique(np.concatenate(chosen))
    found = CurvedCells(degree=degree, cells=curved_cells, nodes=total[curved_cells])
    if smallest_jacobian(found) < _SMALLEST_JACOBIAN:
        raise MeshError("a cell at a circle is too narrow to follow it: ask for smaller elements there")
    return found


def _beside_arcs(
    points: NDArray[np.float64],
    cells: NDArray[np.int64],
    local: NDArray[np.int64],
    inside: NDArray[np.bool_],
    band: _Band,
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
        step = (column[:, 1] - column[:, 0]) % columns
        here = inside[:, start] & inside[:, end] & (row[:, 0] == row[:, 1]) & ((step == 1) | (step == columns - 1))
        first, second = points[cells[here, start]], points[cells[here, end]]
        angles = 2.0 * pi * band.places[column[here]]
        sweep = (angles[:, 1] - angles[:, 0] + pi) % (2.0 * pi) - pi
        turned = angles[:, :1] + sweep[:, None] * inner
        radius = np.linalg.norm(first - band.loop.centre, axis=1)[:, None]  # type: ignore[union-attr]
        arc = band.loop.centre + radius[..., None] * np.stack([np.cos(turned), np.sin(turned)], axis=-1)  # type: ignore[union-attr]
        away = arc - first[:, None] - inner[None, :, None] * (second - first)[:, None]
        values = away / (inner * (1.0 - inner))[None, :, None]
        fit = np.linalg.inv(np.polynomial.chebyshev.chebvander(2.0 * inner - 1.0, len(inner) - 1))
        along = np.polynomial.chebyshev.chebvander(barycentric[:, end] - barycentric[:, start], len(inner) - 1)
        weight = (barycentric[:, start] * barycentric[:, end])[:, None] * (along @ fit)
        nodes[here] += np.einsum("nk,ckd->cnd", weight, values)
        bent |= here
    return bent, nodes
