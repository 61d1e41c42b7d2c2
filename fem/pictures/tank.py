"""One natural mode drawn into a rectangle of a page: potential, displacement vectors, displaced surfaces, walls."""

from __future__ import annotations

import numpy as np

from hydroelastic.fem.pictures.floats import BODY, BODY_EDGE, draw_displaced, draw_resting, up_to_floats
from hydroelastic.fem.pictures.frame import Frame
from hydroelastic.fem.pictures.liquid import LiquidField, between, displacement_on_grid, iso_lines, steep
from hydroelastic.fem.pictures.mode import ModePicture, SurfaceCurve
from hydroelastic.fem.pictures.page import GREY, INK, WHITE, Page
from hydroelastic.fem.pictures.shapes import Array, dashes
from hydroelastic.fem.pictures.view import View, colour_limit, iso_levels

FREE_SURFACE = "#0a58a8"
INTERFACE = "#00747c"
ISO_LINE = "#6e6a72"
ARROW = "#26262b"
WALL_STROKE = 5.0

_WALL = "#3c3c3c"
LOWER_WASH = "#bcd7ef"
UPPER_WASH = "#f0dca4"


def draw_tank(
    page: Page,
    picture: ModePicture,
    view: View,
    frame: Frame,
    *,
    colours: Array,
    spacing: float,
    largest: ModePicture | None = None,
) -> None:
    """Draw a mode without axes and legend.

    Args:
        page: receives the drawing.
        picture: the mode, or an instant of its motion.
        view: what is drawn.
        frame: where it is drawn.
        colours: of the field from its negative to its positive limit, shape (colours, 3).
        spacing: pixels between displacement vectors; 0 for none.
        largest: what gives the scales of colours and vectors; the picture itself by default.
    """
    field = _liquid_field(picture, view, frame)
    limit = colour_limit(largest or picture)
    page.field(field, limit=limit, colours=colours)
    page.strokes(_iso_lines(field, picture, limit, view), stroke=1.1 * frame.unit, colour=ISO_LINE, joined=True)
    _cover_outside(page, field, view, frame)
    if spacing > 0:
        longest = field if largest is None else _liquid_field(largest, view, frame)
        page.arrows(*_arrows(field, longest, view, frame, spacing), stroke=2.0 * frame.unit, colour=ARROW)
    surfaces = tuple(up_to_floats(curve, picture.floats, view.surface_scale, frame) for curve in picture.surfaces)
    _draw_wash(page, picture, surfaces, view, frame)
    for section in picture.floats:
        draw_resting(page, section, frame)
    _draw_walls(page, picture, view, frame)
    _draw_still_levels(page, picture, view, frame)
    _draw_surfaces(page, surfaces, view, frame)
    for section in picture.floats:
        draw_displaced(page, section, view.surface_scale, frame)


def _liquid_field(picture: ModePicture, view: View, frame: Frame) -> LiquidField:
    field = LiquidField(
        points=frame.page(picture.points[:, 0], picture.points[:, 1]),
        triangles=picture.triangles,
        potential=picture.drawn_field,
        displacement=picture.displacement,
    )
    if not (view.cut or view.upper_cut):
        return field
    low, high = _extent(view, frame)
    return between(field, low if view.cut else -np.inf, high if view.upper_cut else np.inf)


def _extent(view: View, frame: Frame) -> tuple[float, float]:
    """Page coordinates of the lowest and the highest drawn point of the liquids."""
    low, high = frame.page(np.zeros(2), np.array([-view.depth, view.upper_depth]))[:, 1]
    return float(low), float(high)


def _iso_lines(field: LiquidField, picture: ModePicture, limit: float, view: View) -> Array:
    """Strokes along the lines of equal ψ, or ρψ, shape (strokes, 2, 2).

    They are left out where it hardly changes: rounding errors would decide on the course of ψ = 0 in still water.
    """
    steepness = picture.weight * np.hypot(*picture.displacement.T)
    return iso_lines(steep(field, steepness, 0.01 * limit / view.length), iso_levels(limit))


def _cover_outside(page: Page, field: LiquidField, view: View, frame: Frame) -> None:
    """Wipe out what the triangles at the ends of a cut tank show beyond them."""
    if not (view.cut or view.upper_cut):
        return
    floor, ceiling = _extent(view, frame)
    ordinates = field.points[field.triangles, 1]
    (left, _), (right, _) = frame.page(np.array([0.0, view.length]), np.zeros(1))
    for cut, ends in ((view.cut, (ordinates.min() - 1.0, floor)), (view.upper_cut, (ceiling, ordinates.max() + 1.0))):
        if cut:
            low, high = (np.array([[left - 1.0, y], [right + 1.0, y]]) for y in ends)
            page.band(low, high, colour=WHITE)


def _arrows(field: LiquidField, longest: LiquidField, view: View, frame: Frame, spacing: float) -> tuple[Array, Array]:
    """Centres and vectors in pixels of the displacement on a regular grid, stretched like the tank.

    They are scaled like those of the longest displacements.
    """
    (left, _), (right, _) = frame.page(np.array([0.0, view.length]), np.zeros(1))
    bottom, top = _extent(view, frame)
    columns, rows = max(round((right - left) / spacing), 2), max(round((top - bottom) / spacing), 2)
    x = left + (right - left) * (np.arange(columns) + 0.5) / columns
    y = bottom + (top - bottom) * (np.arange(rows) + 0.5) / rows
    centres, displacement = displacement_on_grid(field, x, y)
    stretch = np.where(centres[:, 1] > frame.level, frame.upper_stretch, frame.stretch)
    stretches = np.column_stack([np.ones(len(stretch)), stretch])
    lengths = None
    if longest is not field:
        lengths = np.hypot(*(displacement_on_grid(longest, x, y)[1] * stretches).T)
    vectors = drawn_vectors(displacement * stretches, spacing, lengths)
    seen = np.hypot(*vectors.T) > 0.1 * spacing
    return centres[seen], vectors[seen]


def drawn_vectors(vectors: Array, spacing: float, lengths: Array | None = None) -> Array:
    """Vectors of shape (vectors, 2) scaled to the spacing of their grid, with an upper limit of the length.

    ∇ψ grows without bound towards the tips of a body: the 90 % quantile of the lengths gets nearly the spacing, and
    longer vectors are shortened to it. The lengths are those of the vectors, or of what they are an instant of.
    """
    length = np.hypot(*vectors.T) if lengths is None else lengths
    if not length.any():
        return np.zeros_like(vectors)
    reference = np.quantile(length, 0.9) or length.max()
    return 0.95 * spacing * vectors / np.maximum(length, reference)[:, None]


def _displaced(curve: SurfaceCurve, height: Array, view: View, frame: Frame) -> Array:
    """Page coordinates of a curve displaced by a height in the mode's arbitrary scale."""
    return frame.displaced(curve.x, np.full(len(curve.x), curve.level), np.zeros(1), view.surface_scale * height)


def _draw_wash(page: Page, picture: ModePicture, surfaces: tuple[SurfaceCurve, ...], view: View, frame: Frame) -> None:
    """Tint the liquid that passed a still level; where air came in, fade the field."""
    for sign in (1.0, -1.0):
        for curve in surfaces:
            height = sign * np.maximum(sign * curve.displacement, 0.0)
            if height.any():
                colour, opacity = _wash(picture, curve, sign)
                level, surface = (_displaced(curve, y, view, frame) for y in (np.zeros(len(height)), height))
                page.band(level, surface, colour=colour, opacity=opacity)


def _wash(picture: ModePicture, curve: SurfaceCurve, sign: float) -> tuple[str, float]:
    """Colour and opacity of what comes to the other side of a still level by rising or falling."""
    inner = not picture.is_at_top(curve)
    if sign > 0:
        return (LOWER_WASH if inner or not picture.has_two_liquids else UPPER_WASH), 0.55
    return (UPPER_WASH, 0.55) if inner else (WHITE, 0.5)


def _draw_walls(page: Page, picture: ModePicture, view: View, frame: Frame) -> None:
    unit = frame.unit
    wall = WALL_STROKE * unit
    edge = 0.5 * wall
    (left, bottom), (right, top) = frame.page(
        np.array([0.0, view.length]), np.array([-view.depth, view.upper_depth + view.headroom])
    )
    _, ceiling = _extent(view, frame)
    top = ceiling + wall if picture.lid else top
    if "sides" in picture.goes_on:
        for x in (left, right):
            page.strokes(dashes((x, bottom), (x, ceiling), dash=3 * unit, gap=6 * unit), stroke=1.5 * unit, colour=GREY)
    else:
        sides = [[[x, bottom], [x, top]] for x in (left - edge, right + edge)]
        page.strokes(np.array(sides), stroke=wall, colour=_WALL)
    if view.cut or "bottom" in picture.goes_on:
        page.strokes(_cut_edge(left, right, bottom, unit), stroke=1.5 * unit, colour=GREY)
    else:
        page.strokes(
            np.array([[[left - wall, bottom - edge], [right + wall, bottom - edge]]]), stroke=wall, colour=_WALL
        )
    if view.upper_cut or "top" in picture.goes_on:
        page.strokes(_cut_edge(left, right, ceiling, unit), stroke=1.5 * unit, colour=GREY)
        return
    for start, end in picture.lid:
        # Where a piece of the lid meets a wall, it joins it.
        first = left - wall if start <= 0.0 else left + frame.per_metre * start
        last = right + wall if end >= view.length else left + frame.per_metre * end
        page.strokes(np.array([[[first, ceiling + edge], [last, ceiling + edge]]]), stroke=wall, colour=_WALL)


def _cut_edge(left: float, right: float, y: float, unit: float) -> Array:
    """Strokes where the liquid goes on beyond what is drawn."""
    return dashes((left, y), (right, y), dash=3 * unit, gap=6 * unit)


def _draw_still_levels(page: Page, picture: ModePicture, view: View, frame: Frame) -> None:
    ordinates = [0.0]
    if picture.has_two_liquids and not view.upper_cut and view.headroom > 0:
        ordinates.append(view.upper_depth)
    for y in ordinates:
        start, end = frame.page(np.array([0.0, view.length]), np.full(2, y))
        level = dashes(tuple(start), tuple(end), dash=9 * frame.unit, gap=6 * frame.unit)
        page.strokes(level, stroke=1.4 * frame.unit, colour=INK)


def _draw_surfaces(page: Page, surfaces: tuple[SurfaceCurve, ...], view: View, frame: Frame) -> None:
    """Surfaces of liquids first: a body's ends cover theirs."""
    unit = frame.unit
    for curve in surfaces:
        if curve.kind != "body":
            line = _displaced(curve, curve.displacement, view, frame)
            page.ribbon(line, stroke=7.0 * unit, colour=WHITE)
            page.ribbon(line, stroke=4.5 * unit, colour=INTERFACE if curve.kind == "interface" else FREE_SURFACE)
    for curve in surfaces:
        if curve.kind == "body":
            line = _displaced(curve, curve.displacement, view, frame)
            page.ribbon(line, stroke=15.0 * unit, colour=BODY_EDGE)
            page.ribbon(line, stroke=11.0 * unit, colour=BODY)
