"""Hulls of floats from files: solids of CAD by OpenCASCADE, and triangles; how deep they float."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from functools import lru_cache
from pathlib import Path

import basix.ufl
import gmsh
import numpy as np
import ufl
from dolfinx import geometry
from dolfinx.mesh import create_mesh
from mpi4py import MPI
from numpy.typing import NDArray
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

from hydroelastic.meshes.filling import gmsh_model
from hydroelastic.meshes.tagged_mesh import FARTHEST, MeshError
from hydroelastic.meshes.volume_file import lies_in_plane, solids_in
from hydroelastic.physics.arrays import FloatArray
from hydroelastic.physics.wetted_hulls import (
    Hydrostatics,
    OpenSurfaceError,
    Triangles,
    WettedHull,
    hydrostatics_of_surface,
)

_Entities = list[tuple[int, int]]

# Part of the height to which the still level of a mass is found.
_LEVEL = 1e-7
_MOST_STEPS = 40
# Part of the volume by which a hull may differ from its mirror image.
_SAME = 1e-6
# Triangles on CAD: around a full circle, their degree, and the smallest ones in units of the extent.
_AROUND, _DEGREE, _SMALLEST = 16, 4, 0.02
# Part of the waterplane that the sum of all areas may differ from zero.
_CLOSED = 1e-4
# A triangle of a binary STL file: its normal, its corners, and two bytes that mean nothing.
_BINARY_TRIANGLE = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("unused", "<u2")])
# Part of the extent: corners this close are one; binary files hold single precision.
_SAME_PLACE = 1e-6
# Part of the extent: triangles this close to the still level lie in it, as in `Triangles.below`; and part of the height
# by which another level is above them.
_IN_LEVEL, _JUST_ABOVE = 1e-7, 1e-4


def wetted_hull(file: Path, *, draught: float | None = None, volume: float | None = None) -> WettedHull:
    """Measure the wetted part of a hull."""
    return _wetted_hull(file, draught, volume, file.stat().st_mtime_ns)


@lru_cache(maxsize=16)
def _wetted_hull(file: Path, draught: float | None, volume: float | None, _changed: int) -> WettedHull:
    low, high = extent(file)
    level = low + draught if draught is not None else 0.0
    if volume is not None:
        level = _level_of(file, volume, low, high)
    if not low < level <= high + 1e-9 * (high - low):
        raise MeshError(
            f"the still level, z = {level:g} m of {file}, is not between its lowest and highest point, z = {low:g} m "
            f"and {high:g} m; its lengths are taken in metres"
        )
    found, corners = hydrostatics_at(file, level)
    if file.suffix.lower() == ".stl":
        crossing = crossing_place(wetted_triangles(file, level))
        if crossing is not None:
            x, y, z = crossing
            where = f"near x = {x:.4g}, y = {y:.4g} m, {-z:.4g} m below the level"
            raise MeshError(f"the surface in {file} crosses itself {where}: join its parts to one surface")
    least, most = ((float(place[0]), float(place[1]), float(place[2])) for place in corners)
    return WettedHull(
        file=file,
        level=level,
        low=least,
        high=most,
        hydrostatics=found,
        symmetric=(False, False) if file.suffix.lower() == ".stl" else _symmetries(file, level, found.axis),
        waterplane_above=_waterplane_above(file, level) if _has_face_in(file, level) else None,
    )


def _has_face_in(file: Path, level: float) -> bool:
    """Whether a face of a hull lies in the still level, as a ledge or a deck does."""
    if file.suffix.lower() == ".stl":
        triangles = triangles_of(file, file.stat().st_mtime_ns)
        heights = triangles.points[triangles.corners][:, :, 2] - level
        return bool((np.abs(heights) < _IN_LEVEL * np.ptp(triangles.points, axis=0).max()).all(axis=1).any())
    with _solid(file) as solid:
        gmsh.model.occ.synchronize()
        return any(lies_in_plane(tag, 2, level) for _, tag in gmsh.model.getBoundary(solid, oriented=False))


def _waterplane_above(file: Path, level: float) -> float:
    low, high = extent(file)
    above = level + _JUST_ABOVE * (high - low)
    return hydrostatics_at(file, above)[0].waterplane if above < high else 0.0


def _symmetries(file: Path, level: float, middle: tuple[float, float]) -> tuple[bool, bool]:
    """Whether a solid is its own mirror image in planes normal to x and to y through its middle."""
    found = []
    for axis in (0, 1):
        try:
            with _solid(file) as solid:
                occ, wetted = gmsh.model.occ, immersed(solid, level)
                image = occ.copy(wetted)
                occ.mirror(image, 1.0 - axis, float(axis), 0.0, -middle[axis])
                volume = sum(occ.getMass(*one) for one in wetted)
                left = [one for one in occ.cut(image, wetted)[0] if one[0] == 3]
                found.append(sum(occ.getMass(*one) for one in left) < _SAME * volume)
        except MeshError:
            # Coinciding free-form faces may be too much for OpenCASCADE.
            found.append(False)
    return found[0], found[1]


def _level_of(file: Path, volume: float, low: float, high: float) -> float:
    """The level below which a hull has a volume, by Newton's method: the waterplane is the slope of the volume."""
    level = 0.5 * (low + high)
    for _ in range(_MOST_STEPS):
        if not low + _LEVEL * (high - low) < level < high - _LEVEL * (high - low):
            break
        found, _ = hydrostatics_at(file, level)
        step = (volume - found.volume) / found.waterplane
        least, most = low + 0.1 * (level - low), high - 0.1 * (high - level)
        level = min(max(level + step, least), most)
        if abs(step) < _LEVEL * (high - low):
            return level
    raise MeshError(
        f"{file} displaces {volume:g} m³ at no level between its lowest and highest point, z = {low:g} m and "
        f"{high:g} m; its lengths are taken in metres"
    )


def extent(file: Path) -> tuple[float, float]:
    """Return the least and the largest z of a hull, m."""
    if file.suffix.lower() == ".stl":
        heights = triangles_of(file, file.stat().st_mtime_ns).points[:, 2]
        return float(heights.min()), float(heights.max())
    with _solid(file) as solid:
        box = gmsh.model.occ.getBoundingBox(*solid[0])
        return box[2], box[5]


@lru_cache(maxsize=8)
def triangles_of(file: Path, _changed: int) -> Triangles:
    """Return the triangles of a file, m; corners at one place are one."""
    every, corners = np.unique(_corners_of_triangles(file), axis=0, return_inverse=True)
    pairs = cKDTree(every).query_pairs(_SAME_PLACE * np.ptp(every, axis=0).max(), output_type="ndarray")
    links = coo_array((np.ones(len(pairs)), (pairs[:, 0], pairs[:, 1])), shape=(len(every), len(every)))
    _, part = connected_components(links, directed=False)
    _, first, numbers = np.unique(part, return_index=True, return_inverse=True)
    triangles = numbers.ravel()[corners.reshape(-1, 3)]
    distinct = (triangles != np.roll(triangles, 1, axis=1)).all(axis=1)
    return Triangles(points=every[first], corners=triangles[distinct])


def _corners_of_triangles(file: Path) -> NDArray[np.float64]:
    """Read an STL file: three corners for each triangle, m, shape (3 triangles, 3)."""
    try:
        content = file.read_bytes()
        count = int.from_bytes(content[80:84], "little")
        # Binary files may begin with "solid" as well.
        if content.lstrip()[:5].lower() == b"solid" and len(content) != 84 + count * _BINARY_TRIANGLE.itemsize:
            lines = [line.split() for line in content.decode("latin-1").lower().splitlines()]
            corners = np.array([line[1:] for line in lines if line[:1] == ["vertex"]], dtype=np.float64)
        else:
            corners = np.frombuffer(content, _BINARY_TRIANGLE, count, offset=84)["corners"].astype(np.float64)
        triangles = corners.reshape(-1, 3, 3)
    except (OSError, ValueError) as error:
        raise MeshError(f"{file} cannot be read: it is broken, or not an STL file, of text or binary") from error
    if not len(triangles):
        raise MeshError(f"{file} holds no triangles")
    are_places = (np.abs(triangles) < FARTHEST).all(axis=(1, 2))
    if not are_places.all():
        raise MeshError(
            f"triangle {1 + are_places.argmin()} in {file} has a corner whose coordinates are not finite, or beyond "
            f"{FARTHEST:g} m"
        )
    return triangles.reshape(-1, 3)


def wetted_triangles(file: Path, level: float) -> Triangles:
    """Return those below a level, which becomes z = 0."""
    wetted = triangles_of(file, file.stat().st_mtime_ns).below(level)
    try:
        wetted.require_closed()
    except OpenSurfaceError as error:
        raise MeshError(f"the surface in {file} {error}") from error
    return wetted


def hydrostatics_at(file: Path, level: float) -> tuple[Hydrostatics, np.ndarray]:
    """Return the hydrostatics of a hull immersed to a level, and the extremes of its wetted part, shape (2, 3)."""
    if file.suffix.lower() == ".stl":
        wetted = wetted_triangles(file, level)
        return wetted.hydrostatics(), np.array([wetted.points.min(axis=0), wetted.points.max(axis=0)])
    with _solid(file) as solid:
        return _of_solid(immersed(solid, level))


@contextmanager
def _solid(file: Path) -> Iterator[_Entities]:
    with gmsh_model():
        yield hull_solid(file, 1.0)


def hull_solid(file: Path, metres: float) -> _Entities:
    """Read the one solid of a file into the current model, in a unit of length."""
    solids = solids_in(file, metres)
    if len(solids) != 1:
        raise MeshError(f"{file} holds {len(solids)} solids; a hull is one")
    return solids


def immersed(solid: _Entities, level: float) -> _Entities:
    """Return the part of a solid below a level of its file, which becomes z = 0."""
    occ = gmsh.model.occ
    left, front, low, right, back, _ = occ.getBoundingBox(*solid[0])
    pad = right - left + back - front
    box = occ.addBox(
        left - pad, front - pad, low - pad, right - left + 2 * pad, back - front + 2 * pad, level - low + pad
    )
    below = [one for one in occ.intersect(solid, [(3, box)])[0] if one[0] == 3]
    if not below:
        raise MeshError("nothing of the hull is below the still level")
    occ.translate(below, 0.0, 0.0, -level)
    return below


def _of_solid(wetted: _Entities) -> tuple[Hydrostatics, np.ndarray]:
    """By the divergence theorem over curved triangles: the masses that OpenCASCADE states of free-form faces have three
    digits."""
    occ, mesh = gmsh.model.occ, gmsh.model.mesh
    occ.synchronize()
    box = occ.getBoundingBox(*wetted[0])
    gmsh.option.setNumber("Mesh.MeshSizeFromCurvature", _AROUND)
    gmsh.option.setNumber("Mesh.MeshSizeMin", _SMALLEST * (box[3] - box[0] + box[4] - box[1]))
    gmsh.option.setNumber("Mesh.MeshSizeExtendFromBoundary", 0)
    mesh.generate(2)
    mesh.setOrder(_DEGREE)
    kind = mesh.getElementType("triangle", _DEGREE)
    local, weights = mesh.getIntegrationPoints(kind, f"Gauss{3 * _DEGREE}")
    points, areas, lid = [], [], np.zeros(3)
    for _, tag in gmsh.model.getBoundary(wetted, oriented=False):
        frames, _, places = mesh.getJacobians(kind, local, tag)
        along = frames.reshape(-1, len(weights), 3, 3)
        own = (weights[:, None] * np.cross(along[:, :, 0], along[:, :, 1])).reshape(-1, 3)
        if lies_in_plane(tag, 2, 0.0):
            lid += own.sum(axis=0)
        else:
            points.append(places.reshape(-1, 3))
            areas.append(own)
    if not lid.any():
        raise MeshError("the hull does not rise to the still level")
    every = np.concatenate(areas)
    if np.abs(every.sum(axis=0) + lid).max() > _CLOSED * np.abs(lid).max():
        raise MeshError("the faces of the hull do not close it")
    at = np.concatenate(points)
    return hydrostatics_of_surface(at, np.sign(lid[2]) * every), np.array([at.min(axis=0), at.max(axis=0)])


def crossing_place(surface: Triangles) -> FloatArray | None:
    """Return a place near which one side of a triangle passes through another triangle, shape (3,); ``None`` if none
    does. Triangles with a common corner are not looked at."""
    element = basix.ufl.element("Lagrange", "triangle", 1, shape=(3,))
    mesh = create_mesh(MPI.COMM_SELF, cells=surface.corners, x=surface.points, e=ufl.Mesh(element))
    mesh.topology.create_entities(1)
    tree = geometry.bb_tree(mesh, 2)
    boxes = np.asarray(geometry.compute_collisions_trees(tree, tree)).reshape(-1, 2)
    pairs = mesh.topology.original_cell_index[boxes]
    own, other = surface.corners[pairs[:, 0]], surface.corners[pairs[:, 1]]
    apart = ~(own[:, :, None] == other[:, None, :]).any(axis=(1, 2))
    own, other = own[apart], other[apart]
    one, two, three = (surface.points[other[:, corner]] for corner in range(3))
    for corner in range(3):
        start, end = surface.points[own[:, corner]], surface.points[own[:, (corner + 1) % 3]]
        through = _volumes(one, two, three, start) * _volumes(one, two, three, end) < 0.0
        around = [_volumes(start, end, *pair) > 0.0 for pair in ((one, two), (two, three), (three, one))]
        found = np.flatnonzero(through & np.isin(np.sum(around, axis=0), (0, 3)))
        if len(found):
            place: FloatArray = 0.5 * (start[found[0]] + end[found[0]])
            return place
    return None


def _volumes(one: FloatArray, two: FloatArray, three: FloatArray, four: FloatArray) -> FloatArray:
    """Six times the volumes of tetrahedra with their signs, corners of shape (n, 3) → (n,)."""
    volumes: FloatArray = np.einsum("na,na->n", np.cross(two - one, three - one), four - one)
    return volumes
