"""Assembly of gmsh's cells and the rings into one mesh: nodes and cells joined, tagged, and cut along `cut` curves."""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from hydroelastic.meshes.curved_cells import Sides
from hydroelastic.meshes.cutting import cut_open
from hydroelastic.meshes.edges import EDGE_CORNERS, Edges, edges_of
from hydroelastic.meshes.filling import Filling
from hydroelastic.meshes.layout import Layout
from hydroelastic.meshes.outline import Outline, Point, as_points, enclosed_area
from hydroelastic.meshes.rings import ring_triangles
from hydroelastic.meshes.tagged_mesh import MeshError, TaggedMesh

# Relative tolerance of the sum of areas.
_AREA_ROUNDING = 1e-9


def assemble(layout: Layout, filling: Filling) -> tuple[TaggedMesh, list[Sides]]:
    """Join the rings and the cells of gmsh."""
    joined = _joined(layout, filling)
    outline = layout.outline
    _check_areas(outline, joined)
    edges = edges_of(joined.cells)
    starts, ends = (np.concatenate([chain[part] for chain in joined.chains]) for part in (slice(-1), slice(1, None)))
    lined = edges.find(np.column_stack([starts, ends]))
    stops = np.cumsum([len(chain) - 1 for chain in joined.chains])
    joined, edges = _turned(joined, edges, lined)
    sides = _sides(joined, edges, lined, starts, stops)
    points, cells = joined.points, joined.cells
    on_curves = np.split(lined, stops[:-1])
    to_cut = [some for some, curve in zip(on_curves, outline.curves, strict=True) if curve.cut]
    if to_cut:
        cells, copied = cut_open(cells, edges, np.concatenate(to_cut))
        points = points[copied]
    facet_names = _tags([curve.name for curve in outline.curves if curve.name])
    facets, facet_tags = _facets(outline, cells, sides, facet_names)
    cell_names = _tags([region.name for region in outline.regions])
    tag_of_region = np.array([cell_names[region.name] for region in outline.regions], dtype=np.int32)
    mesh = TaggedMesh(
        points=points,
        cells=cells,
        cell_tags=tag_of_region[joined.regions],
        facets=facets,
        facet_tags=facet_tags,
        cell_names=cell_names,
        facet_names=facet_names,
    )
    return mesh, sides


@dataclass(frozen=True, kw_only=True)
class _Joined:
    """All nodes and cells before the mesh is cut open."""

    points: NDArray[np.float64]  # shape (nodes, 2)
    cells: NDArray[np.int64]  # clockwise, shape (cells, 3)
    regions: NDArray[np.int64]  # index of each cell's region
    chains: list[NDArray[np.int64]]  # nodes of each curve from its start to its end


def _joined(layout: Layout, filling: Filling) -> _Joined:
    """gmsh's cells, then ring after ring, corner after corner; each node once."""
    numbers = dict(filling.ends)
    added: list[Point] = []

    def nodes_at(points: NDArray[np.float64]) -> NDArray[np.int64]:
        for point in as_points(points):
            if point not in numbers:
                numbers[point] = len(filling.points) + len(added)
                added.append(point)
        return np.array([numbers[point] for point in as_points(points)], dtype=np.int64)

    cells = list(filling.cells)
    regions = [np.full(len(some), region) for region, some in enumerate(cells)]
    for graded in layout.outline.graded_points:
        for (region, _), wedge in layout.wedges.items():
            if wedge.graded == graded.point:
                index = nodes_at(np.vstack([[graded.point], wedge.nodes.reshape(-1, 2)]))
                cells.append(index[ring_triangles(*wedge.nodes.shape[:2])])
                regions.append(np.full(len(cells[-1]), region))
    chains = []
    for number in range(len(layout.outline.curves)):
        before, after = (nodes_at(layout.within_rings(number, at_start)[1]) for at_start in (True, False))
        chains.append(np.concatenate([before, filling.chains[number], after]))
    return _Joined(
        points=np.vstack([filling.points, np.array(added).reshape(-1, 2)]),
        cells=np.vstack(cells),
        regions=np.concatenate(regions),
        chains=chains,
    )


def _check_areas(outline: Outline, joined: _Joined) -> None:
    """Check that the area of the mesh is that of the domain: gmsh reports no crossing lines."""
    corners = joined.points[joined.cells]
    areas = 0.5 * _cross(corners[:, 2] - corners[:, 0], corners[:, 1] - corners[:, 0])
    for index, region in enumerate(outline.regions):
        chains = [joined.chains[number][:: 1 if forward else -1][:-1] for number, forward in region.loop]
        area = enclosed_area(joined.points[np.concatenate(chains)])
        here = areas[joined.regions == index]
        if not (here.min() > 0.0 and abs(here.sum() - area) <= _AREA_ROUNDING * area):
            raise MeshError(f"the triangles of region {region.name!r} overlap or leave gaps: do curves cross?")


def _turned(joined: _Joined, edges: Edges, lined: NDArray[np.int64]) -> tuple[_Joined, Edges]:
    """Turn cells so that their first corner is opposite to their edge on a curve, of several on the first one: facets
    that have the same place in their cells are integrated together."""
    rank = np.zeros(len(edges.nodes), dtype=np.int64)
    rank[lined] = np.arange(len(lined), 0, -1)
    corners = (np.argmax(rank[edges.places], axis=1)[:, None] + np.arange(3)) % 3
    cells, places = (np.take_along_axis(array, corners, axis=1) for array in (joined.cells, edges.places))
    return replace(joined, cells=cells), replace(edges, places=places)


def _sides(
    joined: _Joined,
    edges: Edges,
    lined: NDArray[np.int64],
    starts: NDArray[np.int64],
    stops: NDArray[np.int64],
) -> list[Sides]:
    """The cells at the edges of each curve, those at each edge one after the other."""
    # An edge has the places 3 · cell + opposite corner.
    flat = edges.places.ravel()
    element_of = np.full(len(edges.nodes), -1)
    element_of[lined] = np.arange(len(lined))
    places = np.flatnonzero(element_of[flat] >= 0)
    elements = element_of[flat[places]]
    order = np.argsort(elements, kind="stable")
    places, elements = places[order], elements[order]
    cells, opposite = np.divmod(places, 3)
    first, second = EDGE_CORNERS[opposite].T
    forward = joined.cells[cells, first] == starts[elements]
    ends = np.where(forward, [first, second], [second, first])
    bounds = np.append(0, stops)
    owned = (slice(*some) for some in pairwise(np.searchsorted(elements, bounds)))
    return [
        Sides(cells=cells[own], elements=elements[own] - before, starts=ends[0, own], ends=ends[1, own])
        for own, before in zip(owned, bounds[:-1], strict=True)
    ]


def _facets(
    outline: Outline, cells: NDArray[np.int64], sides: list[Sides], names: dict[str, int]
) -> tuple[NDArray[np.int64], NDArray[np.int32]]:
    """Facets and their tags: one on each side of a curve that is cut, else one."""
    facets, tags = [], []
    for curve, side in zip(outline.curves, sides, strict=True):
        if curve.name:
            chosen = np.full(len(side.elements), True)
            if not curve.cut:
                chosen[1:] = np.diff(side.elements) > 0
            ends = np.column_stack([side.starts, side.ends])[chosen]
            facets.append(cells[side.cells[chosen][:, None], ends])
            tags.append(np.full(len(ends), names[curve.name], dtype=np.int32))
    found = np.vstack(facets)
    if len(np.unique(np.sort(found, axis=1) @ [cells.max() + 1, 1])) < len(found):
        raise MeshError("a slit of a single element cannot be opened: ask for smaller elements on it")
    return found, np.concatenate(tags)


def _tags(names: list[str]) -> dict[str, int]:
    return {name: tag for tag, name in enumerate(dict.fromkeys(names), start=1)}


def _cross(one: NDArray[np.float64], other: NDArray[np.float64]) -> NDArray[np.float64]:
    result: NDArray[np.float64] = one[:, 0] * other[:, 1] - one[:, 1] * other[:, 0]
    return result
