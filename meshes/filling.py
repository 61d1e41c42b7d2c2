"""Triangulation by gmsh of the regions of a domain outside the rings, between the edges of its boundary."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from itertools import pairwise
from tempfile import TemporaryDirectory

import gmsh
import numpy as np
from numpy.typing import NDArray

from hydroelastic.meshes.interrupts import interrupts_deferred
from hydroelastic.meshes.outline import Point, as_points
from hydroelastic.meshes.size_field import SizeField
from hydroelastic.meshes.tagged_mesh import MeshError

Key = int | tuple[int, int]

# gmsh's types of elements.
_EDGE, _TRIANGLE = 1, 2


@dataclass(frozen=True, kw_only=True)
class Line:
    """A polyline between two regions, or on the boundary; each edge is one of the mesh."""

    key: Key  # lines of the same key are the same, perhaps passed the other way
    points: NDArray[np.float64]  # shape (n, 2)
    forward: bool  # whether the region's boundary passes the points in their order


@dataclass(frozen=True, kw_only=True)
class Filling:
    """The mesh of gmsh."""

    points: NDArray[np.float64]  # coordinates of nodes in the unit of the outline, shape (nodes, 2)
    cells: list[NDArray[np.int64]]  # triangles of each region, shape (triangles, 3), clockwise
    chains: dict[Key, NDArray[np.int64]]  # nodes of each line by its key, in the order of its points
    ends: dict[Point, int]  # nodes at the points of the lines


def fill(points: Iterable[NDArray[np.float64]], loops: Iterable[list[Line]], size: SizeField) -> Filling:
    """Triangulate regions."""
    with gmsh_model():
        drawing = _Drawing(points)
        surfaces = [drawing.surface(loop) for loop in loops]
        gmsh.model.geo.synchronize()
        drawing.mesh_lines()
        for option in ("MeshSizeFromPoints", "MeshSizeExtendFromBoundary", "MeshSizeFromCurvature"):
            gmsh.option.setNumber(f"Mesh.{option}", 0)
        gmsh.option.setNumber("Mesh.Algorithm", 6)  # frontal-Delaunay: the best-shaped triangles
        # Its points have the sizes of the edges at them.
        gmsh.model.mesh.setSizeCallback(lambda dim, tag, x, y, z, lc: size(x, y) if dim else lc)
        with interrupts_deferred():
            gmsh.model.mesh.generate(2)
        return drawing.filling(surfaces)


@contextmanager
def gmsh_model() -> Iterator[None]:
    """A new gmsh model with default options and without messages; gmsh is initialized once in a process."""
    if not gmsh.isInitialized():
        _initialize_gmsh()
    # Otherwise it would delete these files of the user, in the home folder, as it restores defaults.
    gmsh.option.setString("General.SessionFileName", "")
    gmsh.option.setString("General.OptionsFileName", "")
    # Limits of size that one mesh was given would otherwise hold for the next one too.
    gmsh.option.restoreDefaults()
    gmsh.option.setNumber("General.AbortOnError", 2)  # raise it, as gmsh.initialize has it
    gmsh.option.setNumber("General.Verbosity", 0)
    gmsh.model.add("tank")
    try:
        yield
    except MeshError:
        raise
    except Exception as error:  # gmsh raises bare Exception
        # After a failure the mesh generator stays locked until gmsh is initialized again.
        gmsh.finalize()
        raise MeshError(
            "gmsh finds no cells for it; parts that cross, touch or almost touch, or sizes that differ by many powers "
            "of ten, are the usual reasons"
        ) from error
    finally:
        if gmsh.isInitialized():
            gmsh.model.mesh.removeSizeCallback()
            gmsh.model.remove()


def _initialize_gmsh() -> None:
    """Start gmsh, with a home folder that goes: FLTK, which it brings, writes preferences there."""
    home = os.environ.get("HOME")
    with TemporaryDirectory(prefix="hydroelastic_") as folder:
        os.environ["HOME"] = folder
        try:
            # gmsh would otherwise take over Ctrl-C, and a long run could no longer be interrupted.
            gmsh.initialize(readConfigFiles=False, interruptible=False)
        finally:
            del os.environ["HOME"]
            if home is not None:
                os.environ["HOME"] = home


class _Drawing:
    def __init__(self, points: Iterable[NDArray[np.float64]]) -> None:
        # Nodes are numbered as the points are, before all others.
        self._nodes: dict[Point, int] = {}
        for x, y in as_points(np.vstack(list(points))):
            if (x, y) not in self._nodes:
                self._nodes[x, y] = len(self._nodes)
                gmsh.model.geo.addPoint(x, y, 0.0, tag=len(self._nodes))
        self._chains: dict[Key, NDArray[np.int64]] = {}
        # Tags of each line from its first to its last point; negative for reversed lines.
        self._lines: dict[Key, list[int]] = {}

    def surface(self, loop: list[Line]) -> int:
        """A region within a clockwise loop."""
        curves: list[int] = []
        for line in loop:
            lines = self._line(line)
            curves += lines if line.forward else [-one for one in reversed(lines)]
        return int(gmsh.model.geo.addPlaneSurface([gmsh.model.geo.addCurveLoop(curves)]))

    def _line(self, line: Line) -> list[int]:
        if line.key not in self._lines:
            chain = [self._nodes[point] for point in as_points(line.points)]
            self._chains[line.key] = np.array(chain)
            # gmsh, whose tags begin with 1, is given them as the first loop passes them.
            way = 1 if line.forward else -1
            lines = [int(gmsh.model.geo.addLine(1 + a, 1 + b)) for a, b in pairwise(chain[::way])]
            self._lines[line.key] = [way * one for one in lines[::way]]
        return self._lines[line.key]

    def mesh_lines(self) -> None:
        """Make each line an element, without gmsh, which would integrate along it in hundreds of steps."""
        gmsh.option.setNumber("Mesh.MeshOnlyVisible", 1)
        gmsh.model.setVisibility(gmsh.model.getEntities(1), 0)
        gmsh.model.mesh.generate(1)  # nodes at the points alone
        gmsh.option.setNumber("Mesh.MeshOnlyVisible", 0)
        gmsh.option.setNumber("Mesh.MeshOnlyEmpty", 1)
        for key, lines in self._lines.items():
            for line, (start, end) in zip(lines, pairwise(1 + self._chains[key]), strict=True):
                gmsh.model.mesh.addElementsByType(abs(line), _EDGE, [], [start, end] if line > 0 else [end, start])

    def filling(self, surfaces: list[int]) -> Filling:
        """Read gmsh's mesh into arrays with nodes numbered from 0."""
        tags, coordinates, _ = gmsh.model.mesh.getNodes()
        order = np.zeros(int(tags.max()) + 1, dtype=np.int64)
        order[tags.astype(np.int64)] = np.arange(len(tags))
        cells = []
        for surface in surfaces:
            _, nodes = gmsh.model.mesh.getElementsByType(_TRIANGLE, surface)
            cells.append(order[nodes.astype(np.int64)].reshape(-1, 3))
        points = coordinates.reshape(-1, 3)[:, :2].copy()
        return Filling(points=points, cells=cells, chains=self._chains, ends=self._nodes)
