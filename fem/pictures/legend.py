"""What surrounds a drawn mode: title, axes, colour bar, legend and captions."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from hydroelastic.fem.pictures.colours import mode_colours
from hydroelastic.fem.pictures.floats import BODY, BODY_EDGE
from hydroelastic.fem.pictures.frame import Frame
from hydroelastic.fem.pictures.mode import UNIT_MASS, ModePicture
from hydroelastic.fem.pictures.page import INK, Page
from hydroelastic.fem.pictures.shapes import Array, dashes
from hydroelastic.fem.pictures.surroundings import draw_colour_bar, draw_keys
from hydroelastic.fem.pictures.tank import ARROW, FREE_SURFACE, INTERFACE, ISO_LINE, LOWER_WASH, UPPER_WASH, WALL_STROKE
from hydroelastic.fem.pictures.ticks import round_ticks, short_number, tick_labels
from hydroelastic.fem.pictures.view import View

_UNITS = {"ψ": "m²", "ρψ": "kg/m"}


def field_name(picture: ModePicture) -> str:
    """What the colours and lines of a picture show."""
    return "ρψ" if picture.has_two_liquids else "ψ"


def draw_axes(page: Page, view: View, frame: Frame, start: float = 0.0) -> None:
    """Ticks and labels of x, which begins at a start, below, and of y on the left, in metres."""
    unit = frame.unit
    wall = WALL_STROKE * unit
    ends = frame.page(np.array([0.0, view.length, 0.0]), np.array([-view.depth, 0.0, view.upper_depth]))
    (left, bottom), (right, _), (_, top) = ends
    x_ticks = round_ticks(start, start + view.length, 8)
    y_ticks, labels = _ordinates(view, frame)
    x_page, y_page = frame.page(x_ticks - start, np.zeros(1))[:, 0], frame.page(np.zeros(len(y_ticks)), y_ticks)[:, 1]
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


def draw_field_bar(page: Page, picture: ModePicture, unit: float, *, limit: float, y: float) -> None:
    """Colours of the field between −limit and limit."""
    name = field_name(picture)
    draw_colour_bar(
        page,
        (-limit, limit),
        mode_colours(),
        meaning=f"{name} ∝ dynamic pressure" if picture.has_two_liquids else name,
        measure=f"{_UNITS[name]}, {picture.amplitude}",
        unit=unit,
        y=y,
    )


def draw_legend(page: Page, pictures: Sequence[ModePicture], unit: float, *, y: float, vectors: bool) -> None:
    """Keys of what is present, in one centred row."""
    kinds = {curve.kind for picture in pictures for curve in picture.surfaces}
    has_bodies = "body" in kinds or any(picture.floats for picture in pictures)
    names = ["free surface"] * ("free_surface" in kinds) + ["interface"] * ("interface" in kinds)
    names += ["floating body"] * has_bodies
    # A float at rest is dashed like the still levels.
    still = "still level, float at rest" if any(picture.floats for picture in pictures) else "still level"
    names += [still, f"lines of equal {field_name(pictures[0])}"] + ["displacement ∇ψ"] * vectors
    draw_keys(page, names, _draw_key, unit, y=y)


def stretch_note(view: View) -> str:
    """The vertical scale in words, or ""."""
    if view.stretch != view.upper_stretch:
        return f"vertical scale ×{view.stretch:g} in the lower and ×{view.upper_stretch:g} in the upper liquid"
    return f"vertical scale ×{view.stretch:g}" if view.stretch != 1.0 else ""


def scale_notes(view: View, picture: ModePicture) -> str:
    """What the reader must know to measure in the picture."""
    notes = ["the water extends beyond the picture"] if picture.goes_on else []
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
        amplitude = "arbitrary amplitude" if picture.amplitude == UNIT_MASS else picture.amplitude
        notes.append(f"surface displacement drawn ×{short_number(view.surface_scale)} ({amplitude})")
    else:
        notes.append("the surfaces do not move")
    notes.append("longest vectors shortened")
    return "; ".join(notes)


def _draw_key(page: Page, name: str, ends: Array, unit: float) -> None:
    (left, y), (right, _) = ends
    if name == "free surface":
        page.strokes(ends[None], stroke=4.5 * unit, colour=FREE_SURFACE)
    elif name == "interface":
        page.strokes(ends[None], stroke=4.5 * unit, colour=INTERFACE)
    elif name == "floating body":
        page.strokes(ends[None], stroke=15 * unit, colour=BODY_EDGE)
        page.strokes(ends[None] + [[[2 * unit, 0.0], [-2 * unit, 0.0]]], stroke=11 * unit, colour=BODY)
    elif name.startswith("still level"):
        page.strokes(dashes((left, y), (right, y), dash=9 * unit, gap=6 * unit), stroke=1.6 * unit, colour=INK)
    elif name.startswith("lines of equal"):
        page.strokes(ends[None], stroke=1.6 * unit, colour=ISO_LINE)
    else:
        page.arrows(ends.mean(axis=0)[None], 0.8 * (ends[1:] - ends[:1]), stroke=2.4 * unit, colour=ARROW)
