"""Conversion of a float of a scene to a rigid float, in metres and kilograms per metre of width."""

from __future__ import annotations

from dataclasses import replace
from functools import lru_cache
from math import sqrt
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from hydroelastic.physics.attachments import Matrix
from hydroelastic.physics.contours import Contour
from hydroelastic.physics.dofs import PLACES, Level
from hydroelastic.physics.floats import RigidFloat
from hydroelastic.physics.hulls import Hull
from hydroelastic.physics.hydrostatics import hydrostatics, still_level
from hydroelastic.physics.point_contours import outline_contour, polygon_contour
from hydroelastic.physics.profiles import DEFAULT_TAIL, Profile, float_profile, profile_contour
from hydroelastic.physics.revolution import SolidOfRevolution
from hydroelastic.physics.solids import solid_of_revolution
from hydroelastic.scenes.models.attachments import Attachment
from hydroelastic.scenes.models.bodies import MOST_BODIES
from hydroelastic.scenes.models.body_kinds import AnyFloat
from hydroelastic.scenes.models.number_files import read_columns
from hydroelastic.scenes.models.revolved_floats import RevolvedFloat
from hydroelastic.scenes.models.tank_parts import TankParts

DEFAULT_CORNER_ANGLE = 30.0
"""Degrees by which an outline turns in a corner, unless the scene says it."""

POINTS = (3, 1000)
"""How many points an outline may have: with more, the elements of the mesh would follow noise."""


def float_section(body: AnyFloat) -> Profile | None:
    """Return the half-width of a symmetric section as a function of height, or None for polygons and outlines."""
    if isinstance(body, RevolvedFloat):
        return None
    if body.shape == "polygon" or body.shape == "outline" or body.half_width is None or body.half_height is None:
        return None
    tail = DEFAULT_TAIL if body.tail is None else body.tail
    return float_profile(body.shape, body.half_width, body.half_height, tail)


def float_contour(body: AnyFloat, folder: Path) -> Contour | SolidOfRevolution:
    """Return the contour, or the solid, of a float in its own frame, m.

    In it x = 0 at its position and y = 0 at its reference level.

    Args:
        folder: to which the path of an outline's file is relative.

    Raises:
        ValueError: if an outline cannot be read, or is not a contour.
    """
    if isinstance(body, RevolvedFloat):
        return solid_of_revolution(
            body.shape,
            radius=body.radius or 0.0,
            draught=body.draught,
            inner_radius=body.inner_radius or 0.0,
            outline=body.outline or (),
        )
    profile = float_section(body)
    if profile is not None:
        return profile_contour(profile)
    if body.file is not None:
        angle = DEFAULT_CORNER_ANGLE if body.corner_angle is None else body.corner_angle
        return outline_contour(read_outline(folder / body.file), angle)
    return polygon_contour(body.vertices or ())


def level_at_rest(
    body: AnyFloat, contour: Contour | SolidOfRevolution, densities: tuple[float, float], gravity: float
) -> float:
    """Return the ordinate of the still level in a float's frame, m: by its mass, or by its draught without one.

    Args:
        contour: in the float's frame, m.
        densities: below and above the level, kg/m³.
        gravity: m/s².

    Raises:
        ValueError: if its mass is too small or too large to float at the level.
    """
    if body.mass is None and body.draught is not None:
        return contour.bounds[2] + body.draught
    displaced = None if body.mass is None else body.mass - (body.vertical_force or 0.0) / gravity
    return still_level(contour, displaced, densities)


def placed_float(scene: TankParts, index: int) -> RigidFloat:
    """Return a float of a scene at rest, in the frame of the tank, m.

    Args:
        index: of the float among the bodies.

    Raises:
        ValueError: if it cannot float, or not with a section that the level cuts once.
    """
    body = scene.body[index]
    if not isinstance(body, AnyFloat):
        raise TypeError(f"body {index} is not a float")
    level = scene.level_of(body)
    placed = _placed(
        body,
        scene.folder,
        level,
        scene.height_of(level),
        scene.densities_at(level),
        scene.tank.gravity,
        scene.state_of_file(body),
    )
    return placed if scene.is_open else held_float(scene, index, placed)


def held_float(scene: TankParts, index: int, placed: RigidFloat) -> RigidFloat:
    """Return a float that is placed, with its springs to the ground.

    Args:
        index: of the float among the bodies.
        placed: see `placed_float`.
    """
    own = [one for one in scene.attachment if one.body == index + 1 and one.to is None]
    return replace(placed, springs=_springs(placed, own)) if own else placed


def _springs(placed: RigidFloat, attachments: list[Attachment]) -> Matrix:
    """Stiffness of springs to the ground for heave, sway and roll about the centre of mass of a float."""
    total, centre = np.zeros((3, 3)), placed.hydrostatics.centre_of_mass
    for one in attachments:
        x, y = one.at or centre
        # Heave, sway and roll of the point by those of the float.
        path = np.array([[1.0, 0.0, x - centre[0]], [0.0, 1.0, centre[1] - y], [0.0, 0.0, 1.0]])
        total += path.T @ np.array(one.stiffness) @ path
    return tuple((float(heave), float(sway), float(roll)) for heave, sway, roll in total)


# Cached; the key contains the time of the last change of an outline's file, which may be edited meanwhile.
@lru_cache(maxsize=2 * MOST_BODIES)
def _placed(
    body: AnyFloat,
    folder: Path,
    level: Level,
    height: float,
    densities: tuple[float, float],
    gravity: float,
    _state: tuple[int, int] | None,
) -> RigidFloat:
    contour = float_contour(body, folder)
    immersion = level_at_rest(body, contour, densities, gravity)
    # Still level and position are the origin while anything is computed: far from it, digits are lost.
    contour = contour.moved((0.0, -immersion))
    centre = body.centre_of_mass
    if centre is None and body.vertical_centre_of_gravity is not None:
        centre = body.vertical_centre_of_gravity + immersion
    at_rest = hydrostatics(
        contour,
        immersion=immersion,
        densities=densities,
        gravity=gravity,
        centre_of_mass=centre,
        radius_of_gyration=body.radius_of_gyration,
        vertical_force=body.vertical_force or 0.0,
    )
    if body.radius_of_gyration is None and body.inertia is not None:
        at_rest = replace(at_rest, radius_of_gyration=sqrt(body.inertia / at_rest.mass))
    place = (body.position, height)
    at_rest, thin = at_rest.moved(place), body.boundary == "thin"
    return RigidFloat(
        hull=Hull(
            contour=contour.moved(place) if isinstance(contour, Contour) else contour.moved(place).contour,
            profile=float_section(body),
            is_thin=thin,
            height=at_rest.level,
            reference_level=at_rest.reference_level,
            wet_above=level == "interface" and densities[1] > 0.0,
            waterplane=(body.position, body.position) if thin else at_rest.waterplane,
        ),
        hydrostatics=at_rest,
        level=level,
        motions=tuple(sorted(body.motions, key=PLACES.__getitem__)),
    )


def read_outline(file: Path) -> NDArray[np.float64]:
    """Return the points of an outline, m, shape (n, 2): without repeated ones, and not closed by its first point.

    Raises:
        ValueError: with the error in the file and its line.
    """
    rows = read_columns(file, 2)
    points = [row for place, row in enumerate(rows) if place == 0 or row != rows[place - 1]]
    if len(points) > 1 and points[-1] == points[0]:
        points.pop()
    least, most = POINTS
    if not least <= len(points) <= most:
        raise ValueError(f"it holds {len(points) or 'no'} points; {least} to {most} make an outline")
    return np.array(points)
