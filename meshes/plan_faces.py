"""The regions of a plan between bands, walls and mirror planes, filled with triangles by gmsh."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import gmsh
import numpy as np
from numpy.typing import NDArray

from hydroelastic.meshes.interrupts import interrupts_deferred
from hydroelastic.meshes.plan_bands import Band
from hydroelastic.meshes.plan_loops import Mirrors, PlanRegion, PolygonLoop

# Size of cells at a distance from a re-entrant corner.
_CORNER_GROWTH = 0.7


@dataclass(frozen=True, kw_only=True)
class Face:
    """A region to be filled."""

    name: str  # physical name
    outside: NDArray[np.int64]  # nodes around it, anticlockwise
    inside: tuple[NDArray[np.int64], ...]  # nodes around each of its holes, clockwise


@dataclass(frozen=True, kw_only=True)
class Faces:
    """All regions to be filled."""

    # the bands' nodes, and that at which two mirror planes meet if it is in the tank, shape (nodes, 2)
    points: NDArray[np.float64]
    faces: list[Face]  # the regions
    divided: set[tuple[int, int]]  # pairs of nodes between which gmsh may put others: those on mirror planes


def faces_between(wall: PlanRegion, bands: list[Band], mirrors: Mirrors) -> Faces:
    """Return the regions that bands, walls and mirror planes leave.

    Each edge of them has its region on the left: rows of bands, and pieces of mirror planes between the ends of two
    bands. Closed chains of edges are their outlines and holes.
    """
    points = np.concatenate([band.points for band in bands])
    following: dict[int, int] = {}
    name_of: dict[int, str] = {}
    for band in bands:
        for row, forward, name in ((band.row(0), True, band.inside), (band.row(-1), False, band.outside)):
            if name:
                nodes = row if forward else row[::-1]
                closing = [(int(nodes[-1]), int(nodes[0]))] if band.closed else []
                for start, end in [*pairwise(map(int, nodes)), *closing]:
                    following[start], name_of[start] = end, name
    divided: set[tuple[int, int]] = set()
    middle = np.array([[0.0 if mirror is None else mirror for mirror in mirrors]])
    meeting = []
    if None not in mirrors and _is_inside(wall, middle[0]):
        meeting = [len(points)]
        points = np.concatenate([points, middle])
    for axis, mirror in enumerate(mirrors):
        if mirror is None:
            continue
        ends = [
            (int(band.row(row)[column]), (number, column))
            for number, band in enumerate(bands)
            if not band.closed
            for column in (0, -1)
            for row in {0, len(band.distances) - 1}
            if points[band.row(row)[column], axis] == mirror
        ]
        ends += [(node, (-1, 0)) for node in meeting]
        ends.sort(key=lambda end: float(points[end[0], 1 - axis]))
        for (low, below), (high, above) in pairwise(ends):
            # Both ends of one column belong to a band.
            if below != above and _is_inside(wall, 0.5 * (points[low] + points[high])):
                # The tank lies in direction of x, and of y: on the left of −y and of x.
                start, end = (high, low) if axis == 0 else (low, high)
                following[start] = end
                divided.add((start, end))
    return Faces(points=points, faces=_chained(points, following, name_of), divided=divided)


def _is_inside(wall: PlanRegion, point: NDArray[np.float64]) -> bool:
    return wall.outside.contains(point) and not any(hole.contains(point) for hole in wall.inside)


def _chained(points: NDArray[np.float64], following: dict[int, int], name_of: dict[int, str]) -> list[Face]:
    left, cycles = set(following), []
    while left:
        chain = [min(left)]
        while following[chain[-1]] != chain[0]:
            chain.append(following[chain[-1]])
        left -= set(chain)
        cycles.append(np.array(chain))
    areas = [_area(points[cycle]) for cycle in cycles]
    outlines = [number for number, area in enumerate(areas) if area > 0.0]
    holes: dict[int, list[NDArray[np.int64]]] = {number: [] for number in outlines}
    for number, cycle in enumerate(cycles):
        if areas[number] < 0.0:
            around = [
                other
                for other in outlines
                if areas[other] > -areas[number]
                and PolygonLoop(corners=points[cycles[other]]).contains(points[cycle[0]])
            ]
            holes[min(around, key=lambda other: areas[other])].append(cycle)
    return [
        Face(
            name=next(name_of[int(node)] for node in cycles[number] if int(node) in name_of),
            outside=cycles[number],
            inside=tuple(holes[number]),
        )
        for number in outlines
    ]


def _area(corners: NDArray[np.float64]) -> float:
    ahead = np.roll(corners, -1, axis=0)
    return 0.5 * float((corners[:, 0] * ahead[:, 1] - corners[:, 1] * ahead[:, 0]).sum())


def filled(
    found: Faces, size: float, corners: NDArray[np.float64]
) -> tuple[NDArray[np.float64], list[NDArray[np.int64]]]:
    """Return all nodes, and gmsh's triangles of each face; in a model of gmsh's."""
    geo = gmsh.model.geo
    points, tags = found.points, dict[int, int]()
    lines: dict[tuple[int, int], int] = {}

    def loop_of(nodes: NDArray[np.int64]) -> int:
        curves = []
        for pair in zip(map(int, nodes), map(int, np.roll(nodes, -1)), strict=True):
            for node in pair:
                if node not in tags:
                    tags[node] = int(geo.addPoint(*points[node], 0.0))
            lines[pair] = int(geo.addLine(tags[pair[0]], tags[pair[1]]))
            if pair not in found.divided:
                geo.mesh.setTransfiniteCurve(lines[pair], 2)
            curves.append(lines[pair])
        return int(geo.addCurveLoop(curves))

    surfaces = []
    for face in found.faces:
        surfaces.append(int(geo.addPlaneSurface([loop_of(nodes) for nodes in (face.outside, *face.inside)])))
    geo.synchronize()
    for option, value in (("FromPoints", 0), ("ExtendFromBoundary", 1), ("FromCurvature", 0)):
        gmsh.option.setNumber(f"Mesh.MeshSize{option}", value)
    gmsh.option.setNumber("Mesh.Algorithm", 6)

    def wanted(_dim: int, _tag: int, x: float, y: float, _z: float, boundary: float) -> float:
        near = size
        if len(corners):
            distance = float(np.hypot(corners[:, 0] - x, corners[:, 1] - y).min())
            near = max(_CORNER_GROWTH * distance, 1e-9)
        return min(boundary, size, near)

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
        _, triangles = gmsh.model.mesh.getElementsByType(2, surface)
        cells.append(number_of[triangles.astype(np.int64)].reshape(-1, 3))
    return np.concatenate([points, added.reshape(-1, 2)]), cells
