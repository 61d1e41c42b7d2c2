"""A natural mode to be drawn: the field of the liquids, the surfaces and floats that move, and the tank around them."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import Literal, TypeAlias

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Beyond: TypeAlias = Literal["sides", "bottom", "top"]

UNIT_MASS = "unit generalized mass"
"""The scale of natural modes, whose amplitude is arbitrary."""


@dataclass(frozen=True, kw_only=True)
class SurfaceCurve:
    """Vertical displacement of a piece of a still level.

    Attributes:
        kind: what is there.
        x: abscissae in m, increasing, shape (points,).
        displacement: upwards, in the mode's arbitrary scale, shape (points,).
        level: ordinate at rest in m.
    """

    kind: Literal["free_surface", "interface", "body"]
    x: Array
    displacement: Array
    level: float = 0.0

    def __post_init__(self) -> None:
        if self.x.ndim != 1 or self.x.shape != self.displacement.shape or len(self.x) < 2:
            raise ValueError(
                f"a surface curve needs x and displacement of one shape (points ≥ 2,), "
                f"got {self.x.shape} and {self.displacement.shape}"
            )
        if not (np.isfinite(self.x).all() and np.isfinite(self.displacement).all()):
            raise ValueError("x and displacement of a surface curve must be finite")

    def scaled(self, length: float, factor: float) -> SurfaceCurve:
        """The curve with its place multiplied by a length, and its displacement by a factor."""
        return replace(self, x=self.x * length, level=self.level * length, displacement=factor * self.displacement)


@dataclass(frozen=True, kw_only=True)
class FloatSection:
    """The section of a rigid float.

    Attributes:
        contour: corners of a closed polygon at rest in m, the first not repeated, shape (points, 2).
        displacement: of them in the mode's arbitrary scale, shape (points, 2).
        waterplane: abscissae in m at which surfaces of liquids meet it from the left and from the right.
        slit: lower and upper end of the line on which a thin float acts, shape (2, 2); ``None`` where the float
            displaces liquid.
    """

    contour: Array
    displacement: Array
    waterplane: tuple[float, float]
    slit: Array | None = None

    def __post_init__(self) -> None:
        if self.contour.shape != self.displacement.shape or self.contour.shape[1:] != (2,) or len(self.contour) < 3:
            raise ValueError(
                f"a float needs contour and displacement of one shape (points ≥ 3, 2), "
                f"got {self.contour.shape} and {self.displacement.shape}"
            )
        if not (np.isfinite(self.contour).all() and np.isfinite(self.displacement).all()):
            raise ValueError("contour and displacement of a float must be finite")

    def scaled(self, length: float, factor: float) -> FloatSection:
        """The float with its place multiplied by a length, and its displacement by a factor."""
        return FloatSection(
            contour=self.contour * length,
            displacement=factor * self.displacement,
            waterplane=(self.waterplane[0] * length, self.waterplane[1] * length),
            slit=None if self.slit is None else self.slit * length,
        )

    @property
    def height(self) -> float:
        """Height of the section in m."""
        return float(np.ptp(self.contour[:, 1]))

    @property
    def largest(self) -> float:
        """Largest displacement of a point of the contour."""
        return float(np.hypot(*self.displacement.T).max())


@dataclass(frozen=True, kw_only=True)
class ModePicture:
    """A mode of one liquid or two in a rectangular tank 0 ≤ x ≤ length, −depth ≤ y ≤ upper_depth.

    Attributes:
        points: coordinates in m, shape (points, 2).
        triangles: shape (triangles, 3).
        potential: displacement potential ψ, shape (points,).
        displacement: ∇ψ in the mode's arbitrary scale, shape (points, 2).
        surfaces: the pieces of the still levels that move.
        title: one line of text.
        length: of the tank in m.
        depth: of the lower liquid in m.
        upper_depth: of the upper liquid in m; 0 where there is none.
        floats: the rigid floats.
        densities: of the lower and the upper liquid in kg/m³; empty where there is only one.
        lid: pieces of a rigid top, left and right end in m.
        goes_on: where the liquids go on beyond what is given, instead of a wall or a bottom.
        start: abscissa, m, that stands at the left end on the scale of x.
        amplitude: what the scale of the motion is.
    """

    points: Array
    triangles: NDArray[np.integer]
    potential: Array
    displacement: Array
    surfaces: tuple[SurfaceCurve, ...]
    title: str
    length: float
    depth: float
    upper_depth: float = 0.0
    floats: tuple[FloatSection, ...] = ()
    densities: tuple[float, ...] = ()
    lid: tuple[tuple[float, float], ...] = ()
    goes_on: frozenset[Beyond] = frozenset()
    start: float = 0.0
    amplitude: str = UNIT_MASS

    def __post_init__(self) -> None:
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
        if (self.upper_depth > 0) != (len(self.densities) == 2):
            raise ValueError(
                f"an upper liquid has a depth and two liquids have densities, got {self.upper_depth} and "
                f"{self.densities}"
            )

    def times(self, factor: float) -> ModePicture:
        """The motion to another scale."""
        return replace(
            self,
            potential=factor * self.potential,
            displacement=factor * self.displacement,
            surfaces=tuple(curve.scaled(1.0, factor) for curve in self.surfaces),
            floats=tuple(section.scaled(1.0, factor) for section in self.floats),
        )

    @property
    def has_two_liquids(self) -> bool:
        """Whether there is an upper liquid."""
        return self.upper_depth > 0

    def is_at_top(self, curve: SurfaceCurve) -> bool:
        """Whether a curve belongs to the top, and not to the interface."""
        return not self.has_two_liquids or curve.level > 0.0

    @cached_property
    def weight(self) -> Array:
        """What ψ is multiplied with to be drawn, shape (points,): 1, or ρ in kg/m³ of two liquids.

        ρψ is the dynamic pressure over ω². Unlike ψ, it compares across the interface: its jump there is what the
        interface's elevation balances.
        """
        weight = np.ones(len(self.points))
        if self.has_two_liquids:
            # A point on the interface stands once per triangle's cell: the middle of a triangle tells its liquid.
            above = self.points[self.triangles, 1].mean(axis=1) > 0.0
            weight[:] = self.densities[0]
            weight[self.triangles[above]] = self.densities[1]
        return weight

    @cached_property
    def drawn_field(self) -> Array:
        """ψ, or ρψ of two liquids, shape (points,)."""
        return self.weight * self.potential
