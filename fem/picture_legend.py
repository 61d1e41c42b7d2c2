"""What surrounds a drawn mode: title, axes, colour bar, legend and captions."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from hydroelastic.fem.picture_float import BODY, BODY_EDGE
from hydroelastic.fem.picture_frame import Frame
from hydroelastic.fem.picture_mode import ModePicture
from hydroelastic.fem.picture_page import INK, Page
from hydroelastic.fem.picture_shapes import Array, dashes
from hydroelastic.fem.picture_tank import ARROW, FREE_SURFACE, INTERFACE, ISO_LINE, LOWER_WASH, UPPER_WASH, WALL_STROKE
from hydroelastic.fem.picture_view import View, colour_limit, round_ticks

_SUPERSCRIPT = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")
# The diverging scheme PRGn of ColorBrewer, by Cynthia Brewer, at equal steps.
_PURPLE_GREEN = (
    "40004b", "762a83", "9970ab", "c2a5cf", "e7d4e8", "f7f7f7", "d9f0d3", "a6dba0", "5aae61", "1b7837", "00441b",
)  # fmt: skip
_UNITS = {"ψ": "m²", "ρψ": "kg/m"}


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


def field_name(picture: ModePicture) -> str:
    """What the colours and lines of a picture show."""
    return "ρψ" if picture.has_two_liquids else "ψ"


def draw_axes(page: Page, view: View, frame: Frame) -> None:
    """Ticks and labels of x below and of y on the left, in metres."""
    unit = frame.unit
    wall = WALL_STROKE * unit
    ends = frame.page(np.array([0.0, view.length, 0.0]), np.array([-view.depth, 0.0, view.upper_depth]))
    (left, bottom), (right, _), (_, top) = ends
    x_ticks = round_ticks(0.0, view.length, 8)
    y_ticks, labels = _ordinates(view, frame)
    x_page, y_page = frame.page(x_ticks, np.zeros(1))[:, 0], frame.page(np.zeros(len(y_ticks)), y_ticks)[:, 1]
    feet = [[[x, bottom - wall], [x, bottom - wall - 8 * unit]] for x in x_page]
    feet += [[[left - wall, y], [left - wall - 8 * unit, y]] for y in y_page]
    page.strokes(np.array(feet), stroke=1.6 * unit, colour=INK)
    for x, label in zip(x_page, tick_labels(x_ticks), strict=True):
        page.text((x, bottom - wall - 12 * unit), label, size=21 * unit, vertical="top")
    for y, label in zip(y_page, labels, strict=True):
        page.text((left - wall - 14 * unit, y), label, size=21 * unit, horizontal="right")
    widest = max(page.text_width(label, 21 * unit) for label in labels)
    page.text((0.5 * (left + right), bottom - wall - 60 * unit), "x (m)", size=23 * unit)
    page.text((left - wall - widest - 42 * unit, 0.5 * (bottom + top)), "y (m)", size=23 * unit, angle=90.0)


def _ordinates(view: View, frame: Frame) -> tuple[Array, list[str]]:
    """Ticks of y and their labels; each of two liquids with a vertical scale of its own has its own step."""
    if view.stretch == view.upper_stretch:
        ticks = _ticks(-view.depth, view.upper_depth, view.stretch, frame)
        return ticks, tick_labels(ticks)
    below = _ticks(-view.depth, 0.0, view.stretch, frame)
    above = _ticks(0.0, view.upper_depth, view.upper_stretch, frame)
    above = above[above > 0.0]
    return np.concatenate([below, above]), tick_labels(below) + tick_labels(above)


def _ticks(low: float, high: float, stretch: float, frame: Frame) -> Array:
    pixels = stretch * frame.per_metre * (high - low)
    return round_ticks(low, high, max(2, min(6, round(pixels / (75 * frame.unit)))))


def label_liquids(page: Page, picture: ModePicture, view: View, frame: Frame) -> None:
    """Write the densities of two liquids on their right, beside the colours they have beyond their still levels."""
    unit = frame.unit
    depths, colours = (-view.depth, view.upper_depth), (LOWER_WASH, UPPER_WASH)
    for name, density, depth, colour in zip("₂₁", picture.densities, depths, colours, strict=False):
        ((x, y),) = frame.page(np.array([view.length]), np.array([0.5 * depth]))
        left, right = x + (WALL_STROKE + 14) * unit, x + (WALL_STROKE + 34) * unit
        page.band(
            np.array([[left, y - 24 * unit], [right, y - 24 * unit]]),
            np.array([[left, y + 24 * unit], [right, y + 24 * unit]]),
            colour=colour,
        )
        for line, height in ((f"ρ{name} = {density:.5g}", 13 * unit), ("kg/m³", -13 * unit)):
            page.text((right + 10 * unit, y + height), line, size=20 * unit, horizontal="left")


def draw_colour_bar(page: Page, picture: ModePicture, unit: float, *, centre: float, y: float) -> None:
    """Colours of the field between its limits with round ticks, the label on the right."""
    limit, name = colour_limit(picture), field_name(picture)
    exponent = int(np.floor(np.log10(limit)))
    exponent = 0 if -3 <= exponent <= 3 else exponent
    shown = limit / 10.0**exponent
    power = "" if exponent == 0 else f"10{str(exponent).translate(_SUPERSCRIPT)} "
    meaning = f"{name} ∝ dynamic pressure" if picture.has_two_liquids else name
    label = f"{meaning} ({power}{_UNITS[name]}, unit generalized mass)"
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
    page: Page, pictures: Sequence[ModePicture], unit: float, *, centre: float, y: float, vectors: bool
) -> None:
    """Keys of what is present, in one centred row."""
    kinds = {curve.kind for picture in pictures for curve in picture.surfaces}
    has_bodies = "body" in kinds or any(picture.floats for picture in pictures)
    names = ["free surface"] * ("free_surface" in kinds) + ["interface"] * ("interface" in kinds)
    names += ["floating body"] * has_bodies
    names += ["still level", f"lines of equal {field_name(pictures[0])}"] + ["displacement ∇ψ"] * vectors
    size, key, gap = 20 * unit, 56 * unit, 42 * unit
    widths = [key + 12 * unit + page.text_width(name, size) for name in names]
    left = centre - 0.5 * (sum(widths) + gap * (len(names) - 1))
    for name, width in zip(names, widths, strict=True):
        _draw_key(page, name, np.array([[left, y], [left + key, y]]), unit)
        page.text((left + key + 12 * unit, y), name, size=size, horizontal="left")
        left += width + gap


def stretch_note(view: View) -> str:
    """The vertical scale in words, or ""."""
    if view.stretch != view.upper_stretch:
        return f"vertical scale ×{view.stretch:g} in the lower and ×{view.upper_stretch:g} in the upper liquid"
    return f"vertical scale ×{view.stretch:g}" if view.stretch != 1.0 else ""


def scale_notes(view: View) -> str:
    """What the reader must know to measure in the picture."""
    notes = []
    if stretch := stretch_note(view):
        notes.append(f"{stretch}, also of the vectors")
    if view.whole_upper_depth and (view.cut or view.upper_cut):
        notes.append(
            f"only {-view.depth:.3g} m < y < {view.upper_depth:.3g} m of {-view.whole_depth:.3g} m < y < "
            f"{view.whole_upper_depth:.3g} m shown".replace("-", "−")
        )
    elif view.cut:
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
    elif name == "interface":
        page.strokes(ends[None], stroke=4.5 * unit, colour=INTERFACE)
    elif name == "floating body":
        page.strokes(ends[None], stroke=15 * unit, colour=BODY_EDGE)
        page.strokes(ends[None] + [[[2 * unit, 0.0], [-2 * unit, 0.0]]], stroke=11 * unit, colour=BODY)
    elif name == "still level":
        page.strokes(dashes((left, y), (right, y), dash=9 * unit, gap=6 * unit), stroke=1.6 * unit, colour=INK)
    elif name.startswith("lines of equal"):
        page.strokes(ends[None], stroke=1.6 * unit, colour=ISO_LINE)
    else:
        page.arrows(ends.mean(axis=0)[None], 0.8 * (ends[1:] - ends[:1]), stroke=2.4 * unit, colour=ARROW)
