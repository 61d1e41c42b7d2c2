"""Pictures of natural modes and of waves: one of them, all of them on a sheet, animations."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from functools import lru_cache
from pathlib import Path

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Rectangle
from numpy.typing import NDArray

from hydroelastic.fem.pictures.mode import ModePicture
from hydroelastic.output.pictures.colours import INK, LOWER_WASH, UPPER_WASH, mode_colours
from hydroelastic.output.pictures.gif import FRAMES, SECONDS, write_gif
from hydroelastic.output.pictures.notes import field_name, overview_note, scale_notes
from hydroelastic.output.pictures.page import (
    FOOTER,
    HEADING,
    KEYS,
    POINT,
    WIDTH,
    ColourBar,
    FieldImage,
    exponent_of,
    new_page,
    pixels,
    place,
    round_ticks,
    save,
    tick_labels,
    titled,
    write,
    write_caption,
    write_keys,
)
from hydroelastic.output.pictures.tank import WALL, draw_tank, erase_tank, key_names, keys
from hydroelastic.output.pictures.view import View, colour_limit, view_of

# Of ψ and ρψ.
_UNITS = {"ψ": "m²", "ρψ": "kg/m"}
# Left and right of a tank, and for the densities of two liquids.
_BESIDE, _DENSITIES = 230.0, 120.0
# Of a sheet of panels.
_MARGIN, _SHEET_FOOTER, _SHEET_HEADING, _THIN = 40.0, 100.0, 62.0, 0.62
# Pixels: what reads pictures may refuse more than 89 million of them.
_HIGHEST_SHEET = 10_000


def draw_mode(picture: ModePicture, path: Path | str, *, width: int = 1600, largest: ModePicture | None = None) -> None:
    """Write a mode as one PNG with axes, colour bar and legend.

    The height follows from the tank. Shallow tanks are stretched vertically and deep ones cut; the caption says so.
    """
    path = _checked_path(path, width, ".png")
    save(_mode_pages(picture, [picture.title], width, largest)[0], path)


def animate_mode(picture: ModePicture, path: Path | str, *, width: int = 800) -> None:
    """Write a period of a mode's motion as a GIF that repeats itself: everything moves as cos ωt in the same scales."""
    path = _checked_path(path, width, ".gif")
    pages: dict[int, NDArray[np.uint8]] = {}
    for frame in range(FRAMES // 2 + 1):
        # The way back shows the same, at other times.
        frames = sorted({frame, -frame % FRAMES})
        titles = [f"{picture.title}, {phase_words(number / FRAMES)}" for number in frames]
        instant = picture.times(np.cos(2.0 * np.pi * frame / FRAMES))
        pages.update(zip(frames, _mode_pages(instant, titles, width, picture), strict=True))
    write_gif([pages[number] for number in range(FRAMES)], path, seconds=SECONDS, kept=mode_colours())


def phase_words(part: float) -> str:
    """The time of a part of a period in words, always as long."""
    return f"t = {part:.2f} T"


def animate_motion(
    instants: Sequence[ModePicture], largest: ModePicture, path: Path | str, *, width: int = 800
) -> None:
    """Write a motion as a GIF that repeats itself."""
    path = _checked_path(path, width, ".gif")
    pages = [_mode_pages(instant, [instant.title], width, largest)[0] for instant in instants]
    write_gif(pages, path, seconds=SECONDS, kept=mode_colours())


def draw_overview(
    pictures: Sequence[ModePicture], path: Path | str, *, columns: int | None = None, width: int = 1600
) -> None:
    """Write several modes as panels of one PNG, without axes and colour bars; narrower if it would be too high."""
    path = _checked_path(path, width, ".png")
    if not pictures:
        raise ValueError("an overview needs at least one picture")
    views = [view_of(picture) for picture in pictures]
    aspect = max(view.aspect for view in views)
    columns = min(_default_columns(aspect, len(pictures)) if columns is None else columns, len(pictures))
    if columns < 1:
        raise ValueError(f"an overview needs at least one column, got {columns}")
    rows = -(-len(pictures) // columns)
    panel = (WIDTH - _MARGIN * (columns + 1)) / columns
    # Whole pixels: panels of one size share what is found once.
    row = np.ceil(aspect * panel) + _SHEET_HEADING
    height = _SHEET_FOOTER + rows * row + 20.0
    figure = new_page(height, min(width, int(_HIGHEST_SHEET * WIDTH / height)))
    tops = [height - 15.0 - (index // columns) * row for index in range(len(pictures))]
    lefts = [_MARGIN + (index % columns) * (panel + _MARGIN) for index in range(len(pictures))]
    titles = [
        write(figure, picture.title, top - 37.0, size=19.0, x=left + 0.5 * panel, room=panel)
        for picture, left, top in zip(pictures, lefts, tops, strict=True)
    ]
    smallest = min(title.size for title in titles)
    for title in titles:
        title.size = smallest
    write_keys(figure, keys(key_names(pictures, field_name(pictures[0]), vectors=False)), 66.0)
    write_caption(figure, overview_note(pictures, views))
    page = pixels(figure)
    axes = figure.add_axes((0.0, 0.0, 1.0, 1.0))
    for picture, view, left, top in zip(pictures, views, lefts, tops, strict=True):
        drawn = view.aspect * panel
        axes.set_position(place(figure, left, top - _SHEET_HEADING - drawn + 8.0, panel, drawn))
        draw_tank(axes, picture, view, vectors=False, thin=_THIN)
        figure.draw_artist(axes)
        erase_tank(axes)
    save(page, path)


def _mode_pages(
    picture: ModePicture, titles: Sequence[str], width: int, largest: ModePicture | None
) -> list[NDArray[np.uint8]]:
    """A mode, or an instant of its motion in the scales of its largest values, under each of the titles."""
    scales = largest or picture
    view = view_of(scales)
    names = key_names([picture], field_name(picture), vectors=True)
    limit = colour_limit(scales)
    # What of a view differs from mode to mode is not of the page.
    page = _page(
        replace(view, surface_scale=0.0),
        picture.start,
        picture.densities,
        names,
        picture.amplitude,
        exponent_of(-limit, limit),
        width,
    )
    return page.drawn(picture, titles, view, largest)


class _Page:
    """What is the same on the pictures of several modes, drawn once: letters and axes take longer than fields."""

    def __init__(
        self,
        view: View,
        start: float,
        densities: tuple[float, ...],
        names: tuple[str, ...],
        amplitude: str,
        exponent: int,
        width: int,
    ) -> None:
        """Draw scales, densities, keys and colours; make room for a tank, numbers of the colours and words."""
        beside = _DENSITIES if densities else 0.0
        drawn_width = min(WIDTH - _BESIDE - beside, 0.75 * WIDTH / view.aspect)
        drawn_height = drawn_width * view.aspect
        height = round(FOOTER + drawn_height + HEADING)
        still, self._figure = new_page(height, width), new_page(height, width)
        tank = place(still, 0.5 * (WIDTH - drawn_width - beside) + 45.0, FOOTER, drawn_width, drawn_height)
        axes, self._tank = still.add_axes(tank), self._figure.add_axes(tank)
        axes.set_xlim(0.0, view.length)
        axes.set_ylim(*view.drawn(np.array([-view.depth, view.upper_depth + view.headroom])))
        _draw_scales(axes, view, start, drawn_width / view.length)
        _label_liquids(axes, densities, view, view.length / drawn_width)
        write_keys(still, keys(names), KEYS)
        name, meaning = ("ρψ", "ρψ ∝ dynamic pressure") if densities else ("ψ", "ψ")
        measure = f"{_UNITS[name]}, {amplitude}"
        self._bar = ColourBar(still, mode_colours(), meaning=meaning, measure=measure, exponent=exponent)
        self._figure.add_artist(FieldImage(pixels(still), 0, 0))
        self._figure.patch.set_visible(False)

    def drawn(
        self, picture: ModePicture, titles: Sequence[str], view: View, largest: ModePicture | None
    ) -> list[NDArray[np.uint8]]:
        """Draw a mode in place of the one before, under each of the titles."""
        limit = colour_limit(largest or picture)
        ticks = self._bar.span(self._figure, -limit, limit)
        draw_tank(self._tank, picture, view, largest=largest)
        caption = write_caption(self._figure, scale_notes(view, picture))
        pages = titled(self._figure, titles)
        for artist in (caption, *ticks):
            artist.remove()
        erase_tank(self._tank)
        return pages


_page = lru_cache(maxsize=1)(_Page)


def _draw_scales(axes: Axes, view: View, start: float, per_metre: float) -> None:
    """Ticks and labels of x, which begins at a start, below, and of y on the left, in metres.

    Each of two liquids with a vertical scale of its own has its own step of y.
    """
    x = round_ticks(start, start + view.length, 8)
    depths = [(-view.depth, view.upper_depth, view.stretch)]
    if view.stretch != view.upper_stretch:
        depths = [(-view.depth, 0.0, view.stretch), (0.0, view.upper_depth, view.upper_stretch)]
    counts = [max(2, min(6, round(stretch * per_metre * (high - low) / 75.0))) for low, high, stretch in depths]
    y = np.unique(np.concatenate([round_ticks(*ends[:2], n) for ends, n in zip(depths, counts, strict=True)]))
    axes.set_axis_on()
    axes.spines[:].set_visible(False)
    axes.set_xticks(x - start, tick_labels(x))
    axes.set_yticks(view.drawn(y), tick_labels(y))
    axes.tick_params(length=(WALL + 8.0) * POINT, width=1.6 * POINT, pad=4.0 * POINT, labelsize=21.0 * POINT)
    axes.set_xlabel("x, m", fontsize=23.0 * POINT, labelpad=8.0 * POINT)
    axes.set_ylabel("y, m", fontsize=23.0 * POINT, labelpad=8.0 * POINT)
    # Beside the liquids, not the room above them.
    low, middle, high = view.drawn(
        np.array([-view.depth, 0.5 * (view.upper_depth - view.depth), view.upper_depth + view.headroom])
    )
    axes.yaxis.set_label_coords(-75.0 / (per_metre * view.length), (middle - low) / (high - low))


def _label_liquids(axes: Axes, densities: tuple[float, ...], view: View, pixel: float) -> None:
    """Write the densities of two liquids on their right, beside the colours they have beyond their still levels."""
    depths, colours = (-view.depth, view.upper_depth), (LOWER_WASH, UPPER_WASH)
    for name, density, depth, colour in zip("₂₁", densities, depths, colours, strict=False):
        x, y = view.length + (WALL + 14.0) * pixel, float(view.drawn(np.array([0.5 * depth]))[0])
        swatch = Rectangle((x, y - 24.0 * pixel), 20.0 * pixel, 48.0 * pixel, color=colour, linewidth=0, clip_on=False)
        axes.add_patch(swatch)
        words = f"ρ{name} = {density:.5g}\nkg/m³"
        axes.text(x + 30.0 * pixel, y, words, fontsize=20.0 * POINT, va="center", color=INK)


def _checked_path(path: Path | str, width: int, suffix: str) -> Path:
    path = Path(path)
    if path.suffix.lower() != suffix:
        raise ValueError(f"the name of this picture ends in {suffix}, got {path.name}")
    if not path.parent.is_dir():
        raise FileNotFoundError(f"the folder {path.parent} of the picture {path.name} does not exist")
    if width < 400:
        raise ValueError(f"a picture is at least 400 pixels wide, got {width}")
    return path


def _default_columns(aspect: float, panels: int) -> int:
    """Columns by the shape of the panels, as few as fill the same number of rows."""
    most = 2 if aspect < 0.35 else 3 if aspect < 0.9 else 5
    rows = -(-panels // most)
    return -(-panels // rows)
