"""The mesh of the liquid of a scaled tank on one process, by gmsh, and the check of a user mesh. No dolfinx."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from hydroelastic.fem.closed.outline import tank_outline, unsized
from hydroelastic.fem.tank.resolution import Resolution, sharpest_exponent
from hydroelastic.fem.tank.singularities import tank_singular_points
from hydroelastic.meshes.geometry import FREE_SURFACE, LID, LIQUID, TankGeometry, tank_geometry
from hydroelastic.meshes.grading import Grading
from hydroelastic.meshes.outline import GradedPoint, Outline
from hydroelastic.meshes.tagged_mesh import MeshError, TaggedMesh
from hydroelastic.physics.dofs import body_name
from hydroelastic.physics.tank import Tank

# Largest deviation of a user mesh from the scene, by rounding in files, in tank lengths.
_MESH_ROUNDING = 1e-6


def geometry_of(tank: Tank, *, half: bool = False) -> TankGeometry:
    """Return the outline of a tank with one liquid and no floats, or of its left half, with the names of its top."""
    rest = LID if tank.top == "rigid" else FREE_SURFACE
    length = 0.5 if half else 1.0
    pieces = tuple(
        (piece.start, min(piece.end, length), rest if piece.body is None else body_name(piece.body + 1))
        for piece in tank.pieces
        if piece.start < length
    )
    return tank_geometry(length=length, depth=tank.depth, pieces=pieces, mirrored=half)


def make_mesh(
    tank: Tank, resolution: Resolution, *, half: bool = False, infinite_frequency: bool = False
) -> TaggedMesh:
    """Mesh a scaled tank, or its left half, with gmsh; in units of the tank."""
    # gmsh takes a third of a second to import, and a scene with a user mesh does not need it.
    if is_plain(tank):
        from hydroelastic.meshes.tank import build_tank_mesh

        geometry = geometry_of(tank, half=half)
        grading = Grading(
            surface_sizes=resolution.surface_sizes[: len(geometry.segments)],
            bulk_size=resolution.bulk_size,
            tip_size=resolution.tip_size,
            ring_ratio=resolution.ring_ratio,
        )
        return build_tank_mesh(geometry, grading)
    from hydroelastic.meshes.build import build_mesh

    curved = tank.bed == "sphere" or any(not hull.is_thin for hull in tank.hulls.values())
    return build_mesh(
        graded_outline(tank, resolution, half=half, infinite_frequency=infinite_frequency),
        bulk_size=resolution.bulk_size,
        ring_ratio=resolution.ring_ratio,
        geometry_degree=resolution.degree if curved else 1,
    )


def graded_outline(tank: Tank, resolution: Resolution, *, half: bool, infinite_frequency: bool) -> Outline:
    """Return the outline of a tank with graded points at its singular points, graded according to their exponents."""
    sizes = resolution.surface_sizes
    outline = tank_outline(tank, sizes, half=half, joined=infinite_frequency)
    if resolution.tip_size is None:
        return outline
    exponent = sharpest_exponent(tank, infinite_frequency=infinite_frequency)
    depth = resolution.tip_size / resolution.ring_size
    points = tank_singular_points(tank, sizes, half=half, infinite_frequency=infinite_frequency)
    graded_points = tuple(
        GradedPoint(
            point=point.point,
            inner=min(resolution.ring_size, point.grading_distance) * depth ** (exponent / point.exponent),
            outer=min(point.grading_distance, 0.45 * tank.depth),
        )
        for point in points
    )
    return replace(outline, graded_points=graded_points)


def tip_points(tank: Tank, *, half: bool, infinite_frequency: bool = False) -> np.ndarray:
    """Return the points towards which meshes of a tank are graded, in units of the tank, shape (points, 2)."""
    if is_plain(tank):
        return np.array([[tip, 0.0] for tip in geometry_of(tank, half=half).tips]).reshape(-1, 2)
    points = tank_singular_points(tank, unsized(tank), half=half, infinite_frequency=infinite_frequency)
    return np.array([point.point for point in points]).reshape(-1, 2)


def is_plain(tank: Tank) -> bool:
    """Whether the liquid is a single rectangle, with beams without joints or steps on its top."""
    if tank.geometry.is_revolved or tank.bed is not None:
        return False
    return len(tank.layers) == 1 and not tank.hulls and not any(body.nodes for body in tank.bodies)


def unknown_count(points: int, triangles: int, degree: int, *, parts: int = 1) -> int:
    """Number of unknowns of a continuous polynomial of a degree on simply connected meshes of triangles.

    With each triangle divided into n², a mesh has as many unknowns as the original one at n times the degree.
    """
    edges = points + triangles - parts
    return points + (degree - 1) * edges + (degree - 1) * (degree - 2) // 2 * triangles


def check_mesh(tank: Tank, tagged: TaggedMesh) -> None:
    """Check names and extents of a mesh against the scene."""
    geometry = geometry_of(tank)
    names = dict.fromkeys(segment.name for segment in geometry.segments)
    tagged.require(cells=(LIQUID,), facets=names)
    low, high = tagged.points.min(axis=0), tagged.points.max(axis=0)
    expected = np.array([0.0, -tank.depth, 1.0, 0.0])
    if np.abs(np.concatenate([low, high]) - expected).max() > _MESH_ROUNDING:
        raise MeshError(
            f"the mesh fills {low[0]:g} < x/L < {high[0]:g}, {low[1]:g} < y/L < {high[1]:g}; "
            f"the scene's liquid fills 0 < x/L < 1, {-tank.depth:g} < y/L < 0; its lengths are taken in metres"
        )
    _check_nodes(tank, tagged)
    pieces = {name: [piece for piece in geometry.segments if piece.name == name] for name in names}
    for name, segments in pieces.items():
        _check_extent(tagged, name, min(piece.start for piece in segments), max(piece.end for piece in segments))
    for name, segments in pieces.items():
        _check_length(tagged, name, sum(piece.end - piece.start for piece in segments))


def _check_nodes(tank: Tank, tagged: TaggedMesh) -> None:
    for index in range(len(tank.bodies)):
        name = body_name(index + 1)
        x = tagged.facet_nodes(name)[:, 0]
        for place in tank.nodes_of(index):
            if np.abs(x - place).min() > _MESH_ROUNDING:
                raise MeshError(
                    f"group {name} of the mesh has no node at x/L = {place:g}, where the beam has a joint or a step"
                )


def _check_extent(tagged: TaggedMesh, name: str, start: float, end: float) -> None:
    x, y = tagged.facet_nodes(name).T
    if max(abs(x.min() - start), abs(x.max() - end), np.abs(y).max()) > _MESH_ROUNDING:
        raise MeshError(
            f"group {name} of the mesh spans {x.min():g} < x/L < {x.max():g}; "
            f"the scene puts it at {start:g} < x/L < {end:g} on y = 0"
        )


def _check_length(tagged: TaggedMesh, name: str, length: float) -> None:
    missing = length - tagged.facet_measure(name)
    if abs(missing) > _MESH_ROUNDING:
        raise MeshError(
            f"the edges of group {name} of the mesh are {abs(missing):g} tank lengths too "
            f"{'short' if missing > 0 else 'long'} for the scene: some are not in the group, or wrongly in it"
        )
