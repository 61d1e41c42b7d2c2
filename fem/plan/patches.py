"""Places on the still surface at which modes are sampled: triangles on the water and on each plate.

Patches that meet at an edge have points of their own there: the displacement of plate and water differ.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from hydroelastic.fem.level_bed.choice import level_model
from hydroelastic.fem.level_bed.resolution import breakpoints, plate_at
from hydroelastic.fem.level_bed.separation import Separation, separated
from hydroelastic.meshes.plan import plan_mesh
from hydroelastic.meshes.plan_regions import plan_regions
from hydroelastic.physics.arrays import FloatArray
from hydroelastic.physics.dofs import body_name
from hydroelastic.physics.level_tank import LevelTank

# Cells along the larger side of a plan.
_ALONG = 40
# Points are this part of a cell inside it, so that those at an edge are on their own side of it.
_INSIDE = 1e-5
# Cells along a line of orders and across it, of the whole plan.
_LINE_ALONG, _ACROSS = 60, 72
# Beside an edge on this line the water's points lie this part of a piece inside it.
_LINE_INSIDE = 1e-6


@dataclass(frozen=True, kw_only=True)
class Patch:
    """A piece of the still surface, dimensionless.

    Attributes:
        plate: index of the plate that covers it; ``None`` is water.
        points: x and y, shape (points, 2).
        triangles: numbers of their corners, shape (triangles, 3).
    """

    plate: int | None
    points: FloatArray
    triangles: np.ndarray


def level_patches(tank: LevelTank) -> tuple[Patch, ...]:
    """Return the water and the plates of a dimensionless tank, in whichever model."""
    if level_model(tank) == "orders":
        separation = separated(tank)
        assert separation is not None
        return _line_patches(separation)
    return tuple(replace(patch, points=_moved_inside(patch.points, patch.triangles)) for patch in _plan_patches(tank))


def _line_patches(separation: Separation) -> tuple[Patch, ...]:
    """Return the pieces between walls and edges of a tank whose orders separate."""
    whole = separation.end - separation.start
    across = np.linspace(0.0, 2.0 * np.pi if separation.round else separation.width, _ACROSS + 1)
    patches = []
    for left, right in pairwise(breakpoints(separation)):
        plate = plate_at(separation, 0.5 * (left + right))
        inside = 0.0 if plate is not None else _LINE_INSIDE * (right - left)
        count = max(4, round(_LINE_ALONG * (right - left) / whole))
        # Denser towards the edges, where the displacement changes quickly.
        along = left + inside + (right - left - 2.0 * inside) * 0.5 * (1.0 - np.cos(np.linspace(0.0, np.pi, count + 1)))
        first, second = np.meshgrid(along, across, indexing="ij")
        x, y = (first * np.cos(second), first * np.sin(second)) if separation.round else (first, second)
        numbers = np.arange(first.size).reshape(first.shape)
        corners = [numbers[:-1, :-1], numbers[1:, :-1], numbers[1:, 1:], numbers[:-1, 1:]]
        a, b, c, d = (corner.ravel() for corner in corners)
        patches.append(
            Patch(
                plate=plate,
                points=np.column_stack([x.ravel(), y.ravel()]),
                triangles=np.vstack([np.column_stack([a, b, c]), np.column_stack([a, c, d])]),
            )
        )
    return tuple(patches)


def _plan_patches(tank: LevelTank) -> list[Patch]:
    wall, plates = plan_regions(tank)
    mesh = plan_mesh(wall, plates, size=1.0 / _ALONG, layers=1, thickness=0.5 / _ALONG, geometry_degree=2)
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
