"""Tanks of any shape from files: solids of CAD by OpenCASCADE, meshes by gmsh."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from functools import lru_cache
from math import inf
from pathlib import Path
from tempfile import TemporaryDirectory

import gmsh
import numpy as np

from hydroelastic.meshes.cut_volume import cut_volume, with_regions
from hydroelastic.meshes.filling import gmsh_model
from hydroelastic.meshes.formats import FORMATS
from hydroelastic.meshes.geometry import BAFFLE, FREE_SURFACE
from hydroelastic.meshes.inner_walls import boundary_facets, require_declared_walls
from hydroelastic.meshes.tagged_mesh import FARTHEST, MeshError, NodedMesh
from hydroelastic.meshes.tetrahedra import FoldedError, VolumeMesh, checked, mesh_volume, read_gmsh
from hydroelastic.physics.level_tank import FilePlan

# A face at this height, in units of the tank, is of the still surface.
_LEVEL = 1e-6
# Six times the volume of a tetrahedron over the cube of its sides: less is rounding.
_FLAT = 1e-12

# What files are, and how they begin; gmsh runs what begins otherwise as a script.
_STEP = "a STEP file of CAD, ISO 10303-21", (b"ISO-10303-21;",)
_KINDS = {
    ".step": _STEP,
    ".stp": _STEP,
    ".brep": ("a BREP file of OpenCASCADE", (b"DBRep_DrawableShape", b"CASCADE Topology")),
    ".msh": (FORMATS[".msh"], (b"$MeshFormat", b"$Comments")),
}

_Entities = list[tuple[int, int]]


def file_plan(file: Path, fill: float) -> FilePlan:
    """Measure the still surface of a tank that a file describes."""
    return _file_plan(file, fill, file.stat().st_mtime_ns)


@lru_cache(maxsize=8)
def _file_plan(file: Path, fill: float, _changed: int) -> FilePlan:
    plan = FilePlan(file=file, fill=fill, length=1.0, middle=(0.0, 0.0), area=1.0)
    if file.suffix.lower() == ".msh":
        mesh, baffles = _mesh_in_metres(file, _changed)
        plan = replace(plan, fill=-float(mesh.points[:, 2].min()), baffles=baffles)
        surface = mesh.points[mesh.facets]
        sides = surface[:, 1:, :2] - surface[:, :1, :2]
        area = 0.5 * float(np.abs(np.linalg.det(sides)).sum())
        low, high = surface.reshape(-1, 3).min(axis=0), surface.reshape(-1, 3).max(axis=0)
    else:
        with gmsh_model():
            solid_of_file(plan)
            gmsh.model.occ.synchronize()
            low, high, area = np.full(3, inf), np.full(3, -inf), 0.0
            for _, tag in gmsh.model.getEntities(2):
                if lies_in_plane(tag, 2, 0.0):
                    box = np.array(gmsh.model.occ.getBoundingBox(2, tag)).reshape(2, 3)
                    low, high = np.minimum(low, box[0]), np.maximum(high, box[1])
                    area += gmsh.model.occ.getMass(2, tag)
        if not area:
            raise MeshError("the liquid has no still surface: its highest face is not level")
    extent = (high - low)[:2]
    x, y = map(float, 0.5 * (low + high)[:2])
    return replace(
        plan, length=float(extent.max()), size=(float(extent[0]), float(extent[1])), middle=(x, y), area=area
    )


def lies_in_plane(tag: int, axis: int, level: float) -> bool:
    """Return whether a face of the current model lies in a plane normal to an axis.

    Boxes around faces, which OpenCASCADE gives, may be larger than these.
    """
    return (
        gmsh.model.getType(2, tag) == "Plane"
        and abs(gmsh.model.occ.getCenterOfMass(2, tag)[axis] - level) < _LEVEL
        and abs(gmsh.model.getNormal(tag, [0.0, 0.0])[axis]) > 1.0 - _LEVEL
    )


@contextmanager
def readable_by_gmsh(file: Path) -> Iterator[str]:
    """Give the path of a copy of a file of data in a folder of its own: gmsh also runs what stands in FILE.opt."""
    try:
        content = file.read_bytes().lstrip()
    except OSError as error:
        raise MeshError(f"{file} cannot be read: {error.strerror}") from error
    suffix = file.suffix.lower()
    kind, beginnings = _KINDS[suffix]
    broken = f"{file} cannot be read: it is broken, or not {kind}"
    if not content.startswith(beginnings):
        raise MeshError(broken)
    with TemporaryDirectory(prefix="hydroelastic_") as folder:
        copy = Path(folder, f"copy{suffix}")
        copy.write_bytes(content)
        try:
            yield str(copy)
        except Exception as error:  # gmsh raises bare Exception
            raise MeshError(broken) from error


# In OpenCASCADE a broken file may end the process: one that is read for the first time is read in another one before.
_READ = (
    "import gmsh, sys; gmsh.initialize(readConfigFiles=False, interruptible=False); "
    "gmsh.model.occ.importShapes(sys.argv[1]); gmsh.model.occ.synchronize()"
)
_READ_BEFORE: set[bytes] = set()


def solids_in(file: Path, metres: float) -> _Entities:
    """Read the solids of a file into the current model, in a unit of length."""
    gmsh.option.setString("Geometry.OCCTargetUnit", "M")
    gmsh.option.setNumber("Geometry.OCCScaling", 1.0 / metres)
    try:
        with readable_by_gmsh(file) as copy:
            content = Path(copy).read_bytes()
            if content not in _READ_BEFORE:
                subprocess.run(
                    [sys.executable, "-c", _READ, copy], check=True, capture_output=True, cwd=Path(copy).parent
                )
                _READ_BEFORE.add(content)
            return [one for one in gmsh.model.occ.importShapes(copy) if one[0] == 3]
    finally:
        gmsh.option.setNumber("Geometry.OCCScaling", 1.0)


def solid_of_file(plan: FilePlan) -> _Entities:
    """Read a solid into the current model, fill it and move its still surface to z = 0."""
    occ = gmsh.model.occ
    # Unlike a later dilation this keeps cones cones.
    solids = solids_in(plan.file, plan.metres)
    if len(solids) != 1:
        raise MeshError(f"{plan.file} holds {len(solids)} solids; the inside of the tank is one")
    left, front, low, right, back, high = occ.getBoundingBox(*solids[0])
    # The box around a solid is a little larger than it.
    low, high = _extremes(solids, low, high)
    level = low + plan.fill
    if level < high * (1.0 - 1e-9) + 1e-9 * low:
        pad = right - left + back - front
        box = (
            left - pad,
            front - pad,
            low - pad,
            right - left + 2.0 * pad,
            back - front + 2.0 * pad,
            level - low + pad,
        )
        solids = [one for one in occ.intersect(solids, [(3, occ.addBox(*box))])[0] if one[0] == 3]
        if len(solids) != 1:
            raise MeshError(f"at this depth the liquid in {plan.file} falls into {len(solids)} parts")
    elif level > high + 1e-6 * (high - low):
        raise MeshError(f"{plan.file} is {high - low:g} high, less than the depth {plan.fill:g}")
    occ.translate(solids, 0.0, 0.0, -level)
    return solids


def _extremes(solids: _Entities, low: float, high: float) -> tuple[float, float]:
    """Least and largest z of points of a solid, within the box around it."""
    gmsh.model.occ.synchronize()
    heights = [gmsh.model.getValue(0, tag, [])[2] for _, tag in gmsh.model.getBoundary(solids, recursive=True)]
    slack = 1e-5 * (high - low)
    return (
        min(heights) if heights and min(heights) < low + slack else low,
        max(heights) if heights and max(heights) > high - slack else high,
    )


def mesh_of_file(plan: FilePlan) -> VolumeMesh:
    """A mesh of gmsh with the group free_surface, of any degree, in the unit of a plan."""
    mesh, _ = _mesh_in_metres(plan.file, plan.file.stat().st_mtime_ns)
    scaled = replace(mesh, points=np.asarray(mesh.points / plan.metres, dtype=np.float64))
    return VolumeMesh(noded=scaled, volume=mesh_volume(scaled))


@lru_cache(maxsize=1)
def _mesh_in_metres(file: Path, _changed: int) -> tuple[NodedMesh, float]:
    """Read a mesh, with its still surface at z = 0, and the area of its declared walls, m²."""
    with gmsh_model():
        with readable_by_gmsh(file) as copy:
            gmsh.merge(copy)
        mesh = _tetrahedra(file)
    surface = mesh.facets[mesh.facet_tags == mesh.facet_names[FREE_SURFACE]]
    if not len(surface):
        raise MeshError(f'the surface "{FREE_SURFACE}" of {file} holds no triangles')
    outer = np.sort(boundary_facets(mesh.cells[:, :4])[0], axis=1)
    if len(np.unique(np.vstack([outer, np.sort(surface, axis=1)]), axis=0)) > len(outer):
        raise MeshError(f'faces of the surface "{FREE_SURFACE}" of {file} are not on the boundary of its tetrahedra')
    mesh.points[:, 2] -= mesh.points[surface, 2].mean()
    if np.abs(mesh.points[surface, 2]).max() > _LEVEL * np.ptp(mesh.points):
        raise MeshError(f'the surface "{FREE_SURFACE}" of {file} is not level')
    try:
        mesh, _ = checked(mesh)
    except FoldedError as error:
        raise MeshError(f"{file} holds a curved cell that is inverted") from error
    declared = mesh.facets[mesh.facet_tags == mesh.facet_names.get(BAFFLE, -1)]
    opened = cut_volume(mesh, (BAFFLE,), ()) if len(declared) else mesh
    area = require_declared_walls(opened.points, opened.cells[:, :4], declared, str(file))
    return with_regions(opened), area


def _tetrahedra(file: Path) -> NodedMesh:
    """The tetrahedra of the current model, with the faces of named groups; m."""
    kinds = [gmsh.model.mesh.getElementProperties(kind) for kind in gmsh.model.mesh.getElementTypes(3)]
    if not kinds:
        raise MeshError(f"{file} holds no tetrahedra")
    others = sorted({name.split()[0].lower() for name, *_ in kinds if not name.startswith("Tetrahedron")})
    if others:
        raise MeshError(f"{file} holds cells of other kinds ({', '.join(others)}); only tetrahedra are read")
    if len(kinds) > 1:
        raise MeshError(f"{file} holds tetrahedra of several degrees; only those of one are read")
    names = {gmsh.model.getPhysicalName(dim, tag): (dim, tag) for dim, tag in gmsh.model.getPhysicalGroups(2)}
    if FREE_SURFACE not in names:
        there = ", ".join(sorted(names)) or "none"
        raise MeshError(f'{file} has no physical surface "{FREE_SURFACE}" (there are: {there})')
    groups = [name for name in (FREE_SURFACE, BAFFLE) if name in names]
    faces = {int(tag): name for name in groups for tag in gmsh.model.getEntitiesForPhysicalGroup(*names[name])}
    mesh = read_gmsh(kinds[0][2], faces)
    if not (np.abs(mesh.points) < FARTHEST).all():
        raise MeshError(f"{file} holds a node whose coordinates are not finite, or beyond {FARTHEST:g} m")
    corners = mesh.points[mesh.cells[:, :4]]
    sides = corners[:, 1:] - corners[:, :1]
    flat = np.abs(np.linalg.det(sides)) <= _FLAT * np.linalg.norm(sides, axis=2).max(axis=1) ** 3
    if flat.any():
        x, y, z = corners[flat.argmax()].mean(axis=0)
        raise MeshError(f"{file} holds a tetrahedron without volume near ({x:g}, {y:g}, {z:g})")
    return mesh
