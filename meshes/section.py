"""Meshes of plane sections: gmsh by a size field, curved cells, and cells with r = sᵐ at singular points.

A cell that touches a singular point keeps its corners. With its barycentric coordinates λ, s the sum of those of its
other corners, and the old map X of the cell,

    x(λ) = X(λ'),    λ'ᵢ = λᵢ (1 + s + … + s^{m−1}) at the singular corner,    λ'ᵢ = s^{m−1} λᵢ at the others,

so that r ~ sᵐ, and r^α is m times smoother in s. Neighbours agree and no cell is added. Where the cell is curved, its
old map has on the edge from a to b the displacement δ(t) of the exact curve from the chord, blended into the cell,

    X(λ) = Σ λᵢ vᵢ + 4 λₐ λ_b δ(t)/(1 − (λ_b − λₐ)²),    t = (1 + λ_b − λₐ)/2.

Nodes of the geometry are interpolated at Lagrange's points of one degree for the whole mesh. Sources: quarter-point
elements (R. S. Barsoum, Int. J. Numer. Meth. Eng. 10 (1976) 25) for m = 2; blending by M. Zlámal, SIAM J. Numer. Anal.
10 (1973) 229.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from itertools import pairwise
from math import ceil, inf

import basix
import gmsh
import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from hydroelastic.meshes.filling import gmsh_model
from hydroelastic.meshes.geometry import INTERFACE
from hydroelastic.meshes.interrupts import interrupts_deferred
from hydroelastic.meshes.outline import Curve, Outline, Point, as_points
from hydroelastic.meshes.tagged_mesh import MeshError, NodedMesh, TaggedMesh

Array = NDArray[np.float64]
Indices = NDArray[np.int64]

# Points of a curve at which sizes are taken, dense at its ends, where sizes may be small; those for its radius of
# curvature, of which some are kept.
_NEAR_ENDS = np.geomspace(1e-8, 0.02, 50)
_SAMPLES: Array = np.unique(np.concatenate([np.linspace(0.0, 1.0, 65), _NEAR_ENDS, 1.0 - _NEAR_ENDS]))
_FINE: Array = np.linspace(0.0, 1.0, 97, dtype=np.float64)
_KEPT = slice(0, None, 6)
_EDGES = ((1, 2), (0, 2), (0, 1))
# Nodes this close to a point are there, in units of the tank; files may hold single precision.
_ROUNDING_OF_FILES = 1e-6


@dataclass(frozen=True, kw_only=True)
class SectionSizes:
    """Sizes of cells, in the unit of the outline.

    Attributes:
        bulk: largest anywhere.
        growth: by which sizes grow with the distance from what limits them.
        turn: angle by which an edge of a cell may turn along a curve, rad.
        points: size at singular points, and the largest angle of a cell there, rad.
    """

    bulk: float
    growth: float = 0.5
    turn: float = 0.7
    points: Mapping[Point, tuple[float, float]] = field(default_factory=dict)


@dataclass(frozen=True)
class SectionTriangles:
    """A triangulated outline.

    Attributes:
        curves: with a physical name, exact, or inner ones.
        names: physical name of the cells of each region.
        corners: shape (corners, 2).
        cells: numbers of the corners of each, shape (cells, 3).
        regions: that of each cell.
        chains: numbers of the corners along each curve.
        parameters: of the curve at these.
    """

    curves: tuple[Curve, ...]
    names: tuple[str, ...]
    corners: Array
    cells: Indices
    regions: Indices
    chains: list[Indices]
    parameters: list[Array]

    def of_layers(self) -> list[Indices]:
        """The cells of each physical name."""
        of_cells = np.array(self.names)[self.regions]
        return [self.cells[of_cells == name] for name in dict.fromkeys(self.names)]

    def noded(self, powers: Mapping[Point, int], degree: int) -> NodedMesh:
        """The mesh with cells r = sᵐ, of one degree of the geometry, at least the largest m.

        Regions on both sides of a cut curve have nodes of their own on it.
        """
        return _noded(self, powers, degree)


def section_triangles(outline: Outline, sizes: SectionSizes) -> SectionTriangles:
    """Triangulate an outline; cells have one of the points with sizes of their own at most.

    Args:
        outline: the domain, with the largest size on each curve.
        sizes: all other sizes.
    """
    size = _SizeField(outline, sizes)
    parameters = [size.division(curve) for curve in outline.curves]
    corners, cells, regions, chains = _triangles(outline, parameters, size)
    names = tuple(region.name for region in outline.regions)
    largest = {point: angle for point, (_, angle) in sizes.points.items()}
    return _parted(SectionTriangles(outline.curves, names, corners, cells, regions, chains, parameters), largest)


def given_triangles(mesh: TaggedMesh, angles: Mapping[Point, float]) -> SectionTriangles:
    """A straight mesh of one's own, whose nodes at singular points may miss them by the rounding of files.

    Args:
        mesh: in the unit of the points; each tagged edge is a curve of its own.
        angles: largest angle of a cell at each singular point, rad.
    """
    corners = mesh.points.copy()
    for point in angles:
        corners[np.hypot(*(corners - point).T) < _ROUNDING_OF_FILES] = point
    kinds, tags = ({tag: name for name, tag in own.items()} for own in (mesh.cell_names, mesh.facet_names))
    curves = (
        Curve(name=tags[tag], start=start, end=end, cut=tags[tag] == INTERFACE)
        for tag, start, end in zip(
            map(int, mesh.facet_tags),
            as_points(corners[mesh.facets[:, 0]]),
            as_points(corners[mesh.facets[:, 1]]),
            strict=True,
        )
    )
    groups, regions = np.unique(mesh.cell_tags, return_inverse=True)
    return _parted(
        SectionTriangles(
            curves=tuple(curves),
            names=tuple(kinds[group] for group in map(int, groups)),
            corners=corners,
            cells=mesh.cells,
            regions=regions,
            chains=list(mesh.facets),
            parameters=[np.array([0.0, 1.0])] * len(mesh.facets),
        ),
        angles,
    )


def _parted(mesh: SectionTriangles, largest: Mapping[Point, float]) -> SectionTriangles:
    """The mesh with one singular point in each cell, whose angle there is not too large."""
    parted = _Bisection(mesh.corners, mesh.cells, mesh.regions, mesh.chains)
    numbers = map(int, _numbers(mesh.corners, largest))
    angles: dict[int, float] = dict(zip(numbers, largest.values(), strict=True))
    parted.part(set(angles))
    parted.fan(angles)
    return replace(mesh, corners=parted.corners, cells=parted.cells, regions=parted.regions)


class _SizeField:
    """The smallest of the bulk's size and of each source's with growth times the distance from it."""

    def __init__(self, outline: Outline, sizes: SectionSizes) -> None:
        self._sizes = sizes
        starts: list[Array] = []
        ends: list[Array] = []
        near: list[float] = []
        for curve in outline.curves:
            if np.isfinite(curve.size):
                chain = curve.polyline()
                starts += [*chain[:-1]]
                ends += [*chain[1:]]
                near += [curve.size] * (len(chain) - 1)
            if curve.path is not None:
                points = curve.at(_FINE)
                radii = _radii(points)[_KEPT]
                middles = points[1:-1][_KEPT]
                starts += [*middles]
                ends += [*middles]
                near += [*np.minimum(sizes.turn * radii, np.sqrt(2.0 * radii * _gaps(outline, curve, middles)))]
        for point, (own, _) in sizes.points.items():
            starts.append(np.array(point))
            ends.append(np.array(point))
            near.append(own)
        self._starts: Array = np.array(starts).reshape(-1, 2)
        self._near: Array = np.array(near)
        self._steps: Array = np.array(ends).reshape(-1, 2) - self._starts
        counts = self._near < sizes.bulk
        self._starts, self._near, self._steps = self._starts[counts], self._near[counts], self._steps[counts]

    def at(self, points: Array) -> Array:
        """Sizes at points, shape (n, 2)."""
        near = self._near + self._sizes.growth * _distances(points, self._starts, self._steps)
        return np.asarray(np.minimum(near.min(axis=1, initial=inf), self._sizes.bulk))

    def callback(self, x: float, y: float) -> float:
        """The size at one point."""
        return float(self.at(np.array([[x, y]]))[0])

    def division(self, curve: Curve) -> Array:
        """Parameters of the ends of a curve's edges; never one edge between two singular points."""
        points = curve.at(_SAMPLES)
        lengths = np.hypot(*np.diff(points, axis=0).T)
        density = 1.0 / self.at(points)
        count = np.append(0.0, np.cumsum(0.5 * (density[1:] + density[:-1]) * lengths))
        single = self._sizes.points
        least = 2 if curve.start in single and curve.end in single else 1
        edges = max(ceil(count[-1] - 0.2), least)
        found = np.interp(np.linspace(0.0, count[-1], edges + 1), count, _SAMPLES)
        found[[0, -1]] = 0.0, 1.0
        return found


def _radii(points: Array) -> Array:
    """Radii of curvature at the inner points of a chain."""
    before, after = points[1:-1] - points[:-2], points[2:] - points[1:-1]
    turns = np.arctan2(before[:, 0] * after[:, 1] - before[:, 1] * after[:, 0], (before * after).sum(axis=1))
    lengths = 0.5 * (np.hypot(*before.T) + np.hypot(*after.T))
    return np.asarray(lengths / np.maximum(np.abs(turns), 1e-12))


def _gaps(outline: Outline, curve: Curve, points: Array) -> Array:
    """Distances of points of a curve from the nearest curve that does not meet it."""
    own = {curve.start, curve.end}
    others = [number for number, other in enumerate(outline.curves) if not own & {other.start, other.end}]
    chords = outline.chords
    there = np.isin(chords.curves, others)
    if not there.any():
        return np.full(len(points), inf)
    starts, steps = chords.starts[there], chords.ends[there] - chords.starts[there]
    return _distances(points, starts, steps).min(axis=1)


def _distances(points: Array, starts: Array, steps: Array) -> Array:
    """Distances of points from segments, shape (points, segments)."""
    away = points[:, None] - starts
    squares = (steps**2).sum(axis=1)
    along = np.clip((away * steps).sum(axis=2) / np.where(squares > 0.0, squares, 1.0), 0.0, 1.0)
    return np.asarray(np.hypot(*np.moveaxis(away - along[..., None] * steps, 2, 0)))


def _triangles(
    outline: Outline, parameters: list[Array], size: _SizeField
) -> tuple[Array, Indices, Indices, list[Indices]]:
    """Corners, cells with the region of each, and the nodes along each curve."""
    nodes: dict[Point, int] = {}
    chains = []
    with gmsh_model():
        geo, mesh = gmsh.model.geo, gmsh.model.mesh
        lines = []
        for curve, own in zip(outline.curves, parameters, strict=True):
            chain: list[int] = []
            for point in as_points(curve.at(own)):
                if point not in nodes:
                    nodes[point] = len(nodes) + 1
                    geo.addPoint(*point, 0.0, tag=nodes[point])
                chain.append(nodes[point])
            chains.append(np.array(chain) - 1)
            lines.append([geo.addLine(*pair) for pair in pairwise(chain)])
        surfaces = []
        for region in outline.regions:
            loop = [
                line
                for number, forward in region.loop
                for line in (lines[number] if forward else [-one for one in reversed(lines[number])])
            ]
            surfaces.append(geo.addPlaneSurface([geo.addCurveLoop(loop)]))
        geo.synchronize()
        for option in ("MeshSizeFromPoints", "MeshSizeExtendFromBoundary", "MeshSizeFromCurvature"):
            gmsh.option.setNumber(f"Mesh.{option}", 0)
        gmsh.option.setNumber("Mesh.Algorithm", 6)
        gmsh.option.setNumber("Mesh.MeshOnlyVisible", 1)
        gmsh.model.setVisibility(gmsh.model.getEntities(1), 0)
        mesh.generate(1)
        gmsh.option.setNumber("Mesh.MeshOnlyVisible", 0)
        gmsh.option.setNumber("Mesh.MeshOnlyEmpty", 1)
        for chain_of, own_lines in zip(chains, lines, strict=True):
            for line, pair in zip(own_lines, pairwise(chain_of + 1), strict=True):
                mesh.addElementsByType(line, 1, [], list(pair))
        mesh.setSizeCallback(lambda dim, tag, x, y, z, lc: size.callback(x, y) if dim else lc)
        with interrupts_deferred():
            mesh.generate(2)
        tags, coordinates, _ = mesh.getNodes()
        order = np.zeros(int(tags.max()) + 1, dtype=np.int64)
        order[tags.astype(np.int64)] = np.arange(len(tags))
        cells = [order[mesh.getElementsByType(2, one)[1].astype(np.int64)].reshape(-1, 3) for one in surfaces]
    found = [order[chain + 1] for chain in chains]
    corners = coordinates.reshape(-1, 3)[:, :2].copy()
    for curve, ends in zip(outline.curves, found, strict=True):
        corners[ends[[0, -1]]] = curve.start, curve.end
    regions = np.repeat(np.arange(len(cells)), list(map(len, cells)))
    return corners, np.concatenate(cells), regions, found


class _Bisection:
    """Cells whose edges are bisected one by one, with the cells on both sides."""

    def __init__(self, corners: Array, cells: Indices, regions: Indices, chains: list[Indices]) -> None:
        self.corners, self.cells, self.regions = corners, cells, regions
        self._on_curves = {frozenset(pair) for chain in chains for pair in pairwise(map(int, chain))}

    def bisect(self, pair: tuple[int, int]) -> None:
        if frozenset(pair) in self._on_curves:
            return
        at = np.flatnonzero(np.isin(self.cells, pair).sum(axis=1) == 2)
        middle = len(self.corners)
        self.corners = np.vstack([self.corners, self.corners[list(pair)].mean(axis=0)])
        halves = [np.where(self.cells[at] == end, middle, self.cells[at]) for end in pair]
        self.cells = np.vstack([np.delete(self.cells, at, axis=0), *halves])
        self.regions = np.concatenate([np.delete(self.regions, at), self.regions[at], self.regions[at]])

    def part(self, singular: set[int]) -> None:
        """Leave each cell with one singular corner at most."""
        while True:
            is_singular = np.isin(self.cells, list(singular))
            pairs = {
                tuple(sorted(self.cells[cell][is_singular[cell]][:2].tolist()))
                for cell in np.flatnonzero(is_singular.sum(axis=1) > 1)
            }
            pairs = {pair for pair in pairs if frozenset(pair) not in self._on_curves}
            if not pairs:
                return
            self.bisect(min(pairs))

    def fan(self, angles: Mapping[int, float]) -> None:
        """Halve the angles of cells at singular corners until none is larger than it may be."""
        while True:
            at, own = np.nonzero(np.isin(self.cells, list(angles)))
            ends = [self.cells[at, (own + turn) % 3] for turn in (0, 1, 2)]
            one, other = (self.corners[end] - self.corners[ends[0]] for end in ends[1:])
            found = np.abs(np.arctan2(one[:, 0] * other[:, 1] - one[:, 1] * other[:, 0], (one * other).sum(axis=1)))
            wide = found > np.array([angles[corner] for corner in map(int, ends[0])])
            pairs = {
                (min(pair), max(pair)) for pair in zip(ends[1][wide].tolist(), ends[2][wide].tolist(), strict=True)
            }
            pairs = {pair for pair in pairs if frozenset(pair) not in self._on_curves}
            if not pairs:
                return
            for pair in sorted(pairs):
                self.bisect(pair)


def _numbers(corners: Array, points: Iterable[Point]) -> Indices:
    """Numbers of the corners at some points."""
    where = {point: number for number, point in enumerate(as_points(corners))}
    missing = [point for point in points if point not in where]
    if missing:
        raise MeshError(f"no node of the mesh lies at {missing[0]}")
    return np.array([where[point] for point in points], dtype=np.int64)


def _noded(mesh: SectionTriangles, powers: Mapping[Point, int], degree: int) -> NodedMesh:
    corners, cells, regions, chains, parameters = mesh.corners, mesh.cells, mesh.regions, mesh.chains, mesh.parameters
    count = len(corners)
    # Edges of the curves, by the key of their two corners.
    sources = np.concatenate([np.full(len(chain) - 1, number) for number, chain in enumerate(chains)])
    firsts, seconds = (np.concatenate([chain[part] for chain in chains]) for part in (slice(None, -1), slice(1, None)))
    keys = np.minimum(firsts, seconds) * count + np.maximum(firsts, seconds)
    order = np.argsort(keys)
    sides = np.array([cells[:, edge] for edge in _EDGES])  # (3, cells, 2)
    side_keys = sides.min(axis=2) * count + sides.max(axis=2)
    place = np.minimum(np.searchsorted(keys[order], side_keys), len(keys) - 1)
    edge = np.where(keys[order][place] == side_keys, order[place], -1)  # the curve's edge at each side of each cell
    names = [curve.name for curve in mesh.curves]
    is_cut = np.array([curve.cut for curve in mesh.curves])
    split = _split(cells, side_keys, np.where(edge >= 0, is_cut[sources[edge]], False))

    element = basix.create_element(
        basix.ElementFamily.P, basix.CellType.triangle, degree, basix.LagrangeVariant.gll_warped
    )
    weights = np.column_stack([1.0 - element.points.sum(axis=1), element.points])
    mapped = np.broadcast_to(weights, (len(cells), *weights.shape)).copy()
    singular = dict(zip(map(int, _numbers(corners, powers)), powers.values(), strict=True))
    for corner, power in singular.items():
        at, own = np.nonzero(cells == corner)
        near = np.zeros((len(at), 1, 3), dtype=bool)
        near[np.arange(len(at)), 0, own] = True
        s = 1.0 - weights.T[own][:, :, None]
        mapped[at] = np.where(near, weights * sum(s**n for n in range(power)), weights * s ** (power - 1))
    nodes = np.einsum("cna,cax->cnx", mapped, corners[cells])
    starts = np.concatenate([own[:-1] for own in parameters])
    ends = np.concatenate([own[1:] for own in parameters])
    for side, (a, b) in enumerate(_EDGES):
        for number, curve in enumerate(mesh.curves):
            if curve.path is None:
                continue
            at = np.flatnonzero((edge[side] >= 0) & (sources[edge[side]] == number))
            own = edge[side][at]
            turned = cells[at, a] != firsts[own]
            first, last = np.where(turned, ends[own], starts[own]), np.where(turned, starts[own], ends[own])
            one, other = mapped[at][:, :, a], mapped[at][:, :, b]
            t = 0.5 * (1.0 + other - one)
            chord = (
                corners[cells[at, a]][:, None] * (1.0 - t)[..., None] + corners[cells[at, b]][:, None] * t[..., None]
            )
            exact = curve.at((first[:, None] + (last - first)[:, None] * t).ravel()).reshape(*t.shape, 2)
            room = 1.0 - (other - one) ** 2
            blend = np.where(room > 0.0, 4.0 * one * other / np.where(room > 0.0, room, 1.0), 0.0)
            nodes[at] += blend[..., None] * (exact - chord)
    points, numbers = _numbered(degree, split, nodes)

    tags = {name: tag for tag, name in enumerate(dict.fromkeys(name for name in names if name), 1)}
    kinds = {name: tag for tag, name in enumerate(dict.fromkeys(mesh.names), 1)}
    side_at, cell_at = np.nonzero((edge >= 0) & (np.array([bool(name) for name in names])[sources[edge]]))
    facets = np.take_along_axis(numbers[cell_at], np.array(_EDGES)[side_at], axis=1)
    return NodedMesh(
        cell="triangle",
        degree=degree,
        points=points,
        cells=numbers,
        cell_tags=np.array([kinds[name] for name in mesh.names], dtype=np.int32)[regions],
        facets=facets,
        facet_tags=np.array([tags.get(name, 0) for name in names], dtype=np.int32)[sources[edge[side_at, cell_at]]],
        cell_names=kinds,
        facet_names=tags,
    )


def _split(cells: Indices, side_keys: Indices, is_cut: NDArray[np.bool_]) -> Indices:
    """Cells in corners that are shared across edges that are not cut only: corners of cells that hang together."""
    count = len(cells)
    keys, cell_at, side_at = side_keys.T.ravel(), np.repeat(np.arange(count), 3), np.tile(np.arange(3), count)
    order = np.argsort(keys, kind="stable")
    same = np.flatnonzero((keys[order][1:] == keys[order][:-1]) & ~is_cut.T.ravel()[order][1:])
    one, other = order[same], order[same + 1]
    links = []
    for end in (0, 1):
        corner = cells[cell_at[one], np.array(_EDGES)[side_at[one], end]]
        local = np.argmax(cells[cell_at[other]] == corner[:, None], axis=1)
        links.append((3 * cell_at[one] + np.array(_EDGES)[side_at[one], end], 3 * cell_at[other] + local))
    rows, columns = (np.concatenate(one) for one in zip(*links, strict=True))
    graph = coo_array((np.ones(len(rows)), (rows, columns)), shape=(3 * count, 3 * count))
    return np.asarray(connected_components(graph, directed=False)[1], dtype=np.int64).reshape(count, 3)


def _numbered(degree: int, cells: Indices, nodes: Array) -> tuple[Array, Indices]:
    """Nodes told by corners and their counts on the lattice, alike in the cells that share them."""
    lattice = basix.create_element(
        basix.ElementFamily.P, basix.CellType.triangle, degree, basix.LagrangeVariant.equispaced
    ).points
    counts = np.rint(degree * np.column_stack([1.0 - lattice.sum(axis=1), lattice])).astype(np.int64)
    told = np.where(counts > 0, cells[:, None, :] * (degree + 1) + counts, -1)
    told = np.sort(told.reshape(-1, 3), axis=1) + 1
    width = int(told.max()) + 1
    keys = (told[:, 0] * width + told[:, 1]) * width + told[:, 2]
    _, first, numbers = np.unique(keys, return_index=True, return_inverse=True)
    return nodes.reshape(-1, 2)[first], numbers.reshape(len(cells), -1)
