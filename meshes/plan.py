"""Plans of tanks: triangles with layers along the edges of plates, graded geometrically across them.

ψ has singularities r ln r at an edge and is smooth along it, so that only the distance from it is graded. Each outline
has bands of layers on both sides, made here: between mitred parallels of a polygon, between concentric circles of a
disc. gmsh fills what is left. At circles cells are curved; those of the bands have their nodes at polar coordinates,
for layers thinner than the sagitta of their arcs would else fold.
"""

from __future__ import annotations

from math import sqrt

import numpy as np

from hydroelastic.meshes.filling import gmsh_model
from hydroelastic.meshes.plan_arcs import curved_cells
from hydroelastic.meshes.plan_bands import Band, bands_around
from hydroelastic.meshes.plan_faces import faces_between, filled
from hydroelastic.meshes.plan_grid import are_rectangles, grid_mesh
from hydroelastic.meshes.plan_loops import (
    RATIO,
    UNGRADED,
    CircleLoop,
    Loop,
    Mirrors,
    PlanRegion,
    gaps_around,
    kept_by,
    room_between,
)
from hydroelastic.meshes.tagged_mesh import TaggedMesh

# Ratio of successive nodes' distances from a re-entrant corner of a wall.
_CORNER_RATIO = 0.4


def edges_of(wall: PlanRegion, plates: tuple[PlanRegion, ...]) -> tuple[Loop, ...]:
    """Return the edges of plates beside water: all, or none of a plate that covers the plan."""
    covered = any(plate.outside is wall.outside for plate in plates)
    return () if covered else tuple(loop for plate in plates for loop in plate.loops)


def plan_mesh(
    wall: PlanRegion,
    plates: tuple[PlanRegion, ...],
    *,
    size: float,
    layers: int,
    thickness: float,
    geometry_degree: int,
    mirrors: Mirrors = (None, None),
) -> TaggedMesh:
    """Triangulate a plan."""
    if are_rectangles(wall, plates):
        return grid_mesh(wall, plates, size=size, layers=layers, thickness=thickness, mirrors=mirrors)
    covered = any(plate.outside is wall.outside for plate in plates)
    edges, walls = edges_of(wall, plates), wall.loops
    thick = min(thickness, room_between(walls, edges))
    # What bands leave of the gap beside each edge: a wall has none.
    left = (gaps_around(walls, edges) - thick * np.array([1.0, 2.0])).min(axis=1, initial=np.inf)
    steps = thick * RATIO ** np.arange(layers)
    bands: list[Band] = []

    def add(loop: Loop, inside: str, outside: str, *, is_wall: bool) -> None:
        largest = size
        if isinstance(loop, CircleLoop) and not covered:
            # In what a gap leaves between bands cells are long: an arc leaves its chord at half the angle at which
            # such a cell's next side does.
            width = left.min(initial=np.inf) if is_wall else left[edges.index(loop)]
            largest = min(largest, sqrt(loop.radius * width))
        towards = UNGRADED if is_wall else thick * RATIO ** np.arange(max(layers - 2, 1))[::-1]
        bands.extend(
            bands_around(
                loop,
                sum(band.size for band in bands),
                mirrors=mirrors,
                size=largest,
                steps=steps[:0] if is_wall else steps,
                towards=towards,
                # ψ ~ r^(2/3) at a re-entrant corner of a wall; its cells are as long as they are wide.
                reentrant=0.5 * largest * _CORNER_RATIO ** np.arange(2 * layers + 2)[::-1] if is_wall else towards,
                inside=inside,
                outside=outside,
            )
        )

    water = plates[0].name if covered else wall.name
    add(wall.outside, water, "", is_wall=True)
    for hole in wall.inside:
        add(hole, "", water, is_wall=True)
    for plate in () if covered else plates:
        add(plate.outside, plate.name, wall.name, is_wall=False)
        for hole in plate.inside:
            add(hole, wall.name, plate.name, is_wall=False)
    corners = np.concatenate([loop.graded_corners for loop in walls])
    with gmsh_model():
        found = faces_between(wall, bands, mirrors)
        points, blocks = filled(found, size, corners[kept_by(mirrors, corners, 0.0)])
    named = [(face.name, block) for face, block in zip(found.faces, blocks, strict=True)]
    for band in bands:
        named += [(name, block) for name, block in zip((band.inside, band.outside), band.cells(), strict=True) if name]
    names = list(dict.fromkeys(name for name, _ in named))
    cells = np.concatenate([block for _, block in named])
    corner = points[cells]
    along, across = corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0]
    turned = along[:, 0] * across[:, 1] < along[:, 1] * across[:, 0]
    cells[turned] = cells[turned][:, ::-1]
    return TaggedMesh(
        points=points,
        cells=cells,
        cell_tags=np.concatenate([np.full(len(block), names.index(name)) for name, block in named]).astype(np.int32),
        facets=np.empty((0, 2), dtype=np.int64),
        facet_tags=np.empty(0, dtype=np.int32),
        cell_names={name: number for number, name in enumerate(names)},
        facet_names={},
        curved=curved_cells(points, cells, bands, geometry_degree),
    )
