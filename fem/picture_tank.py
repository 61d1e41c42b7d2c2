"""One natural mode drawn into a rectangle of a page: potential, displacement vectors, displaced surfaces, walls."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from hydroelastic.fem.picture_page import (
    GREY,
    INK,
    Array,
    Page,
    arrow_triangles,
    band_triangles,
    dashes,
    triangle_mesh,
)
from hydroelastic.fem.picture_view import ModePicture, SurfaceCurve, View, colour_limit, iso_levels

if TYPE_CHECKING:
    import pyvista

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
    mesh = _liquid_mesh(picture, view, frame)
    limit = colour_limit(picture)
    page.field(mesh, values="potential", limit=limit, colours=colours)
    page.strokes(_iso_lines(mesh, limit, view), stroke=1.1 * frame.unit, colour=ISO_LINE)
    if spacing > 0:
        page.triangles(_arrows(mesh, view, frame, spacing), colour=ARROW)
    _draw_wash(page, picture, view, frame)
    _draw_walls(page, view, frame)
    start, end = frame.page(np.array([0.0, view.length]), np.zeros(2))
    level = dashes(tuple(start), tuple(end), dash=9 * frame.unit, gap=6 * frame.unit)
    page.strokes(level, stroke=1.4 * frame.unit, colour=INK)
    _draw_surfaces(page, picture, view, frame)


def _liquid_mesh(picture: ModePicture, view: View, frame: Frame) -> pyvista.PolyData:
    mesh = triangle_mesh(frame.page(picture.points[:, 0], picture.points[:, 1]), picture.triangles)
    mesh.point_data["potential"] = picture.potential
    mesh.point_data["displacement"] = picture.displacement
    if view.cut:
        floor = frame.page(np.zeros(1), np.array([-view.depth]))[0, 1]
        mesh = mesh.clip(normal=(0.0, -1.0, 0.0), origin=(0.0, floor, 0.0))
    return mesh


def _iso_lines(mesh: pyvista.PolyData, limit: float, view: View) -> Array:
    """Strokes along the lines of equal ψ, shape (strokes, 2, 2).

    They are left out where ψ hardly changes: rounding errors would decide on the course of ψ = 0 in still water.
    """
    if np.ptp(mesh.point_data["potential"]) == 0.0:
        return np.empty((0, 2, 2))
    lines = mesh.contour(isosurfaces=iso_levels(limit).tolist(), scalars="potential")
    if lines.n_cells == 0:
        return np.empty((0, 2, 2))
    ends = lines.lines.reshape(-1, 3)[:, 1:]
    gradient = np.hypot(*np.asarray(lines.point_data["displacement"], dtype=np.float64).T)
    certain = gradient[ends].max(axis=1) * view.length > 0.01 * limit
    return np.asarray(lines.points, dtype=np.float64)[ends[certain]][:, :, :2]


def _arrows(mesh: pyvista.PolyData, view: View, frame: Frame, spacing: float) -> Array:
    """Triangles of the displacement vectors on a regular grid, stretched like the tank."""
    import pyvista

    (left, bottom), (right, top) = frame.page(np.array([0.0, view.length]), np.array([-view.depth, 0.0]))
    columns, rows = max(round((right - left) / spacing), 2), max(round((top - bottom) / spacing), 2)
    x = left + (right - left) * (np.arange(columns) + 0.5) / columns
    y = bottom + (top - bottom) * (np.arange(rows) + 0.5) / rows
    grid = np.stack(np.meshgrid(x, y), axis=-1).reshape(-1, 2)
    probe = pyvista.PolyData(np.column_stack([grid, np.zeros(len(grid))])).sample(mesh)
    inside = np.asarray(probe.point_data["vtkValidPointMask"], dtype=bool)
    vectors = np.asarray(probe.point_data["displacement"], dtype=np.float64)[inside] * [1.0, frame.stretch]
    vectors = drawn_vectors(vectors, spacing)
    seen = np.hypot(*vectors.T) > 0.1 * spacing
    return arrow_triangles(grid[inside][seen], vectors[seen], stroke=2.0 * frame.unit)


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
    for colour, sign, opacity in ((_WASH, 1.0, 0.55), ("#ffffff", -1.0, 0.5)):
        for curve in picture.surfaces:
            height = sign * np.maximum(sign * view.surface_scale * curve.displacement, 0.0)
            if height.any():
                band = band_triangles(frame.page(curve.x, np.zeros(1)), frame.page(curve.x, height))
                page.triangles(band, colour=colour, opacity=opacity)


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
            page.ribbon(_displaced(curve, view, frame), stroke=7.0 * unit, colour="#ffffff")
            page.ribbon(_displaced(curve, view, frame), stroke=4.5 * unit, colour=FREE_SURFACE)
    for curve in picture.surfaces:
        if curve.kind == "body":
            page.ribbon(_displaced(curve, view, frame), stroke=15.0 * unit, colour=BODY_EDGE)
            page.ribbon(_displaced(curve, view, frame), stroke=11.0 * unit, colour=BODY)
