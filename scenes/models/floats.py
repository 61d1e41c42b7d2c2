"""From a float of a scene to its contour and its hydrostatics, in metres and kilograms per metre of width."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import lru_cache
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from hydroelastic.physics.contours import Arc, Contour, Point, root
from hydroelastic.physics.point_contours import outline_contour, polygon_contour
from hydroelastic.physics.profiles import DEFAULT_TAIL, Profile, ProfileArc, float_profile
from hydroelastic.scenes.models.bodies import MOST_BODIES, Float
from hydroelastic.scenes.models.outline_files import read_outline
from hydroelastic.scenes.models.tank import TankScene

DEFAULT_CORNER_ANGLE = 30.0
"""Degrees by which an outline turns in a corner, unless the scene says it."""

NEUTRAL = 1e-12
"""A stiffness smaller than this part of its terms is zero: only rounding keeps it from being so."""

AT_CORNER = 1e-9
"""A still level nearer to a corner than this part of the section's height passes through it: decimal masses are
not exact."""


def float_section(body: Float) -> Profile | None:
    """Return the half-width of a symmetric float as a function of height, or None for polygons and outlines."""
    if body.shape == "polygon" or body.shape == "outline" or body.half_width is None or body.half_height is None:
        return None
    tail = DEFAULT_TAIL if body.tail is None else body.tail
    return float_profile(body.shape, body.half_width, body.half_height, tail)


def float_contour(body: Float, folder: Path) -> Contour:
    """Return the contour of a float in its own frame, m: x = 0 at its position, y = 0 at its reference level.

    Args:
        body: the float.
        folder: where the path of an outline's file starts.

    Raises:
        ValueError: if an outline cannot be read, or is no contour.
    """
    profile = float_section(body)
    if profile is not None:
        right = tuple(_right(arc) for arc in profile.arcs)
        return Contour(right + tuple(_mirrored(arc) for arc in reversed(right)))
    if body.file is not None:
        angle = DEFAULT_CORNER_ANGLE if body.corner_angle is None else body.corner_angle
        return outline_contour(read_outline(folder / body.file), angle)
    return polygon_contour(body.vertices or ())


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


@dataclass(frozen=True, kw_only=True)
class Hydrostatics:
    """A float at rest: where it floats, and what restores it.

    Points lie in the frame of the tank: x from the left wall, y from the still interface, or from the still surface
    of one liquid. Heave is counted upwards, roll anticlockwise about the centre of mass G.

    Attributes:
        mass: m, kg/m.
        level: ordinate of the still level at which it floats, m.
        reference_level: ordinate of the shape's reference level, m.
        areas: of the section below and above the level, m².
        centroids: of these parts, the centres of buoyancy, m.
        waterplane: x of the left and of the right contact point, m.
        centre_of_mass: G, m.
        radius_of_gyration: about G, m.
        heave_stiffness: c33 = Δρ g B, N/m².
        coupling_stiffness: c35 = c53 = Δρ g ∫(x − x_G) dx over the waterplane, N/m.
        roll_stiffness: c55 = Δρ g ∫(x − x_G)² dx + g Σ ρⱼ Aⱼ (y_Bⱼ − y_G), N.
        free_roll_stiffness: c55 − c35²/c33, the stiffness of a roll that heave follows without force, N.
    """

    mass: float
    level: float
    reference_level: float
    areas: tuple[float, float]
    centroids: tuple[Point, Point]
    waterplane: tuple[float, float]
    centre_of_mass: Point
    radius_of_gyration: float
    heave_stiffness: float
    coupling_stiffness: float
    roll_stiffness: float
    free_roll_stiffness: float

    def moved(self, shift: Point) -> Hydrostatics:
        """Return the same float elsewhere."""
        x, y = shift
        one, other = ((x + centre_x, y + centre_y) for centre_x, centre_y in self.centroids)
        return replace(
            self,
            level=y + self.level,
            reference_level=y + self.reference_level,
            centroids=(one, other),
            waterplane=(x + self.waterplane[0], x + self.waterplane[1]),
            centre_of_mass=(x + self.centre_of_mass[0], y + self.centre_of_mass[1]),
        )

    @property
    def stiffness(self) -> NDArray[np.float64]:
        """Stiffness of heave, sway and roll, shape (3, 3): N/m², N/m and N."""
        c33, c35, c55 = self.heave_stiffness, self.coupling_stiffness, self.roll_stiffness
        return np.array([[c33, 0.0, c35], [0.0, 0.0, 0.0], [c35, 0.0, c55]])


@dataclass(frozen=True, kw_only=True)
class PlacedFloat:
    """A float where it rests, in the frame of the tank, m.

    Attributes:
        contour: of its section.
        hydrostatics: what keeps it there.
    """

    contour: Contour
    hydrostatics: Hydrostatics


def placed_float(scene: TankScene, index: int) -> PlacedFloat:
    """Return a float of a scene where it rests.

    Args:
        scene: the scene.
        index: of the float among the bodies.

    Raises:
        ValueError: if it cannot float, or not with a section that the level cuts once.
    """
    body = scene.body[index]
    if not isinstance(body, Float):
        raise TypeError(f"body {index} is not a float")
    level = scene.level_of(body)
    state = (scene.folder / body.file).stat() if body.file is not None else None
    return _placed(
        body,
        scene.folder,
        scene.height_of(level),
        scene.densities_at(level),
        scene.tank.gravity,
        (state.st_mtime_ns, state.st_size) if state is not None else None,
    )


# Many ask for the same float. The state of an outline's file is that of its last change: it may be edited meanwhile.
@lru_cache(maxsize=2 * MOST_BODIES)
def _placed(
    body: Float,
    folder: Path,
    height: float,
    densities: tuple[float, float],
    gravity: float,
    _state: tuple[int, int] | None,
) -> PlacedFloat:
    contour = float_contour(body, folder)
    immersion = still_level(contour, body.mass, densities)
    # Still level and position are the origin while anything is computed: far from it, digits are lost.
    contour = contour.moved((0.0, -immersion))
    at_rest = hydrostatics(contour, body, immersion=immersion, densities=densities, gravity=gravity)
    place = (body.position, height)
    return PlacedFloat(contour=contour.moved(place), hydrostatics=at_rest.moved(place))


def still_level(contour: Contour, mass: float | None, densities: tuple[float, float]) -> float:
    """Return the ordinate of the still level in a float's frame, by Archimedes: ρ₂ A₂ + ρ₁ A₁ = m.

    Args:
        contour: in the float's frame, m.
        mass: m, kg/m; None floats with the reference level y = 0 at the still level.
        densities: ρ₂ below and ρ₁ above the level, kg/m³.

    Raises:
        ValueError: if it is too light or too heavy to float at the level.
    """
    if mass is None:
        return 0.0
    below, above = densities
    area = contour.moments().area
    if not above * area < mass < below * area:
        raise ValueError(f"a mass between {above * area:g} and {below * area:g} kg/m floats at this level")
    _, _, low, high = contour.bounds
    immersed = (mass - above * area) / (below - above)
    level = root(lambda y: contour.moments(y).area - immersed, low, high)
    corners = (y for _, y in contour.corners)
    return next((y for y in corners if abs(y - level) < AT_CORNER * (high - low)), level)


def hydrostatics(
    contour: Contour, body: Float, *, immersion: float, densities: tuple[float, float], gravity: float
) -> Hydrostatics:
    """Return the hydrostatics of a float at rest, in a frame with its position and the still level as origin.

    Args:
        contour: in that frame, m.
        body: its mass properties.
        immersion: ordinate of the still level above the shape's reference level, m.
        densities: below and above the level, kg/m³.
        gravity: m/s².

    Raises:
        ValueError: if the level does not meet the contour in two points.
    """
    chain = contour.below(0.0)
    left, right = chain[0].start[0], chain[-1].end[0]
    whole, parts = contour.moments(), (contour.moments(0.0, side="below"), contour.moments(0.0, side="above"))
    mass = sum(density * part.area for density, part in zip(densities, parts, strict=True))
    x_mass = sum(density * part.first[0] for density, part in zip(densities, parts, strict=True)) / mass
    y_mass = whole.centroid[1] if body.centre_of_mass is None else body.centre_of_mass - immersion
    restoring = gravity * (densities[0] - densities[1])
    width, middle = right - left, _sum_or_zero(0.5 * left, 0.5 * right, -x_mass)
    about_middle = restoring * width**3 / 12.0
    lever = [gravity * density * part.first[1] for density, part in zip(densities, parts, strict=True)]
    lever.append(-gravity * mass * y_mass)
    about_mass = about_middle + restoring * width * middle**2
    return Hydrostatics(
        mass=mass,
        level=0.0,
        reference_level=-immersion,
        areas=(parts[0].area, parts[1].area),
        centroids=(parts[0].centroid, parts[1].centroid),
        waterplane=(left, right),
        centre_of_mass=(x_mass, y_mass),
        radius_of_gyration=whole.radius_of_gyration if body.radius_of_gyration is None else body.radius_of_gyration,
        heave_stiffness=restoring * width,
        coupling_stiffness=restoring * width * middle,
        roll_stiffness=_sum_or_zero(about_mass, *lever),
        free_roll_stiffness=_sum_or_zero(about_middle, *lever),
    )


def _sum_or_zero(*terms: float) -> float:
    total = sum(terms)
    return total if abs(total) > NEUTRAL * max(map(abs, terms)) else 0.0
