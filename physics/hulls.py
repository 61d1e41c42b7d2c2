"""The hull of a body: the contour of its section where it meets the liquids, in metres or in units of its tank."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from hydroelastic.physics.contours import Arc, Contour
from hydroelastic.physics.profiles import Profile

# Contours that are mirror images in decimal input differ by a few units of the last place.
_ROUNDING = 1e-12


@dataclass(frozen=True, kw_only=True)
class Hull:
    """A contour at rest, in the frame of the tank."""

    contour: Contour  # of the section
    profile: Profile | None  # its half width about the reference level; of a symmetric section
    is_thin: bool  # whether its boundary conditions are imposed on its middle line
    height: float  # ordinate of the still level
    reference_level: float  # ordinate of the shape's reference level
    wet_above: bool  # whether there is liquid above the still level
    waterplane: tuple[float, float]  # x of its two contact points with the still level, the same for a thin one

    def moved(self, shift: float) -> Hull:
        """Return the same hull further to the right, m."""
        left, right = self.waterplane
        return replace(self, contour=self.contour.moved((shift, 0.0)), waterplane=(left + shift, right + shift))

    def scaled(self, length: float, start: float, end: float) -> Hull:
        """Return the hull in units of a length, between given contact points in these units."""
        profile = self.profile
        if profile is not None:
            profile = replace(profile, half_width=profile.half_width / length, half_height=profile.half_height / length)
        return replace(
            self,
            contour=self.contour.scaled(1.0 / length),
            profile=profile,
            height=self.height / length,
            reference_level=self.reference_level / length,
            waterplane=(start, end),
        )

    @cached_property
    def below(self) -> tuple[Arc, ...]:
        """The contour under the still level, from the left contact point to the right one."""
        return self._between(self.contour.below(self.height), self.waterplane)

    @cached_property
    def above(self) -> tuple[Arc, ...]:
        """The contour over it, from the right contact point to the left one; empty where it is dry."""
        return self._between(self.contour.above(self.height), self.waterplane[::-1]) if self.wet_above else ()

    def _between(self, chain: tuple[Arc, ...], ends: tuple[float, float]) -> tuple[Arc, ...]:
        """A chain of arcs with its ends exactly where the pieces of the still level end."""
        arcs = list(chain)
        arcs[0] = replace(arcs[0], start=(ends[0], self.height))
        arcs[-1] = replace(arcs[-1], end=(ends[1], self.height))
        return tuple(arcs)

    @property
    def slit(self) -> tuple[float, float]:
        """Lowest and highest point of the middle line of a thin float."""
        assert self.profile is not None
        return self.reference_level - self.profile.extent, self.reference_level + self.profile.extent

    @property
    def kinks(self) -> tuple[tuple[float, float], ...]:
        """Points of a slit, beside its ends and the still level, where the flux jumps: the widest of pointed shapes."""
        if not self.is_thin or self.profile is None or self.profile.shape not in ("wedge", "exponential"):
            return ()
        low, high = self.slit
        height = self.reference_level - self.height
        if abs(height) <= _ROUNDING * (high - low) or (height > 0.0 and not self.wet_above):
            return ()
        return ((self.waterplane[0], self.reference_level),)

    @property
    def bounds(self) -> tuple[float, float, float, float]:
        """Smallest and largest x, smallest and largest y."""
        return self.contour.bounds

    @property
    def smallest_extent(self) -> float:
        """The smaller of its width and of its largest draught in a liquid."""
        left, right, low, high = self.bounds
        reaches = [self.height - low, *([high - self.height] if self.wet_above else [])]
        return min(right - left, *reaches)

    @cached_property
    def is_symmetric(self) -> bool:
        """Whether it is its own mirror image about the vertical through its contact points' middle.

        Straight sides and splines are symmetric if the points that they join are; the half that is modelled is then the
        section's left half, whatever rounding does to the right one.
        """
        points = np.vstack([arc.point(np.array([0.0, *arc.knots])) for arc in self.contour.arcs])
        image = points * [-1.0, 1.0] + [2.0 * self.middle, 0.0]
        nearest = np.abs(points[:, None] - image[None]).max(axis=2).min(axis=0)
        return bool(nearest.max() <= self.rounding)

    @property
    def middle(self) -> float:
        """x of the middle of its contact points."""
        return 0.5 * sum(self.waterplane)

    @property
    def rounding(self) -> float:
        """Lengths below this are rounding."""
        low_x, high_x, low_y, high_y = self.bounds
        return _ROUNDING * max(high_x - low_x, high_y - low_y)

    def is_copy_of(self, other: Hull) -> bool:
        """Whether it has the shape and draught of another one up to rounding, wherever both lie."""
        points, others = (hull._samples - [hull.waterplane[0], 0.0] for hull in (self, other))
        same = self.is_thin == other.is_thin and points.shape == others.shape
        return same and bool(np.abs(points - others).max() <= self.rounding)

    @property
    def _samples(self) -> NDArray[np.float64]:
        """A few points of each arc, shape (points, 2), by which shapes are compared."""
        return np.vstack([arc.point(np.linspace(0.0, 1.0, 5)) for arc in self.contour.arcs])
