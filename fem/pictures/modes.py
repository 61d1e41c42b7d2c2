"""Pictures of natural modes, rendered by VTK without a screen: one mode, or all of them on a sheet."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import AbstractContextManager, nullcontext
from dataclasses import replace
from pathlib import Path

import numpy as np

from hydroelastic.fem.pictures.canvas import Canvas, NoRendererError
from hydroelastic.fem.pictures.colours import mode_colours, rgb
from hydroelastic.fem.pictures.floats import BODY, BODY_EDGE
from hydroelastic.fem.pictures.frame import frame_of
from hydroelastic.fem.pictures.gif import FRAMES, SECONDS, write_gif
from hydroelastic.fem.pictures.legend import (
    draw_axes,
    draw_field_bar,
    draw_legend,
    field_name,
    label_liquids,
    scale_notes,
    stretch_note,
)
from hydroelastic.fem.pictures.mode import FloatSection, ModePicture, SurfaceCurve
from hydroelastic.fem.pictures.page import Page
from hydroelastic.fem.pictures.surroundings import (
    FOOTER,
    HEADING,
    REFERENCE_WIDTH,
    write_caption,
    write_title,
)
from hydroelastic.fem.pictures.tank import FREE_SURFACE, INTERFACE, draw_tank
from hydroelastic.fem.pictures.view import View, colour_limit, view_of

__all__ = [
    "Canvas",
    "FloatSection",
    "ModePicture",
    "NoRendererError",
    "SurfaceCurve",
    "animate_mode",
    "animate_motion",
    "draw_mode",
    "draw_overview",
]

# Of a sheet of panels, in pixels of a page of the width to which sizes refer.
_MARGIN, _FOOTER, _HEADING = 40.0, 100.0, 62.0
# Pixels: graphics end at 16384, and what reads pictures may refuse more than 89 million of them.
_HIGHEST_SHEET = 10_000


def draw_mode(
    picture: ModePicture,
    path: Path | str,
    *,
    width: int = 1600,
    canvas: Canvas | None = None,
    largest: ModePicture | None = None,
) -> None:
    """Write a mode as one PNG with axes, colour bar and legend.

    The height follows from the tank. Shallow tanks are stretched vertically and deep ones cut; the caption says so.

    Args:
        picture: the mode.
        path: of the PNG file in an existing folder.
        width: of the image in pixels.
        canvas: draws it; give the same one for several pictures, it is slow to open.
        largest: what gives the scales, if the picture is an instant of a motion; the picture itself by default.

    Raises:
        FileNotFoundError: the folder of the file does not exist.
        ValueError: the file's name does not end in .png, or the width is below 400.
        NoRendererError: no library of this computer can render.
    """
    path = _checked_path(path, width, ".png")
    with _opened(canvas) as opened:
        _mode_page(opened, picture, width, largest).save(path)


def animate_mode(
    picture: ModePicture, path: Path | str, *, width: int = 800, canvas: Canvas | None = None, frames: int = FRAMES
) -> None:
    """Write a period of a mode's motion as a GIF that repeats itself: everything moves as cos ωt in the same scales.

    Args:
        picture: the mode, at its largest displacement.
        path: of the GIF file in an existing folder.
        width: of the image in pixels.
        canvas: draws it; give the same one for several pictures, it is slow to open.
        frames: pages of a period.

    Raises:
        FileNotFoundError: the folder of the file does not exist.
        ValueError: the file's name does not end in .gif, or the width is below 400.
        NoRendererError: no library of this computer can render.
    """
    animate_motion(
        [
            replace(picture.times(np.cos(2.0 * np.pi * part)), title=f"{picture.title}, {phase_words(part)}")
            for part in np.arange(frames) / frames
        ],
        picture,
        path,
        width=width,
        canvas=canvas,
    )


def phase_words(part: float) -> str:
    """The time of a part of a period in words, always as long."""
    return f"t = {part:.2f} T"


def animate_motion(
    instants: Sequence[ModePicture],
    largest: ModePicture,
    path: Path | str,
    *,
    width: int = 800,
    canvas: Canvas | None = None,
) -> None:
    """Write a motion as a GIF that repeats itself.

    Args:
        instants: a period of the motion.
        largest: the largest values of everything in the period, which give the scales of all pages.
        path: of the GIF file in an existing folder.
        width: of the image in pixels.
        canvas: draws it; give the same one for several pictures, it is slow to open.

    Raises:
        FileNotFoundError: the folder of the file does not exist.
        ValueError: the file's name does not end in .gif, or the width is below 400.
        NoRendererError: no library of this computer can render.
    """
    path = _checked_path(path, width, ".gif")
    with _opened(canvas) as opened:
        pages = [_mode_page(opened, instant, width, largest).pixels() for instant in instants]
    kept = np.vstack([mode_colours()[::2], *map(rgb, (FREE_SURFACE, INTERFACE, BODY, BODY_EDGE))])
    write_gif(pages, path, seconds=SECONDS, kept=kept)


def _mode_page(canvas: Canvas, picture: ModePicture, width: int, largest: ModePicture | None = None) -> Page:
    """A mode, or an instant of its motion in the scales of its largest values."""
    scales = largest or picture
    view = view_of(scales)
    unit = width / REFERENCE_WIDTH
    beside = 120 * unit if picture.has_two_liquids else 0.0
    drawn_width, drawn_height = _drawn_size(view, available=width - 230 * unit - beside, highest=0.75 * width)
    footer = FOOTER * unit
    left = 0.5 * (width - drawn_width - beside) + 45 * unit
    frame = frame_of(view, left=left, bottom=footer, per_metre=drawn_width / view.length, unit=unit)
    page = Page(canvas, width=width, height=round(footer + drawn_height + HEADING * unit))
    draw_tank(page, picture, view, frame, colours=mode_colours(), spacing=44 * unit, largest=largest)
    write_title(page, picture.title, unit)
    draw_axes(page, view, frame, picture.start)
    label_liquids(page, picture, view, frame)
    draw_field_bar(page, picture, unit, limit=colour_limit(scales), y=112 * unit)
    draw_legend(page, [picture], unit, y=172 * unit, vectors=True)
    write_caption(page, scale_notes(view, picture), unit)
    return page


def draw_overview(
    pictures: Sequence[ModePicture],
    path: Path | str,
    *,
    columns: int | None = None,
    width: int = 1600,
    canvas: Canvas | None = None,
) -> None:
    """Write several modes as panels of one PNG, without axes and colour bars; narrower if it would be too high.

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
    path = _checked_path(path, width, ".png")
    if not pictures:
        raise ValueError("an overview needs at least one picture")
    views = [view_of(picture) for picture in pictures]
    aspect = max(view.aspect for view in views)
    columns = min(_default_columns(aspect, len(pictures)) if columns is None else columns, len(pictures))
    if columns < 1:
        raise ValueError(f"an overview needs at least one column, got {columns}")
    rows = -(-len(pictures) // columns)
    width = min(width, int(_HIGHEST_SHEET / _sheet_height(1.0, aspect, columns, rows)))
    unit = width / REFERENCE_WIDTH
    margin, heading = _MARGIN * unit, _HEADING * unit
    panel = (width - margin * (columns + 1)) / columns
    row = aspect * panel + heading
    height = round(_sheet_height(width, aspect, columns, rows))
    with _opened(canvas) as opened:
        page = Page(opened, width=width, height=height)
        widest = max(page.text_width(picture.title, 19 * unit) for picture in pictures)
        for index, (picture, view) in enumerate(zip(pictures, views, strict=True)):
            left = margin + (index % columns) * (panel + margin)
            top = height - 15 * unit - (index // columns) * row
            title = (left + 0.5 * panel, top - 32 * unit)
            page.text(title, picture.title, size=19 * unit * min(panel / widest, 1.0))
            scale = panel / view.length
            bottom = top - heading - view.drawn_height * scale + 8 * unit
            frame = frame_of(view, left=left, bottom=bottom, per_metre=scale, unit=0.62 * unit)
            draw_tank(page, picture, view, frame, colours=mode_colours(), spacing=0.0)
        draw_legend(page, pictures, unit, y=66 * unit, vectors=False)
        write_caption(page, _overview_note(pictures, views), unit)
        page.save(path)


def _sheet_height(width: float, aspect: float, columns: int, rows: int) -> float:
    """Height of a sheet of panels, in proportion to its width."""
    unit = width / REFERENCE_WIDTH
    panel = (width - _MARGIN * unit * (columns + 1)) / columns
    return _FOOTER * unit + rows * (aspect * panel + _HEADING * unit) + 20 * unit


def _checked_path(path: Path | str, width: int, suffix: str) -> Path:
    path = Path(path)
    if path.suffix.lower() != suffix:
        raise ValueError(f"the name of this picture ends in {suffix}, got {path.name}")
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


def _overview_note(pictures: Sequence[ModePicture], views: Sequence[View]) -> str:
    name = field_name(pictures[0])
    notes = [f"each panel has its own scale of {name} (green positive, purple negative) and of the displacement"]
    stretches = [*dict.fromkeys(filter(None, map(stretch_note, views)))]
    notes += stretches
    if any(view.cut or view.upper_cut for view in views):
        part = "part around the interface" if pictures[0].has_two_liquids else "upper part of the liquid"
        notes.append(f"only the {part} shown")
    return "; ".join(notes)
