"""A triangulated domain as plain arrays: what gmsh makes, what meshio reads and writes, what dolfinx is given."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray


class MeshError(ValueError):
    """A mesh that cannot be read, or that lacks what its user promised."""


@dataclass(frozen=True, kw_only=True)
class TaggedMesh:
    """Triangles and boundary edges, each with the tag of a physical group.

    Attributes:
        points: node coordinates, shape (nodes, 2).
        cells: node indices, shape (cells, 3).
        cell_tags: physical group of each cell, shape (cells,).
        facets: node indices of the tagged edges, shape (facets, 2).
        facet_tags: physical group of each tagged edge, shape (facets,).
        cell_names: physical name → tag, for cells.
        facet_names: physical name → tag, for edges.
    """

    points: NDArray[np.float64]
    cells: NDArray[np.int64]
    cell_tags: NDArray[np.int32]
    facets: NDArray[np.int64]
    facet_tags: NDArray[np.int32]
    cell_names: dict[str, int]
    facet_names: dict[str, int]

    def require(self, *, cells: Iterable[str], facets: Iterable[str]) -> None:
        """Check that named groups exist and are not empty.

        Raises:
            MeshError: naming every group that is missing, and those that are there.
        """
        problems = []
        for kind, wanted, names, tags in (
            ("cells", cells, self.cell_names, self.cell_tags),
            ("edges", facets, self.facet_names, self.facet_tags),
        ):
            missing = [name for name in wanted if name not in names or not np.any(tags == names[name])]
            if missing:
                there = ", ".join(sorted(names)) or "none"
                problems.append(f"physical groups of {kind} missing: {', '.join(missing)} (there are: {there})")
        if problems:
            raise MeshError("; ".join(problems))

    def facet_nodes(self, name: str) -> NDArray[np.float64]:
        """Coordinates of the nodes of the edges of one group, shape (nodes, 2)."""
        chosen = self.facets[self.facet_tags == self.facet_names[name]]
        return self.points[np.unique(chosen)]

    def facet_measure(self, name: str) -> float:
        """Total length of the edges of one group."""
        chosen = self.points[self.facets[self.facet_tags == self.facet_names[name]]]
        return float(np.linalg.norm(chosen[:, 1] - chosen[:, 0], axis=1).sum())

    def scaled(self, factor: float) -> TaggedMesh:
        """The same mesh with all coordinates multiplied by ``factor``."""
        return TaggedMesh(
            points=self.points * factor,
            cells=self.cells,
            cell_tags=self.cell_tags,
            facets=self.facets,
            facet_tags=self.facet_tags,
            cell_names=self.cell_names,
            facet_names=self.facet_names,
        )
