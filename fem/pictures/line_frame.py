"""Where a line in space stands on a page, and the box around it with its scales."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import product

import numpy as np

from hydroelastic.fem.pictures.canvas import Horizontal, Vertical
from hydroelastic.fem.pictures.line_view import Array, LineView
from hydroelastic.fem.pictures.page import GREY, INK, Page
from hydroelastic.fem.pictures.ticks import tick_labels

_GRID = "#d4d4d8"
# From where a line that leaves the plane is seen: from the left in front, and from above.
_SIGHT = np.array([-0.55, -1.0, 0.45])
# The scale of y is left out where its labels would cover each other: where it is shorter, in pixels of a unit.
_SHORTEST_AXIS = 60.0
# Labels begin or end beside ticks that point to a side by more than this part, and stand below or at others.
_ASLANT = 0.15


@dataclass(frozen=True, kw_only=True)
class LineFrame:
    """A parallel projection with the same scale in all directions.

    Attributes:
        right: direction in space that points to the right on the page, shape (3,).
        up: direction in space that points upwards on the page.
        origin: page coordinates of the origin in space, shape (2,).
        per_metre: pixels per metre of both.
        unit: pixels of the page's unit of line widths.
    """

    right: Array
    up: Array
    origin: Array
    per_metre: float
    unit: float

    def page(self, points: Array) -> Array:
        """Page coordinates of points or, without the origin's, of vectors in m, shape (n, 3) to (n, 2)."""
        return self.origin + self.vectors(points)

    def vectors(self, vectors: Array) -> Array:
        """Vectors in pixels of vectors in m, shape (n, 3) to (n, 2)."""
        return self.per_metre * np.column_stack([vectors @ self.right, vectors @ self.up])


def line_frame(view: LineView, *, width: float, highest: float, left: float, bottom: float, unit: float) -> LineFrame:
    """Fit a view into a width and a height in pixels, centred above the left end of its room and its bottom."""
    right, up = _directions(view)
    corners = np.array(list(product(*zip(view.low, view.high, strict=True))))
    across, upwards = corners @ right, corners @ up
    per_metre = min(width / np.ptp(across), highest / np.ptp(upwards))
    start = left + 0.5 * (width - per_metre * np.ptp(across))
    return LineFrame(
        right=right,
        up=up,
        origin=np.array([start - per_metre * across.min(), bottom - per_metre * upwards.min()]),
        per_metre=float(per_metre),
        unit=unit,
    )


def drawn_height(view: LineView, *, width: float, highest: float) -> float:
    """Height in pixels of a view fitted into a width and a height."""
    corners = np.array(list(product(*zip(view.low, view.high, strict=True))))
    across, upwards = (np.ptp(corners @ direction) for direction in _directions(view))
    return float(min(width * upwards / across, highest))


def _directions(view: LineView) -> tuple[Array, Array]:
    if view.flat:
        return np.array([1.0, 0.0, 0.0]), np.array([0.0, 0.0, 1.0])
    towards = -_SIGHT / np.linalg.norm(_SIGHT)
    right = np.cross(towards, [0.0, 0.0, 1.0])
    right /= np.linalg.norm(right)
    return right, np.cross(right, towards)


def draw_box(page: Page, view: LineView, frame: LineFrame) -> None:
    """Grids on the far sides of the box, ticks and labels of its axes in metres."""
    low, high = view.low, view.high
    grid = [*_grid(view, (0, 2), 1, high[1])]
    if not view.flat:
        grid += [*_grid(view, (1, 2), 0, high[0]), *_grid(view, (0, 1), 2, low[2])]
    strokes = np.array([frame.page(np.array(ends)) for ends in grid])
    page.strokes(strokes, stroke=1.4 * frame.unit, colour=_GRID)
    _axis(page, view, frame, 0, np.array([0.0, low[1], low[2]]), 1.0)
    if not view.flat:
        _axis(page, view, frame, 1, np.array([low[0], 0.0, low[2]]), -1.0)
    _axis(page, view, frame, 2, np.array([low[0], high[1], 0.0]), -1.0)


def _grid(view: LineView, axes: tuple[int, int], normal: int, at: float) -> list[list[Array]]:
    """Both ends of the lines at the ticks of two axes and at the edge, on a side of the box."""
    lines = []
    for own, other in (axes, axes[::-1]):
        # The box begins where the line does, which may be between two ticks.
        for tick in (view.low[own], *view.ticks(own)):
            ends = np.empty((2, 3))
            ends[:, own], ends[:, normal], ends[:, other] = tick, at, (view.low[other], view.high[other])
            lines.append([*ends])
    return lines


def _axis(page: Page, view: LineView, frame: LineFrame, axis: int, base: Array, side: float) -> None:
    """An axis with ticks and labels away from the box, the name turned along it.

    Args:
        page: receives them.
        view: what is drawn.
        frame: where it is drawn.
        axis: 0, 1 or 2.
        base: a point of the axis at the coordinate 0.
        side: 1 if the box lies to the left of the axis' direction on the page, −1 if to the right.
    """
    unit = frame.unit
    ticks = view.ticks(axis)
    points = base + ticks[:, None] * np.eye(3)[axis]
    places = frame.page(points)
    edges = frame.page(base + np.array([[view.low[axis]], [view.high[axis]]]) * np.eye(3)[axis])
    along = edges[1] - edges[0]
    length = float(np.hypot(*along))
    outwards = side * np.array([along[1], -along[0]]) / length
    page.strokes(edges[None], stroke=1.6 * unit, colour=GREY)
    page.strokes(np.stack([places, places + 8 * unit * outwards], axis=1), stroke=1.6 * unit, colour=INK)
    labels = tick_labels(ticks)
    if length < _SHORTEST_AXIS * unit * len(ticks):
        # Both ends say enough.
        labels = [label if place in (0, len(labels) - 1) else "" for place, label in enumerate(labels)]
    horizontal: Horizontal = "left" if outwards[0] > _ASLANT else "right" if outwards[0] < -_ASLANT else "center"
    vertical: Vertical = "top" if outwards[1] < -_ASLANT else "center"
    for place, label in zip(places, labels, strict=True):
        x, y = place + 14 * unit * outwards
        page.text((x, y), label, size=21 * unit, horizontal=horizontal, vertical=vertical)
    widest = max(page.text_width(label, 21 * unit) for label in labels)
    # Beyond the labels in the direction away from the box.
    beyond = 14 * unit + abs(outwards[0]) * widest + abs(outwards[1]) * 21 * unit + 26 * unit
    x, y = edges.mean(axis=0) + beyond * outwards
    angle = float(np.degrees(np.arctan2(along[1], along[0])))
    page.text((x, y), f"{'xyz'[axis]} (m)", size=23 * unit, angle=angle if angle <= 90.0 else angle - 180.0)
