"""Rigid solids that float in a tank in three dimensions: hydrostatics, inertia, and the displacement of six motions.

With volume V, centre of buoyancy z_B, waterplane A and its second moments I_x = ∫y², I_y = ∫x², z_G of the centre of
mass, and m = ρV:

    heave ρgA,    roll about x: ρg I_x + ρgV(z_B − z_G),    pitch about y: ρg I_y + ρgV(z_B − z_G)

Surge, sway and yaw have no stiffness.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import Literal, TypeAlias, get_args

import numpy as np

from hydroelastic.physics.arrays import FloatArray
from hydroelastic.physics.plate import Point, scaled_point
from hydroelastic.physics.scales import Scales
from hydroelastic.physics.solids import solid_of_revolution

RigidMotion: TypeAlias = Literal["surge", "sway", "heave", "roll", "pitch", "yaw"]
RIGID_MOTIONS: tuple[RigidMotion, ...] = get_args(RigidMotion)
"""Along x, y and z, and about axes along x, y and z through the centre of mass."""

# Part of ρg I_x below which a stiffness is rounding.
_ROUNDING = 1e-12

SolidFloatShape: TypeAlias = Literal["cylinder", "sphere", "box"]


@dataclass(frozen=True, kw_only=True)
class Hydrostatics:
    """What follows from the wetted part of a solid, in powers of m.

    Attributes:
        volume: V.
        buoyancy: z_B.
        waterplane: A.
        second: I_x and I_y about the middle of the waterplane.
    """

    volume: float
    buoyancy: float
    waterplane: float
    second: Point


@dataclass(frozen=True, kw_only=True)
class SolidFloat:
    """A rigid solid that floats, upright at rest, by Archimedes' principle.

    Attributes:
        shape: an upright cylinder, a sphere, or a box with sides along x and y.
        size: diameters or sides along x and y, m.
        draught: depth of its lowest point, m.
        position: x and y of its axis, m.
        centre_of_gravity: z_G, m.
        gyration: radii of gyration about axes along x, y and z through the centre of mass, m.
        motions: those that are free.
    """

    shape: SolidFloatShape
    size: Point
    draught: float
    position: Point
    centre_of_gravity: float
    gyration: tuple[float, float, float]
    motions: tuple[RigidMotion, ...]

    def scaled(self, units: Scales) -> SolidFloat:
        """Return it in units of a length."""
        length = units.length
        x, y, z = self.gyration
        return replace(
            self,
            size=scaled_point(self.size, length),
            draught=self.draught / length,
            position=scaled_point(self.position, length),
            centre_of_gravity=self.centre_of_gravity / length,
            gyration=(x / length, y / length, z / length),
        )

    @cached_property
    def hydrostatics(self) -> Hydrostatics:
        """Volume, centre of buoyancy and waterplane."""
        (along, across), depth = self.size, self.draught
        if self.shape == "box":
            area = along * across
            second = (along * across**3 / 12.0, across * along**3 / 12.0)
            return Hydrostatics(volume=area * depth, buoyancy=-0.5 * depth, waterplane=area, second=second)
        solid = solid_of_revolution(self.shape, radius=0.5 * along, draught=depth)
        wetted, contact = solid.moments(0.0), solid.below(0.0)[-1].end[0]
        area, moment = solid.waterplane(-contact, contact)
        buoyancy = wetted.first[1] / wetted.area
        return Hydrostatics(volume=wetted.area, buoyancy=buoyancy, waterplane=area, second=(moment, moment))

    def stiffness(self) -> FloatArray:
        """Return the hydrostatic stiffness of its motions over ρg, shape (motions,)."""
        found = self.hydrostatics
        lever = found.volume * (found.buoyancy - self.centre_of_gravity)
        values = {"heave": found.waterplane, "roll": found.second[0] + lever, "pitch": found.second[1] + lever}
        stiffness = np.array([values.get(motion, 0.0) for motion in self.motions])
        # That of a sphere about its centre is rounding.
        negligible = _ROUNDING * max(found.second)
        return np.where(np.abs(stiffness) < negligible, 0.0, stiffness)

    def inertia(self) -> FloatArray:
        """Return mass or moment of inertia of its motions over ρ, shape (motions,)."""
        radii = dict(zip(RIGID_MOTIONS, (1.0, 1.0, 1.0, *self.gyration), strict=True))
        return np.array([self.hydrostatics.volume * radii[motion] ** 2 for motion in self.motions])

    def displacement(self, motion: RigidMotion, points: FloatArray) -> FloatArray:
        """Return the displacement of points (3, n) by a unit of a motion, (3, n)."""
        place = RIGID_MOTIONS.index(motion)
        axis = np.zeros(3)
        axis[place % 3] = 1.0
        if place < 3:
            return np.broadcast_to(axis[:, None], points.shape)
        centre = np.array([*self.position, self.centre_of_gravity])
        return np.cross(axis, (points - centre[:, None]).T).T

    def distance(self, points: FloatArray) -> FloatArray:
        """Return the distance of points (n, 3) from its surface, 0 on it, but for a factor of order 1, (n,)."""
        x, y = (points[:, :2] - np.array(self.position)).T
        (along, across), z = self.size, points[:, 2]
        if self.shape == "sphere":
            radius = 0.5 * along
            return np.asarray(np.abs(np.sqrt(x**2 + y**2 + (z - radius + self.draught) ** 2) - radius))
        outside = (
            np.hypot(x, y) - 0.5 * along
            if self.shape == "cylinder"
            else np.maximum(np.abs(x) - 0.5 * along, np.abs(y) - 0.5 * across)
        )
        return np.asarray(np.abs(np.maximum(outside, -self.draught - z)))
