"""Pictures of natural modes, rendered by VTK without a screen: one mode, or all of them on a sheet."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import AbstractContextManager, nullcontext
from pathlib import Path

from hydroelastic.fem.picture_canvas import Canvas, NoRendererError
from hydroelastic.fem.picture_frame import frame_of
from hydroelastic.fem.picture_legend import (
    draw_axes,
    draw_colour_bar,
    draw_legend,
    field_name,
    label_liquids,
    mode_colours,
    scale_notes,
    stretch_note,
    write_line,
)
from hydroelastic.fem.picture_mode import FloatSection, ModePicture, SurfaceCurve
from hydroelastic.fem.picture_page import GREY, Page
from hydroelastic.fem.picture_tank import draw_tank
from hydroelastic.fem.picture_view import View, view_of

__all__ = ["Canvas", "FloatSection", "ModePicture", "NoRendererError", "SurfaceCurve", "draw_mode", "draw_overview"]

_REFERENCE_WIDTH = 1600.0
"""Sizes are given for this image width and scaled with it."""


def draw_mode(picture: ModePicture, path: Path | str, *, width: int = 1600, canvas: Canvas | None = None) -> None:
    """Write a mode as one PNG with axes, colour bar and legend.

    The height follows from the tank. Shallow tanks are stretched vertically and deep ones cut; the caption says so.

    Args:
        picture: the mode.
        path: of the PNG file in an existing folder.
        width: of the image in pixels.
        canvas: draws it; give the same one for several pictures, it is slow to open.

    Raises:
        FileNotFoundError: the folder of the file does not exist.
        ValueError: the file's name does not end in .png, or the width is below 400.
        NoRendererError: no library of this computer can render.
    """
    path = _checked_path(path, width)
    view = view_of(picture)
    unit = width / _REFERENCE_WIDTH
    beside = 120 * unit if picture.has_two_liquids else 0.0
    drawn_width, drawn_height = _drawn_size(view, available=width - 230 * unit - beside, highest=0.75 * width)
    footer = 285 * unit
    height = round(footer + drawn_height + 85 * unit)
    left = 0.5 * (width - drawn_width - beside) + 45 * unit
    frame = frame_of(view, left=left, bottom=footer, per_metre=drawn_width / view.length, unit=unit)
    with _opened(canvas) as opened:
        page = Page(opened, width=width, height=height)
        draw_tank(page, picture, view, frame, colours=mode_colours(), spacing=44 * unit)
        write_line(page, picture.title, (0.5 * width, height - 42 * unit), size=30 * unit, room=width - 60 * unit)
        draw_axes(page, view, frame)
        label_liquids(page, picture, view, frame)
        draw_colour_bar(page, picture, unit, centre=0.5 * width, y=112 * unit)
        draw_legend(page, [picture], unit, centre=0.5 * width, y=172 * unit, vectors=True)
        _write_caption(page, scale_notes(view), unit)
        page.save(path)


def draw_overview(
    pictures: Sequence[ModePicture],
    path: Path | str,
    *,
    columns: int | None = None,
    width: int = 1600,
    canvas: Canvas | None = None,
) -> None:
    """Write several modes as panels of one PNG, without axes and colour bars.

    Args:
        pictures: the modes; each is drawn in its own scale.
        path: of the PNG file in an existing folder.
        columns: panels in a row; chosen from the shape of the tank by default.
        width: of the image in pixels.
        canvas: draws it; give the same one for several pictures, it is slow to open.

    Raises:
        FileNotFoundError: the folder of the file does not exist.
        ValueError: no picture, no column, a wrong file name or a width below 400.
        NoRendererError: no library of this computer can render.
    """
    path = _checked_path(path, width)
    if not pictures:
        raise ValueError("an overview needs at least one picture")
    views = [view_of(picture) for picture in pictures]
    aspect = max(view.aspect for view in views)
    columns = min(_default_columns(aspect, len(pictures)) if columns is None else columns, len(pictures))
    if columns < 1:
        raise ValueError(f"an overview needs at least one column, got {columns}")
    unit = width / _REFERENCE_WIDTH
    margin, footer, heading = 40 * unit, 100 * unit, 62 * unit
    panel = (width - margin * (columns + 1)) / columns
    row = aspect * panel + heading
    rows = -(-len(pictures) // columns)
    height = round(footer + rows * row + 20 * unit)
    with _opened(canvas) as opened:
        page = Page(opened, width=width, height=height)
        for index, (picture, view) in enumerate(zip(pictures, views, strict=True)):
            left = margin + (index % columns) * (panel + margin)
            top = height - 15 * unit - (index // columns) * row
            title = (left + 0.5 * panel, top - 32 * unit)
            write_line(page, picture.title, title, size=19 * unit, room=panel)
            scale = panel / view.length
            bottom = top - heading - view.drawn_height * scale + 8 * unit
            frame = frame_of(view, left=left, bottom=bottom, per_metre=scale, unit=0.62 * unit)
            draw_tank(page, picture, view, frame, colours=mode_colours(), spacing=0.0)
        draw_legend(page, pictures, unit, centre=0.5 * width, y=66 * unit, vectors=False)
        _write_caption(page, _overview_note(pictures, views), unit)
        page.save(path)


def _checked_path(path: Path | str, width: int) -> Path:
    path = Path(path)
    if path.suffix.lower() != ".png":
        raise ValueError(f"a picture is a PNG file, got {path.name}")
    if not path.parent.is_dir():
        raise FileNotFoundError(f"the folder {path.parent} of the picture {path.name} does not exist")
    if width < 400:
        raise ValueError(f"a picture is at least 400 pixels wide, got {width}")
    return path


def _opened(canvas: Canvas | None) -> AbstractContextManager[Canvas]:
    """The given canvas, which stays open, or one for this picture alone."""
    return Canvas() if canvas is None else nullcontext(canvas)


def _drawn_size(view: View, *, available: float, highest: float) -> tuple[float, float]:
    """Width and height of the drawn tank within the room on the page."""
    width = min(available, highest / view.aspect)
    return width, width * view.aspect


def _default_columns(aspect: float, panels: int) -> int:
    """Columns by the shape of the panels, as few as fill the same number of rows."""
    most = 2 if aspect < 0.35 else 3 if aspect < 0.9 else 5
    rows = -(-panels // most)
    return -(-panels // rows)


def _write_caption(page: Page, text: str, unit: float) -> None:
    room = page.width - 40 * unit
    write_line(page, text, (0.5 * page.width, 30 * unit), size=19 * unit, room=room, colour=GREY)


def _overview_note(pictures: Sequence[ModePicture], views: Sequence[View]) -> str:
    name = field_name(pictures[0])
    notes = [f"each panel has its own scale of {name} (green positive, purple negative) and of the displacement"]
    stretches = [*dict.fromkeys(filter(None, map(stretch_note, views)))]
    notes += stretches
    if any(view.cut or view.upper_cut for view in views):
        part = "part around the interface" if pictures[0].has_two_liquids else "upper part of the liquid"
        notes.append(f"only the {part} shown")
    return "; ".join(notes)
