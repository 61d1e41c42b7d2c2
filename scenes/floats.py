"""From a float of a scene to its contour and its hydrostatics, in metres and kilograms."""

from __future__ import annotations

from dataclasses import dataclass
from math import exp, log, pi

import numpy as np
from scipy.optimize import brentq

from hydroelastic.meshes.contours import Arc, AreaMoments, Array, Contour, Point, straight_arc
from hydroelastic.scenes.model_bodies import Float
from hydroelastic.scenes.models import TankScene

TAIL = 1e-3
"""Where the exponential shape ends unless the scene says it: at this part of its half width."""

NEUTRAL = 1e-12
"""A roll stiffness smaller than this part of its terms is zero: only rounding keeps it from being so."""


def float_contour(body: Float) -> Contour:
    """Return the contour of a float in its own frame, m: x = 0 at its position, y = 0 at its reference level."""
    width, height = body.half_width or 0.0, body.half_height or 0.0
    if body.shape == "polygon":
        return polygon_contour(body.vertices or ())
    if body.shape == "rectangle":
        return polygon_contour(((-width, -height), (width, -height), (width, height), (-width, height)))
    if body.shape == "wedge":
        return polygon_contour(((0.0, -height), (width, 0.0), (0.0, height), (-width, 0.0)))
    if body.shape == "ellipse":
        return _ellipse(width, height)
    if body.shape == "parabola":
        return _parabola(width, height)
    return _exponential(width, height, body.tail or TAIL)


def polygon_contour(vertices: tuple[Point, ...]) -> Contour:
    """Return the contour of a polygon, its corners given in either sense."""
    x, y = np.array(vertices).T
    doubled_area = float(np.sum(x * np.roll(y, -1) - np.roll(x, -1) * y))
    corners = vertices if doubled_area > 0.0 else vertices[::-1]
    return Contour(tuple(map(straight_arc, corners, (*corners[1:], corners[0]))))


def _ellipse(width: float, height: float) -> Contour:
    corners = ((width, 0.0), (0.0, height), (-width, 0.0), (0.0, -height))

    def quarter(number: int) -> Arc:
        def angle(t: Array) -> Array:
            return 0.5 * pi * (number + t)

        return Arc(
            curve=lambda t: np.column_stack([width * np.cos(angle(t)), height * np.sin(angle(t))]),
            velocity=lambda t: 0.5 * pi * np.column_stack([-width * np.sin(angle(t)), height * np.cos(angle(t))]),
            start=corners[number],
            end=corners[(number + 1) % 4],
        )

    return Contour(tuple(quarter(number) for number in range(4)))


def _parabola(width: float, height: float) -> Contour:
    def side(sign: float) -> Arc:
        return Arc(
            curve=lambda t: np.column_stack([sign * 4.0 * width * t * (1.0 - t), sign * height * (2.0 * t - 1.0)]),
            velocity=lambda t: np.column_stack([sign * 4.0 * width * (1.0 - 2.0 * t), np.full_like(t, 2 * sign * height)]),
            start=(0.0, -sign * height),
            end=(0.0, sign * height),
        )

    return Contour((side(1.0), side(-1.0)))


def _exponential(width: float, height: float, tail: float) -> Contour:
    tip = height * log(1.0 / tail)

    def quarter(across: float, up: float, *, outwards: bool) -> Arc:
        def s(t: Array) -> Array:
            return log(1.0 / tail) * (1.0 - t if outwards else t)

        def curve(t: Array) -> Array:
            half_width = width * (np.exp(-s(t)) - tail) / (1.0 - tail)
            return np.column_stack([across * half_width, up * height * s(t)])

        def velocity(t: Array) -> Array:
            ds = log(1.0 / tail) * (-1.0 if outwards else 1.0)
            slope = -width * np.exp(-s(t)) / (1.0 - tail)
            return ds * np.column_stack([across * slope, np.full_like(t, up * height)])

        ends = ((0.0, up * tip), (across * width, 0.0))
        return Arc(
            curve=curve, velocity=velocity, start=ends[0 if outwards else 1], end=ends[1 if outwards else 0]
        )

    return Contour(
        (
            quarter(1.0, -1.0, outwards=True),
            quarter(1.0, 1.0, outwards=False),
            quarter(-1.0, 1.0, outwards=True),
            quarter(-1.0, -1.0, outwards=False),
        )
    )


@dataclass(frozen=True, kw_only=True)
class Hydrostatics:
    """A float at rest: where it floats, and what restores it, per metre of width.

    Lengths count from the left wall and up from y = 0 of the tank. Stiffnesses are those of heave (upwards) and roll
    (anticlockwise) about the centre of mass G.

    Attributes:
        mass: m, kg/m.
        level: ordinate of the still level at which it floats, m.
        reference_level: ordinate of the shape's reference level, m.
        below: integrals over the part below the level.
        above: integrals over the part above it.
        waterplane: x of the left and of the right contact point, m.
        centre_of_mass: G, m.
        radius_of_gyration: about G, m.
        heave_stiffness: c33 = Δρ g B, N/m².
        coupling_stiffness: c35 = c53 = Δρ g ∫(x − x_G) dx over the waterplane, N/m.
        roll_stiffness: c55 = Δρ g ∫(x − x_G)² dx + g Σ ρⱼ Vⱼ (y_Bⱼ − y_G), N.
    """

    mass: float
    level: float
    reference_level: float
    below: AreaMoments
    above: AreaMoments
    waterplane: tuple[float, float]
    centre_of_mass: Point
    radius_of_gyration: float
    heave_stiffness: float
    coupling_stiffness: float
    roll_stiffness: float


@dataclass(frozen=True, kw_only=True)
class PlacedFloat:
    """A float where it rests in the tank, m.

    Attributes:
        contour: in the frame of the tank.
        hydrostatics: in the frame of the tank.
    """

    contour: Contour
    hydrostatics: Hydrostatics


def placed_float(scene: TankScene, index: int) -> PlacedFloat:
    """Return a float of a scene where it rests.

    Args:
        scene: the scene.
        index: of the float among the bodies.

    Raises:
        ValueError: if it cannot float there, or not as one section that the level cuts once.
    """
    body = scene.body[index]
    if not isinstance(body, Float):
        raise TypeError(f"body {index} is no float")
    level = scene.level_of(body)
    densities = scene.densities_at(level)
    contour = float_contour(body)
    immersion = still_level(contour, body.mass, densities)
    shift = (body.position, scene.height_of(level) - immersion)
    moved = contour.moved(shift)
    return PlacedFloat(
        contour=moved,
        hydrostatics=hydrostatics(
            moved,
            body,
            level=scene.height_of(level),
            reference_level=shift[1],
            densities=densities,
            gravity=scene.tank.gravity,
        ),
    )


def still_level(contour: Contour, mass: float | None, densities: tuple[float, float]) -> float:
    """Return the ordinate of the still level in a float's frame: ρ₂ A₂ + ρ₁ A₁ = m (Archimedes).

    Args:
        contour: in the float's frame, m.
        mass: kg/m; None floats at the reference level, y = 0.
        densities: below and above the level, kg/m³.

    Raises:
        ValueError: if it is too light or too heavy for both liquids.
    """
    if mass is None:
        return 0.0
    below, above = densities
    area = contour.moments().area
    _, _, low, high = contour.bounds
    if not above * area < mass < below * area:
        raise ValueError(f"it floats with a mass between {above * area:g} and {below * area:g} kg/m only")
    immersed = (mass - above * area) / (below - above)
    return float(brentq(lambda level: contour.moments(level).area - immersed, low, high, xtol=1e-300, rtol=8.9e-16))


def hydrostatics(
    contour: Contour,
    body: Float,
    *,
    level: float,
    reference_level: float,
    densities: tuple[float, float],
    gravity: float,
) -> Hydrostatics:
    """Return the hydrostatics of a float at rest.

    Args:
        contour: where it rests, in the frame of the tank, m.
        body: its mass properties.
        level: ordinate of the still level, m.
        reference_level: ordinate of the shape's reference level, m.
        densities: below and above the level, kg/m³.
        gravity: m/s².

    Raises:
        ValueError: if the level does not cut the contour in two points.
    """
    chain = contour.below(level)
    left, right = chain[0].start[0], chain[-1].end[0]
    whole, below, above = contour.moments(), contour.moments(level), contour.moments(level, side="above")
    displaced = tuple(zip(densities, (below, above), strict=True))
    mass = sum(density * part.area for density, part in displaced)
    x_mass = sum(density * part.first[0] for density, part in displaced) / mass
    y_mass = whole.centroid[1] if body.centre_of_mass is None else reference_level + body.centre_of_mass
    restoring = gravity * (densities[0] - densities[1])
    waterplane = restoring * ((right - x_mass) ** 3 - (left - x_mass) ** 3) / 3.0
    buoyancy = gravity * sum(density * part.first[1] for density, part in displaced)
    weight = gravity * mass * y_mass
    roll = waterplane + buoyancy - weight
    if abs(roll) < NEUTRAL * max(waterplane, abs(buoyancy), abs(weight)):
        roll = 0.0
    return Hydrostatics(
        mass=mass,
        level=level,
        reference_level=reference_level,
        below=below,
        above=above,
        waterplane=(left, right),
        centre_of_mass=(x_mass, y_mass),
        radius_of_gyration=whole.radius_of_gyration if body.radius_of_gyration is None else body.radius_of_gyration,
        heave_stiffness=restoring * (right - left),
        coupling_stiffness=0.5 * restoring * ((right - x_mass) ** 2 - (left - x_mass) ** 2),
        roll_stiffness=roll,
    )
