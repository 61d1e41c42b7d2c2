"""A natural mode to be drawn, and the choice of its scales."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

_ROUND_NUMBERS = np.array([1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0])

FLATTEST = 0.15
"""A tank whose depth/length is smaller than this is stretched vertically."""
FLAT_TARGET = 0.2
"""Drawn depth/length of a stretched tank, at least."""
DEEPEST = 1.5
"""A tank whose depth/length is larger than this is cut."""
DEEP_CUT = 1.25
"""Drawn depth/length of a cut tank; the slowest part of a mode, exp(πy/length), has fallen to 2 % there."""


@dataclass(frozen=True, kw_only=True)
class SurfaceCurve:
    """Vertical displacement of a piece of the liquid's top.

    Attributes:
        kind: what floats there.
        x: abscissae in m, increasing, shape (points,).
        displacement: upwards, in the mode's arbitrary scale, shape (points,).
    """

    kind: Literal["free_surface", "body"]
    x: Array
    displacement: Array

    def __post_init__(self) -> None:
        """Refuse arrays that do not belong together."""
        if self.x.ndim != 1 or self.x.shape != self.displacement.shape or len(self.x) < 2:
            raise ValueError(
                f"a surface curve needs x and displacement of one shape (points ≥ 2,), "
                f"got {self.x.shape} and {self.displacement.shape}"
            )
        if not (np.isfinite(self.x).all() and np.isfinite(self.displacement).all()):
            raise ValueError("x and displacement of a surface curve must be finite")


@dataclass(frozen=True, kw_only=True)
class ModePicture:
    """A natural mode of the liquid in a rectangular tank 0 ≤ x ≤ length, −depth ≤ y ≤ 0.

    Attributes:
        points: coordinates in m, shape (points, 2).
        triangles: shape (triangles, 3).
        potential: displacement potential ψ, shape (points,).
        displacement: ∇ψ in the mode's arbitrary scale, shape (points, 2).
        surfaces: the pieces of the top.
        title: one line of text.
        length: of the tank in m.
        depth: of the liquid in m.
    """

    points: Array
    triangles: NDArray[np.integer]
    potential: Array
    displacement: Array
    surfaces: tuple[SurfaceCurve, ...]
    title: str
    length: float
    depth: float

    def __post_init__(self) -> None:
        """Refuse arrays that do not belong together."""
        count = len(self.points)
        expected = {"points": (count, 2), "potential": (count,), "displacement": (count, 2)}
        wrong = [f"{name} {getattr(self, name).shape}" for name, shape in expected.items()
                 if getattr(self, name).shape != shape]  # fmt: skip
        if self.triangles.ndim != 2 or self.triangles.shape[1] != 3:
            wrong.append(f"triangles {self.triangles.shape}")
        if wrong:
            raise ValueError(f"shapes do not fit {count} points: {', '.join(wrong)}")
        finite = all(np.isfinite(getattr(self, name)).all() for name in expected)
        if not finite:
            raise ValueError("points, potential and displacement must be finite")
        if not (self.length > 0 and self.depth > 0):
            raise ValueError(f"length and depth must be positive, got {self.length} and {self.depth}")


@dataclass(frozen=True, kw_only=True)
class View:
    """What of the tank is drawn, and how it is scaled.

    Attributes:
        length: of the tank in m.
        depth: drawn depth in m.
        whole_depth: depth of the liquid in m.
        stretch: vertical scale over horizontal scale.
        surface_scale: factor of the surfaces' displacement; 0 if nothing moves.
        amplitude: largest drawn displacement of a surface in m.
    """

    length: float
    depth: float
    whole_depth: float
    stretch: float
    surface_scale: float
    amplitude: float

    @property
    def cut(self) -> bool:
        """Whether the liquid goes on below the drawn depth."""
        return self.depth < self.whole_depth

    @property
    def headroom(self) -> float:
        """Drawn height above the still level in m, the same for a mode and its opposite."""
        return 1.35 * self.amplitude

    @property
    def aspect(self) -> float:
        """Height over width on the page."""
        return self.stretch * (self.depth + self.headroom) / self.length


def view_of(picture: ModePicture) -> View:
    """Choose the vertical scale, the drawn depth and the scale of the surfaces."""
    ratio = picture.depth / picture.length
    depth = DEEP_CUT * picture.length if ratio > DEEPEST else picture.depth
    stretch = 1.0 if ratio >= FLATTEST else _round_up(FLAT_TARGET / ratio)
    amplitude = 0.1 * min(picture.length, 1.6 * depth)
    largest = max((float(np.abs(curve.displacement).max()) for curve in picture.surfaces), default=0.0)
    return View(
        length=picture.length,
        depth=depth,
        whole_depth=picture.depth,
        stretch=stretch,
        surface_scale=amplitude / largest if largest > 0 else 0.0,
        amplitude=amplitude,
    )


def colour_limit(picture: ModePicture) -> float:
    """Largest |ψ|, or 1 for a liquid at rest."""
    return float(np.abs(picture.potential).max(initial=0.0)) or 1.0


def iso_levels(limit: float) -> Array:
    """Round levels of ψ between −limit and limit, six to twelve on each side.

    The level 0 is a hair above it: on the mirror plane of an antisymmetric mode ψ is 0 at whole edges of triangles,
    where a line has no course.
    """
    levels = round_ticks(-limit, limit, 24)
    return levels + np.where(levels == 0.0, 1e-6 * limit, 0.0)


def round_ticks(low: float, high: float, count: int) -> Array:
    """Multiples of 1, 2 or 5 times a power of ten in [low, high], about ``count`` of them and never many more."""
    rough = (high - low) / count
    power = 10.0 ** np.floor(np.log10(rough))
    step = power * next(s for s in (1.0, 2.0, 5.0, 10.0) if s * power >= rough * (1 - 1e-9))
    first, last = np.ceil(low / step - 1e-9), np.floor(high / step + 1e-9)
    return step * np.arange(first, last + 1)


def _round_up(value: float) -> float:
    power = 10.0 ** np.floor(np.log10(value))
    return float(power * _ROUND_NUMBERS[value / power * (1 - 1e-9) <= _ROUND_NUMBERS][0])
