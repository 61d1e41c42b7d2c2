"""Places on the still surface at which modes are sampled: triangles on the water and on each plate.

Patches that meet at an edge have points of their own there: the displacement of plate and water differ.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from hydroelastic.fem.level_bed.resolution import breakpoints, plate_at
from hydroelastic.fem.level_bed.separation import Separation
from hydroelastic.physics.arrays import FloatArray

# Cells along the line and across it, of the whole plan.
_ALONG, _ACROSS = 60, 72
# Beside an edge the water's points lie this part of a piece inside it.
_INSIDE = 1e-6


@dataclass(frozen=True, kw_only=True)
class Patch:
    """A piece of the still surface, dimensionless.

    Attributes:
        plate: index of the plate that covers it; ``None`` is water.
        points: x and y, shape (points, 2).
        triangles: numbers of their corners, shape (triangles, 3).
        shape: number of points along the line and across it; the last of these is the fastest.
    """

    plate: int | None
    points: FloatArray
    triangles: np.ndarray
    shape: tuple[int, int]


def line_patches(separation: Separation) -> tuple[Patch, ...]:
    """Return the pieces between walls and edges of a tank whose orders separate."""
    whole = separation.end - separation.start
    across = np.linspace(0.0, 2.0 * np.pi if separation.round else separation.width, _ACROSS + 1)
    patches = []
    for left, right in pairwise(breakpoints(separation)):
        plate = plate_at(separation, 0.5 * (left + right))
        inside = 0.0 if plate is not None else _INSIDE * (right - left)
        count = max(4, round(_ALONG * (right - left) / whole))
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
                shape=(len(along), len(across)),
            )
        )
    return tuple(patches)
