"""A triangulated domain as plain arrays, independent of gmsh, meshio and dolfinx."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray


class MeshError(ValueError):
    """A mesh that cannot be read, or that does not have the required groups."""


class MisplacedError(MeshError):
    """Parts of a tank that do not fit together as they are given."""


class TooManyCellsError(MeshError):
    """More cells than are to be made; `cells` by their sizes."""

    def __init__(self, cells: float, most: float) -> None:
        super().__init__(cells, most)
        self.cells, self.most = round(cells), most

    def __str__(self) -> str:
        return (
            f"about {self.cells:.1g} tetrahedra are needed, and {self.most:.1g} can be made: cells are as small "
            "as the liquid is shallow, as its waves are short, or as a wall is curved or a gap narrow in deep liquid"
        )


FARTHEST = 1e30
"""Largest coordinate that files may have, m: products of several are still numbers."""


@dataclass(frozen=True, kw_only=True)
class CurvedCells:
    """Cells whose geometry is polynomial; all the others are straight."""

    degree: int  # of the geometry, at least 2
    cells: NDArray[np.int64]  # indices of the curved cells, shape (curved,)
    # their nodes in the order of ``basix.ufl.element("Lagrange", "triangle", degree, shape=(2,))``, the corners first
    # as in `TaggedMesh.cells`, shape (curved, nodes per cell, 2)
    nodes: NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class Deviation:
    """Largest deviation of the edges of a mesh from the curves that they approximate, measured between their nodes."""

    distance: float = 0.0  # in units of length
    angle: float = 0.0  # between the normals, radians


@dataclass(frozen=True, kw_only=True)
class TaggedMesh:
    """Triangles and boundary edges, each with the tag of a physical group."""

    points: NDArray[np.float64]  # node coordinates, m or dimensionless, shape (nodes, 2)
    cells: NDArray[np.int64]  # node indices, shape (cells, 3)
    cell_tags: NDArray[np.int32]  # physical group of each cell, shape (cells,)
    facets: NDArray[np.int64]  # node indices of the tagged edges, shape (facets, 2)
    facet_tags: NDArray[np.int32]  # physical group of each tagged edge, shape (facets,)
    cell_names: dict[str, int]  # physical name → tag, for cells
    facet_names: dict[str, int]  # physical name → tag, for edges
    curved: CurvedCells | None = None  # the cells that are curved, ``None`` if all are straight
    # deviation of the edges from the meshed curves; zero where that is not known
    deviation: Deviation = field(default_factory=Deviation)

    def require(self, *, cells: Iterable[str], facets: Iterable[str]) -> None:
        """Check that named groups exist and are not empty."""
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
        """Coordinates of the nodes of the edges of one group, shape (nodes, 2), in the unit of the mesh."""
        chosen = self.facets[self.facet_tags == self.facet_names[name]]
        return self.points[np.unique(chosen)]

    def facet_measure(self, name: str) -> float:
        """Total length of the edges of one group, in the unit of the mesh."""
        chosen = self.points[self.facets[self.facet_tags == self.facet_names[name]]]
        return float(np.linalg.norm(chosen[:, 1] - chosen[:, 0], axis=1).sum())

    def scaled(self, factor: float) -> TaggedMesh:
        """The same mesh with all coordinates multiplied by ``factor``."""
        return replace(
            self,
            points=self.points * factor,
            curved=self.curved and replace(self.curved, nodes=self.curved.nodes * factor),
            deviation=replace(self.deviation, distance=self.deviation.distance * factor),
        )


@dataclass(frozen=True, kw_only=True)
class NodedMesh:
    """A mesh of simplices of one degree in plain arrays, with its nodes in the order of dolfinx."""

    cell: str  # "triangle" or "tetrahedron"
    degree: int  # of the geometry
    points: NDArray[np.float64]  # nodes, m or dimensionless, shape (nodes, dim)
    # numbers of each cell's nodes in the order of ``basix.ufl.element("Lagrange", cell, degree)``, the corners first,
    # shape (cells, nodes per cell)
    cells: NDArray[np.int64]
    cell_tags: NDArray[np.int32]  # group of each cell, shape (cells,)
    facets: NDArray[np.int64]  # numbers of the corners of the tagged facets, shape (facets, dim)
    facet_tags: NDArray[np.int32]  # group of each of them, shape (facets,)
    cell_names: dict[str, int]  # physical name → tag, of cells
    facet_names: dict[str, int]  # physical name → tag, of facets
    deviation: float = 0.0  # of the edges from the curves meshed, in units of length; zero where that is not known
