"""Fields as plain arrays on one process, for pictures and files: ψ and ∇ψ on small triangles, ψ along surfaces."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from dolfinx import fem
from mpi4py import MPI
from numpy.polynomial.chebyshev import chebpts2, chebvander
from numpy.typing import NDArray

from hydroelastic.fem.cells import cell_corners, cell_jacobians, cell_positions, owned_cells
from hydroelastic.fem.facets import facet_groups
from hydroelastic.fem.liquid import LiquidSpace
from hydroelastic.physics.contours import POINTS


@dataclass(frozen=True, kw_only=True)
class LiquidSample:
    """Several modes sampled on the same triangles, in the units of the mesh.

    Attributes:
        points: coordinates, shape (points, 2); points on a cell's edge stand once per cell.
        triangles: shape (triangles, 3).
        liquid: of each triangle: 1 is the lowest, shape (triangles,).
        potential: ψ of each mode, shape (modes, points).
        displacement: ∇ψ of each mode, shape (modes, points, 2).
    """

    points: NDArray[np.float64]
    triangles: NDArray[np.int64]
    liquid: NDArray[np.int64]
    potential: NDArray[np.float64]
    displacement: NDArray[np.float64]


@dataclass(frozen=True, kw_only=True)
class SurfaceTrace:
    """ψ of several modes at Chebyshev's points of the facets of a named surface, from left to right.

    At a slit that crosses the surface ψ has two values, each of which belongs to the facet on its side.

    Attributes:
        x: abscissae in the unit of the mesh, increasing in each facet, shape (facets, points).
        potential: ψ in its unit in the solution, shape (modes, facets, points).
    """

    x: NDArray[np.float64]
    potential: NDArray[np.float64]

    def between(self, start: float, end: float) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """`POINTS` places from x = start to x = end, both of which are ends of facets, and ψ there."""
        middle = 0.5 * (self.x[:, 0] + self.x[:, -1])
        inside = (middle > start) & (middle < end)
        nodes, potential = self.x[inside], self.potential[:, inside]
        x: NDArray[np.float64] = np.linspace(start, end, POINTS, dtype=np.float64)
        facets = np.maximum(np.searchsorted(nodes[:, 0], x, side="right") - 1, 0)
        left, right = nodes[facets, 0], nodes[facets, -1]
        degree = nodes.shape[1] - 1
        basis = chebvander(2.0 * (x - left) / (right - left) - 1.0, degree) @ np.linalg.inv(
            chebvander(chebpts2(degree + 1), degree)
        )
        return x, np.einsum("mxk,xk->mx", potential[:, facets], basis)


def sample_liquid(
    liquid: LiquidSpace, functions: list[fem.Function], chosen: NDArray[np.int32] | None = None
) -> LiquidSample | None:
    """Evaluate ψ and ∇ψ on a subdivision of each cell, finer in larger cells."""
    mesh = liquid.tank.mesh
    if chosen is None:
        chosen = owned_cells(mesh)
    corners = cell_corners(mesh, chosen)
    size = np.sqrt(np.abs(np.linalg.det(corners[:, 1:] - corners[:, :1])))
    largest = mesh.comm.allreduce(size.max(initial=0.0), op=MPI.MAX)
    levels = np.select([size > 0.25 * largest, size > 0.05 * largest, size > 0.01 * largest], [10, 6, 4], 2)
    pieces = []
    for level in np.unique(levels):
        cells = chosen[levels == level]
        pieces.append(_sample_cells(liquid, functions, cells, int(level)))
    gathered = mesh.comm.gather(pieces, root=0)
    if gathered is None:
        return None
    return _merge([piece for process in gathered for piece in process])


def _sample_cells(liquid: LiquidSpace, functions: list[fem.Function], cells: np.ndarray, level: int) -> LiquidSample:
    reference, triangles = _subdivided_triangle(level)
    table = liquid.space.element.basix_element.tabulate(1, reference)[:, :, :, 0]
    dofs = liquid.space.dofmap.list[cells]
    points = cell_positions(liquid.tank.mesh, cells, reference)
    inverse = np.linalg.inv(cell_jacobians(liquid.tank.mesh, cells, reference))
    inverse = np.broadcast_to(inverse, (*points.shape[:2], *inverse.shape[2:]))
    potential = np.array([function.x.array[dofs] @ table[0].T for function in functions])
    reference_gradient = np.array(
        [np.stack([function.x.array[dofs] @ table[k].T for k in (1, 2)], axis=-1) for function in functions]
    )
    gradient = np.einsum("mcpj,cpji->mcpi", reference_gradient, inverse)
    connectivity = (np.arange(len(cells)) * len(reference))[:, None, None] + triangles[None]
    modes = len(functions)
    # No unknown is shared by two liquids: the first one of a cell determines its liquid.
    layers = liquid.layer_of[dofs[:, 0]].astype(np.int64)
    return LiquidSample(
        points=points.reshape(-1, 2),
        triangles=connectivity.reshape(-1, 3),
        liquid=np.repeat(1 + layers, len(triangles)),
        potential=potential.reshape(modes, -1),
        displacement=gradient.reshape(modes, -1, 2),
    )


def _merge(pieces: list[LiquidSample]) -> LiquidSample:
    offsets = np.cumsum([0, *(len(piece.points) for piece in pieces)])
    return LiquidSample(
        points=np.vstack([piece.points for piece in pieces]),
        triangles=np.vstack([piece.triangles + offset for piece, offset in zip(pieces, offsets[:-1], strict=True)]),
        liquid=np.concatenate([piece.liquid for piece in pieces]),
        potential=np.hstack([piece.potential for piece in pieces]),
        displacement=np.hstack([piece.displacement for piece in pieces]),
    )


def _subdivided_triangle(level: int) -> tuple[np.ndarray, np.ndarray]:
    """Points and triangles of the unit triangle cut into ``level``² equal parts."""
    index: dict[tuple[int, int], int] = {}
    points: list[tuple[float, float]] = []
    for j in range(level + 1):
        for i in range(level + 1 - j):
            index[i, j] = len(points)
            points.append((i / level, j / level))
    triangles = []
    for i, j in index:
        if i + j < level:
            triangles.append((index[i, j], index[i + 1, j], index[i, j + 1]))
        if i + j < level - 1:
            triangles.append((index[i + 1, j], index[i + 1, j + 1], index[i, j + 1]))
    return np.array(points), np.array(triangles)


def sample_surface(
    liquid: LiquidSpace, functions: list[fem.Function], name: str, layer: int = 0
) -> SurfaceTrace | None:
    """ψ along a named line."""
    count = liquid.degree + 1
    local = 0.5 * (1.0 + chebpts2(count))[:, None]
    x: list[np.ndarray] = [np.empty((0, count))]
    values: list[np.ndarray] = [np.empty((len(functions), 0, count))]
    for group in facet_groups(liquid, name, layer):
        reference = group.reference_points(local)
        basis = liquid.space.element.basix_element.tabulate(0, reference)[0, :, :, 0]
        dofs = liquid.space.dofmap.list[group.cells]
        x.append(group.physical_points(reference)[:, :, 0])
        values.append(np.array([function.x.array[dofs] @ basis.T for function in functions]))
    gathered = liquid.tank.mesh.comm.gather((np.concatenate(x), np.concatenate(values, axis=1)), root=0)
    if gathered is None:
        return None
    return _from_left_to_right(
        np.concatenate([part[0] for part in gathered]), np.concatenate([part[1] for part in gathered], axis=1)
    )


def _from_left_to_right(x: np.ndarray, potential: np.ndarray) -> SurfaceTrace:
    within = np.argsort(x, axis=1)
    x = np.take_along_axis(x, within, axis=1)
    potential = np.take_along_axis(potential, within[None], axis=2)
    order = np.argsort(x.mean(axis=1))
    return SurfaceTrace(x=x[order], potential=potential[:, order])
