"""Hulls of triangles in gmsh: their surface is parametrized, so that it can be meshed anew at any size.

The surface is divided at its sharp edges. It is joined to a liquid of OpenCASCADE by a still surface with the hull's
waterlines as holes; the liquid below gets the hull as part of its boundary.
"""

from __future__ import annotations

from math import pi

import gmsh
import numpy as np

from hydroelastic.meshes.hull_file import wetted_triangles
from hydroelastic.meshes.tagged_mesh import MeshError, MisplacedError
from hydroelastic.meshes.volume_solids import box_around
from hydroelastic.physics.arrays import FloatArray
from hydroelastic.physics.solid_floats import SolidFloat

# Angle between triangles from which their common edge is an edge of the hull, and between pieces of a waterline.
_SHARP = 30.0 * pi / 180.0
# Numbers of parts of OpenCASCADE begin here, so that none of a hull has them too; those made of both have the second.
_FIRST, _JOINED = 100_000, 200_000
_TRIANGLE = 2
# Of each curve of a loop, when it is asked what lies inside.
_PIECES = 100


def add_hulls(floats: dict[str, SolidFloat]) -> dict[str, list[int]]:
    """Add the wetted surfaces of hulls to an empty model; return the numbers of their faces, by the hull's name."""
    if not floats:
        return {}
    mesh, count, every = gmsh.model.mesh, 1, {}
    for name, solid in floats.items():
        assert solid.hull is not None
        triangles = wetted_triangles(solid.hull.file, solid.hull.level)
        points = triangles.points / solid.hull.metres + np.array([*solid.origin, 0.0])
        tag = gmsh.model.addDiscreteEntity(2)
        mesh.addNodes(2, tag, np.arange(count, count + len(points)), points.ravel())
        mesh.addElementsByType(tag, _TRIANGLE, [], (triangles.corners + count).ravel())
        count += len(points)
        every[name] = points
    try:
        mesh.classifySurfaces(_SHARP, True, True, _SHARP)
        mesh.createGeometry()
    except Exception as error:  # gmsh raises bare Exception
        files = ", ".join(str(solid.hull.file) for solid in floats.values() if solid.hull)
        raise MeshError(
            f"the surface in {files} cannot be parametrized: give it as a solid (*.step), or mend and coarsen its "
            "triangles"
        ) from error
    found: dict[str, list[int]] = {name: [] for name in floats}
    for _, tag in gmsh.model.getEntities(2):
        (place, *_) = np.array(mesh.getNodes(2, tag, includeBoundary=True)[1]).reshape(-1, 3)
        nearest = min(every, key=lambda name: float(np.linalg.norm(every[name] - place, axis=1).min()))
        found[nearest].append(tag)
    for dim in range(-2, 4):
        gmsh.model.occ.setMaxTag(dim, _FIRST)
    # While these are there, each part that is made has a larger number than they.
    far = 1e3
    gmsh.model.occ.addBox(far, far, far, 1.0, 1.0, 1.0, _FIRST)
    return found


def release_numbers() -> None:
    """Remove what keeps the numbers of hulls from being given again, before the model is synchronized."""
    gmsh.model.occ.remove([(3, _FIRST)], recursive=True)


def join_hulls(liquid: int, surfaces: list[int], hulls: dict[str, list[int]]) -> tuple[int, list[int], int]:
    """Replace a volume of OpenCASCADE by one that leaves out hulls."""
    geo, model = gmsh.model.geo, gmsh.model
    waterlines = [
        loop
        for faces in hulls.values()
        for loop in _loops([tag for _, tag in model.getBoundary([(2, tag) for tag in faces], oriented=False)])
    ]
    around = {face for face in surfaces for loop in waterlines if _holds(face, loop)}
    if len(around) != 1:
        raise MisplacedError("the waterline of a hull does not lie inside one part of the still surface")
    (replaced,) = around
    if any(not _holds(replaced, loop) for loop in waterlines):
        raise MisplacedError("the waterline of a hull is not inside the tank, or touches something else")
    rims = _loops([abs(tag) for _, tag in model.getBoundary([(2, replaced)], combined=False, oriented=False)])
    rims.sort(key=lambda loop: -float(np.ptp([box_around((1, tag)) for tag in loop], axis=(0, 1)).max()))
    boundary = [tag for _, tag in model.getBoundary([(3, liquid)], oriented=False) if tag != replaced]
    inside = {dim: model.mesh.getEmbedded(dim, tag) for dim, tag in ((2, replaced), (3, liquid))}
    still = [
        geo.addPlaneSurface([geo.addCurveLoop(loop) for loop in loops], _JOINED + number)
        for number, loops in enumerate(_waters(rims[0], rims[1:], waterlines))
    ]
    shell = [*boundary, *still, *(tag for faces in hulls.values() for tag in faces)]
    volume = geo.addVolume([geo.addSurfaceLoop(shell)], _JOINED)
    geo.synchronize()
    for dim, parent in ((2, still[0]), (3, volume)):
        for own in range(dim):
            tags = [tag for entity, tag in inside[dim] if entity == own]
            if tags:
                model.mesh.embed(own, tags, dim, parent)
    gmsh.model.occ.remove([(3, liquid), (2, replaced)])
    gmsh.model.occ.synchronize()
    return volume, still, replaced


def _waters(rim: list[int], holes: list[list[int]], waterlines: list[list[int]]) -> list[list[list[int]]]:
    """The loops of each part of the still surface, the outer one first: around all hulls, and in each moonpool.

    A waterline in an odd number of others is the rim of a moonpool; all else inside of it belongs to its water.
    """
    lines = [_polyline(loop) for loop in waterlines]

    def around(loop: list[int]) -> list[int]:
        place = _polyline(loop)[0, 0]
        return [number for number, line in enumerate(lines) if waterlines[number] != loop and _encloses(line, place)]

    pools = {number for number, loop in enumerate(waterlines) if len(around(loop)) % 2}
    waters = {-1: [rim], **{number: [waterlines[number]] for number in sorted(pools)}}
    for loop in (*holes, *(loop for number, loop in enumerate(waterlines) if number not in pools)):
        # The innermost of those around it lies in the most others.
        owner = max(pools.intersection(around(loop)), key=lambda number: len(around(waterlines[number])), default=-1)
        waters[owner].append(loop)
    return list(waters.values())


def _polyline(loop: list[int]) -> FloatArray:
    """Starts and ends of short pieces of curves in the plan, shape (pieces, 2, 2)."""
    pieces = []
    for tag in loop:
        (first,), (last,) = gmsh.model.getParametrizationBounds(1, tag)
        places = np.array(gmsh.model.getValue(1, tag, np.linspace(first, last, _PIECES + 1).tolist())).reshape(-1, 3)
        pieces.append(np.stack([places[:-1, :2], places[1:, :2]], axis=1))
    return np.concatenate(pieces)


def _encloses(line: FloatArray, place: FloatArray) -> bool:
    """Whether a ray from a place crosses the pieces of a closed line an odd number of times."""
    start, end = np.moveaxis(line - place, 1, 0)
    passes = (start[:, 1] > 0.0) != (end[:, 1] > 0.0)
    (x, y), (along, across) = start[passes].T, (end - start)[passes].T
    return bool(np.count_nonzero(x - y * along / across > 0.0) % 2)


def _holds(face: int, loop: list[int]) -> bool:
    points: list[FloatArray] = [np.array(gmsh.model.mesh.getNodes(1, tag, True)[1]) for tag in loop]
    places = np.concatenate(points)
    return bool(gmsh.model.isInside(2, face, places.tolist()) == len(places) // 3)


def _loops(curves: list[int]) -> list[list[int]]:
    ends = {tag: {point for _, point in gmsh.model.getBoundary([(1, tag)], oriented=False)} for tag in set(curves)}
    loops = []
    while ends:
        first, reached = ends.popitem()
        loop = [first]
        while more := next((tag for tag, points in ends.items() if points & reached), None):
            reached = ends.pop(more)
            loop.append(more)
        loops.append(loop)
    return loops
