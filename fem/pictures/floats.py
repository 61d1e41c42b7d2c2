"""A rigid float on a page: its section where it rests, and displaced; surfaces of liquids up to it."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from hydroelastic.fem.pictures.frame import Frame
from hydroelastic.fem.pictures.mode import Array, FloatSection, SurfaceCurve
from hydroelastic.fem.pictures.page import INK, Page
from hydroelastic.fem.pictures.shapes import closed, dashed

BODY = "#d9660a"
BODY_EDGE = "#5c2a00"

_RESTING = "#f6e6d8"
# Ends of surfaces miss the contact points by less than this part of the waterplane.
_ROUNDING = 1e-6


def draw_resting(page: Page, section: FloatSection, frame: Frame) -> None:
    """Fill the place of a float in the liquid; mark the line on which a thin one acts."""
    if section.slit is None:
        page.area(frame.page(*section.contour.T), colour=_RESTING)
    else:
        page.ribbon(frame.page(*section.slit.T), stroke=5.0 * frame.unit, colour=BODY_EDGE)


def draw_displaced(page: Page, section: FloatSection, scale: float, frame: Frame) -> None:
    """Draw a float displaced, a thin one so that its line shows through, and dashes where it rests."""
    unit = frame.unit
    corners = displaced_corners(section, scale, frame)
    page.area(corners, colour=BODY, opacity=1.0 if section.slit is None else 0.45)
    page.ribbon(closed(corners), stroke=3.5 * unit, colour=BODY_EDGE)
    at_rest = closed(frame.page(*section.contour.T))[:-1]
    for dash in dashed(at_rest, dash=9.0 * unit, gap=6.0 * unit):
        page.ribbon(dash, stroke=1.6 * unit, colour=INK)


def displaced_corners(section: FloatSection, scale: float, frame: Frame) -> Array:
    """Page coordinates of a contour displaced by a factor, shape (points, 2)."""
    return frame.displaced(*section.contour.T, *(scale * section.displacement.T))


def up_to_floats(curve: SurfaceCurve, floats: tuple[FloatSection, ...], scale: float, frame: Frame) -> SurfaceCurve:
    """Continue a surface of a liquid at its height to where a float is drawn that it touches at rest.

    It ends at the contact points at rest, and the displaced float leaves a gap, or covers its end.
    """
    x, displacement = curve.x, curve.displacement
    for section in floats if curve.kind != "body" else ():
        left, right = section.waterplane
        near = _ROUNDING * (right - left)
        corners = displaced_corners(section, scale, frame)
        for end, contact, other in ((-1, left, right), (0, right, left)):
            if abs(x[end] - contact) < near:
                at_end = x[[end]], np.full(1, curve.level), np.zeros(1), scale * displacement[[end]]
                ((_, height),) = frame.displaced(*at_end)
                met = (_crossings(corners, height) - frame.left) / frame.per_metre
                met = met[(met - contact) * (met - other) < 0.0]
                if len(met):
                    nearest = met[np.argmin(np.abs(met - contact))]
                    place = len(x) if end else 0
                    x = np.insert(x, place, nearest)
                    displacement = np.insert(displacement, place, displacement[end])
    return replace(curve, x=x, displacement=displacement)


def _crossings(corners: Array, height: float) -> Array:
    """Abscissae at which a closed polygon crosses a height."""
    ends = np.roll(corners, -1, axis=0)
    crosses = (corners[:, 1] > height) != (ends[:, 1] > height)
    start, step = corners[crosses], (ends - corners)[crosses]
    abscissae: Array = start[:, 0] + step[:, 0] * (height - start[:, 1]) / step[:, 1]
    return abscissae
