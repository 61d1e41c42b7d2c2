"""Half-widths of symmetric rigid floats: exponential, parabola, ellipse, wedge (rhombus), rectangle."""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Literal, get_args

import numpy as np
import numpy.typing as npt

from hydroelastic.physics.arrays import FloatArray
from hydroelastic.physics.contours import Arc, Contour, Point

FloatShape = Literal["exponential", "parabola", "ellipse", "wedge", "rectangle"]
DEFAULT_TAIL = 1e-3


@dataclass(frozen=True, kw_only=True)
class ProfileArc:
    """A smooth piece of the right side of a section, directed upward."""

    # maps t in [0, 1], shape (n,), to points (x, y) in m, shape (n, 2); smooth up to both ends
    point: Callable[[npt.ArrayLike], FloatArray]
    # its derivative with respect to t, m, of the same shapes, also smooth up to both ends
    velocity: Callable[[npt.ArrayLike], FloatArray]
    straight: bool  # whether it is a straight segment


@dataclass(frozen=True, kw_only=True)
class Profile:
    """A section −ω(y) ≤ x ≤ ω(y), |y| ≤ `extent`, symmetric about x = 0 and about the level y = 0.

    With b = `half_width` and h = `half_height`, on |y| < extent:

        exponential  ω = b (e^{−|y|/h} − tail)/(1 − tail),  extent = h ln(1/tail)
        parabola     ω = b (1 − y²/h²)
        ellipse      ω = b √(1 − y²/h²)
        wedge        ω = b (1 − |y|/h)
        rectangle    ω = b

    b contains the small factor α of the thin-float theory: b = α l, h = 1/μ for the exponential.

    Raises:
        ValueError: on construction, if a quantity is out of its range.
    """

    shape: FloatShape  # one of the five
    half_width: float  # b, half of the breadth at y = 0, m
    half_height: float  # h, m; the decay length 1/μ of the exponential
    # of the exponential, in [0, 1); 0 is the unbounded shape, which has no outline. 0 for all other shapes.
    tail: float = 0.0

    def __post_init__(self) -> None:
        if self.shape not in get_args(FloatShape):
            raise ValueError(f"shape is {self.shape!r}; known are {', '.join(get_args(FloatShape))}")
        for name in ("half_width", "half_height"):
            value = getattr(self, name)
            if not (math.isfinite(value) and value > 0):
                raise ValueError(f"{name} is {value}; it must be finite and positive")
        if not 0 <= self.tail < 1:
            raise ValueError(f"tail is {self.tail}; it must be at least 0 and less than 1")
        if self.tail and self.shape != "exponential":
            raise ValueError(f"tail belongs to the exponential, not to the {self.shape}")

    @property
    def extent(self) -> float:
        """Distance from the level y = 0 to the highest point, m; infinite for an exponential without end."""
        if self.shape != "exponential":
            return self.half_height
        return self.half_height * -math.log(self.tail) if self.tail else math.inf

    @property
    def is_blunt(self) -> bool:
        """Whether the section ends in a flat edge, ω(extent) > 0, which no thin-float theory admits."""
        return self.shape == "rectangle"

    def half_width_at(self, y: npt.ArrayLike) -> FloatArray:
        """Return ω(y) ≥ 0, m: even in y, 0 above and below the section.

        Args:
            y: height above the level y = 0, m.

        Returns:
            Values in the shape of ``y``.
        """
        distance = np.abs(np.asarray(y, dtype=np.float64)) / self.half_height
        inside = distance <= self.extent / self.half_height
        width: FloatArray = self.half_width * np.where(inside, self._relative_width(np.where(inside, distance, 0.0)), 0)
        return width

    def slope_at(self, y: npt.ArrayLike) -> FloatArray:
        """Return ω'(y) = dω/dy: odd in y, so **negative above** the level y = 0 and positive below it.

        At y = 0 it is 0, the mean of both sides, although exponential and wedge have a corner there. At the ends
        y = ±extent it is the slope from within: infinite for the ellipse. Above and below the section it is 0.

        Args:
            y: height above the level y = 0, m.

        Returns:
            Values in the shape of ``y``, dimensionless.
        """
        height = np.asarray(y, dtype=np.float64)
        distance = np.abs(height) / self.half_height
        inside = distance <= self.extent / self.half_height
        steepness = self._relative_slope(np.where(inside, distance, 0.0))
        slope: FloatArray = np.sign(height) * self.half_width / self.half_height * np.where(inside, steepness, 0.0)
        return slope

    @property
    def arcs(self) -> tuple[ProfileArc, ...]:
        """The right side from the lowest point (0, −extent) to the highest (0, extent), in smooth arcs.

        They meet in `corners`, the two ends excepted; the left side is the mirror image.
        """
        self._check_bounded()
        b, h, end = self.half_width, self.half_height, self.extent
        if self.shape == "ellipse":
            return (
                ProfileArc(
                    point=lambda t: _ellipse(b, h, t), velocity=lambda t: _ellipse_velocity(b, h, t), straight=False
                ),
            )
        if self.shape == "parabola":
            return (self._graph_arc(-end, end),)
        if self.shape == "exponential":
            return self._graph_arc(-end, 0.0), self._graph_arc(0.0, end)
        through = [(0.0, -h), (b, -h), (b, h), (0.0, h)] if self.shape == "rectangle" else [(0.0, -h), (b, 0), (0.0, h)]
        return tuple(_segment(*ends) for ends in itertools.pairwise(through))

    @property
    def corners(self) -> FloatArray:
        """Points (x, y), x ≥ 0, where the outline of the whole section has a corner, from below, m, shape (n, 2).

        Those at x = 0 are the pointed ends, where the right side meets its mirror image.
        """
        self._check_bounded()
        b, end = self.half_width, self.extent
        corners: dict[FloatShape, list[tuple[float, float]]] = {
            "exponential": [(0.0, -end), (b, 0.0), (0.0, end)],
            "parabola": [(0.0, -end), (0.0, end)],
            "ellipse": [],
            "wedge": [(0.0, -end), (b, 0.0), (0.0, end)],
            "rectangle": [(b, -end), (b, end)],
        }
        return np.array(corners[self.shape], dtype=np.float64).reshape(-1, 2)

    def _check_bounded(self) -> None:
        if math.isinf(self.extent):
            raise ValueError("the exponential with tail = 0 has no end and so no outline; give it a tail")

    def _relative_width(self, distance: FloatArray) -> FloatArray:
        """Return ω/b at distance = |y|/h, within the section."""
        if self.shape == "exponential":
            if not self.tail:
                return np.exp(-distance)
            # e^{−d} − tail without cancellation near the end, where it must fall to exactly 0.
            end = -math.log(self.tail)
            return np.exp(-distance) * np.expm1(distance - end) / math.expm1(-end)
        if self.shape == "parabola":
            return (1 - distance) * (1 + distance)
        if self.shape == "ellipse":
            return np.sqrt((1 - distance) * (1 + distance))
        return 1 - distance if self.shape == "wedge" else np.ones_like(distance)

    def _relative_slope(self, distance: FloatArray) -> FloatArray:
        """Return (h/b) dω/d|y| ≤ 0 at distance = |y|/h, within the section."""
        if self.shape == "exponential":
            return -np.exp(-distance) / (1 - self.tail)
        if self.shape == "parabola":
            return -2 * distance
        if self.shape == "ellipse":
            with np.errstate(divide="ignore"):
                return -distance / np.sqrt((1 - distance) * (1 + distance))
        return np.full_like(distance, -1.0 if self.shape == "wedge" else 0.0)

    def _graph_arc(self, start: float, end: float) -> ProfileArc:
        """Return x = ω(y) between two heights; at a corner y = 0 the slope is that from within."""
        middle = 0.5 * (start + end)

        def height(t: npt.ArrayLike) -> FloatArray:
            s = np.asarray(t, dtype=np.float64)
            return start * (1 - s) + end * s

        def point(t: npt.ArrayLike) -> FloatArray:
            y = height(t)
            return np.stack([self.half_width_at(y), y], axis=-1)

        def velocity(t: npt.ArrayLike) -> FloatArray:
            y = height(t)
            side = np.sign(np.where(y == 0, middle, y))
            slope = side * self.half_width / self.half_height * self._relative_slope(np.abs(y) / self.half_height)
            return (end - start) * np.stack([slope, np.ones_like(y)], axis=-1)

        return ProfileArc(point=point, velocity=velocity, straight=False)


def float_profile(shape: FloatShape, half_width: float, half_height: float, tail: float = DEFAULT_TAIL) -> Profile:
    """Return the section of the given shape.

    Args:
        shape: exponential, parabola, ellipse, wedge or rectangle.
        half_width: b, half of the breadth at y = 0, m.
        half_height: h, half of the height, m; the decay length 1/μ of the exponential.
        tail: where the exponential ends, as a part of its half-width before the ending; other shapes do not use it.
    """
    if shape == "exponential":
        return Profile(shape=shape, half_width=half_width, half_height=half_height, tail=tail)
    return Profile(shape=shape, half_width=half_width, half_height=half_height)


def profile_contour(profile: Profile) -> Contour:
    """Return the closed contour of a section, counterclockwise from its lowest point, m."""
    right = tuple(_right(arc) for arc in profile.arcs)
    return Contour(right + tuple(_mirrored(arc) for arc in reversed(right)))


def _right(arc: ProfileArc) -> Arc:
    (start, end) = ((float(x), float(y)) for x, y in arc.point(np.array([0.0, 1.0])))
    return Arc(curve=arc.point, velocity=arc.velocity, start=_on_axis(start), end=_on_axis(end), straight=arc.straight)


def _on_axis(point: Point) -> Point:
    """A point of a profile; sines of π leave one that lies on the axis beside it by rounding."""
    x, y = point
    return (0.0 if abs(x) < 1e-15 * abs(y) else x), y


def _mirrored(arc: Arc) -> Arc:
    """The mirror image of an arc about x = 0, passed the other way."""
    (x, y), (z, w) = arc.start, arc.end
    return replace(
        arc,
        curve=lambda t: arc.curve(1.0 - t) * (-1.0, 1.0),
        velocity=lambda t: arc.velocity(1.0 - t) * (1.0, -1.0),
        start=(-z, w),
        end=(-x, y),
    )


def _ellipse(half_width: float, half_height: float, t: npt.ArrayLike) -> FloatArray:
    angle = np.pi * np.asarray(t, dtype=np.float64)
    return np.stack([half_width * np.sin(angle), -half_height * np.cos(angle)], axis=-1)


def _ellipse_velocity(half_width: float, half_height: float, t: npt.ArrayLike) -> FloatArray:
    angle = np.pi * np.asarray(t, dtype=np.float64)
    return np.pi * np.stack([half_width * np.cos(angle), half_height * np.sin(angle)], axis=-1)


def _segment(start: tuple[float, float], end: tuple[float, float]) -> ProfileArc:
    first, last = np.array(start), np.array(end)

    def point(t: npt.ArrayLike) -> FloatArray:
        s = np.asarray(t, dtype=np.float64)[..., None]
        return first * (1 - s) + last * s

    def velocity(t: npt.ArrayLike) -> FloatArray:
        return np.broadcast_to(last - first, (*np.shape(t), 2))

    return ProfileArc(point=point, velocity=velocity, straight=True)
