"""Volumes of tanks: shape-regular tetrahedra, graded alike in all directions towards the edges of plates.

Anisotropic layers, which cost nothing on a plan, ruin multigrid in a volume. Cells at curved walls and beds are of the
geometry's degree. A smooth bed through points moves the nodes of a tank with a level bed vertically.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from itertools import combinations
from math import pi

import gmsh
import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import RBFInterpolator
from scipy.spatial import cKDTree

from hydroelastic.meshes.cut_volume import cut_volume, with_regions
from hydroelastic.meshes.discrete_hull import add_hulls, join_hulls, release_numbers
from hydroelastic.meshes.edge_layers import with_edge_layers
from hydroelastic.meshes.filling import gmsh_model
from hydroelastic.meshes.geometry import BAFFLE, FREE_SURFACE, INTERFACE, LIQUID, LOWER_LIQUID, UPPER_LIQUID
from hydroelastic.meshes.interrupts import interrupts_deferred
from hydroelastic.meshes.plan_loops import Mirrors
from hydroelastic.meshes.refinement import APART
from hydroelastic.meshes.surfaces import Surface, circle_of, surface_of
from hydroelastic.meshes.tagged_mesh import MeshError, MisplacedError, NodedMesh, TooManyCellsError
from hydroelastic.meshes.tetrahedra import VolumeMesh, checked, mesh_integral, read_gmsh
from hydroelastic.meshes.volume_file import lies_in_plane, mesh_of_file
from hydroelastic.meshes.volume_solids import (
    baffle_faces,
    below,
    box_around,
    face,
    faces_of,
    float_solid,
    kept,
    liquid_solid,
    require_inside,
)
from hydroelastic.physics.arrays import FloatArray
from hydroelastic.physics.dofs import body_name, body_number
from hydroelastic.physics.level_tank import Box, Cylinder, FilePlan, middle_of
from hydroelastic.physics.plate import Disc, Rectangle
from hydroelastic.physics.solid_floats import SolidFloat
from hydroelastic.physics.volume_tank import SlopingBed, SurveyedBed, VolumeTank

MIRRORS = ("mirror_x", "mirror_y")
"""Names of the planes of symmetry, by the axis that is normal to them."""
CELLS_OF_A_CUBE = 8.5
"""Tetrahedra of the size of a cube's edge in it, measured."""
CELLS_OF_EDGES = 37.0
"""Cells that grow from edges of plates with the size h there, over their length over h; measured."""
MOST_CELLS = 3e6
"""That gmsh makes, on one process and with a gigabyte for each million."""

# Growth of the size of cells per distance from an edge.
_GROWTH = 0.6
# Points of a curve from which distances are measured.
_SAMPLES = 200
# Smallest part of the bulk size that the curvature of a wall asks for.
_LEAST_CURVED = 0.2
# Part of the area of a plate that may lie elsewhere.
_LEVEL = 1e-7
# Thickness of a liquid over the size of the cells, below which gmsh may not end.
_THINNEST = 1e-2
# Cells around a curved wall that is refined later; of 8 around a sphere some were inverted, of 12 none.
_FEWEST_AROUND = 12

# Part of the size at which the chord of a wall would meet the other one; measured: of 0.5 some cells are inverted.
_SAFE = 0.2
GROWTH = 2.0 * _SAFE
"""Growth of that size per distance s from the place, as the gap grows like s²/2r."""

# The vertical part of the normal of a wall that meets the still surface at right angles is less.
_UPRIGHT = 0.1
# By so much boxes around edges are larger than these.
_BOXES = 1e-6
# Cosine of the angle between two segments from which they meet in a corner: 45° from straight. Of circles segments are
# eighths at most.
_STRAIGHT = -0.7


@dataclass(frozen=True, kw_only=True)
class VolumeSizes:
    """Sizes of cells, in units of the tank."""

    edge: float  # at the edges of plates
    bulk: float  # elsewhere
    geometry: int  # degree of the geometry of curved cells
    around: int = 16  # least number of cells around a curved wall
    # how often straight cells of gmsh are to be divided into eight on all processes, which have these sizes then; see
    # `meshes.refinement`
    refinements: int = 0
    # how often the cells at singular edges are cut, where they are not refined; see `meshes.edge_layers`
    layers: int = 0

    @property
    def coarse(self) -> VolumeSizes:
        """Those of gmsh's cells."""
        times = 2**self.refinements
        around = max(self.around // times, _FEWEST_AROUND)
        return replace(self, edge=times * self.edge, bulk=times * self.bulk, around=around)


def volume_mesh(
    tank: VolumeTank, sizes: VolumeSizes, mirrors: Mirrors = (None, None), most: float = MOST_CELLS
) -> VolumeMesh:
    """Mesh a dimensionless tank, of at most so many cells by gmsh, on the calling process only."""
    if isinstance(tank.plan, FilePlan) and tank.plan.file.suffix.lower() == ".msh":
        return mesh_of_file(tank.plan)
    bed = depth_over(tank)
    _require_thick(tank, sizes)
    with gmsh_model():
        parts = _parts(tank, mirrors)
        _require_covered(tank, parts, 2 ** sum(mirror is not None for mirror in mirrors))
        edges, curved, faces = singular_edges(tank, parts.faces, mirrors), _is_curved(tank), parts.faces
        surfaces: dict[tuple[str, ...], Surface] = {}
        if sizes.refinements:
            apart = {tag: f"{name}{APART}{tag}" for tag, name in faces.items()}
            # Meshes that are cut open are not refined.
            surfaces = {} if {BAFFLE, INTERFACE} & set(faces.values()) else _surfaces(apart)
            sizes, faces = (sizes.coarse, apart) if surfaces else (replace(sizes, refinements=0), faces)
        if (cells := _cells(tank, sizes, parts, edges)) > most:
            raise TooManyCellsError(cells, MOST_CELLS)
        _set_sizes(tank, sizes, edges)
        with interrupts_deferred():
            gmsh.model.mesh.generate(3)
            degree = sizes.geometry if curved and not sizes.refinements else 1
            if degree > 1:
                gmsh.model.mesh.setOrder(degree)
        mesh = read_gmsh(degree, {tag: name for tag, name in faces.items() if name}, parts.layers)
        segments, corners = singular_segments(mesh, edges)
    if sizes.refinements:
        return VolumeMesh(noded=mesh, volume=parts.volume, surfaces=surfaces, curved=curved)
    volume = parts.volume
    if isinstance(tank.bed, SurveyedBed):
        stretched = mesh_integral(mesh, lambda places: np.asarray(bed(places[:, :2]) / tank.depth))
        volume *= stretched / mesh_integral(mesh, lambda places: np.ones(len(places)))
        points = mesh.points.copy()
        points[:, 2] *= bed(points[:, :2]) / tank.depth
        mesh = replace(mesh, points=points)
    # Parts of curved cells may be thinner than these are curved; they are inverted only where these are.
    mesh, straightened = checked(mesh, straighten=not isinstance(tank.bed, SurveyedBed))
    mesh = with_edge_layers(mesh, segments, corners, sizes.layers)
    cuts = tuple({BAFFLE, INTERFACE} & set(mesh.facet_names))
    if cuts:
        mesh = with_regions(cut_volume(mesh, cuts, (INTERFACE,)))
    return VolumeMesh(noded=mesh, volume=volume, straightened=straightened)


@dataclass(frozen=True, kw_only=True)
class _Parts:
    """The parts of a model of gmsh."""

    layers: dict[int, str]  # name of the liquid of each volume
    faces: dict[int, str]  # name of each face of the liquids, "" of walls
    volume: float  # of the liquids


def _parts(tank: VolumeTank, mirrors: Mirrors) -> _Parts:
    """Make the liquids in the current model, cut by planes of symmetry, with faces of plates, baffles and floats."""
    occ = gmsh.model.occ
    first = len(tank.plates) + 1
    floats = {body_name(number): solid for number, solid in enumerate(tank.floats, first)}
    triangulated = {name: solid for name, solid in floats.items() if solid.hull and solid.hull.is_triangulated}
    hulls = add_hulls(triangulated)
    liquid = kept(liquid_solid(tank), tank, mirrors)
    images = 2 ** sum(mirror is not None for mirror in mirrors)
    # Of free-form faces OpenCASCADE's masses have three digits.
    volume = occ.getMass(*liquid[0]) - sum(solid.hydrostatics.volume for solid in tank.floats) / images
    tools = {body_name(index): kept(face(plate.outline), tank, mirrors) for index, plate in enumerate(tank.plates, 1)}
    tools |= {name: kept(float_solid(floats[name]), tank, mirrors) for name in floats if name not in hulls}
    if isinstance(tank.plan, FilePlan):
        # Of other plans the scene tells.
        for name in tools.keys() & floats.keys():
            require_inside(name, tools[name], liquid)
    tools[BAFFLE] = [one for baffle in tank.baffles for one in baffle_faces(baffle, tank, liquid)]
    if tank.interface is not None:
        tools[LOWER_LIQUID] = below(tank, tank.interface)
    flat = [one for tool in tools.values() for one in tool]
    made = occ.fragment(liquid, flat)[1] if flat else [[one] for one in liquid]
    if hulls:
        release_numbers()
    occ.synchronize()
    pieces, place = {}, len(liquid)
    for name, tool in tools.items():
        pieces[name] = {one for part in made[place : place + len(tool)] for one in part}
        place += len(tool)
    bodies = {one for name in floats for one in pieces.get(name, ())}
    liquids = {one for part in made[: len(liquid)] for one in part} - bodies
    lower = liquids & pieces.get(LOWER_LIQUID, set())
    wetted = {name: faces_of(sorted(pieces[name])) for name in floats if name not in hulls}
    if wetted or lower:
        others = [one for one in gmsh.model.getEntities(3) if one not in liquids]
        occ.remove(others, recursive=True)
        occ.synchronize()
    if len(liquids) != 1 + bool(lower) and not tank.baffles:
        raise MisplacedError("the bed divides the liquid")
    layers = {tag: (LOWER_LIQUID if (3, tag) in lower else UPPER_LIQUID) if lower else LIQUID for _, tag in liquids}
    owners = {tag: name for name in tools for dim, tag in pieces[name] if dim == 2}
    faces = {
        tag: owners.get(tag) or _name(tag, wetted, mirrors)
        for _, tag in gmsh.model.getBoundary(sorted(liquids), combined=False, oriented=False)
    }
    left = set(gmsh.model.getEntities(2))
    if any((2, tag) not in left for tag, name in owners.items() if name == BAFFLE):
        raise MisplacedError("a baffle meets a float")
    faces |= {tag: BAFFLE for tag, name in owners.items() if name == BAFFLE}
    if lower:
        shared = faces_of(sorted(lower)) & faces_of(sorted(liquids - lower))
        faces |= {tag: INTERFACE for tag in shared if faces[tag] != BAFFLE}
    if hulls:
        above = next(tag for _, tag in liquids - lower)
        water = [tag for tag, name in faces.items() if name == FREE_SURFACE]
        joined, still, replaced = join_hulls(above, water, hulls)
        layers = {joined if tag == above else tag: name for tag, name in layers.items()}
        del faces[replaced]
        faces |= dict.fromkeys(still, FREE_SURFACE) | {tag: name for name, tags in hulls.items() for tag in tags}
    return _Parts(layers=layers, faces=faces, volume=volume)


def _require_thick(tank: VolumeTank, sizes: VolumeSizes) -> None:
    """Refuse two liquids, one of which is much thinner than the cells."""
    if tank.lower is not None and min(tank.lower.depth, tank.depth - tank.lower.depth) < _THINNEST * sizes.bulk:
        raise MeshError("one of the liquids is so thin that its cells would be flat: leave it out, or make it thicker")


def _cells(tank: VolumeTank, sizes: VolumeSizes, parts: _Parts, edges: set[int]) -> float:
    """Return about the number of cells that gmsh will make: in the liquid, at curved walls, in gaps, at edges."""
    cubes = parts.volume / sizes.bulk**3
    smallest = _smallest(tank, sizes)
    for tag in parts.faces:
        if gmsh.model.getType(2, tag) not in ("Plane", "Discrete surface"):
            middle = np.mean(gmsh.model.getParametrizationBounds(2, tag), axis=0)
            curvature = max(gmsh.model.getCurvature(2, tag, middle))
            size = max(2.0 * pi / (sizes.around * max(curvature, 1e-9)), smallest)
            if size < sizes.bulk:
                cubes += gmsh.model.occ.getMass(2, tag) / size**2
    # ∫2πr/(s + gr)³ dr, over the depth.
    cubes += sum(pi * tank.depth / (GROWTH**2 * size) for _, size in _gaps(tank, sizes))
    lengths = sum(gmsh.model.occ.getMass(1, edge) for edge in edges) if sizes.edge < sizes.bulk else 0.0
    return CELLS_OF_A_CUBE * cubes + CELLS_OF_EDGES * lengths / sizes.edge


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
        slope, middle = np.array(bed.slope), np.array(middle_of(tank.plan))
        return lambda places: np.asarray(tank.depth - (places - middle) @ slope)
    if isinstance(bed, SurveyedBed):
        table = np.array(bed.points)
        # Cubic splines of the distance, exact for planes; they have continuous second derivatives.
        surface = RBFInterpolator(table[:, :2], table[:, 2] - table[:, 2].min(), kernel="cubic", degree=1)
        return lambda places: np.asarray(tank.depth - surface(places))
    return lambda places: np.full(len(places), tank.depth)


def _require_covered(tank: VolumeTank, parts: _Parts, images: int) -> None:
    for number, plate in enumerate(tank.plates, 1):
        area = sum(gmsh.model.occ.getMass(2, tag) for tag, name in parts.faces.items() if name == body_name(number))
        if images * area < plate.outline.area * (1.0 - _LEVEL):
            raise MisplacedError(f"plate {number} does not lie on the still surface of the tank")


def _name(tag: int, wetted: dict[str, set[int]], mirrors: Mirrors) -> str:
    """Name of a face of the liquid: a float, the still surface, a plane of symmetry, or "" for a wall."""
    for axis, level, name in ((2, 0.0, FREE_SURFACE), *zip((0, 1), mirrors, MIRRORS, strict=True)):
        # Walls of the tank are no planes through its middle.
        if level is not None and lies_in_plane(tag, axis, level):
            return name
    return next((name for name, faces in wetted.items() if tag in faces), "")


def _is_curved(tank: VolumeTank) -> bool:
    round_plates = any(isinstance(plate.outline, Disc) for plate in tank.plates)
    return (
        isinstance(tank.plan, Cylinder)
        or any(isinstance(outline, Disc) for outline in tank.columns)
        or any(solid.shape != "box" for solid in tank.floats)
        or round_plates
        or isinstance(tank.bed, SurveyedBed)
        or (isinstance(tank.plan, FilePlan) and any(kind not in ("Plane",) for kind in _kinds()))
    )


def _kinds() -> set[str]:
    return {gmsh.model.getType(2, tag) for _, tag in gmsh.model.getEntities(2)}


def _least_radius(solid: SolidFloat) -> float:
    """Of an outline it is that of its narrowest corner: of a hole, a column or a blunt tip."""
    return min([0.5 * min(solid.size), *(r for r, z in solid.outline if r > 0.0 and z <= 0.0)])


def _gaps(tank: VolumeTank, sizes: VolumeSizes) -> list[tuple[FloatArray, float]]:
    return [(place, size) for place, size in narrow_gaps(tank) if size < sizes.bulk]


def _smallest(tank: VolumeTank, sizes: VolumeSizes) -> float:
    """Size below which curvature, which is unbounded at the tip of a cone, asks for nothing."""
    around = [_least_radius(solid) for solid in tank.floats if solid.shape != "box"]
    around += [one.radius for one in tank.columns if isinstance(one, Disc)]
    small = [2.0 * pi * radius / sizes.around for radius in around] + [size for _, size in _gaps(tank, sizes)]
    return min([sizes.edge, _LEAST_CURVED * sizes.bulk, *small])


def _set_sizes(tank: VolumeTank, sizes: VolumeSizes, edges: set[int]) -> None:
    mesh = gmsh.model.mesh
    fields = []
    for (x, y), size in _gaps(tank, sizes):
        fields.append(mesh.field.add("MathEval"))
        mesh.field.setString(fields[-1], "F", f"{size} + {GROWTH} * sqrt((x - ({x}))^2 + (y - ({y}))^2)")
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
        fields.append(growing)
    if fields:
        smallest = mesh.field.add("Min")
        mesh.field.setNumbers(smallest, "FieldsList", fields)
        mesh.field.setAsBackgroundMesh(smallest)
    for option, value in {
        "MeshSizeMax": sizes.bulk,
        "MeshSizeMin": _smallest(tank, sizes),
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


def narrow_gaps(tank: VolumeTank) -> Iterator[tuple[FloatArray, float]]:
    """Yield the place in the plan, and the size of cells there, of gaps beside round columns.

    A chord of the length h is h²/8r from its arc, so that h = √(8 r gap) would reach the other wall.
    """
    discs = [one for one in tank.columns if isinstance(one, Disc)]
    for disc in discs:
        centre = np.array(disc.position)
        for place, gap in _beside_walls(tank, centre, disc.radius):
            yield place, _size(disc.radius, gap)
    for one, other in combinations(discs, 2):
        between = np.subtract(other.position, one.position)
        distance = float(np.linalg.norm(between))
        place = one.position + between * one.radius / distance
        yield place, _size(min(one.radius, other.radius), distance - one.radius - other.radius)


def _size(radius: float, gap: float) -> float:
    return _SAFE * float(np.sqrt(8.0 * radius * max(gap, 0.0)))


def _beside_walls(tank: VolumeTank, centre: FloatArray, radius: float) -> Iterator[tuple[FloatArray, float]]:
    if isinstance(tank.plan, Box):
        for axis, length in enumerate((tank.plan.length, tank.plan.width)):
            for wall in (0.0, length):
                place = centre.copy()
                place[axis] = wall
                yield place, abs(centre[axis] - wall) - radius
    elif isinstance(tank.plan, Cylinder):
        distance = float(np.linalg.norm(centre))
        if distance > 0.0:
            yield centre * tank.plan.radius / distance, tank.plan.radius - distance - radius


def singular_edges(tank: VolumeTank, faces: dict[int, str], mirrors: Mirrors) -> set[int]:
    """Return the curves of gmsh's current model beside which ψ is singular.

    Edges of plates, corners of floats and columns, and tips of baffles; not those that planes of symmetry make, nor
    where walls of a float meet the still surface at right angles.
    """
    found: set[int] = set()
    beside: set[int] = set()
    tips: list[int] = []
    for tag, name in faces.items():
        edges = [edge for _, edge in gmsh.model.getBoundary([(2, tag)], oriented=False)]
        if name == BAFFLE:
            tips += edges
            continue
        beside |= {*edges, *(edge for dim, edge in gmsh.model.mesh.getEmbedded(2, tag) if dim == 1)}
        number = body_number(name)
        if number is None:
            continue
        for edge in edges:
            box = box_around((1, edge))
            level = number > len(tank.plates) and np.abs(box[:, 2]).max() < _BOXES and _is_upright(tag, edge)
            if not level and not any(
                mirror is not None and np.abs(box[:, axis] - mirror).max() < _BOXES
                for axis, mirror in enumerate(mirrors)
            ):
                found.add(edge)
    found |= {edge for edge in tips if tips.count(edge) == 1} - beside
    corners = [corner for outline in tank.columns if isinstance(outline, Rectangle) for corner in outline.corners]
    for edge in beside if corners else ():
        low, high = box_around((1, edge))
        if any(np.abs([*(low[:2] - corner), *(high[:2] - corner)]).max() < _BOXES for corner in corners):
            found.add(edge)
    return found


def singular_segments(mesh: NodedMesh, edges: set[int]) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Return the edges of cells on curves of gmsh's current model, and the points in which these meet at an angle."""
    corners = np.unique(mesh.cells[:, :4])
    nearest = cKDTree(mesh.points[corners])
    found = [np.empty((0, 2), np.int64)]
    for edge in sorted(edges):
        # Of each edge of a cell the ends come first, then the nodes between them.
        tags, coordinates, _ = gmsh.model.mesh.getNodes(1, edge, includeBoundary=True)
        places = dict(zip(tags, coordinates.reshape(-1, 3), strict=True))
        kinds, _, nodes = gmsh.model.mesh.getElements(1, edge)
        # The pole of a sphere is a curve without any.
        for kind, own in zip(kinds, nodes, strict=True):
            ends = own.reshape(-1, gmsh.model.mesh.getElementProperties(kind)[3])[:, :2]
            found.append(corners[nearest.query([[places[end] for end in pair] for pair in ends])[1]])
    every = np.concatenate(found)
    ends, counts = np.unique(every, return_counts=True)
    angles = []
    for end in ends[counts > 1]:
        own = every[(every == end).any(axis=1)]
        along = mesh.points[own[own != end]] - mesh.points[end]
        along /= np.linalg.norm(along, axis=1)[:, None]
        if len(along) > 2 or along[0] @ along[1] > _STRAIGHT:
            angles.append(end)
    return every, np.array(angles, dtype=np.int64)


def _is_upright(face: int, edge: int) -> bool:
    """Whether a face meets the still surface at right angles, in the middle of an edge of it."""
    (start,), (end,) = gmsh.model.getParametrizationBounds(1, edge)
    place = gmsh.model.getValue(1, edge, [0.5 * (start + end)])
    normal = gmsh.model.getNormal(face, gmsh.model.getParametrization(2, face, place))
    return bool(abs(normal[2]) < _UPRIGHT)
