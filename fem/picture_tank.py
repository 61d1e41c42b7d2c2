"""One natural mode drawn into a rectangle of a page: potential, displacement vectors, displaced surfaces, walls."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hydroelastic.fem.picture_liquid import LiquidField, above, displacement_on_grid, iso_lines, moving
from hydroelastic.fem.picture_page import GREY, INK, WHITE, Page
from hydroelastic.fem.picture_shapes import Array, dashes
from hydroelastic.fem.picture_view import ModePicture, SurfaceCurve, View, colour_limit, iso_levels

BODY = "#d9660a"
BODY_EDGE = "#5c2a00"
FREE_SURFACE = "#0a58a8"
ISO_LINE = "#6e6a72"
ARROW = "#26262b"
WALL_STROKE = 5.0

_WALL = "#3c3c3c"
_WASH = "#bcd7ef"


@dataclass(frozen=True, kw_only=True)
class Frame:
    """Where the tank stands on the page.

    Attributes:
        left: page coordinate of x = 0.
        level: page coordinate of y = 0.
        per_metre: pixels per metre of x.
        stretch: vertical scale over horizontal scale.
        unit: pixels of the page's unit of line widths.
    """

    left: float
    level: float
    per_metre: float
    stretch: float
    unit: float

    def page(self, x: Array, y: Array) -> Array:
        """Page coordinates of points in m, shape (points, 2)."""
        return np.column_stack(
            [self.left + self.per_metre * x, self.level + self.stretch * self.per_metre * np.broadcast_to(y, x.shape)]
        )


def draw_tank(page: Page, picture: ModePicture, view: View, frame: Frame, *, colours: Array, spacing: float) -> None:
    """Draw a mode without axes and legend.

    Args:
        page: receives the drawing.
        picture: the mode.
        view: what is drawn.
        frame: where it is drawn.
        colours: of the potential from its negative to its positive limit, shape (colours, 3).
        spacing: pixels between displacement vectors; 0 for none.
    """
    field = _liquid_field(picture, view, frame)
    limit = colour_limit(picture)
    page.field(field, limit=limit, colours=colours)
    page.strokes(_iso_lines(field, limit, view), stroke=1.1 * frame.unit, colour=ISO_LINE, joined=True)
    _cover_below(page, field, view, frame)
    if spacing > 0:
        page.arrows(*_arrows(field, view, frame, spacing), stroke=2.0 * frame.unit, colour=ARROW)
    _draw_wash(page, picture, view, frame)
    _draw_walls(page, view, frame)
    start, end = frame.page(np.array([0.0, view.length]), np.zeros(2))
    level = dashes(tuple(start), tuple(end), dash=9 * frame.unit, gap=6 * frame.unit)
    page.strokes(level, stroke=1.4 * frame.unit, colour=INK)
    _draw_surfaces(page, picture, view, frame)


def _liquid_field(picture: ModePicture, view: View, frame: Frame) -> LiquidField:
    field = LiquidField(
        points=frame.page(picture.points[:, 0], picture.points[:, 1]),
        triangles=picture.triangles,
        potential=picture.potential,
        displacement=picture.displacement,
    )
    return above(field, _floor(view, frame)) if view.cut else field


def _floor(view: View, frame: Frame) -> float:
    """Page coordinate of the lowest drawn point of the liquid."""
    return float(frame.page(np.zeros(1), np.array([-view.depth]))[0, 1])


def _iso_lines(field: LiquidField, limit: float, view: View) -> Array:
    """Strokes along the lines of equal ψ, shape (strokes, 2, 2).

    They are left out where ψ hardly changes: rounding errors would decide on the course of ψ = 0 in still water.
    """
    return iso_lines(moving(field, 0.01 * limit / view.length), iso_levels(limit))


def _cover_below(page: Page, field: LiquidField, view: View, frame: Frame) -> None:
    """Wipe out what the triangles at the floor of a cut tank show below it."""
    if view.cut:
        floor, lowest = _floor(view, frame), float(field.points[field.triangles, 1].min())
        (left, _), (right, _) = frame.page(np.array([0.0, view.length]), np.zeros(1))
        low, high = (np.array([[left - 1.0, y], [right + 1.0, y]]) for y in (lowest - 1.0, floor))
        page.band(low, high, colour=WHITE)


def _arrows(field: LiquidField, view: View, frame: Frame, spacing: float) -> tuple[Array, Array]:
    """Centres and vectors in pixels of the displacement on a regular grid, stretched like the tank."""
    (left, bottom), (right, top) = frame.page(np.array([0.0, view.length]), np.array([-view.depth, 0.0]))
    columns, rows = max(round((right - left) / spacing), 2), max(round((top - bottom) / spacing), 2)
    x = left + (right - left) * (np.arange(columns) + 0.5) / columns
    y = bottom + (top - bottom) * (np.arange(rows) + 0.5) / rows
    centres, displacement = displacement_on_grid(field, x, y)
    vectors = drawn_vectors(displacement * [1.0, frame.stretch], spacing)
    seen = np.hypot(*vectors.T) > 0.1 * spacing
    return centres[seen], vectors[seen]


def drawn_vectors(vectors: Array, spacing: float) -> Array:
    """Vectors of shape (vectors, 2) scaled to the spacing of their grid, with an upper limit of the length.

    ∇ψ grows without bound towards the tips of a body: the 90 % quantile of the lengths gets nearly the spacing, and
    longer vectors are shortened to it.
    """
    length = np.hypot(*vectors.T)
    if not length.any():
        return np.zeros_like(vectors)
    reference = np.quantile(length, 0.9) or length.max()
    return 0.95 * spacing * vectors / np.maximum(length, reference)[:, None]


def _displaced(curve: SurfaceCurve, view: View, frame: Frame) -> Array:
    return frame.page(curve.x, view.surface_scale * curve.displacement)


def _draw_wash(page: Page, picture: ModePicture, view: View, frame: Frame) -> None:
    """Tint the liquid that rose above the still level, and fade the field where the surface fell below it."""
    for colour, sign, opacity in ((_WASH, 1.0, 0.55), (WHITE, -1.0, 0.5)):
        for curve in picture.surfaces:
            height = sign * np.maximum(sign * view.surface_scale * curve.displacement, 0.0)
            if height.any():
                level, surface = frame.page(curve.x, np.zeros(1)), frame.page(curve.x, height)
                page.band(level, surface, colour=colour, opacity=opacity)


def _draw_walls(page: Page, view: View, frame: Frame) -> None:
    unit = frame.unit
    wall = WALL_STROKE * unit
    (left, bottom), (right, top) = frame.page(np.array([0.0, view.length]), np.array([-view.depth, view.headroom]))
    edge = 0.5 * wall
    sides = [[[x, bottom], [x, top]] for x in (left - edge, right + edge)]
    page.strokes(np.array(sides), stroke=wall, colour=_WALL)
    if view.cut:
        page.strokes(
            dashes((left, bottom), (right, bottom), dash=3 * unit, gap=6 * unit), stroke=1.5 * unit, colour=GREY
        )
    else:
        page.strokes(
            np.array([[[left - wall, bottom - edge], [right + wall, bottom - edge]]]), stroke=wall, colour=_WALL
        )


def _draw_surfaces(page: Page, picture: ModePicture, view: View, frame: Frame) -> None:
    """Free surfaces first: a body's ends cover theirs."""
    unit = frame.unit
    for curve in picture.surfaces:
        if curve.kind == "free_surface":
            page.ribbon(_displaced(curve, view, frame), stroke=7.0 * unit, colour=WHITE)
            page.ribbon(_displaced(curve, view, frame), stroke=4.5 * unit, colour=FREE_SURFACE)
    for curve in picture.surfaces:
        if curve.kind == "body":
            page.ribbon(_displaced(curve, view, frame), stroke=15.0 * unit, colour=BODY_EDGE)
            page.ribbon(_displaced(curve, view, frame), stroke=11.0 * unit, colour=BODY)
