"""A thin elastic plate without draught on a still surface: its outline, stiffness and mass."""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import inf, isfinite, pi
from typing import Literal, TypeAlias

import numpy as np

from hydroelastic.physics.arrays import FloatArray
from hydroelastic.physics.scales import Scales

Edge: TypeAlias = Literal["free", "hinged", "clamped", "sliding"]
"""What holds an edge that lies on a wall: nothing, w = 0, w = 0 and w_n = 0, or w_n = 0 alone."""

Point: TypeAlias = tuple[float, float]
"""x and y, m."""


@dataclass(frozen=True, kw_only=True)
class Rectangle:
    """A rectangle with sides along x and y."""

    position: Point  # x and y of its centre, m
    size: Point  # its lengths along x and along y, m

    @property
    def area(self) -> float:
        """Its area, m²."""
        return self.size[0] * self.size[1]

    @property
    def extent(self) -> float:
        """The larger of its lengths along x and y, m."""
        return max(self.size)

    @property
    def corners(self) -> tuple[Point, ...]:
        """Its corners, around it."""
        (x, y), (along, across) = self.position, self.size
        return tuple(
            (x + 0.5 * one * along, y + 0.5 * other * across) for one, other in ((-1, -1), (1, -1), (1, 1), (-1, 1))
        )

    def scaled(self, length: float) -> Rectangle:
        """Return it in units of a length."""
        return replace(self, position=scaled_point(self.position, length), size=scaled_point(self.size, length))


@dataclass(frozen=True, kw_only=True)
class Strip:
    """A strip over the whole width of a box; its side edges slide along the walls."""

    start: float  # x of its left edge, m
    length: float  # its length along x, m
    width: float  # that of the box, m

    @property
    def end(self) -> float:
        """The x of its right edge, m."""
        return self.start + self.length

    @property
    def area(self) -> float:
        """Its area, m²."""
        return self.length * self.width

    @property
    def extent(self) -> float:
        """The larger of its lengths along x and y, m."""
        return max(self.length, self.width)

    @property
    def corners(self) -> tuple[Point, ...]:
        """Its corners, around it."""
        return (self.start, 0.0), (self.end, 0.0), (self.end, self.width), (self.start, self.width)

    def scaled(self, length: float) -> Strip:
        """Return it in units of a length."""
        return replace(self, start=self.start / length, length=self.length / length, width=self.width / length)


@dataclass(frozen=True, kw_only=True)
class Disc:
    """A disc, or a ring."""

    radius: float  # outer radius, m
    position: Point = (0.0, 0.0)  # x and y of its centre, m
    inner_radius: float = 0.0  # that of a ring, m; 0 of a disc

    @property
    def area(self) -> float:
        """Its area, m²."""
        return pi * (self.radius**2 - self.inner_radius**2)

    @property
    def extent(self) -> float:
        """The larger of its lengths along x and y, m."""
        return 2.0 * self.radius

    def scaled(self, length: float) -> Disc:
        """Return it in units of a length."""
        return replace(
            self,
            radius=self.radius / length,
            position=scaled_point(self.position, length),
            inner_radius=self.inner_radius / length,
        )


@dataclass(frozen=True, kw_only=True)
class Polygon:
    """A polygon."""

    points: tuple[Point, ...]  # its corners in order, without the first one repeated, m

    @property
    def area(self) -> float:
        """Its area, m²."""
        following = (*self.points[1:], self.points[0])
        return 0.5 * abs(sum(x * v - u * y for (x, y), (u, v) in zip(self.points, following, strict=True)))

    @property
    def extent(self) -> float:
        """The larger of its lengths along x and y, m."""
        return float(np.ptp(np.array(self.points), axis=0).max())

    @property
    def corners(self) -> FloatArray:
        """Its corners anticlockwise, shape (corners, 2)."""
        corners: FloatArray = np.array(self.points, dtype=np.float64)
        ahead = np.roll(corners, -1, axis=0)
        area = float((corners[:, 0] * ahead[:, 1] - corners[:, 1] * ahead[:, 0]).sum())
        return corners if area > 0.0 else corners[::-1]

    def scaled(self, length: float) -> Polygon:
        """Return it in units of a length."""
        return replace(self, points=tuple(scaled_point(point, length) for point in self.points))


Outline: TypeAlias = Rectangle | Strip | Disc | Polygon
"""The outline of a plate at rest; a ring is a disc with an inner radius."""

Bounds: TypeAlias = tuple[Point, Point]
"""Least and largest x, and least and largest y, m."""


def bounds_of(outline: Outline) -> Bounds:
    """Return the box around an outline, m."""
    if isinstance(outline, Strip):
        return (outline.start, outline.end), (0.0, outline.width)
    if isinstance(outline, Rectangle):
        (x, y), (length, width) = outline.position, outline.size
        return (x - 0.5 * length, x + 0.5 * length), (y - 0.5 * width, y + 0.5 * width)
    if isinstance(outline, Disc):
        (x, y), radius = outline.position, outline.radius
        return (x - radius, x + radius), (y - radius, y + radius)
    along, across = zip(*outline.points, strict=True)
    return (min(along), max(along)), (min(across), max(across))


@dataclass(frozen=True, kw_only=True)
class Plate:
    """A uniform Kirchhoff plate: D Δ²w + m ẅ + s ρ g w = pressure of the liquid.

    Raises:
        ValueError: if the rigidity is not positive, the mass negative or not finite, or ν not in (−1, 1/2].
    """

    outline: Outline  # what it covers
    flexural_rigidity: float  # D, N·m; infinite of a rigid plate
    mass_per_area: float  # m, kg/m²
    poisson_ratio: float = 0.3
    hydrostatic: bool = True  # whether the hydrostatic restoring ρ g w acts on it
    # what holds the edges that lie on walls; all others are free. The side edges of a strip always slide.
    edge: Edge = "free"
    slats: bool = False  # whether a strip consists of beams side by side, without stiffness across: a(w, w) = ∫w_xx²

    def __post_init__(self) -> None:
        if not (self.flexural_rigidity > 0.0 and isfinite(self.mass_per_area) and self.mass_per_area >= 0.0):
            raise ValueError("a plate needs a positive flexural rigidity and a mass per area that is not negative")
        if not -1.0 < self.poisson_ratio <= 0.5:
            raise ValueError(f"Poisson's ratio is {self.poisson_ratio}; it lies above −1 and is 1/2 at most")

    @property
    def is_elastic(self) -> bool:
        """Whether it bends."""
        return self.flexural_rigidity < inf

    def scaled(self, units: Scales) -> Plate:
        """Return it in other units."""
        return replace(
            self,
            outline=self.outline.scaled(units.length),
            flexural_rigidity=self.flexural_rigidity / units.flexural_rigidity,
            mass_per_area=self.mass_per_area / units.mass_per_length,
        )


def scaled_point(point: Point, length: float) -> Point:
    """Return a point in units of a length."""
    return point[0] / length, point[1] / length
