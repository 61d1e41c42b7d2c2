"""Volumes of tanks: shape-regular tetrahedra, graded alike in all directions towards the edges of plates.

Anisotropic layers, which cost nothing on a plan, ruin multigrid in a volume. Cells at curved walls and beds are of the
geometry's degree. A smooth bed through points moves the nodes of a tank with a level bed vertically.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from math import atan, hypot, pi

import gmsh
import numpy as np
from scipy.interpolate import RBFInterpolator

from hydroelastic.meshes.filling import gmsh_model
from hydroelastic.meshes.geometry import FREE_SURFACE
from hydroelastic.meshes.interrupts import interrupts_deferred
from hydroelastic.meshes.plan_loops import Mirrors
from hydroelastic.meshes.refinement import APART
from hydroelastic.meshes.surfaces import Surface, circle_of, surface_of
from hydroelastic.meshes.tagged_mesh import MeshError
from hydroelastic.meshes.tetrahedra import VolumeMesh, checked, mesh_integral, read_gmsh
from hydroelastic.meshes.volume_file import lies_in_plane, mesh_of_file, solid_of_file
from hydroelastic.physics.arrays import FloatArray
from hydroelastic.physics.dofs import body_name, body_number
from hydroelastic.physics.level_tank import Box, Cylinder, FilePlan
from hydroelastic.physics.plate import Disc, Outline, Polygon, Rectangle, Strip
from hydroelastic.physics.solid_floats import SolidFloat
from hydroelastic.physics.volume_tank import SlopingBed, SurveyedBed, VolumeTank

MIRRORS = ("mirror_x", "mirror_y")
"""Names of the planes of symmetry, by the axis that is normal to them."""

# Growth of the size of cells per distance from an edge.
_GROWTH = 0.6
# Points of a curve from which distances are measured.
_SAMPLES = 200
# A face at this height, in units of the tank, is of the still surface.
# Smallest part of the bulk size that the curvature of a wall asks for.
_LEAST_CURVED = 0.2
_LEVEL = 1e-7
# Cells around a curved wall that is refined later; of 8 around a sphere some were inverted, of 12 none.
_FEWEST_AROUND = 12
# Points this close to a float, in units of the tank, are on it.
_ON_FLOAT = 1e-7
# By so much boxes around edges are larger than these.
_BOXES = 1e-6


@dataclass(frozen=True, kw_only=True)
class VolumeSizes:
    """Sizes of cells, in units of the tank.

    Attributes:
        edge: at the edges of plates.
        bulk: elsewhere.
        geometry: degree of the geometry of curved cells.
        around: least number of cells around a curved wall.
        refinements: how often straight cells of gmsh are to be divided into eight on all processes, which have these
            sizes then; see `meshes.refinement`.
    """

    edge: float
    bulk: float
    geometry: int
    around: int = 16
    refinements: int = 0

    @property
    def coarse(self) -> VolumeSizes:
        """Those of gmsh's cells."""
        times = 2**self.refinements
        around = max(self.around // times, _FEWEST_AROUND)
        return replace(self, edge=times * self.edge, bulk=times * self.bulk, around=around)


def volume_mesh(tank: VolumeTank, sizes: VolumeSizes, mirrors: Mirrors = (None, None)) -> VolumeMesh:
    """Mesh a dimensionless tank, on the calling process only.

    Args:
        tank: the tank.
        sizes: of the cells.
        mirrors: x and y of planes of symmetry, below which nothing is meshed.

    Raises:
        FoldedError: if a cell is inverted.
        MeshError: if gmsh fails, or if the file's groups do not fit.
    """
    if isinstance(tank.plan, FilePlan) and tank.plan.file.suffix.lower() == ".msh":
        return mesh_of_file(tank.plan)
    bed = depth_over(tank)
    with gmsh_model():
        occ = gmsh.model.occ
        solid = _liquid(tank)
        if tank.floats:
            solid = occ.cut(solid, [one for float_ in tank.floats for one in _float_solid(float_)])[0]
        solid = _kept(solid, tank, mirrors)
        plates = [_face(plate.outline) for plate in tank.plates]
        plates = [_kept(plate, tank, mirrors) for plate in plates]
        flat = [one for plate in plates for one in plate]
        parts = occ.fragment(solid, flat)[1] if flat else []
        occ.synchronize()
        if len(gmsh.model.getEntities(3)) != 1:
            raise MeshError("the bed divides the liquid")
        (liquid,) = gmsh.model.getEntities(3)
        owners = _owners(plates, parts[len(solid) :])
        faces = {tag: _name(tank, tag, owners, mirrors) for _, tag in gmsh.model.getBoundary([liquid], oriented=False)}
        _require_covered(tank, owners, faces, 2 ** sum(mirror is not None for mirror in mirrors))
        volume = occ.getMass(*liquid)
        edges, curved = _singular_edges(tank, faces, mirrors), _is_curved(tank)
        surfaces: dict[tuple[str, ...], Surface] = {}
        if sizes.refinements:
            apart = {tag: f"{name}{APART}{tag}" for tag, name in faces.items()}
            surfaces = _surfaces(apart)
            sizes, faces = (sizes.coarse, apart) if surfaces else (replace(sizes, refinements=0), faces)
        _set_sizes(tank, sizes, edges)
        with interrupts_deferred():
            gmsh.model.mesh.generate(3)
            degree = sizes.geometry if curved and not sizes.refinements else 1
            if degree > 1:
                gmsh.model.mesh.setOrder(degree)
        mesh = read_gmsh(degree, {tag: name for tag, name in faces.items() if name})
    if sizes.refinements:
        return VolumeMesh(noded=mesh, volume=volume, surfaces=surfaces, curved=curved)
    if isinstance(tank.bed, SurveyedBed):
        stretched = mesh_integral(mesh, lambda places: np.asarray(bed(places[:, :2]) / tank.depth))
        volume *= stretched / mesh_integral(mesh, lambda places: np.ones(len(places)))
        points = mesh.points.copy()
        points[:, 2] *= bed(points[:, :2]) / tank.depth
        mesh = replace(mesh, points=points)
    return VolumeMesh(noded=checked(mesh, tips=isinstance(tank.plan, FilePlan) and not tank.floats), volume=volume)


def _surfaces(faces: dict[int, str]) -> dict[tuple[str, ...], Surface]:
    """The surface of each face, and a cylinder through each circle between faces in one plane, which do not tell it;
    none at all if one of them has no closed form: new nodes could not be moved to it."""
    found: dict[tuple[str, ...], Surface] = {}
    for tag, name in faces.items():
        surface = surface_of(tag)
        if surface is None:
            return {}
        found[(name,)] = surface
    for _, curve in gmsh.model.getEntities(1):
        pair = [int(tag) for tag in gmsh.model.getAdjacencies(1, curve)[0] if tag in faces]
        if len(pair) == 2 and gmsh.model.getType(1, curve) != "Line":
            normals = np.array([gmsh.model.getNormal(tag, [0.0, 0.0]) for tag in pair])
            planes = all(gmsh.model.getType(2, tag) == "Plane" for tag in pair)
            if planes and abs(normals[0] @ normals[1]) > 1.0 - _LEVEL:
                circle = circle_of(curve)
                if circle is None:
                    return {}
                found[faces[pair[0]], faces[pair[1]]] = circle
    return found


def depth_over(tank: VolumeTank) -> Callable[[FloatArray], FloatArray]:
    """Return the depth of an upright tank at places of the plan (n, 2) → (n,)."""
    bed = tank.bed
    if isinstance(bed, SlopingBed):
        slope, middle = np.array(bed.slope), np.array(plan_middle(tank))
        return lambda places: np.asarray(tank.depth - (places - middle) @ slope)
    if isinstance(bed, SurveyedBed):
        table = np.array(bed.points)
        # Cubic splines of the distance, exact for planes; they have continuous second derivatives.
        surface = RBFInterpolator(table[:, :2], table[:, 2] - table[:, 2].min(), kernel="cubic", degree=1)
        return lambda places: np.asarray(tank.depth - surface(places))
    return lambda places: np.full(len(places), tank.depth)


def plan_middle(tank: VolumeTank) -> tuple[float, float]:
    """Return the middle of the box around the plan."""
    plan = tank.plan
    if isinstance(plan, Box):
        return 0.5 * plan.length, 0.5 * plan.width
    if isinstance(plan, FilePlan):
        return plan.middle
    if isinstance(plan, Polygon):
        x, y = zip(*plan.points, strict=True)
        return 0.5 * (min(x) + max(x)), 0.5 * (min(y) + max(y))
    return 0.0, 0.0


_Entities = list[tuple[int, int]]


def _liquid(tank: VolumeTank) -> _Entities:
    """The liquid as a solid."""
    occ, plan = gmsh.model.occ, tank.plan
    if isinstance(plan, FilePlan):
        return solid_of_file(plan)
    reach = 4.0 + tank.depth
    low = 2.0 * reach if isinstance(tank.bed, SlopingBed) else tank.depth
    if isinstance(plan, Box):
        solid = [(3, occ.addBox(0.0, 0.0, -low, plan.length, plan.width, low))]
    elif isinstance(plan, Cylinder):
        solid = [(3, occ.addCylinder(0.0, 0.0, -low, 0.0, 0.0, low, plan.radius))]
        if plan.inner_radius:
            inner = [(3, occ.addCylinder(0.0, 0.0, -low, 0.0, 0.0, low, plan.inner_radius))]
            solid = occ.cut(solid, inner)[0]
    else:
        face = _face(plan)
        solid = [one for one in occ.extrude(face, 0.0, 0.0, -low) if one[0] == 3]
    if isinstance(tank.bed, SlopingBed):
        (along, across), (x, y) = tank.bed.slope, plan_middle(tank)
        below = [(3, occ.addBox(-reach, -reach, -3.0 * reach, 2.0 * reach, 2.0 * reach, 3.0 * reach))]
        steepness = hypot(along, across)
        if steepness:
            occ.rotate(below, 0.0, 0.0, 0.0, across / steepness, -along / steepness, 0.0, atan(steepness))
        occ.translate(below, x, y, -tank.depth)
        solid = occ.cut(solid, below)[0]
    return solid


def _face(outline: Outline) -> _Entities:
    """An outline as a face at z = 0."""
    occ = gmsh.model.occ
    if isinstance(outline, Rectangle | Strip):
        if isinstance(outline, Strip):
            left, low, size = outline.start, 0.0, (outline.length, outline.width)
        else:
            size = outline.size
            left, low = outline.position[0] - 0.5 * size[0], outline.position[1] - 0.5 * size[1]
        return [(2, occ.addRectangle(left, low, 0.0, *size))]
    if isinstance(outline, Disc):
        x, y = outline.position
        disc = [(2, occ.addDisk(x, y, 0.0, outline.radius, outline.radius))]
        if outline.inner_radius:
            hole = [(2, occ.addDisk(x, y, 0.0, outline.inner_radius, outline.inner_radius))]
            disc = occ.cut(disc, hole)[0]
        return disc
    points = [occ.addPoint(x, y, 0.0) for x, y in outline.points]
    lines = [occ.addLine(one, other) for one, other in zip(points, [*points[1:], points[0]], strict=True)]
    return [(2, occ.addPlaneSurface([occ.addCurveLoop(lines)]))]


def _kept(entities: _Entities, tank: VolumeTank, mirrors: Mirrors) -> _Entities:
    """The part above the planes of symmetry."""
    dim, far = entities[0][0], 10.0 + 4.0 * tank.depth
    for axis, mirror in enumerate(mirrors):
        if mirror is not None:
            start = [-far, -far, -far]
            start[axis] = mirror
            half = [(3, gmsh.model.occ.addBox(*start, 2.0 * far, 2.0 * far, 2.0 * far))]
            entities = [one for one in gmsh.model.occ.intersect(entities, half)[0] if one[0] == dim]
    return entities


def _owners(plates: list[_Entities], parts: list[_Entities]) -> dict[int, int]:
    """Index of the plate of each face that plates were cut into."""
    indices = [index for index, plate in enumerate(plates) for _ in plate]
    return {tag: index for index, part in zip(indices, parts, strict=True) for dim, tag in part if dim == 2}


def _require_covered(tank: VolumeTank, owners: dict[int, int], faces: dict[int, str], images: int) -> None:
    for index, plate in enumerate(tank.plates):
        area = sum(gmsh.model.occ.getMass(2, tag) for tag, own in owners.items() if own == index and tag in faces)
        if images * area < plate.outline.area * (1.0 - _LEVEL):
            raise MeshError(f"plate {index + 1} does not lie on the still surface of the tank")


def _name(tank: VolumeTank, tag: int, plates: dict[int, int], mirrors: Mirrors) -> str:
    """Name of a face of the liquid: a plate, a float, the still surface, a plane of symmetry, or "" for a wall."""
    if tag in plates:
        return body_name(plates[tag] + 1)
    for axis, level, name in ((2, 0.0, FREE_SURFACE), *zip((0, 1), mirrors, MIRRORS, strict=True)):
        # Walls of the tank are no planes through its middle.
        if level is not None and lies_in_plane(tag, axis, level):
            return name
    for index, solid in enumerate(tank.floats, len(tank.plates) + 1):
        if solid.distance(_points_of(tag)).max() < _ON_FLOAT:
            return body_name(index)
    return ""


def _points_of(face: int) -> FloatArray:
    """Points of a face: of its middle, and of its edges."""
    low, high = gmsh.model.getParametrizationBounds(2, face)
    points = [gmsh.model.getValue(2, face, [0.5 * (a + b) for a, b in zip(low, high, strict=True)])]
    for _, edge in gmsh.model.getBoundary([(2, face)], oriented=False):
        (start,), (end,) = gmsh.model.getParametrizationBounds(1, edge)
        points.append(gmsh.model.getValue(1, edge, [0.5 * (start + end)]))
    return np.array(points)


def _float_solid(solid: SolidFloat) -> _Entities:
    """A float as a solid that reaches above the still surface."""
    occ, (x, y), depth = gmsh.model.occ, solid.position, solid.draught
    if solid.shape == "sphere":
        return [(3, occ.addSphere(x, y, 0.5 * solid.size[0] - depth, 0.5 * solid.size[0]))]
    if solid.shape == "cylinder":
        return [(3, occ.addCylinder(x, y, -depth, 0.0, 0.0, 2.0 * depth, 0.5 * solid.size[0]))]
    along, across = solid.size
    return [(3, occ.addBox(x - 0.5 * along, y - 0.5 * across, -depth, along, across, 2.0 * depth))]


def _is_curved(tank: VolumeTank) -> bool:
    round_plates = any(isinstance(plate.outline, Disc) for plate in tank.plates)
    return (
        isinstance(tank.plan, Cylinder)
        or any(solid.shape != "box" for solid in tank.floats)
        or round_plates
        or isinstance(tank.bed, SurveyedBed)
        or (isinstance(tank.plan, FilePlan) and any(kind not in ("Plane",) for kind in _kinds()))
    )


def _kinds() -> set[str]:
    return {gmsh.model.getType(2, tag) for _, tag in gmsh.model.getEntities(2)}


def _singular_edges(tank: VolumeTank, faces: dict[int, str], mirrors: Mirrors) -> set[int]:
    """Edges of plates and corners of floats; not those that planes of symmetry make, nor where walls of a float meet
    the still surface at right angles."""
    upright = {
        body_name(number) for number, solid in enumerate(tank.floats, len(tank.plates) + 1) if solid.shape != "sphere"
    }
    found = set()
    for face, name in faces.items():
        if body_number(name) is None:
            continue
        planes = [*enumerate(mirrors), (2, 0.0 if name in upright else None)]
        for _, edge in gmsh.model.getBoundary([(2, face)], oriented=False):
            box = np.array(gmsh.model.occ.getBoundingBox(1, edge)).reshape(2, 3)
            if not any(level is not None and np.abs(box[:, axis] - level).max() < _BOXES for axis, level in planes):
                found.add(edge)
    return found


def _set_sizes(tank: VolumeTank, sizes: VolumeSizes, edges: set[int]) -> None:
    """Cells grow from singular edges, and follow curved walls."""
    mesh = gmsh.model.mesh
    around = [pi * min(solid.size) / sizes.around for solid in tank.floats if solid.shape != "box"]
    if edges and sizes.edge < sizes.bulk:
        near = mesh.field.add("Distance")
        mesh.field.setNumbers(near, "CurvesList", sorted(edges))
        mesh.field.setNumber(near, "Sampling", _SAMPLES)
        growing = mesh.field.add("Threshold")
        mesh.field.setNumber(growing, "InField", near)
        mesh.field.setNumber(growing, "SizeMin", sizes.edge)
        mesh.field.setNumber(growing, "SizeMax", sizes.bulk)
        mesh.field.setNumber(growing, "DistMin", 0.0)
        mesh.field.setNumber(growing, "DistMax", (sizes.bulk - sizes.edge) / _GROWTH)
        mesh.field.setAsBackgroundMesh(growing)
    for option, value in {
        "MeshSizeMax": sizes.bulk,
        # Curvature is unbounded at the tip of a cone.
        "MeshSizeMin": min([sizes.edge, _LEAST_CURVED * sizes.bulk, *around]),
        "MeshSizeFromPoints": 0,
        "MeshSizeExtendFromBoundary": 0,
        "MeshSizeFromCurvature": sizes.around,
        "Algorithm": 6,
        "Algorithm3D": 1,
        "Optimize": 1,
        "ElementOrder": 1,
        "HighOrderOptimize": 0,
    }.items():
        gmsh.option.setNumber(f"Mesh.{option}", value)
