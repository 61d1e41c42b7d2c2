"""Modes of a volume as plain arrays: displacement of the still surface on rank 0, ψ in the liquid on all processes."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import basix
import numpy as np
from dolfinx import fem
from numpy.typing import NDArray

from hydroelastic.fem.cells import owned_cells
from hydroelastic.fem.facets import facet_groups
from hydroelastic.fem.level_bed.solution import LevelMode
from hydroelastic.fem.liquid import as_functions
from hydroelastic.fem.shape_loads import potential_basis
from hydroelastic.fem.volume.problem import VolumeProblem
from hydroelastic.meshes.geometry import FREE_SURFACE
from hydroelastic.physics.arrays import FloatArray

# Parts of a facet's edges.
_PARTS = 3
# Points this close, in units of the tank, are one.
_SAME = 1e-9
# Part of the largest value of a mode.
_SAME_VALUE = 1e-6
# Points on the surface of pictures; where there are more, those close to each other become one.
_MOST_POINTS = 200_000
# Nodes of VTK's quadratic tetrahedron among those of dolfinx.
_OF_VTK = [0, 1, 2, 3, 9, 6, 8, 7, 5, 4]
# Nodes of a mirror image in the order of a cell that is not turned: of triangles and of these tetrahedra.
_TURNED = {3: [1, 0, 2], 10: [1, 0, 2, 3, 4, 6, 5, 8, 7, 9]}


@dataclass(frozen=True, kw_only=True)
class SurfaceSample:
    """Modes on the still surface, dimensionless; plates and water have points of their own at edges.

    Attributes:
        points: x and y, shape (points, 2).
        triangles: numbers of their corners, shape (triangles, 3).
        plate_of_points: number of the plate at each point, from 1; 0 is water.
        plate_of_triangles: the same of each triangle.
        elevations: upward displacement in each mode, shape (modes, points).
    """

    points: FloatArray
    triangles: NDArray[np.int64]
    plate_of_points: NDArray[np.int32]
    plate_of_triangles: NDArray[np.int32]
    elevations: FloatArray


def surface_sample(modes: tuple[LevelMode, ...], names: tuple[str, ...]) -> SurfaceSample | None:
    """Sample modes on the still surface; ``None`` on other ranks than 0 (collective)."""
    model = problem_of(modes[0]).model
    liquid = model.liquid
    functions = as_functions(liquid, [one.mode.potential for one in modes])
    local = basix.create_lattice(basix.CellType.triangle, _PARTS, basix.LatticeType.equispaced, True)
    triangles = _lattice_triangles()
    parts = []
    for number, name in enumerate((FREE_SURFACE, *names)):
        places: list[FloatArray] = [np.empty((0, 3))]
        values: list[FloatArray] = [np.empty((len(modes), 0))]
        for group in facet_groups(liquid, name) if name in liquid.tank.facet_names else ():
            reference = group.reference_points(local)
            points = group.physical_points(reference).reshape(-1, 3)
            places.append(points)
            if number:
                values.append(_deflections(modes, name, points))
            else:
                # On the water gη = ω²ψ.
                table, dofs = potential_basis(liquid, reference), liquid.space.dofmap.list[group.cells]
                values.append(
                    np.array(
                        [
                            one.mode.eigenvalue
                            * (function.x.array[dofs] @ table.T).ravel()
                            * any(surface.surface == FREE_SURFACE for surface in one.problem.pencil.surfaces)
                            for one, function in zip(modes, functions, strict=True)
                        ]
                    )
                )
        parts.append((number, np.concatenate(places), np.concatenate(values, axis=1)))
    comm = liquid.tank.mesh.comm
    count = comm.allreduce(sum(len(at) for _, at, _ in parts))
    pitch = _SAME if count <= _MOST_POINTS else float(np.sqrt(model.tank.plan.area / model.images / _MOST_POINTS))
    divided = bool(model.tank.baffles)
    gathered = comm.gather([_thinned(*part, triangles, pitch, divided) for part in parts if len(part[1])], root=0)
    if gathered is None:
        return None
    corners, owners, every, elevations = [], [], [], []
    first = 0
    for number, at, moved, own in (part for process in gathered for part in process):
        corners.append(first + own)
        every.append(at)
        elevations.append(moved)
        owners.append((number, len(at), len(own)))
        first += len(at)
    plate_of_points = np.repeat(*np.array([(number, count) for number, count, _ in owners]).T).astype(np.int32)
    plate_of_triangles = np.repeat(*np.array([(number, count) for number, _, count in owners]).T).astype(np.int32)
    joined, shown, triangles = _mirrored(modes, np.concatenate(every), np.concatenate(elevations, axis=1), corners)
    images = len(joined) // len(plate_of_points)
    return SurfaceSample(
        points=joined,
        triangles=triangles,
        plate_of_points=np.tile(plate_of_points, images),
        plate_of_triangles=np.tile(plate_of_triangles, images),
        elevations=shown,
    )


def _thinned(
    number: int, points: FloatArray, values: FloatArray, triangles: NDArray[np.int64], pitch: float, divided: bool
) -> tuple[int, FloatArray, FloatArray, NDArray[np.int64]]:
    """Of lattices on facets the points, values and triangles that are left where points closer than a pitch are one.

    On both sides of a baffle, where the water is divided, points stay two.
    """
    kept, numbers = _merged(points, pitch, values if divided else None)
    corners = numbers.reshape(-1, triangles.max() + 1)[:, triangles].reshape(-1, 3)
    distinct = (corners != np.roll(corners, 1, axis=1)).all(axis=1)
    return number, points[kept, :2], values[:, kept], corners[distinct]


def problem_of(mode: LevelMode) -> VolumeProblem:
    """Return the problem of a mode of a volume."""
    assert isinstance(mode.problem, VolumeProblem)
    return mode.problem


def _mirrored(
    modes: tuple[LevelMode, ...], points: FloatArray, values: FloatArray, cells: list[NDArray[np.int64]]
) -> tuple[FloatArray, FloatArray, NDArray[np.int64]]:
    """Points (n, dim), values of each mode (modes, n) and cells, with all their mirror images."""
    joined = np.concatenate(cells)
    for axis, mirror in enumerate(problem_of(modes[0]).model.mirrors):
        if mirror is not None:
            image = points.copy()
            image[:, axis] = 2.0 * mirror - image[:, axis]
            odd = np.array([problem_of(one).symmetry_class.parity[axis] == 1 for one in modes])
            joined = np.concatenate([joined, joined[:, _TURNED[joined.shape[1]]] + len(points)])
            points = np.concatenate([points, image])
            values = np.concatenate([values, np.where(odd, -1.0, 1.0)[:, None] * values], axis=1)
    return points, values, joined


def _deflections(modes: tuple[LevelMode, ...], name: str, points: FloatArray) -> FloatArray:
    values = []
    for one in modes:
        problem = problem_of(one)
        plates = problem.model.plates[problem.symmetry_class.parity]
        sizes = np.cumsum([0, *(plate.body.size for plate in plates)])
        ((plate, (start, end)),) = [
            (plate, ends) for plate, ends in zip(plates, pairwise(sizes), strict=True) if plate.body.surface == name
        ]
        values.append(
            one.mode.body_amplitudes[start:end] @ plate.deflection(np.asarray(points[:, :2].T, dtype=np.float64))
        )
    return np.array(values, dtype=np.float64)


def volume_sample(modes: tuple[LevelMode, ...]) -> tuple[FloatArray, NDArray[np.int64], FloatArray]:
    """Return the part of each process: points (n, 3), quadratic tetrahedra (cells, 10), ψ of each mode (modes, n).

    Nothing is gathered (collective).
    """
    liquid = problem_of(modes[0]).model.liquid
    mesh = liquid.tank.mesh
    quadratic = fem.functionspace(mesh, ("Lagrange", 2))
    used, cells = np.unique(quadratic.dofmap.list[: len(owned_cells(mesh))][:, _OF_VTK], return_inverse=True)
    nodes, values = fem.Function(quadratic), []
    for function in as_functions(liquid, [one.mode.potential for one in modes]):
        nodes.interpolate(function)
        values.append(nodes.x.array[used])
    points = quadratic.tabulate_dof_coordinates()[used]
    every, shown, joined = _mirrored(
        modes, points, np.array(values).reshape(len(modes), len(used)), [cells.reshape(-1, len(_OF_VTK))]
    )
    return every, joined, shown


def _merged(points: FloatArray, pitch: float, values: FloatArray | None) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """The first of each set of points in one cell of a lattice, and the number of each point among them."""
    keys = points / pitch
    if values is not None:
        largest = np.abs(values).max(axis=1, keepdims=True) + np.finfo(float).tiny
        keys = np.column_stack([keys, (values / (_SAME_VALUE * largest)).T])
    _, kept, numbers = np.unique(np.round(keys), axis=0, return_index=True, return_inverse=True)
    return kept, numbers.ravel()


def _lattice_triangles() -> NDArray[np.int64]:
    """The small triangles of a lattice on a triangle, whose rows run along its first edge."""
    starts = np.cumsum([0, *range(_PARTS + 1, 0, -1)])
    upright = [(starts[j] + i, starts[j] + i + 1, starts[j + 1] + i) for j in range(_PARTS) for i in range(_PARTS - j)]
    turned = [
        (starts[j] + i + 1, starts[j + 1] + i + 1, starts[j + 1] + i)
        for j in range(_PARTS)
        for i in range(_PARTS - j - 1)
    ]
    return np.array(upright + turned)
