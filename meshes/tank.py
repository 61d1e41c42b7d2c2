"""Tank meshes: gmsh fills the rectangle outside the rings, the rings around the tips are laid by rule."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

import gmsh
import numpy as np

from hydroelastic.meshes.geometry import BOTTOM, LEFT_WALL, LIQUID, TankGeometry
from hydroelastic.meshes.grading import Grading, SizeField, TipRings, tip_rings
from hydroelastic.meshes.interrupts import interrupts_deferred
from hydroelastic.meshes.tagged_mesh import MeshError, TaggedMesh

_LIQUID_TAG = 1


@contextmanager
def _gmsh_model() -> Iterator[None]:
    """A fresh, silent gmsh model; gmsh is started only once in a process and left as it was found."""
    if not gmsh.isInitialized():
        # gmsh would otherwise take over Ctrl-C, and a long run could no longer be interrupted.
        gmsh.initialize(readConfigFiles=False, interruptible=False)
        gmsh.option.setNumber("General.Verbosity", 0)
    gmsh.model.add("tank")
    try:
        yield
    finally:
        gmsh.model.mesh.removeSizeCallback()
        gmsh.model.remove()


def build_tank_mesh(geometry: TankGeometry, grading: Grading) -> TaggedMesh:
    """Triangulate a tank.

    The groups are `LIQUID` for the cells; `BOTTOM`, `LEFT_WALL`, `TankGeometry.right_end` and the names of the
    geometry's segments for the edges. Every joint of two segments is a node.

    Args:
        geometry: the tank.
        grading: element sizes, in the geometry's unit of length.

    Returns:
        The mesh of straight triangles, on the calling process only.

    Raises:
        MeshError: if gmsh fails.
    """
    rings = tip_rings(geometry, grading)
    names = [BOTTOM, LEFT_WALL, geometry.right_end, *dict.fromkeys(segment.name for segment in geometry.segments)]
    facet_names = {name: tag for tag, name in enumerate(names, start=1)}
    with _gmsh_model():
        try:
            points, cells, facets, facet_tags, corners = _fill(
                geometry, rings, SizeField(geometry, rings, grading), facet_names
            )
        except Exception as error:  # gmsh raises bare Exception
            raise MeshError(f"gmsh could not mesh the tank: {error}") from error
    for ring, outer in zip(rings, corners, strict=True):
        nodes, triangles = ring.nodes(), ring.triangles()
        # The outermost ring's nodes are gmsh's; the others are appended.
        inside = len(nodes) - len(ring.angles)
        index = np.concatenate([len(points) + np.arange(inside), outer])
        points = np.vstack([points, nodes[:inside]])
        cells = np.vstack([cells, index[triangles]])
        edges, tags = _ring_edges(geometry, ring, nodes, facet_names)
        facets = np.vstack([facets, index[edges]])
        facet_tags = np.concatenate([facet_tags, tags])
    return TaggedMesh(
        points=points,
        cells=cells,
        cell_tags=np.full(len(cells), _LIQUID_TAG, dtype=np.int32),
        facets=facets,
        facet_tags=facet_tags.astype(np.int32),
        cell_names={LIQUID: _LIQUID_TAG},
        facet_names=facet_names,
    )


def _fill(
    geometry: TankGeometry, rings: tuple[TipRings, ...], size: SizeField, facet_names: dict[str, int]
) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray, list[np.ndarray]]:
    """Mesh the rectangle outside the rings; return arrays and, per ring, the indices of its outermost nodes."""
    corners: list[list[int]] = []
    ring_at = {ring.centre: ring for ring in rings}

    def ring_points(ring: TipRings) -> list[int]:
        points = [_point(x, y) for x, y in ring.nodes()[-len(ring.angles) :]]
        corners.append(points)
        return points

    # Along the top from left to right, dipping under each ring.
    top: list[int] = []
    lines: list[tuple[str, int, int]] = []
    left = ring_at.get(0.0)
    # A ring at the left wall begins on the wall itself, below the corner.
    start = list(reversed(ring_points(left))) if left else [_point(0.0, 0.0)]
    top += start
    for number, segment in enumerate(geometry.segments):
        ring = ring_at.get(segment.end)
        last = number == len(geometry.segments) - 1
        dip = list(reversed(ring_points(ring))) if ring else [_point(segment.end, 0.0)]
        lines.append((segment.name, top[-1], dip[0]))
        top += dip
        if last:
            end = dip[-1]
    bottom_left, bottom_right = _point(0.0, -geometry.depth), _point(geometry.length, -geometry.depth)
    lines += [
        (geometry.right_end, end, bottom_right),
        (BOTTOM, bottom_right, bottom_left),
        (LEFT_WALL, bottom_left, top[0]),
    ]

    named = {(a, b): name for name, a, b in lines}
    loop_points = [*top, bottom_right, bottom_left]
    curves = []
    groups: dict[str, list[int]] = {}
    for a, b in zip(loop_points, [*loop_points[1:], loop_points[0]], strict=True):
        curve = gmsh.model.geo.addLine(a, b)
        curves.append(curve)
        name = named.get((a, b))
        if name is None:
            gmsh.model.geo.mesh.setTransfiniteCurve(curve, 2)  # an edge of a ring is one element
        else:
            groups.setdefault(name, []).append(curve)
    surface = gmsh.model.geo.addPlaneSurface([gmsh.model.geo.addCurveLoop(curves)])
    gmsh.model.geo.synchronize()

    for option in ("MeshSizeFromPoints", "MeshSizeExtendFromBoundary", "MeshSizeFromCurvature"):
        gmsh.option.setNumber(f"Mesh.{option}", 0)
    gmsh.option.setNumber("Mesh.Algorithm", 6)  # frontal-Delaunay: the best-shaped triangles
    gmsh.model.mesh.setSizeCallback(lambda dim, tag, x, y, z, lc: size(x, y))
    with interrupts_deferred():
        gmsh.model.mesh.generate(2)
    return _arrays(surface, groups, facet_names, corners)


def _point(x: float, y: float) -> int:
    return int(gmsh.model.geo.addPoint(x, y, 0.0))


def _arrays(
    surface: int, groups: dict[str, list[int]], facet_names: dict[str, int], corners: list[list[int]]
) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray, list[np.ndarray]]:
    """Read gmsh's mesh into arrays with nodes numbered from 0."""
    tags, coordinates, _ = gmsh.model.mesh.getNodes()
    order = np.zeros(int(tags.max()) + 1, dtype=np.int64)
    order[tags.astype(np.int64)] = np.arange(len(tags))
    points = coordinates.reshape(-1, 3)[:, :2].copy()
    _, nodes = gmsh.model.mesh.getElementsByType(2, surface)
    cells = order[nodes.astype(np.int64)].reshape(-1, 3)
    facets, facet_tags = [], []
    for name, curves in groups.items():
        for curve in curves:
            _, nodes = gmsh.model.mesh.getElementsByType(1, curve)
            edges = order[nodes.astype(np.int64)].reshape(-1, 2)
            facets.append(edges)
            facet_tags.append(np.full(len(edges), facet_names[name]))
    outer = [
        np.array([order[int(gmsh.model.mesh.getNodes(0, point)[0][0])] for point in ring_points])
        for ring_points in corners
    ]
    return points, cells, np.vstack(facets), np.concatenate(facet_tags), outer


def _ring_edges(
    geometry: TankGeometry, ring: TipRings, nodes: np.ndarray, facet_names: dict[str, int]
) -> tuple[np.ndarray, np.ndarray]:
    """Boundary edges of a ring, as indices into its nodes, and their tags."""
    count = len(ring.angles)
    rays = {0: [0, *range(1, len(nodes), count)], count - 1: [0, *range(count, len(nodes), count)]}
    edges, tags = [], []
    for ray in rays.values():
        pairs = np.column_stack([ray[:-1], ray[1:]])
        x, y = nodes[ray[-1]]
        edges.append(pairs)
        tags.append(np.full(len(pairs), facet_names[_name_at(geometry, ring.centre, float(x), float(y))]))
    return np.vstack(edges), np.concatenate(tags)


def _name_at(geometry: TankGeometry, centre: float, x: float, y: float) -> str:
    """Group of the boundary ray from a tip to the point (x, y)."""
    if y < 0.0:
        return LEFT_WALL if centre == 0.0 else geometry.right_end
    middle = 0.5 * (centre + x)
    return next(segment.name for segment in geometry.segments if segment.start < middle < segment.end)
