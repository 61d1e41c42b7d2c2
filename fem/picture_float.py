"""A rigid float on a page: its section where it rests, and displaced."""

from __future__ import annotations

from hydroelastic.fem.picture_frame import Frame
from hydroelastic.fem.picture_mode import FloatSection
from hydroelastic.fem.picture_page import INK, Page
from hydroelastic.fem.picture_shapes import closed, dashed

BODY = "#d9660a"
BODY_EDGE = "#5c2a00"

_RESTING = "#f6e6d8"


def draw_resting(page: Page, section: FloatSection, frame: Frame) -> None:
    """Fill the place of a float in the liquid; mark the line on which a thin one acts."""
    if section.slit is None:
        page.area(frame.page(*section.contour.T), colour=_RESTING)
    else:
        page.ribbon(frame.page(*section.slit.T), stroke=5.0 * frame.unit, colour=BODY_EDGE)


def draw_displaced(page: Page, section: FloatSection, scale: float, frame: Frame) -> None:
    """Draw a float displaced, a thin one so that its line shows through, and dashes where it rests."""
    unit = frame.unit
    corners = frame.displaced(*section.contour.T, *(scale * section.displacement.T))
    page.area(corners, colour=BODY, opacity=1.0 if section.slit is None else 0.45)
    page.ribbon(closed(corners), stroke=3.5 * unit, colour=BODY_EDGE)
    at_rest = closed(frame.page(*section.contour.T))[:-1]
    for dash in dashed(at_rest, dash=9.0 * unit, gap=6.0 * unit):
        page.ribbon(dash, stroke=1.6 * unit, colour=INK)
