"""The solids and faces of a tank in gmsh, by OpenCASCADE: its liquid, columns, floats, baffles and outlines."""

from __future__ import annotations

from math import atan, hypot, inf, pi

import gmsh
import numpy as np

from hydroelastic.meshes.hull_file import hull_solid
from hydroelastic.meshes.plan_loops import Mirrors
from hydroelastic.meshes.tagged_mesh import MisplacedError
from hydroelastic.meshes.volume_file import solid_of_file
from hydroelastic.physics.level_tank import Box, Cylinder, FilePlan, middle_of
from hydroelastic.physics.obstacles import Baffle, VerticalBaffle
from hydroelastic.physics.plate import Disc, Outline, Rectangle, Strip
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
    """A length beyond the extent of the tank."""
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
    """The part of a baffle in the liquid.

    Raises:
        MisplacedError: if there is none.
    """
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
        section = _polygon([(x + r, y, z) for r, z in solid.outline])
        return [one for one in occ.revolve(section, x, y, 0.0, 0.0, 0.0, 1.0, 2.0 * pi) if one[0] == 3]
    along, across = solid.size
    return [(3, occ.addBox(x - 0.5 * along, y - 0.5 * across, -depth, along, across, 2.0 * depth))]


def require_inside(name: str, solids: Entities, liquid: Entities) -> None:
    """Refuse a float that is not inside of a liquid, or touches its walls or bed.

    Raises:
        MisplacedError: if it does.
    """
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
