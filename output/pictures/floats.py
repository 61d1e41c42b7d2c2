"""Surfaces of liquids up to the floats that they touch, displaced as they are drawn."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from hydroelastic.fem.pictures.mode import Array, FloatSection, SurfaceCurve
from hydroelastic.output.pictures.view import View

# Ends of surfaces miss the contact points by less than this part of the waterplane.
_ROUNDING = 1e-6


def up_to_floats(curve: SurfaceCurve, floats: tuple[FloatSection, ...], view: View) -> SurfaceCurve:
    """Continue a surface of a liquid at its height to where a float is drawn that it touches at rest.

    It ends at the contact points at rest, and the displaced float leaves a gap, or covers its end.
    """
    x, displacement = curve.x, curve.displacement
    for section in floats if curve.kind != "body" else ():
        left, right = section.waterplane
        near = _ROUNDING * (right - left)
        corners = view.displaced(section)
        for end, contact, other in ((-1, left, right), (0, right, left)):
            if abs(x[end] - contact) < near:
                met = _crossings(corners, view.heights(curve, curve.displacement)[end])
                met = met[(met - contact) * (met - other) < 0.0]
                if len(met):
                    place = len(x) if end else 0
                    x = np.insert(x, place, met[np.argmin(np.abs(met - contact))])
                    displacement = np.insert(displacement, place, displacement[end])
    return replace(curve, x=x, displacement=displacement)


def _crossings(corners: Array, height: float) -> Array:
    ends = np.roll(corners, -1, axis=0)
    crosses = (corners[:, 1] > height) != (ends[:, 1] > height)
    start, step = corners[crosses], (ends - corners)[crosses]
    abscissae: Array = start[:, 0] + step[:, 0] * (height - start[:, 1]) / step[:, 1]
    return abscissae
