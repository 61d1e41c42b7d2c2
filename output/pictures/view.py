"""What of a mode's tank is drawn, and the choice of its scales."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hydroelastic.fem.pictures.mode import Array, FloatSection, ModePicture, SurfaceCurve

_ROUND_NUMBERS = np.array([1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0])

FLATTEST = 0.15
"""A tank whose depth/length is smaller than this is stretched vertically."""
FLAT_TARGET = 0.2
"""Drawn depth/length of a stretched tank, at least."""
DEEPEST = 1.5
"""A liquid whose depth/length is larger than this is cut."""
DEEP_CUT = 1.25
"""Drawn depth/length of a cut liquid; the slowest part of a mode, exp(πy/length), has fallen to 2 % there."""
DEEPEST_OF_TWO = 1.0
"""Of two liquids, one whose depth/length is larger than this is cut, unless its far side moves."""
DEEP_CUT_OF_TWO = 0.8
"""Drawn depth/length of such a one, at which the slowest part of a mode has fallen to 8 %."""
TALLEST = 2.0
"""Two liquids whose drawn height/length is larger than this are compressed to less."""
THINNEST = 0.05
"""Of two liquids, one whose drawn depth/length is smaller than this gets a vertical scale of its own."""
THIN_TARGET = 0.1
"""Drawn depth/length of such a thin liquid, at least."""
BESIDE_FLOAT = 1.2
"""A cut liquid reaches this many times as deep as the floats in it."""


@dataclass(frozen=True, kw_only=True)
class View:
    """What of the tank is drawn, and how it is scaled. Lengths are in m.

    Attributes:
        length: of the tank.
        depth: drawn depth of the lower liquid.
        whole_depth: depth of the lower liquid.
        upper_depth: drawn depth of the upper liquid.
        whole_upper_depth: depth of the upper liquid.
        stretch: vertical scale over horizontal scale in the lower liquid.
        upper_stretch: the same in the upper liquid.
        surface_scale: factor of the displacement of surfaces and floats; 0 if nothing moves.
        amplitude: largest drawn displacement of a surface or float.
        headroom: drawn height above the top, the same for a mode and its opposite.
    """

    length: float
    depth: float
    whole_depth: float
    upper_depth: float
    whole_upper_depth: float
    stretch: float
    upper_stretch: float
    surface_scale: float
    amplitude: float
    headroom: float

    @property
    def cut(self) -> bool:
        """Whether the liquid goes on below the drawn depth."""
        return self.depth < self.whole_depth

    @property
    def upper_cut(self) -> bool:
        """Whether the upper liquid goes on above what is drawn."""
        return self.upper_depth < self.whole_upper_depth

    @property
    def rise(self) -> float:
        """Vertical scale over horizontal scale of displacements of surfaces and floats, and above the top."""
        return min(self.stretch, self.upper_stretch)

    @property
    def aspect(self) -> float:
        """Height over width on the page."""
        (low, high) = self.drawn(np.array([-self.depth, self.upper_depth + self.headroom]))
        return float(high - low) / self.length

    def drawn(self, y: Array) -> Array:
        """Heights on the page of ordinates in m, in the scale of the abscissae."""
        below, above = np.minimum(y, 0.0), np.maximum(y - self.upper_depth, 0.0)
        return self.stretch * below + self.upper_stretch * (y - below - above) + self.rise * above

    def displaced(self, section: FloatSection) -> Array:
        """Corners of a displaced float on the page, in the scale of the abscissae, shape (points, 2)."""
        moved = self.surface_scale * section.displacement
        x, y = section.contour.T
        return np.column_stack([x + moved[:, 0], self.drawn(y) + self.rise * moved[:, 1]])

    def heights(self, curve: SurfaceCurve, displacement: Array) -> Array:
        """Heights on the page of a curve with a displacement in the mode's arbitrary scale."""
        level = self.drawn(np.full(len(curve.x), curve.level))
        return np.asarray(level + self.rise * self.surface_scale * displacement)


def view_of(picture: ModePicture) -> View:
    """Choose the vertical scales, the drawn depths and the scale of the displacements."""
    depth, upper_depth = _drawn_depths(picture)
    stretch, upper_stretch = _stretches(depth / picture.length, upper_depth / picture.length)
    rise = min(stretch, upper_stretch)
    amplitude = _amplitude(picture, stretch * depth, upper_stretch * upper_depth, rise)
    largest = max(
        (
            *(float(np.abs(curve.displacement).max()) for curve in picture.surfaces),
            *(section.largest for section in picture.floats),
        ),
        default=0.0,
    )
    return View(
        length=picture.length,
        depth=depth,
        whole_depth=picture.depth,
        upper_depth=upper_depth,
        whole_upper_depth=picture.upper_depth,
        stretch=stretch,
        upper_stretch=upper_stretch,
        surface_scale=amplitude / largest if largest > 0 else 0.0,
        amplitude=amplitude,
        headroom=_headroom(picture, amplitude),
    )


def _amplitude(picture: ModePicture, lower: float, upper: float, rise: float) -> float:
    """Largest drawn displacement, for drawn heights of the liquids and the vertical scale of displacements."""
    if picture.has_two_liquids:
        # Surfaces must not meet across a thin liquid.
        amplitude = min(0.1 * picture.length, 0.3 * lower, 0.3 * upper) / rise
    else:
        amplitude = 0.1 * min(picture.length, 1.6 * lower) / rise
    # A float is not to leave its place, nor the liquid it; but what moves much less is not seen.
    least = 0.25 * amplitude
    return min((amplitude, *(max(0.25 * section.height, least) for section in picture.floats)))


def _drawn_depths(picture: ModePicture) -> tuple[float, float]:
    """Drawn depths of the lower and the upper liquid; above, only still liquid can be left out."""
    ordinates = np.concatenate([np.zeros(1), *(section.contour[:, 1] for section in picture.floats)])
    depth = _drawn_depth(picture, picture.depth, -float(ordinates.min()))
    if _top_moves(picture):
        return depth, picture.upper_depth
    return depth, _drawn_depth(picture, picture.upper_depth, float(ordinates.max()))


def _drawn_depth(picture: ModePicture, depth: float, reach: float) -> float:
    two = picture.has_two_liquids
    deepest, cut = (DEEPEST_OF_TWO, DEEP_CUT_OF_TWO) if two else (DEEPEST, DEEP_CUT)
    if depth <= deepest * picture.length:
        return depth
    return min(depth, max(cut * picture.length, BESIDE_FLOAT * reach))


def _top_moves(picture: ModePicture) -> bool:
    """Whether a surface or a body moves at the top of the uppermost liquid."""
    top = picture.upper_depth
    return any(picture.is_at_top(curve) for curve in picture.surfaces) or any(
        float(section.contour[:, 1].max()) > top for section in picture.floats
    )


def _headroom(picture: ModePicture, amplitude: float) -> float:
    if picture.has_two_liquids and not _top_moves(picture):
        return 0.0
    reached = max((float(section.contour[:, 1].max()) for section in picture.floats), default=picture.upper_depth)
    return max(reached - picture.upper_depth, 0.0) + 1.35 * amplitude


def _stretches(lower: float, upper: float) -> tuple[float, float]:
    """Vertical scales of the lower and the upper liquid from their drawn depths over the length."""
    whole = lower + upper
    stretch = 1.0 if whole >= FLATTEST else _round_up(FLAT_TARGET / whole)
    if upper == 0.0:
        return stretch, stretch
    if whole > TALLEST:
        stretch = _round_down(TALLEST / whole)
    lower_stretch, upper_stretch = (
        stretch if stretch * depth >= THINNEST else _round_up(THIN_TARGET / depth) for depth in (lower, upper)
    )
    return lower_stretch, upper_stretch


def colour_limit(picture: ModePicture) -> float:
    """Largest absolute value of the drawn field, or 1 for liquids at rest."""
    return float(np.abs(picture.drawn_field).max(initial=0.0)) or 1.0


def _round_up(value: float) -> float:
    power = 10.0 ** np.floor(np.log10(value))
    return float(power * _ROUND_NUMBERS[value / power * (1 - 1e-9) <= _ROUND_NUMBERS][0])


def _round_down(value: float) -> float:
    power = 10.0 ** np.floor(np.log10(value))
    return float(power * _ROUND_NUMBERS[value / power * (1 + 1e-9) >= _ROUND_NUMBERS][-1])
