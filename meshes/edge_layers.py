"""Layers of tetrahedra that become thinner in geometric progression towards singular edges.

At the edge of a plate, the corner of a float or the tip of a baffle ψ varies steeply across the edge and smoothly along
it. Cells at the edge are cut at a fixed part of their width, again and again: a layer costs as many cells as the edge
has segments, where cells of one length in all directions would need many more segments. Corners, in which edges meet at
an angle, are cut off in the same way. Multigrid converges slowly on such cells: they are for factorizations.

A cell has no corner, one corner, or one edge on the singular edges, once all other edges between such corners are
bisected. It is then cut into prisms, and these into three cells each by diagonals from the lowest number on each side,
so that neighbours agree (J. Dompierre et al., How to subdivide pyramids, prisms and hexahedra into tetrahedra, 8th
International Meshing Roundtable, 1999).
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import combinations

import basix
import numpy as np
from numpy.typing import NDArray

from hydroelastic.meshes.tagged_mesh import NodedMesh

_Ints = NDArray[np.int64]

LAYER_RATIO = 0.3
"""Of the widths of successive layers; measured: at degree 4 fewer unknowns than 0.15 and 0.4 for the same error."""

_EDGES = np.array(list(combinations(range(4), 2)))
# Of the face opposite to each corner.
_FACES = np.array(basix.topology(basix.CellType.tetrahedron)[2])
# Prisms (0, 1, 2; 3, 4, 5) turned so that each corner in turn is the first one, and their two divisions where that has
# the lowest number: by the diagonal 1–5 or 2–4 of the side opposite to it.
_TURNED = np.array(
    [
        (0, 1, 2, 3, 4, 5),
        (1, 2, 0, 4, 5, 3),
        (2, 0, 1, 5, 3, 4),
        (3, 5, 4, 0, 2, 1),
        (4, 3, 5, 1, 0, 2),
        (5, 4, 3, 2, 1, 0),
    ]
)
_DIVIDED = np.array([[(0, 1, 2, 5), (0, 1, 5, 4), (0, 4, 5, 3)], [(0, 1, 2, 4), (0, 4, 2, 5), (0, 4, 5, 3)]])
# A cell with one corner near, the first one: where the new corners on the edges to the others are 4, 5 and 6.
_TIP, _BEHIND_TIP = [0, 4, 5, 6], [4, 5, 6, 1, 2, 3]
# A cell with two corners near: where 4 and 5 are on the edges from the first one, 6 and 7 on those from the second one.
_ALONG_EDGE, _BEHIND_EDGE = [0, 4, 5, 1, 6, 7], [2, 4, 6, 3, 5, 7]


def with_edge_layers(mesh: NodedMesh, segments: _Ints, corners: _Ints, layers: int) -> NodedMesh:
    """Cut the cells at singular edges into layers."""
    if not layers or not len(segments):
        return mesh
    parts = _Parts(
        cells=mesh.cells[:, :4],
        parents=np.arange(len(mesh.cells)),
        places=np.tile(np.eye(4), (len(mesh.cells), 1, 1)),
        segments=segments,
        count=len(mesh.points),
    )
    for _ in range(layers):
        parts = parts.bisected_between(corners, np.empty((0, 2), np.int64)).cut_near(corners)
        parts = parts.bisected_between(np.unique(parts.segments), parts.segments)
        parts = parts.cut_near(np.unique(parts.segments))
    return _assembled(mesh, parts)


@dataclass(frozen=True, kw_only=True)
class _Parts:
    """Parts of the cells of a mesh."""

    cells: _Ints  # numbers of their corners, shape (n, 4)
    parents: _Ints  # the cell of which each is a part, shape (n,)
    places: NDArray[np.float64]  # barycentric coordinates of their corners in these cells, shape (n, 4, 4)
    segments: _Ints  # of the singular edges, by their ends, shape (m, 2)
    count: int  # number of corners

    def bisected_between(self, corners: _Ints, kept: _Ints) -> _Parts:
        """Bisect all edges between some corners, but for those that are kept, given by their ends, shape (n, 2).

        Of the edges of a cell the lowest comes first, so that cells with a common face divide it alike.
        """
        pairs = self.keys(self.cells[:, _EDGES])
        keys = np.setdiff1d(pairs[np.isin(self.cells[:, _EDGES], corners).all(axis=2)], self.keys(kept))
        found = self
        while True:
            own = found.keys(found.cells[:, _EDGES])
            own = np.where(np.isin(own, keys), own, np.iinfo(np.int64).max)
            lowest = own.min(axis=1)
            chosen = np.flatnonzero(lowest < np.iinfo(np.int64).max)
            if not len(chosen):
                return found._with_segments(keys, self.count)
            ends = _EDGES[own[chosen].argmin(axis=1)]
            rows = np.arange(len(chosen))
            middles = found.places[chosen[:, None], ends].mean(axis=1)
            halves = []
            for end in ends.T:
                cells, places = found.cells[chosen].copy(), found.places[chosen].copy()
                cells[rows, end] = self.count + np.searchsorted(keys, lowest[chosen])
                places[rows, end] = middles
                halves.append((chosen, cells, places))
            found = found._replaced(chosen, halves)

    def cut_near(self, corners: _Ints) -> _Parts:
        """Cut all edges between some corners and others, at a part of their length from the former.

        Each cell must have one of them at most, or two.
        """
        near = np.isin(self.cells, corners)
        order = np.argsort(~near, axis=1, kind="stable")
        cells, places = np.take_along_axis(self.cells, order, 1), np.take_along_axis(self.places, order[..., None], 1)
        tips, along = (np.flatnonzero(near.sum(axis=1) == count) for count in (1, 2))
        cuts = [(tips, ([0, 0, 0], [1, 2, 3])), (along, ([0, 0, 1, 1], [2, 3, 2, 3]))]
        new_keys = [
            self.keys(np.stack([cells[some][:, one], cells[some][:, other]], -1)) for some, (one, other) in cuts
        ]
        keys = np.unique(np.concatenate([own.ravel() for own in new_keys]))
        made = []
        for (some, (one, other)), own in zip(cuts, new_keys, strict=True):
            every = np.concatenate([cells[some], self.count + np.searchsorted(keys, own)], axis=1)
            new = (1.0 - LAYER_RATIO) * places[some][:, one] + LAYER_RATIO * places[some][:, other]
            where = np.concatenate([places[some], new], axis=1)
            if some is tips:
                made.append((some, every[:, _TIP], where[:, _TIP]))
            for prism in [_BEHIND_TIP] if some is tips else [_ALONG_EDGE, _BEHIND_EDGE]:
                made += [(some, *part) for part in _divided(every[:, prism], where[:, prism])]
        return self._replaced(np.concatenate([tips, along]), made)._with_segments(keys, self.count)

    def keys(self, pairs: _Ints) -> _Ints:
        """A number of each pair of corners, shape (…, 2) → (…,)."""
        ordered = np.sort(pairs, axis=-1)
        keys: _Ints = ordered[..., 0] * np.int64(2**31) + ordered[..., 1]
        return keys

    def _replaced(self, gone: _Ints, made: list[tuple[_Ints, _Ints, NDArray[np.float64]]]) -> _Parts:
        """With parts (of which cells, corners, places) in place of cells that are gone."""
        kept = np.delete(np.arange(len(self.cells)), gone)
        of_cells, cells, places = zip((kept, self.cells[kept], self.places[kept]), *made, strict=True)
        return replace(
            self,
            cells=np.concatenate(cells),
            parents=self.parents[np.concatenate(of_cells)],
            places=np.concatenate(places),
        )

    def _with_segments(self, keys: _Ints, first: int) -> _Parts:
        """With new corners, numbered from the first one, on edges of these keys; segments among them are divided."""
        own = self.keys(self.segments)
        divided = np.isin(own, keys)
        middle = first + np.searchsorted(keys, own[divided])
        halves = [np.column_stack([end, middle]) for end in self.segments[divided].T]
        return replace(self, segments=np.concatenate([self.segments[~divided], *halves]), count=first + len(keys))


def _divided(prisms: _Ints, places: NDArray[np.float64]) -> list[tuple[_Ints, NDArray[np.float64]]]:
    """Three tetrahedra of each prism, (n, 6) → (n, 4), with the places of their corners."""
    turned = _TURNED[prisms.argmin(axis=1)]
    cells = np.take_along_axis(prisms, turned, 1)
    second = np.minimum(cells[:, 1], cells[:, 5]) > np.minimum(cells[:, 2], cells[:, 4])
    found = []
    for corners in np.moveaxis(_DIVIDED[second.astype(int)], 1, 0):
        chosen = np.take_along_axis(turned, corners, 1)
        found.append((np.take_along_axis(prisms, chosen, 1), np.take_along_axis(places, chosen[..., None], 1)))
    return found


def _assembled(mesh: NodedMesh, parts: _Parts) -> NodedMesh:
    """The parts as a mesh of the same degree, with the groups of what they are parts of."""
    # Turned like the cell of which they are parts.
    turned = np.linalg.det(parts.places) < 0.0
    cells, places = parts.cells.copy(), parts.places.copy()
    cells[turned] = cells[turned][:, [1, 0, 2, 3]]
    places[turned] = places[turned][:, [1, 0, 2, 3]]
    element = basix.create_element(
        basix.ElementFamily.P, basix.CellType.tetrahedron, mesh.degree, basix.LagrangeVariant.gll_warped
    )
    weights = np.column_stack([1.0 - element.points.sum(axis=1), element.points])
    inside = weights @ places
    values = element.tabulate(0, inside[..., 1:].reshape(-1, 3))[0, :, :, 0].reshape(*inside.shape[:2], -1)
    points = values @ mesh.points[mesh.cells[parts.parents]]
    # A node is told by the corners on which it depends, with its weights.
    lattice = basix.create_element(
        basix.ElementFamily.P, basix.CellType.tetrahedron, mesh.degree, basix.LagrangeVariant.equispaced
    ).points
    counts = np.rint(mesh.degree * np.column_stack([1.0 - lattice.sum(axis=1), lattice])).astype(np.int64)
    told = np.where(counts > 0, cells[:, None, :] * (mesh.degree + 1) + counts, -1)
    _, first, numbers = np.unique(np.sort(told.reshape(-1, 4), axis=1), axis=0, return_index=True, return_inverse=True)
    numbers = numbers.reshape(told.shape[:2])
    # Faces on those of their parents, which have the same groups.
    original = np.sort(mesh.cells[:, :4][:, _FACES], axis=2)
    faces, of_cells = np.unique(
        np.concatenate([original.reshape(-1, 3), np.sort(mesh.facets, axis=1)]), axis=0, return_inverse=True
    )
    tags = np.zeros(len(faces), np.int32)
    of_cells = of_cells.ravel()
    tags[of_cells[original.size // 3 :]] = mesh.facet_tags
    own = tags[of_cells[: original.size // 3]].reshape(-1, 4)[parts.parents]
    facets, marks = [], []
    for corners in _FACES:
        for face in range(4):
            lies_on = (places[:, corners, face] == 0.0).all(axis=1) & (own[:, face] > 0)
            facets.append(numbers[lies_on][:, corners])
            marks.append(own[lies_on, face])
    every, which = np.unique(np.sort(np.concatenate(facets), axis=1), axis=0, return_index=True)
    return replace(
        mesh,
        points=points.reshape(-1, 3)[first],
        cells=numbers,
        cell_tags=mesh.cell_tags[parts.parents],
        facets=every,
        facet_tags=np.concatenate(marks)[which],
    )
