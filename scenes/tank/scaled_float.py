"""A rigid float in units of the tank: its wetted contour, its inertia and what restores it."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from hydroelastic.physics.contours import Arc, Contour
from hydroelastic.physics.profiles import Profile, float_profile
from hydroelastic.scenes.models.bodies import Float, Motion
from hydroelastic.scenes.models.floats import placed_float
from hydroelastic.scenes.models.tank import TankScene
from hydroelastic.scenes.tank.scaling import Scales

MOTIONS: tuple[Motion, ...] = ("heave", "sway", "roll")

# Contours that decimal input means to be mirror images differ by a few units of the last place.
_ROUNDING = 1e-12


@dataclass(frozen=True, kw_only=True)
class ScaledFloat:
    """A float at rest, in units of the tank.

    Attributes:
        given: what the scene says of it.
        contour: its section.
        level: ordinate of the still level at which it floats.
        wet_above: whether there is liquid above that level.
        waterplane: x of its two contact points with the still level, the same for a thin float.
        below: the contour under the still level, from the left contact point to the right one.
        above: the contour over it, from the right contact point to the left one; empty where it is dry.
        profile: its half width about the reference level, for a thin float; else ``None``.
        reference_level: ordinate of the shape's reference level.
        centre_of_mass: x and y.
        inertia: mass for heave and sway, moment of inertia for roll, shape (3,).
        stiffness: hydrostatic, of heave, sway and roll, shape (3, 3).
    """

    given: Float
    contour: Contour
    level: float
    wet_above: bool
    waterplane: tuple[float, float]
    below: tuple[Arc, ...]
    above: tuple[Arc, ...]
    profile: Profile | None
    reference_level: float
    centre_of_mass: tuple[float, float]
    inertia: NDArray[np.float64]
    stiffness: NDArray[np.float64]

    @property
    def motions(self) -> tuple[Motion, ...]:
        """In what ways it may move, in the order of `MOTIONS`."""
        return tuple(motion for motion in MOTIONS if motion in self.given.motions)

    @property
    def turns(self) -> NDArray[np.float64]:
        """1 of a motion that is an angle, 0 of one that is a length, shape (motions,)."""
        return np.array([float(motion == "roll") for motion in self.motions])

    @property
    def is_thin(self) -> bool:
        """Whether its conditions are put on its middle line."""
        return self.profile is not None

    @property
    def slit(self) -> tuple[float, float]:
        """Lowest and highest point of the middle line of a thin float."""
        assert self.profile is not None
        return self.reference_level - self.profile.extent, self.reference_level + self.profile.extent

    @property
    def kinks(self) -> tuple[tuple[float, float], ...]:
        """Points of a slit, beside its ends and the still level, where the flux jumps: the widest of pointed shapes."""
        if self.profile is None or self.profile.shape not in ("wedge", "exponential"):
            return ()
        low, high = self.slit
        height = self.reference_level - self.level
        if abs(height) <= _ROUNDING * (high - low) or (height > 0.0 and not self.wet_above):
            return ()
        return ((self.waterplane[0], self.reference_level),)

    @property
    def bounds(self) -> tuple[float, float, float, float]:
        """Smallest and largest x, smallest and largest y."""
        return self.contour.bounds

    @property
    def smallest_extent(self) -> float:
        """The smaller of its width and of what it reaches into a liquid."""
        left, right, low, high = self.bounds
        reaches = [self.level - low, *([high - self.level] if self.wet_above else [])]
        return min(right - left, *reaches)

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
        x, y = self.centre_of_mass
        return np.array([y - points[1], points[0] - x])


def scaled_float(scene: TankScene, index: int, units: Scales, waterplane: tuple[float, float]) -> ScaledFloat:
    """Bring a float of a scene into units of the tank.

    Args:
        scene: the scene.
        index: of the float among the bodies.
        units: of the tank.
        waterplane: x of its two contact points, in units of the tank.
    """
    body = scene.body[index]
    assert isinstance(body, Float)
    placed = placed_float(scene, index)
    rest = placed.hydrostatics
    length = units.length
    contour = placed.contour.scaled(1.0 / length)
    level = scene.level_of(body)
    height = scene.height_of(level) / length
    thin = body.boundary == "thin"
    wet_above = level == "interface"
    return ScaledFloat(
        given=body,
        contour=contour,
        level=height,
        wet_above=wet_above,
        waterplane=waterplane,
        below=() if thin else _between(placed.contour.below(rest.level), 1.0 / length, waterplane, height),
        above=()
        if thin or not wet_above
        else _between(placed.contour.above(rest.level), 1.0 / length, waterplane[::-1], height),
        profile=_profile(body, length) if thin else None,
        reference_level=rest.reference_level / length,
        centre_of_mass=(rest.centre_of_mass[0] / length, rest.centre_of_mass[1] / length),
        inertia=rest.mass / (units.density * length**2) * np.array([1.0, 1.0, (rest.radius_of_gyration / length) ** 2]),
        stiffness=_stiffness(rest.heave_stiffness, rest.coupling_stiffness, rest.roll_stiffness, units),
    )


def _between(chain: tuple[Arc, ...], factor: float, ends: tuple[float, float], height: float) -> tuple[Arc, ...]:
    """A chain of arcs scaled, with its ends exactly where the pieces of the still level end."""
    arcs = [arc.mapped(factor, (0.0, 0.0)) for arc in chain]
    arcs[0] = replace(arcs[0], start=(ends[0], height))
    arcs[-1] = replace(arcs[-1], end=(ends[1], height))
    return tuple(arcs)


def _profile(body: Float, length: float) -> Profile:
    assert body.shape in ("exponential", "parabola", "ellipse", "wedge")
    assert body.half_width is not None
    assert body.half_height is not None
    more = {"tail": body.tail} if body.shape == "exponential" and body.tail is not None else {}
    return float_profile(body.shape, body.half_width / length, body.half_height / length, **more)


def _stiffness(heave: float, coupling: float, roll: float, units: Scales) -> NDArray[np.float64]:
    pressure = units.density * units.gravity
    stiffness = np.zeros((3, 3))
    stiffness[0, 0] = heave / (pressure * units.length)
    stiffness[0, 2] = stiffness[2, 0] = coupling / (pressure * units.length**2)
    stiffness[2, 2] = roll / (pressure * units.length**3)
    return stiffness


def is_symmetric(body: ScaledFloat) -> bool:
    """Whether a float is its own mirror image about the vertical through its contact points' middle.

    Straight sides and splines are symmetric if the points that they join are; the half that is modelled is then the
    section's left half, whatever rounding does to the right one.
    """
    left, right = body.waterplane
    middle = 0.5 * (left + right)
    low_x, high_x, low_y, high_y = body.bounds
    points = np.vstack([arc.point(np.array([0.0, *arc.knots])) for arc in body.contour.arcs])
    image = points * [-1.0, 1.0] + [2.0 * middle, 0.0]
    nearest = np.abs(points[:, None] - image[None]).max(axis=2).min(axis=0)
    return bool(
        max(float(nearest.max()), abs(body.centre_of_mass[0] - middle))
        <= _ROUNDING * max(high_x - low_x, high_y - low_y)
    )
