"""Mesh of open water: the mesh of a basin, surrounded by layers of elongated cells whose width grows outwards.

From every node on the sides that are extended a straight ray leads outwards: sideways, downwards, upwards, and from
each corner between two such sides also diagonally, so that the number of cells in a layer does not grow with its
distance.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from hydroelastic.meshes.geometry import BOTTOM, FAR_END, LEFT_WALL, LID, RIGHT_WALL
from hydroelastic.meshes.tagged_mesh import TaggedMesh

Direction = tuple[int, int]
Ray = tuple[int, Direction]
"""A node of the basin and the direction of its ray."""

_OUTWARDS: dict[str, Direction] = {LEFT_WALL: (-1, 0), RIGHT_WALL: (1, 0), BOTTOM: (0, -1), LID: (0, 1)}
_SIDEWAYS = (LEFT_WALL, RIGHT_WALL)


@dataclass(frozen=True, kw_only=True)
class CellLayers:
    """Distances of the outer sides of successive layers of cells from the basin, ascending, in the unit of the mesh."""

    sideways: NDArray[np.float64]  # distances from the left and the right wall, shape (layers,)
    below: NDArray[np.float64]  # distances from the bottom, if it is extended, shape (layers,)
    above: NDArray[np.float64]  # distances from the lid, if it is extended, shape (layers,)


def extended(mesh: TaggedMesh, sides: tuple[str, ...], layers: CellLayers) -> TaggedMesh:
    """Surround a basin with layers of cells; the result is a larger basin with the same names of sides."""
    rim = _Rim(mesh, sides)
    numbers, positions = rim.nodes(layers)
    cells, tags = rim.cells(numbers, positions)
    facets, facet_tags = rim.facets(numbers)
    kept = ~np.isin(mesh.facet_tags, [mesh.facet_names[side] for side in sides])
    return replace(
        mesh,
        points=positions,
        cells=np.vstack([mesh.cells, cells]),
        cell_tags=np.concatenate([mesh.cell_tags, tags]),
        facets=np.vstack([mesh.facets[kept], facets]),
        facet_tags=np.concatenate([mesh.facet_tags[kept], facet_tags]),
    )


def with_far_ends(mesh: TaggedMesh, sides: tuple[str, ...]) -> TaggedMesh:
    """Give the outer sides at which the mesh is truncated one common name, `FAR_END`."""
    tag = max(mesh.facet_names.values()) + 1
    far = np.isin(mesh.facet_tags, [mesh.facet_names[side] for side in sides])
    names = {name: number for name, number in mesh.facet_names.items() if name not in sides}
    return replace(
        mesh, facet_tags=np.where(far, tag, mesh.facet_tags).astype(np.int32), facet_names={**names, FAR_END: tag}
    )


class _Rim:
    def __init__(self, mesh: TaggedMesh, sides: tuple[str, ...]) -> None:
        self._mesh = mesh
        owner = _cell_at_edge(mesh)
        sides_of: dict[int, list[str]] = {}
        # Edges between rays, each with the tag of its cell and the name of the side that it will be part of.
        self._edges: list[tuple[Ray, Ray, int, str]] = []
        for side in sides:
            for first, second in mesh.facets[mesh.facet_tags == mesh.facet_names[side]]:
                tag = int(mesh.cell_tags[owner[_key(first, second)]])
                ends = ((int(first), _OUTWARDS[side]), (int(second), _OUTWARDS[side]))
                self._edges.append((*ends, tag, side))
                for node in (int(first), int(second)):
                    sides_of.setdefault(node, []).append(side)
        for node, names in sides_of.items():
            wall = next((name for name in names if name in _SIDEWAYS), None)
            level = next((name for name in names if name not in _SIDEWAYS), None)
            if wall is not None and level is not None:
                self._edges += self._corner(node, wall, level)
        self.rays = list(dict.fromkeys(ray for first, second, _, _ in self._edges for ray in (first, second)))
        self._rails = list(self._rail_names(sides))

    def _corner(self, node: int, wall: str, level: str) -> Iterator[tuple[Ray, Ray, int, str]]:
        sideways, vertical = _OUTWARDS[wall], _OUTWARDS[level]
        diagonal = (sideways[0], vertical[1])
        tag = next(tag for first, second, tag, _ in self._edges if node in (first[0], second[0]))
        yield (node, sideways), (node, diagonal), tag, wall
        yield (node, diagonal), (node, vertical), tag, level

    def _rail_names(self, sides: tuple[str, ...]) -> Iterator[tuple[Ray, int]]:
        """Rays that go on along a named curve of the basin, and its tag."""
        extended_tags = [self._mesh.facet_names[side] for side in sides]
        for (first, second), tag in zip(self._mesh.facets, self._mesh.facet_tags, strict=True):
            if tag not in extended_tags:
                yield from ((ray, int(tag)) for ray in self.rays if ray[0] in (first, second))

    def nodes(self, layers: CellLayers) -> tuple[NDArray[np.int64], NDArray[np.float64]]:
        """Number of the node of each ray at each level, shape (rays, levels), and the positions of all nodes."""
        base = self._mesh.points[[node for node, _ in self.rays]]
        ways = np.array([way for _, way in self.rays], dtype=np.float64)
        vertical = np.where(ways[:, 1:] < 0.0, layers.below, layers.above)
        distances = np.stack([np.broadcast_to(layers.sideways, vertical.shape), vertical], axis=2)
        outer = base[:, None] + ways[:, None] * distances
        numbers = np.empty((len(self.rays), 1 + len(layers.sideways)), dtype=np.int64)
        numbers[:, 0] = [node for node, _ in self.rays]
        numbers[:, 1:] = len(self._mesh.points) + np.arange(outer.shape[0] * outer.shape[1]).reshape(outer.shape[:2])
        return numbers, np.vstack([self._mesh.points, outer.reshape(-1, 2)])

    def cells(
        self, numbers: NDArray[np.int64], positions: NDArray[np.float64]
    ) -> tuple[NDArray[np.int64], NDArray[np.int32]]:
        """Two triangles between neighbouring rays and levels, one where rays leave the same corner; clockwise."""
        row = {ray: index for index, ray in enumerate(self.rays)}
        cells, tags = [], []
        for first, second, tag, _ in self._edges:
            one, other = numbers[row[first]], numbers[row[second]]
            for inner in range(numbers.shape[1] - 1):
                quad = (one[inner], one[inner + 1], other[inner + 1], other[inner])
                for triangle in _halves(quad, positions):
                    cells.append(triangle)
                    tags.append(tag)
        return np.array(cells, dtype=np.int64), np.array(tags, dtype=np.int32)

    def facets(self, numbers: NDArray[np.int64]) -> tuple[NDArray[np.int64], NDArray[np.int32]]:
        """Edges along named curves, then the new sides."""
        row = {ray: index for index, ray in enumerate(self.rays)}
        facets, tags = [], []
        for ray, tag in dict.fromkeys(self._rails):
            along = numbers[row[ray]]
            facets += list(pairwise(along))
            tags += [tag] * (len(along) - 1)
        for first, second, _, side in self._edges:
            facets.append((numbers[row[first], -1], numbers[row[second], -1]))
            tags.append(self._mesh.facet_names[side])
        return np.array(facets, dtype=np.int64), np.array(tags, dtype=np.int32)


def _key(first: int, second: int) -> tuple[int, int]:
    return (int(min(first, second)), int(max(first, second)))


def _cell_at_edge(mesh: TaggedMesh) -> dict[tuple[int, int], int]:
    """A cell at each edge; at a boundary edge the only one."""
    return {_key(cell[place], cell[place - 1]): number for number, cell in enumerate(mesh.cells) for place in range(3)}


def _halves(quad: tuple[int, int, int, int], positions: NDArray[np.float64]) -> Iterator[tuple[int, int, int]]:
    """A quadrilateral cut along its shorter diagonal; a triangle where two of its corners are one node."""
    a, b, c, d = quad
    if np.linalg.norm(positions[a] - positions[c]) <= np.linalg.norm(positions[b] - positions[d]):
        halves = ((a, b, c), (a, c, d))
    else:
        halves = ((a, b, d), (b, c, d))
    for one, two, three in halves:
        if len({one, two, three}) == 3:
            u, v = positions[two] - positions[one], positions[three] - positions[one]
            yield (one, two, three) if u[0] * v[1] < u[1] * v[0] else (one, three, two)
