"""Where a tank stands on a page: from metres to pixels."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hydroelastic.fem.pictures.mode import Array
from hydroelastic.fem.pictures.view import View


@dataclass(frozen=True, kw_only=True)
class Frame:
    """Where the tank stands on the page.

    Attributes:
        left: page coordinate of x = 0.
        level: page coordinate of y = 0.
        per_metre: pixels per metre of x.
        stretch: vertical scale over horizontal scale below y = 0.
        upper_stretch: the same in the upper liquid.
        rise: the same of displacements, and above the top.
        top: ordinate of the top in m.
        unit: pixels of the page's unit of line widths.
    """

    left: float
    level: float
    per_metre: float
    stretch: float
    upper_stretch: float
    rise: float
    top: float
    unit: float

    def page(self, x: Array, y: Array) -> Array:
        """Page coordinates of points in m, shape (points, 2)."""
        y = np.broadcast_to(y, x.shape)
        below, above = np.minimum(y, 0.0), np.maximum(y - self.top, 0.0)
        heights = self.stretch * below + self.upper_stretch * (y - below - above) + self.rise * above
        return np.column_stack([self.left + self.per_metre * x, self.level + self.per_metre * heights])

    def displaced(self, x: Array, y: Array, right: Array, up: Array) -> Array:
        """Page coordinates of points in m displaced by vectors in m, shape (points, 2)."""
        moved: Array = self.page(x, y) + self.per_metre * np.column_stack(
            [np.broadcast_to(right, x.shape), self.rise * np.broadcast_to(up, x.shape)]
        )
        return moved


def frame_of(view: View, *, left: float, bottom: float, per_metre: float, unit: float) -> Frame:
    """The frame of a view whose lowest drawn point is at a page coordinate."""
    return Frame(
        left=left,
        level=bottom + view.stretch * view.depth * per_metre,
        per_metre=per_metre,
        stretch=view.stretch,
        upper_stretch=view.upper_stretch,
        rise=view.rise,
        top=view.upper_depth,
        unit=unit,
    )
