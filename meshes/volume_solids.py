"""The solids and faces of a tank in gmsh, by OpenCASCADE: its liquid, columns, floats, baffles and outlines."""

from __future__ import annotations

from itertools import product
from math import atan, hypot, inf, pi, sqrt

import gmsh
import numpy as np

from hydroelastic.meshes.filling import gmsh_model
from hydroelastic.meshes.hull_file import hull_solid, wetted_triangles
from hydroelastic.meshes.plan_loops import Mirrors
from hydroelastic.meshes.tagged_mesh import MisplacedError
from hydroelastic.meshes.volume_file import solid_of_file
from hydroelastic.physics.arrays import FloatArray
from hydroelastic.physics.level_tank import Box, Cylinder, FilePlan, middle_of
from hydroelastic.physics.obstacles import Baffle, VerticalBaffle
from hydroelastic.physics.plate import Bounds, Disc, Outline, Rectangle, Strip, bounds_of
from hydroelastic.physics.solid_floats import SolidFloat
from hydroelastic.physics.volume_tank import SlopingBed, VolumeTank

Entities = list[tuple[int, int]]
"""Dimension and tag of parts of a model of gmsh."""

# In units of the tank: parts that are closer touch.
_GAP = 1e-6
# Part of the volume that counts as nothing.
_NOTHING = 1e-9


def liquid_solid(tank: VolumeTank) -> Entities:
    """All of the inside of the tank up to the still surface, but for columns."""
    occ, plan = gmsh.model.occ, tank.plan
    solid = solid_of_file(plan) if isinstance(plan, FilePlan) else _upright(tank)
    for number, outline in enumerate(tank.columns, 1):
        whole = occ.getMass(*solid[0])
        solid = [one for one in occ.cut(solid, _prism(face(outline), 2.0 * _reach(tank)))[0] if one[0] == 3]
        if len(solid) != 1 or occ.getMass(*solid[0]) > whole * (1.0 - _NOTHING):
            raise MisplacedError(f"column {number} does not stand in the tank, or divides it")
    return solid


def _reach(tank: VolumeTank) -> float:
    return 4.0 + tank.depth


def _upright(tank: VolumeTank) -> Entities:
    occ, plan, reach = gmsh.model.occ, tank.plan, _reach(tank)
    assert not isinstance(plan, FilePlan)
    low = 2.0 * reach if isinstance(tank.bed, SlopingBed) else tank.depth
    if isinstance(plan, Box):
        solid = [(3, occ.addBox(0.0, 0.0, -low, plan.length, plan.width, low))]
    elif isinstance(plan, Cylinder):
        solid = [(3, occ.addCylinder(0.0, 0.0, -low, 0.0, 0.0, low, plan.radius))]
        if plan.inner_radius:
            inner = [(3, occ.addCylinder(0.0, 0.0, -low, 0.0, 0.0, low, plan.inner_radius))]
            solid = occ.cut(solid, inner)[0]
    else:
        solid = _prism(face(plan), low)
    if isinstance(tank.bed, SlopingBed):
        (along, across), (x, y) = tank.bed.slope, middle_of(tank.plan)
        below = [(3, occ.addBox(-reach, -reach, -3.0 * reach, 2.0 * reach, 2.0 * reach, 3.0 * reach))]
        steepness = hypot(along, across)
        if steepness:
            occ.rotate(below, 0.0, 0.0, 0.0, across / steepness, -along / steepness, 0.0, atan(steepness))
        occ.translate(below, x, y, -tank.depth)
        solid = occ.cut(solid, below)[0]
    return solid


def _prism(faces: Entities, depth: float) -> Entities:
    return [one for one in gmsh.model.occ.extrude(faces, 0.0, 0.0, -depth) if one[0] == 3]


def below(tank: VolumeTank, level: float) -> Entities:
    """A box around all of the tank below a level."""
    reach, (x, y) = _reach(tank), middle_of(tank.plan)
    low = 3.0 * reach
    return [(3, gmsh.model.occ.addBox(x - reach, y - reach, -low, 2.0 * reach, 2.0 * reach, low + level))]


def face(outline: Outline, level: float = 0.0) -> Entities:
    """An outline as a face at a level."""
    occ = gmsh.model.occ
    if isinstance(outline, Rectangle | Strip):
        if isinstance(outline, Strip):
            left, low, size = outline.start, 0.0, (outline.length, outline.width)
        else:
            size = outline.size
            left, low = outline.position[0] - 0.5 * size[0], outline.position[1] - 0.5 * size[1]
        return [(2, occ.addRectangle(left, low, level, *size))]
    if isinstance(outline, Disc):
        x, y = outline.position
        disc = [(2, occ.addDisk(x, y, level, outline.radius, outline.radius))]
        if outline.inner_radius:
            hole = [(2, occ.addDisk(x, y, level, outline.inner_radius, outline.inner_radius))]
            disc = occ.cut(disc, hole)[0]
        return disc
    return _polygon([(x, y, level) for x, y in outline.points])


def _polygon(corners: list[tuple[float, float, float]]) -> Entities:
    occ = gmsh.model.occ
    points = [occ.addPoint(*corner) for corner in corners]
    lines = [occ.addLine(one, other) for one, other in zip(points, [*points[1:], points[0]], strict=True)]
    return [(2, occ.addPlaneSurface([occ.addCurveLoop(lines)]))]


def baffle_faces(baffle: Baffle, tank: VolumeTank, liquid: Entities) -> Entities:
    """The part of a baffle in the liquid."""
    if isinstance(baffle, VerticalBaffle):
        (x, y), (right, back) = baffle.start, baffle.end
        low = -2.0 * _reach(tank) if baffle.bottom == -inf else baffle.bottom
        own = _polygon([(x, y, low), (right, back, low), (right, back, baffle.top), (x, y, baffle.top)])
    else:
        own = face(baffle.outline, baffle.level)
    found = [one for one in gmsh.model.occ.intersect(own, liquid, removeTool=False)[0] if one[0] == 2]
    if not found:
        raise MisplacedError("a baffle does not lie in the liquid")
    return found


def float_solid(solid: SolidFloat) -> Entities:
    """A float as a solid that reaches to the still surface at least."""
    occ, (x, y), depth = gmsh.model.occ, solid.position, solid.draught
    if solid.hull is not None:
        body = hull_solid(solid.hull.file, solid.hull.metres)
        occ.translate(body, *solid.origin, -solid.hull.level / solid.hull.metres)
        return body
    if solid.shape == "sphere":
        return [(3, occ.addSphere(x, y, 0.5 * solid.size[0] - depth, 0.5 * solid.size[0]))]
    if solid.shape == "cylinder":
        return [(3, occ.addCylinder(x, y, -depth, 0.0, 0.0, 2.0 * depth, 0.5 * solid.size[0]))]
    if solid.shape == "revolved":
        # The seam lies where planes of symmetry leave nothing: in one, edges of it and of the plane would coincide.
        section = _polygon([(x - r * sqrt(0.5), y - r * sqrt(0.5), z) for r, z in solid.outline])
        return [one for one in occ.revolve(section, x, y, 0.0, 0.0, 0.0, 1.0, 2.0 * pi) if one[0] == 3]
    along, across = solid.size
    return [(3, occ.addBox(x - 0.5 * along, y - 0.5 * across, -depth, along, across, 2.0 * depth))]


def gap_of_solids(one: SolidFloat, other: SolidFloat | Rectangle | Disc) -> float:
    """Return the least distance, m, of the wetted parts of two floats, or of a float and a column; 0 where they
    meet."""
    with gmsh_model():
        if isinstance(other, SolidFloat):
            first, second = _wetted_part(one, other.bounds), _wetted_part(other, one.bounds)
        else:
            first, second = _wetted_part(one, bounds_of(other)), _prism(face(other), 2.0 * one.draught)
        gmsh.model.occ.synchronize()
        if _is_around(one, second) or (isinstance(other, SolidFloat) and _is_around(other, first)):
            return 0.0
        pairs = product(first, second)
        return min((float(gmsh.model.occ.getDistance(*a, *b)[0]) for a, b in pairs), default=inf)


def _is_triangulated(solid: SolidFloat) -> bool:
    return solid.hull is not None and solid.hull.is_triangulated


def _wetted_corners(solid: SolidFloat) -> FloatArray:
    """Corners of the wetted triangles of a hull, shape (triangles, 3, 3)."""
    assert solid.hull is not None
    triangles = wetted_triangles(solid.hull.file, solid.hull.level)
    return np.asarray(triangles.points[triangles.corners] + np.array([*solid.origin, 0.0]))


def _wetted_part(solid: SolidFloat, near: Bounds) -> Entities:
    """The wetted part of a float; of a hull of triangles, those of them over a part of the plan."""
    if _is_triangulated(solid):
        corners, (low, high) = _wetted_corners(solid), np.transpose(near)
        over = (corners.min(axis=1)[:, :2] <= high).all(axis=1) & (corners.max(axis=1)[:, :2] >= low).all(axis=1)
        return [made for triangle in corners[over].tolist() for made in _polygon(triangle)]
    body = float_solid(solid)
    left, front, low, right, back, _ = gmsh.model.occ.getBoundingBox(*body[0])
    pad = right - left
    lengths = (right - left + 2.0 * pad, back - front + 2.0 * pad, pad - low)
    below = gmsh.model.occ.addBox(left - pad, front - pad, low - pad, *lengths)
    return [one for one in gmsh.model.occ.intersect(body, [(3, below)])[0] if one[0] == 3]


def _is_around(solid: SolidFloat, parts: Entities) -> bool:
    """Whether a part of another body lies inside of a hull of triangles, of which only the surface is compared.

    The solid angle of the surface and of its image in the still level, 2 arctan(a·(b × c) / (abc + …)) of each triangle
    (Van Oosterom and Strackee 1983), is 4π inside.
    """
    if not _is_triangulated(solid) or not parts:
        return False
    (point, *_) = gmsh.model.getBoundary(parts[:1], combined=False, oriented=False, recursive=True)
    place = np.array(gmsh.model.getValue(*point, []))
    corners, angle = _wetted_corners(solid), 0.0
    for side in (1.0, -1.0):
        one, other, third = np.moveaxis(corners * [1.0, 1.0, side] - place, 1, 0)
        a, b, c = (np.linalg.norm(side_of, axis=1) for side_of in (one, other, third))
        below = a * b * c + (one * other).sum(1) * c + (other * third).sum(1) * a + (third * one).sum(1) * b
        angle += side * 2.0 * float(np.arctan2((one * np.cross(other, third)).sum(1), below).sum())
    return abs(angle) > 2.0 * pi


def require_inside(name: str, solids: Entities, liquid: Entities) -> None:
    """Refuse a float that is not inside of a liquid, or touches its walls or bed."""
    occ = gmsh.model.occ
    common = occ.intersect(solids, liquid, removeObject=False, removeTool=False)[0]
    faces = [face for _, solid in liquid for loop in occ.getSurfaceLoops(solid)[1] for face in loop]
    walls = [face for face in faces if np.abs(np.array(occ.getBoundingBox(2, face))[[2, 5]]).max() > _GAP]
    if not common or min(occ.getDistance(*one, 2, wall)[0] for one in solids for wall in walls) < _GAP:
        raise MisplacedError(f"{name.replace('_', ' ')} does not lie in the liquid, or touches the tank")
    occ.remove(common, recursive=True)


def kept(entities: Entities, tank: VolumeTank, mirrors: Mirrors) -> Entities:
    """The part above the planes of symmetry."""
    dim, far = entities[0][0], 10.0 + 4.0 * tank.depth
    for axis, mirror in enumerate(mirrors):
        if mirror is not None and entities:
            start = [-far, -far, -far]
            start[axis] = mirror
            half = [(3, gmsh.model.occ.addBox(*start, 2.0 * far, 2.0 * far, 2.0 * far))]
            entities = [one for one in gmsh.model.occ.intersect(entities, half)[0] if one[0] == dim]
    return entities


def box_around(entity: tuple[int, int]) -> np.ndarray:
    """Return the corners of a box around a part, shape (2, 3)."""
    return np.array(gmsh.model.getBoundingBox(*entity)).reshape(2, 3)


def faces_of(entities: Entities) -> set[int]:
    """Numbers of the faces of volumes, those between two of them too."""
    return {tag for _, tag in gmsh.model.getBoundary(entities, combined=False, oriented=False)}
