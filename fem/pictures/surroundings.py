"""What surrounds any drawing: title, caption, colour bar, a row of keys."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from hydroelastic.fem.pictures.page import GREY, INK, Page
from hydroelastic.fem.pictures.shapes import Array
from hydroelastic.fem.pictures.ticks import power_of_ten, round_ticks, tick_labels

REFERENCE_WIDTH = 1600.0
"""Sizes are given for this image width and scaled with it."""
FOOTER = 285.0
"""Height below a drawing for its axis, keys, colours and caption."""
HEADING = 85.0
"""Height above a drawing for its title."""

DrawKey = Callable[[Page, str, Array, float], None]
"""Draws the key of a name between two points, shape (2, 2), for a unit of widths."""


def write_line(
    page: Page, text: str, position: tuple[float, float], *, size: float, room: float, colour: str = INK
) -> None:
    """Write a centred line of text, smaller if it would not fit into ``room`` pixels."""
    fit = room / max(page.text_width(text, size), 1.0)
    page.text(position, text, size=size * min(fit, 1.0), colour=colour)


def write_title(page: Page, text: str, unit: float) -> None:
    """Write a title at the top of a page."""
    write_line(page, text, (0.5 * page.width, page.height - 42 * unit), size=30 * unit, room=page.width - 60 * unit)


def write_caption(page: Page, text: str, unit: float) -> None:
    """Write what the reader must know to measure at the bottom of a page."""
    room = page.width - 40 * unit
    write_line(page, text, (0.5 * page.width, 30 * unit), size=19 * unit, room=room, colour=GREY)


def draw_keys(page: Page, names: Sequence[str], draw: DrawKey, unit: float, *, y: float) -> None:
    """Write names with their keys in one centred row, smaller if they would not fit."""
    page_width = page.width - 40 * unit

    def widths_at(scale: float) -> list[float]:
        return [(56 + 12) * scale + page.text_width(name, 20 * scale) for name in names]

    whole = sum(widths_at(unit)) + 42 * unit * (len(names) - 1)
    unit *= min(page_width / whole, 1.0)
    widths, gap, key = widths_at(unit), 42 * unit, 56 * unit
    left = 0.5 * page.width - 0.5 * (sum(widths) + gap * (len(names) - 1))
    for name, width in zip(names, widths, strict=True):
        draw(page, name, np.array([[left, y], [left + key, y]]), unit)
        page.text((left + key + 12 * unit, y), name, size=20 * unit, horizontal="left")
        left += width + gap


def draw_colour_bar(
    page: Page, limits: tuple[float, float], colours: Array, *, meaning: str, measure: str, unit: float, y: float
) -> None:
    """Colours between two limits with round ticks, what they mean on the right, all centred.

    Args:
        page: receives them.
        limits: values of the first and the last colour.
        colours: at equal steps, shape (colours, 3).
        meaning: of the values.
        measure: their unit, with anything that belongs into the same parentheses.
        unit: of widths.
        y: height of the middle.
    """
    exponent = int(np.floor(np.log10(max(abs(limit) for limit in limits))))
    exponent = 0 if -3 <= exponent <= 3 else exponent
    low, high = (limit / 10.0**exponent for limit in limits)
    power = "" if exponent == 0 else f"{power_of_ten(exponent)} "
    label = f"{meaning} ({power}{measure})"
    width, height, gap = 640 * unit, 20 * unit, 40 * unit
    left = 0.5 * (page.width - width - gap - page.text_width(label, 21 * unit))
    edges = left + width * np.linspace(0.0, 1.0, len(colours))
    bottom, top, right = y - 0.5 * height, y + 0.5 * height, left + width
    page.gradient(edges, bottom, top, colours)
    outline = np.array([[left, bottom], [right, bottom], [right, top], [left, top], [left, bottom]])
    page.strokes(np.stack([outline[:-1], outline[1:]], axis=1), stroke=1.4 * unit, colour=INK)
    ticks = round_ticks(low, high, 8)
    for tick, text in zip(ticks, tick_labels(ticks), strict=True):
        x = left + width * (tick - low) / (high - low)
        page.strokes(np.array([[[x, bottom], [x, bottom - 7 * unit]]]), stroke=1.6 * unit, colour=INK)
        page.text((x, bottom - 10 * unit), text, size=20 * unit, vertical="top")
    page.text((right + gap, y), label, size=21 * unit, horizontal="left")
