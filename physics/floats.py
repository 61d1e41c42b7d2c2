"""A rigid float at rest: its wetted contour, its inertia and its hydrostatic stiffness, in metres or in units of its
tank."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from hydroelastic.physics.contours import Arc, Contour
from hydroelastic.physics.hydrostatics import Hydrostatics
from hydroelastic.physics.motions import Level, Motion
from hydroelastic.physics.profiles import Profile
from hydroelastic.physics.scales import Scales

# Contours that decimal input means to be mirror images differ by a few units of the last place.
_ROUNDING = 1e-12


@dataclass(frozen=True, kw_only=True)
class RigidFloat:
    """A float at rest, in the frame of the tank.

    Attributes:
        contour: of its section.
        hydrostatics: where it floats, its inertia and its stiffness.
        profile: its half width about the reference level; of a symmetric section.
        is_thin: whether its boundary conditions are imposed on its middle line.
        level: at which it floats.
        wet_above: whether there is liquid above that level.
        waterplane: x of its two contact points with the still level, the same for a thin float.
        motions: its free motions, in the order of `MOTIONS`.
    """

    contour: Contour
    hydrostatics: Hydrostatics
    profile: Profile | None
    is_thin: bool
    level: Level
    wet_above: bool
    waterplane: tuple[float, float]
    motions: tuple[Motion, ...]

    def moved(self, shift: float) -> RigidFloat:
        """Return the same float further to the right, m."""
        left, right = self.waterplane
        return replace(
            self,
            contour=self.contour.moved((shift, 0.0)),
            hydrostatics=self.hydrostatics.moved((shift, 0.0)),
            waterplane=(left + shift, right + shift),
        )

    def scaled(self, units: Scales, start: float, end: float) -> RigidFloat:
        """Return the float in other units, between given contact points in these units."""
        factor, profile = 1.0 / units.length, self.profile
        if profile is not None:
            profile = replace(
                profile,
                half_width=profile.half_width / units.length,
                half_height=profile.half_height / units.length,
            )
        return replace(
            self,
            contour=self.contour.scaled(factor),
            hydrostatics=self.hydrostatics.scaled(units),
            profile=profile,
            waterplane=(start, end),
        )

    @property
    def height(self) -> float:
        """Ordinate of the still level."""
        return self.hydrostatics.level

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
    def inertia(self) -> NDArray[np.float64]:
        """Mass for heave and sway, moment of inertia for roll, shape (3,)."""
        return self.hydrostatics.inertia

    @property
    def stiffness(self) -> NDArray[np.float64]:
        """Hydrostatic stiffness of heave, sway and roll, shape (3, 3)."""
        return self.hydrostatics.stiffness

    @property
    def roll_stiffness(self) -> float:
        """Stiffness of roll, N; with free heave that of a roll without heave force."""
        rest = self.hydrostatics
        return rest.free_roll_stiffness if "heave" in self.motions else rest.roll_stiffness

    @property
    def turns(self) -> NDArray[np.float64]:
        """1 of a motion that is an angle, 0 of one that is a length, shape (motions,)."""
        return np.array([float(motion == "roll") for motion in self.motions])

    @property
    def slit(self) -> tuple[float, float]:
        """Lowest and highest point of the middle line of a thin float."""
        assert self.profile is not None
        reference = self.hydrostatics.reference_level
        return reference - self.profile.extent, reference + self.profile.extent

    @property
    def kinks(self) -> tuple[tuple[float, float], ...]:
        """Points of a slit, beside its ends and the still level, where the flux jumps: the widest of pointed shapes."""
        if not self.is_thin or self.profile is None or self.profile.shape not in ("wedge", "exponential"):
            return ()
        low, high = self.slit
        height = self.hydrostatics.reference_level - self.height
        if abs(height) <= _ROUNDING * (high - low) or (height > 0.0 and not self.wet_above):
            return ()
        return ((self.waterplane[0], self.hydrostatics.reference_level),)

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
        left, right = self.waterplane
        middle = 0.5 * (left + right)
        points = np.vstack([arc.point(np.array([0.0, *arc.knots])) for arc in self.contour.arcs])
        image = points * [-1.0, 1.0] + [2.0 * middle, 0.0]
        nearest = np.abs(points[:, None] - image[None]).max(axis=2).min(axis=0)
        gap = max(float(nearest.max()), abs(self.hydrostatics.centre_of_mass[0] - middle))
        return bool(gap <= _ROUNDING * self._size)

    def is_mirror_image_of(self, other: object) -> bool:
        """Whether it is the mirror image of another body up to rounding, wherever both float."""
        return isinstance(other, RigidFloat) and self.is_symmetric and self._is_copy_of(other)

    def _is_copy_of(self, other: RigidFloat) -> bool:
        points, others = (body._samples - [body.waterplane[0], 0.0] for body in (self, other))
        same = (self.motions, self.is_thin, self.level) == (other.motions, other.is_thin, other.level)
        if not same or points.shape != others.shape:
            return False
        gap = max(
            np.abs(points - others).max(),
            abs(self.hydrostatics.radius_of_gyration - other.hydrostatics.radius_of_gyration),
            abs(self.hydrostatics.centre_of_mass[1] - other.hydrostatics.centre_of_mass[1]),
        )
        return bool(gap <= _ROUNDING * self._size)

    @property
    def _samples(self) -> NDArray[np.float64]:
        """A few points of each arc, shape (points, 2), by which shapes are compared."""
        return np.vstack([arc.point(np.linspace(0.0, 1.0, 5)) for arc in self.contour.arcs])

    @property
    def _size(self) -> float:
        low_x, high_x, low_y, high_y = self.bounds
        return max(high_x - low_x, high_y - low_y)

    def displacement(self, motion: Motion, points: NDArray[np.float64]) -> NDArray[np.float64]:
        """Displacement by a unit of a motion: upwards, to the right, anticlockwise about the centre of mass.

        Args:
            motion: which.
            points: shape (2, n).

        Returns:
            Shape (2, n).
        """
        zero, one = np.zeros(points.shape[1]), np.ones(points.shape[1])
        if motion == "heave":
            return np.array([zero, one])
        if motion == "sway":
            return np.array([one, zero])
        x, y = self.hydrostatics.centre_of_mass
        return np.array([y - points[1], points[0] - x])
