"""Places on the still surface of boxes and plans at which modes are sampled: triangles on the water and each plate."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise, product

import numpy as np

from hydroelastic.fem.level_bed.choice import level_model
from hydroelastic.fem.level_bed.patches import Patch, line_patches
from hydroelastic.fem.level_bed.separation import separated
from hydroelastic.fem.plan.rectangle_body import rectangle_of
from hydroelastic.meshes.plan import plan_mesh
from hydroelastic.meshes.plan_regions import plan_regions
from hydroelastic.physics.arrays import FloatArray
from hydroelastic.physics.dofs import body_name
from hydroelastic.physics.level_tank import Box, LevelTank

# Cells along the larger side of a plan.
_ALONG = 40
# Points are this part of a cell inside it, so that those at an edge are on their own side of it.
_INSIDE = 1e-5


def level_patches(tank: LevelTank) -> tuple[Patch, ...]:
    """Return the water and the plates of a dimensionless tank, in whichever model."""
    model = level_model(tank)
    if model == "orders":
        separation = separated(tank)
        assert separation is not None
        return line_patches(separation)
    patches = _box_patches(tank) if model == "box" else _plan_patches(tank)
    return tuple(replace(patch, points=_moved_inside(patch.points, patch.triangles)) for patch in patches)


def _box_patches(tank: LevelTank) -> list[Patch]:
    """Rectangles between the lines through the edges of all plates."""
    assert isinstance(tank.plan, Box)
    sides = (tank.plan.length, tank.plan.width)
    outlines = [rectangle_of(plate.outline) for plate in tank.plates]
    lines = []
    for axis, side in enumerate(sides):
        places = {0.0, side}
        for outline in outlines:
            middle, half = outline.position[axis], 0.5 * outline.size[axis]
            places |= {place for place in (middle - half, middle + half) if 1e-9 < place < side - 1e-9}
        lines.append(sorted(places))
    patches = []
    for (left, right), (low, high) in product(*map(pairwise, lines)):
        counts = [max(3, round(_ALONG * (end - start) / max(sides))) for start, end in ((left, right), (low, high))]
        # Denser towards the edges, where the displacement changes quickly.
        along, across = (0.5 * (1.0 - np.cos(np.linspace(0.0, np.pi, count + 1))) for count in counts)
        x, y = np.meshgrid(left + (right - left) * along, low + (high - low) * across, indexing="ij")
        numbers = np.arange(x.size).reshape(x.shape)
        a, b, c, d = (part.ravel() for part in (numbers[:-1, :-1], numbers[1:, :-1], numbers[1:, 1:], numbers[:-1, 1:]))
        middle_x, middle_y = 0.5 * (left + right), 0.5 * (low + high)
        under = [
            index
            for index, outline in enumerate(outlines)
            if abs(middle_x - outline.position[0]) < 0.5 * outline.size[0]
            and abs(middle_y - outline.position[1]) < 0.5 * outline.size[1]
        ]
        patches.append(
            Patch(
                plate=under[0] if under else None,
                points=np.column_stack([x.ravel(), y.ravel()]),
                triangles=np.vstack([np.column_stack([a, b, c]), np.column_stack([a, c, d])]),
                shape=(x.shape[0], x.shape[1]),
            )
        )
    return patches


def _plan_patches(tank: LevelTank) -> list[Patch]:
    wall, plates = plan_regions(tank)
    mesh = plan_mesh(wall, plates, size=lambda _: 1.0 / _ALONG, layers=1, thickness=0.5 / _ALONG, geometry_degree=2)
    patches = []
    plate_of = {body_name(index + 1): index for index in range(len(plates))}
    for name, tag in mesh.cell_names.items():
        cells = mesh.cells[mesh.cell_tags == tag]
        used, triangles = np.unique(cells, return_inverse=True)
        patches.append(
            Patch(
                plate=plate_of.get(name),
                points=mesh.points[used],
                triangles=triangles.reshape(-1, 3),
                shape=(len(used), 1),
            )
        )
    return patches


def _moved_inside(points: FloatArray, triangles: np.ndarray) -> FloatArray:
    """Move each point towards the middle of the triangles around it."""
    middles = np.repeat(points[triangles].mean(axis=1), 3, axis=0)
    sums, counts = np.zeros_like(points), np.zeros(len(points))
    np.add.at(sums, triangles.ravel(), middles)
    np.add.at(counts, triangles.ravel(), 1.0)
    moved: FloatArray = points + _INSIDE * (sums / counts[:, None] - points)
    return moved
