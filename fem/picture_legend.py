"""What surrounds a drawn mode: title, axes, colour bar, legend and captions."""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from hydroelastic.fem.picture_page import INK, Page
from hydroelastic.fem.picture_shapes import Array, dashes
from hydroelastic.fem.picture_tank import ARROW, BODY, BODY_EDGE, FREE_SURFACE, ISO_LINE, WALL_STROKE, Frame
from hydroelastic.fem.picture_view import SurfaceCurve, View, round_ticks

_SUPERSCRIPT = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
# The diverging scheme PRGn of ColorBrewer, by Cynthia Brewer, at equal steps.
_PURPLE_GREEN = (
    "40004b", "762a83", "9970ab", "c2a5cf", "e7d4e8", "f7f7f7", "d9f0d3", "a6dba0", "5aae61", "1b7837", "00441b",
)  # fmt: skip
_POTENTIAL = "ψ (m², unit generalized mass)"


def mode_colours() -> Array:
    """Colours of ψ from negative to positive, shape (256, 3): purple, white, green, distinct for colour-blind readers.

    Blue and orange stay free for the surfaces. The ends are left out: they are too dark for vectors and lines.
    """
    known = np.array([[int(colour[place : place + 2], 16) / 255.0 for place in (0, 2, 4)] for colour in _PURPLE_GREEN])
    at = np.linspace(0.0, 1.0, len(known))
    return np.column_stack([np.interp(np.linspace(0.17, 0.83, 256), at, channel) for channel in known.T])


def write_line(
    page: Page, text: str, position: tuple[float, float], *, size: float, room: float, colour: str = INK
) -> None:
    """Write a centred line of text, smaller if it would not fit into ``room`` pixels."""
    fit = room / max(page.text_width(text, size), 1.0)
    page.text(position, text, size=size * min(fit, 1.0), colour=colour)


def draw_axes(page: Page, view: View, frame: Frame) -> None:
    """Ticks and labels of x below and of y on the left, in metres."""
    unit = frame.unit
    wall = WALL_STROKE * unit
    (left, bottom), (right, level) = frame.page(np.array([0.0, view.length]), np.array([-view.depth, 0.0]))
    x_ticks = round_ticks(0.0, view.length, 8)
    y_ticks = round_ticks(-view.depth, 0.0, max(2, min(6, round((level - bottom) / (75 * unit)))))
    x_page, y_page = frame.page(x_ticks, np.zeros(1))[:, 0], frame.page(np.zeros(len(y_ticks)), y_ticks)[:, 1]
    feet = [[[x, bottom - wall], [x, bottom - wall - 8 * unit]] for x in x_page]
    feet += [[[left - wall, y], [left - wall - 8 * unit, y]] for y in y_page]
    page.strokes(np.array(feet), stroke=1.6 * unit, colour=INK)
    for x, label in zip(x_page, tick_labels(x_ticks), strict=True):
        page.text((x, bottom - wall - 12 * unit), label, size=21 * unit, vertical="top")
    labels = tick_labels(y_ticks)
    for y, label in zip(y_page, labels, strict=True):
        page.text((left - wall - 14 * unit, y), label, size=21 * unit, horizontal="right")
    widest = max(page.text_width(label, 21 * unit) for label in labels)
    page.text((0.5 * (left + right), bottom - wall - 60 * unit), "x (m)", size=23 * unit)
    page.text((left - wall - widest - 42 * unit, 0.5 * (bottom + level)), "y (m)", size=23 * unit, angle=90.0)


def draw_colour_bar(page: Page, limit: float, unit: float, *, centre: float, y: float) -> None:
    """Colours of ψ from −limit to limit with round ticks, the label on the right."""
    exponent = int(np.floor(np.log10(limit)))
    exponent = 0 if -3 <= exponent <= 3 else exponent
    shown = limit / 10.0**exponent
    label = _POTENTIAL if exponent == 0 else _POTENTIAL.replace("(", f"(10{str(exponent).translate(_SUPERSCRIPT)} ")
    width, height, gap = 640 * unit, 20 * unit, 40 * unit
    left = centre - 0.5 * (width + gap + page.text_width(label, 21 * unit))
    colours = mode_colours()
    edges = left + width * np.linspace(0.0, 1.0, len(colours))
    bottom, top, right = y - 0.5 * height, y + 0.5 * height, left + width
    page.gradient(edges, bottom, top, colours)
    outline = np.array([[left, bottom], [right, bottom], [right, top], [left, top], [left, bottom]])
    page.strokes(np.stack([outline[:-1], outline[1:]], axis=1), stroke=1.4 * unit, colour=INK)
    ticks = round_ticks(-shown, shown, 8)
    for tick, text in zip(ticks, tick_labels(ticks), strict=True):
        x = left + width * (tick + shown) / (2 * shown)
        page.strokes(np.array([[[x, bottom], [x, bottom - 7 * unit]]]), stroke=1.6 * unit, colour=INK)
        page.text((x, bottom - 10 * unit), text, size=20 * unit, vertical="top")
    page.text((right + gap, y), label, size=21 * unit, horizontal="left")


def draw_legend(
    page: Page, surfaces: Iterable[SurfaceCurve], unit: float, *, centre: float, y: float, vectors: bool
) -> None:
    """Keys of what is present, in one centred row."""
    kinds = {curve.kind for curve in surfaces}
    names = ["still level", "lines of equal ψ"]
    names = ["free surface"] * ("free_surface" in kinds) + ["floating body"] * ("body" in kinds) + names
    names += ["displacement ∇ψ"] * vectors
    size, key, gap = 20 * unit, 56 * unit, 42 * unit
    widths = [key + 12 * unit + page.text_width(name, size) for name in names]
    left = centre - 0.5 * (sum(widths) + gap * (len(names) - 1))
    for name, width in zip(names, widths, strict=True):
        _draw_key(page, name, np.array([[left, y], [left + key, y]]), unit)
        page.text((left + key + 12 * unit, y), name, size=size, horizontal="left")
        left += width + gap


def scale_notes(view: View) -> str:
    """What the reader must know to measure in the picture."""
    notes = []
    if view.stretch != 1.0:
        notes.append(f"vertical scale ×{view.stretch:g}, also of the vectors")
    if view.cut:
        notes.append(f"only the upper {view.depth:.3g} m of {view.whole_depth:.3g} m of liquid shown")
    if view.surface_scale > 0:
        notes.append(f"surface displacement drawn ×{short_number(view.surface_scale)} (arbitrary amplitude)")
    else:
        notes.append("the surfaces do not move")
    notes.append("longest vectors shortened")
    return "; ".join(notes)


def short_number(value: float) -> str:
    """Three significant digits, with a power of ten for very large and very small numbers."""
    if 1e-3 <= value < 999.5:
        return f"{value:.3g}"
    mantissa, exponent = f"{value:.2e}".split("e")
    return f"{mantissa}·10{str(int(exponent)).translate(_SUPERSCRIPT)}"


def tick_labels(ticks: Array) -> list[str]:
    """Numbers with the same, smallest sufficient count of decimals and a true minus sign."""
    scale = float(np.abs(ticks).max(initial=0.0)) or 1.0
    decimals = next((d for d in range(12) if np.allclose(ticks, np.round(ticks, d), rtol=0, atol=1e-6 * scale)), 12)
    return [f"{tick + 0.0:.{decimals}f}".replace("-", "−") for tick in np.round(ticks, decimals)]


def _draw_key(page: Page, name: str, ends: Array, unit: float) -> None:
    (left, y), (right, _) = ends
    if name == "free surface":
        page.strokes(ends[None], stroke=4.5 * unit, colour=FREE_SURFACE)
    elif name == "floating body":
        page.strokes(ends[None], stroke=15 * unit, colour=BODY_EDGE)
        page.strokes(ends[None] + [[[2 * unit, 0.0], [-2 * unit, 0.0]]], stroke=11 * unit, colour=BODY)
    elif name == "still level":
        page.strokes(dashes((left, y), (right, y), dash=9 * unit, gap=6 * unit), stroke=1.6 * unit, colour=INK)
    elif name == "lines of equal ψ":
        page.strokes(ends[None], stroke=1.6 * unit, colour=ISO_LINE)
    else:
        page.arrows(ends.mean(axis=0)[None], 0.8 * (ends[1:] - ends[:1]), stroke=2.4 * unit, colour=ARROW)
