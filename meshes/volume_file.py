"""Tanks of any shape from files: solids of CAD by OpenCASCADE, meshes by gmsh."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from functools import lru_cache
from math import inf
from pathlib import Path
from tempfile import TemporaryDirectory

import gmsh
import numpy as np

from hydroelastic.meshes.filling import gmsh_model
from hydroelastic.meshes.formats import FORMATS
from hydroelastic.meshes.geometry import FREE_SURFACE
from hydroelastic.meshes.tagged_mesh import MeshError
from hydroelastic.meshes.tetrahedra import VolumeMesh, checked, mesh_volume, read_gmsh
from hydroelastic.physics.level_tank import FilePlan

# A face at this height, in units of the tank, is of the still surface.
_LEVEL = 1e-6

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
    """Measure the still surface of a tank that a file describes.

    Args:
        file: it.
        fill: height of the still surface above the lowest point, m.

    Raises:
        MeshError: if it cannot be read, or does not hold what is needed.
    """
    return _file_plan(file, fill, file.stat().st_mtime_ns)


@lru_cache(maxsize=8)
def _file_plan(file: Path, fill: float, _changed: int) -> FilePlan:
    plan = FilePlan(file=file, fill=fill, length=1.0, middle=(0.0, 0.0), area=1.0)
    if file.suffix.lower() == ".msh":
        mesh = mesh_of_file(plan).noded
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
    return replace(plan, length=float(extent.max()), middle=(x, y), area=area)


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
    """Give the path of a copy of a file of data in a folder of its own: gmsh also runs what stands in FILE.opt.

    Raises:
        MeshError: if the file, by its first bytes, is not what its name says, or gmsh cannot read it.
    """
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


def solids_in(file: Path, metres: float) -> _Entities:
    """Read the solids of a file into the current model, in a unit of length.

    Raises:
        MeshError: if it cannot be read.
    """
    gmsh.option.setString("Geometry.OCCTargetUnit", "M")
    gmsh.option.setNumber("Geometry.OCCScaling", 1.0 / metres)
    try:
        with readable_by_gmsh(file) as copy:
            return [one for one in gmsh.model.occ.importShapes(copy) if one[0] == 3]
    finally:
        gmsh.option.setNumber("Geometry.OCCScaling", 1.0)


def solid_of_file(plan: FilePlan) -> _Entities:
    """Read a solid into the current model, fill it and move its still surface to z = 0.

    Raises:
        MeshError: if the file does not hold one solid, or the liquid falls into several.
    """
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
    """A mesh of gmsh with the group free_surface, of any degree."""
    with gmsh_model():
        with readable_by_gmsh(plan.file) as copy:
            gmsh.merge(copy)
        names = {gmsh.model.getPhysicalName(dim, tag): (dim, tag) for dim, tag in gmsh.model.getPhysicalGroups(2)}
        if FREE_SURFACE not in names:
            there = ", ".join(sorted(names)) or "none"
            raise MeshError(f'{plan.file} has no physical surface "{FREE_SURFACE}" (there are: {there})')
        degrees = {int(gmsh.model.mesh.getElementProperties(kind)[2]) for kind in gmsh.model.mesh.getElementTypes(3)}
        if len(degrees) != 1:
            raise MeshError(f"{plan.file} does not hold tetrahedra of one degree")
        faces = gmsh.model.getEntitiesForPhysicalGroup(*names[FREE_SURFACE])
        mesh = read_gmsh(degrees.pop(), {int(tag): FREE_SURFACE for tag in faces})
    points = mesh.points / plan.metres
    points[:, 2] -= points[mesh.facets, 2].mean()
    if np.abs(points[mesh.facets, 2]).max() > _LEVEL * np.ptp(points):
        raise MeshError(f'the surface "{FREE_SURFACE}" of {plan.file} is not level')
    mesh = checked(tips=True, mesh=replace(mesh, points=np.asarray(points, dtype=np.float64)))
    return VolumeMesh(noded=mesh, volume=mesh_volume(mesh))
