"""Lines in space as PNG files: a thread coloured by its tension, what holds it, what it carries, the stream beside."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from hydroelastic.fem.pictures.canvas import Canvas
from hydroelastic.fem.pictures.colours import magnitude_colours, rgb
from hydroelastic.fem.pictures.floats import BODY, BODY_EDGE
from hydroelastic.fem.pictures.gif import SECONDS, write_gif
from hydroelastic.fem.pictures.line_frame import LineFrame, draw_box, drawn_height, line_frame
from hydroelastic.fem.pictures.line_view import Array, LineView
from hydroelastic.fem.pictures.page import INK, WHITE, Page
from hydroelastic.fem.pictures.shapes import closed
from hydroelastic.fem.pictures.surroundings import (
    FOOTER,
    HEADING,
    REFERENCE_WIDTH,
    draw_colour_bar,
    draw_keys,
    write_caption,
    write_title,
)

_STREAM = "#56B4E9"
_SHADOW = "#c4c4ca"
_EDGE = "#2a2a2a"
# Length of the longest arrow of the stream, of the diagonal of the box.
_ARROW = 0.14
_THREAD, _HELD, _SHADOWED = "thread", "held end", "shadow straight below"


@dataclass(frozen=True, kw_only=True)
class DrawnLine:
    """A line and what is on it.

    Attributes:
        points: m, shape (n, 3).
        values: by which it is coloured, shape (n,).
        fixed: points that are held, shape (k, 3).
        bodies: points that carry something, shape (m, 3).
        title: above the picture.
        note: what else the caption says.
    """

    points: Array
    values: Array
    fixed: Array
    bodies: Array
    title: str
    note: str = ""


def draw_lines(view: LineView, lines: Sequence[DrawnLine], paths: Sequence[Path], *, width: int = 1600) -> None:
    """Draw pictures of one view with one window.

    Args:
        view: what stays the same.
        lines: one for each picture.
        paths: PNG files, as many.
        width: of the images in pixels.

    Raises:
        NoRendererError: no library of this computer can render.
    """
    with Canvas() as canvas:
        for line, path in zip(lines, paths, strict=True):
            _page(canvas, view, line, width).save(path)


def animate_line(
    view: LineView, lines: Sequence[DrawnLine], path: Path, *, width: int = 800, seconds: float = SECONDS
) -> None:
    """Draw pictures of one view as the pages of a GIF that repeats itself.

    Args:
        view: what stays the same.
        lines: one for each page, two or more.
        path: of the GIF file in an existing folder.
        width: of the image in pixels.
        seconds: that all pages together last.

    Raises:
        NoRendererError: no library of this computer can render.
    """
    with Canvas() as canvas:
        pages = [_page(canvas, view, line, width).pixels() for line in lines]
    kept = np.vstack([magnitude_colours()[::2], *map(rgb, (_STREAM, BODY, BODY_EDGE))])
    write_gif(pages, path, seconds=seconds, kept=kept)


def _page(canvas: Canvas, view: LineView, line: DrawnLine, width: int) -> Page:
    unit = width / REFERENCE_WIDTH
    left, right = 150 * unit, 60 * unit
    room = {"width": width - left - right, "highest": 0.62 * width}
    # The scales of a box seen from above stand lower than those of a plane.
    footer = FOOTER * unit if view.flat else (FOOTER + 20.0) * unit
    page = Page(canvas, width=width, height=round(footer + drawn_height(view, **room) + HEADING * unit))
    frame = line_frame(view, **room, left=left, bottom=footer, unit=unit)
    draw_box(page, view, frame)
    _draw_stream(page, view, frame)
    _draw_line(page, view, line, frame)
    write_title(page, line.title, unit)
    draw_keys(page, _names(view, line), _draw_key, unit, y=172 * unit)
    draw_colour_bar(
        page, view.colours, magnitude_colours(), meaning=view.quantity, measure=view.measure, unit=unit, y=112 * unit
    )
    write_caption(page, "; ".join(filter(None, [_sight(view), line.note])), unit)
    return page


def _sight(view: LineView) -> str:
    sight = "seen along y" if view.flat else "parallel projection, seen from −x, −y and above"
    return f"{sight}; drawn to scale"


def _draw_stream(page: Page, view: LineView, frame: LineFrame) -> None:
    """Arrows of the velocity at a few heights, that begin at the upstream side of the box."""
    fastest = _fastest(view)
    if view.stream is None or fastest == 0.0:
        return
    heights, velocities = view.stream
    mean = velocities.mean(axis=0)
    upstream = np.where(mean >= 0.0, view.low, view.high)
    starts = np.column_stack(
        [np.full(len(heights), upstream[0]), np.full(len(heights), 0.5 * (view.low + view.high)[1]), heights]
    )
    vectors = _ARROW * view.diagonal / fastest * velocities
    seen = np.linalg.norm(velocities, axis=1) > 1e-3 * fastest
    centres = frame.page(starts + 0.5 * vectors)[seen]
    page.arrows(centres, frame.vectors(vectors)[seen], stroke=4.0 * frame.unit, colour=_STREAM)


def _fastest(view: LineView) -> float:
    return 0.0 if view.stream is None else float(np.max(np.linalg.norm(view.stream[1], axis=1)))


def _draw_line(page: Page, view: LineView, line: DrawnLine, frame: LineFrame) -> None:
    unit = frame.unit
    if not view.flat:
        below = line.points * [1.0, 1.0, 0.0] + [0.0, 0.0, view.low[2]]
        page.ribbon(frame.page(below), stroke=4.0 * unit, colour=_SHADOW)
    curve, scale = frame.page(line.points), magnitude_colours()
    at = np.linspace(*view.colours, len(scale))
    colours = np.column_stack([np.interp(line.values, at, channel) for channel in scale.T])
    page.ribbon(curve, stroke=12.0 * unit, colour=WHITE)
    # A dark edge: the lightest colours are hardly seen on white.
    page.ribbon(curve, stroke=9.0 * unit, colour=_EDGE)
    page.coloured_ribbon(curve, colours, stroke=6.5 * unit)
    for place in frame.page(line.fixed):
        _held(page, place, unit)
    for place in frame.page(line.bodies):
        _body(page, place, unit)


def _held(page: Page, place: Array, unit: float) -> None:
    page.area(place + 11.0 * unit * np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]]), colour=INK)


def _body(page: Page, place: Array, unit: float) -> None:
    angles = np.linspace(0.0, 2.0 * np.pi, 33)[:-1]
    disc = place + 10.0 * unit * np.column_stack([np.cos(angles), np.sin(angles)])
    page.area(disc, colour=BODY)
    page.ribbon(closed(disc), stroke=3.0 * unit, colour=BODY_EDGE)


def _names(view: LineView, line: DrawnLine) -> list[str]:
    names = [_THREAD] + [_HELD] * bool(len(line.fixed)) + ["body"] * bool(len(line.bodies))
    names += [_SHADOWED] * (not view.flat)
    fastest = _fastest(view)
    return names + [f"stream, longest arrow {fastest:.3g} m/s"] * (fastest > 0.0)


def _draw_key(page: Page, name: str, ends: Array, unit: float) -> None:
    middle = ends.mean(axis=0)
    if name == _THREAD:
        scale = magnitude_colours()
        page.ribbon(ends, stroke=9.0 * unit, colour=_EDGE)
        curve = np.linspace(ends[0], ends[1], len(scale))
        page.coloured_ribbon(curve, scale, stroke=6.5 * unit)
    elif name == _HELD:
        _held(page, middle, unit)
    elif name == "body":
        _body(page, middle, unit)
    elif name == _SHADOWED:
        page.strokes(ends[None], stroke=4.0 * unit, colour=_SHADOW)
    else:
        page.arrows(middle[None], 0.9 * (ends[1:] - ends[:1]), stroke=4.0 * unit, colour=_STREAM)
