"""Rigid solids that float in a tank in three dimensions: hydrostatics, inertia, and the displacement of six motions.

With volume V, centre of buoyancy z_B, waterplane A and its second moments I_x = ∫y², I_y = ∫x², z_G of the centre of
mass, and m = ρV:

    heave ρgA,    roll about x: ρg I_x + ρgV(z_B − z_G),    pitch about y: ρg I_y + ρgV(z_B − z_G)

Of a hull that is not symmetric, heave is coupled with roll by ρg∫y and with pitch by −ρg∫x, roll with pitch by −ρg∫xy,
all over the waterplane about the vertical axis through the centre of mass. Surge, sway and yaw have no stiffness.
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
from hydroelastic.physics.wetted_hulls import Hydrostatics, WettedHull

RigidMotion: TypeAlias = Literal["surge", "sway", "heave", "roll", "pitch", "yaw"]
RIGID_MOTIONS: tuple[RigidMotion, ...] = get_args(RigidMotion)
"""Along x, y and z, and about axes along x, y and z through the centre of mass."""

# Part of ρg I_x below which a stiffness is rounding.
_ROUNDING = 1e-12

SolidFloatShape: TypeAlias = Literal["cylinder", "sphere", "box", "revolved", "hull"]


@dataclass(frozen=True, kw_only=True)
class SolidFloat:
    """A rigid solid that floats, upright at rest, by Archimedes' principle."""

    # an upright cylinder, a sphere, a box with sides along x and y, a revolved outline, or a hull of a file
    shape: SolidFloatShape
    size: Point  # largest extents along x and y of its wetted part, m
    draught: float  # depth of its lowest point, m
    position: Point  # x and y of the vertical axis through its centre of mass, m
    centre_of_gravity: float  # z_G, m
    gyration: tuple[float, float, float]  # radii of gyration about axes along x, y and z through the centre of mass, m
    motions: tuple[RigidMotion, ...]  # those that are free
    # corners [r, z] of a revolved outline from the axis back to it, z from the still level, m
    outline: tuple[Point, ...] = ()
    hull: WettedHull | None = None  # the wetted part of a hull of a file

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
            outline=tuple(scaled_point(point, length) for point in self.outline),
            hull=None if self.hull is None else self.hull.scaled(length),
        )

    @property
    def bounds(self) -> tuple[Point, Point]:
        """Least and largest x, and least and largest y, of its wetted part."""
        if self.hull is not None:
            low, high = ((place[0], place[1]) for place in (self.hull.low, self.hull.high))
            (x, y), (left, front), (right, back) = self.origin, low, high
            return (x + left, x + right), (y + front, y + back)
        (x, y), (along, across) = self.position, self.size
        return (x - 0.5 * along, x + 0.5 * along), (y - 0.5 * across, y + 0.5 * across)

    @property
    def origin(self) -> Point:
        """x and y of the origin of its file, or of its axis."""
        (x, y), (right, back) = self.position, self.hydrostatics.axis
        return x - right, y - back

    @cached_property
    def hydrostatics(self) -> Hydrostatics:
        """Volume, centre of buoyancy and waterplane."""
        (along, across), depth = self.size, self.draught
        if self.hull is not None:
            return self.hull.hydrostatics
        if self.shape == "box":
            area = along * across
            second = (along * across**3 / 12.0, across * along**3 / 12.0)
            return Hydrostatics(volume=area * depth, buoyancy=-0.5 * depth, waterplane=area, second=second)
        assert self.shape != "hull"
        solid = solid_of_revolution(self.shape, radius=0.5 * along, draught=depth, outline=self.outline)
        wetted = solid.moments(0.0)
        chain = solid.below(0.0)
        area, moment = solid.waterplane(chain[0].start[0], chain[-1].end[0])
        return Hydrostatics(
            volume=wetted.area,
            buoyancy=wetted.first[1] / wetted.area,
            waterplane=area,
            second=(moment, moment),
        )

    def stiffness(self) -> FloatArray:
        """Return the hydrostatic stiffness of its motions over ρg, shape (motions, motions)."""
        found = self.hydrostatics
        lever = found.volume * (found.buoyancy - self.centre_of_gravity)
        (x, y), (about_x, about_y), product = found.first, found.second, found.product
        restored = np.array(
            [[found.waterplane, y, -x], [y, about_x + lever, -product], [-x, -product, about_y + lever]]
        )
        # That of a sphere about its centre is rounding.
        restored[1:, 1:][np.abs(restored[1:, 1:]) < _ROUNDING * max(found.second)] = 0.0
        stiffness = np.zeros((6, 6))
        stiffness[2:5, 2:5] = restored
        places = [RIGID_MOTIONS.index(motion) for motion in self.motions]
        return np.asarray(stiffness[np.ix_(places, places)])

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
