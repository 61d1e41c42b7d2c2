"""An upright tank with a level bed in three dimensions: its plan, the liquid, and plates on the still surface.

z is upwards from the still surface; a box has its origin in a corner, a cylinder and a ring on their axis.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import pi
from pathlib import Path
from typing import TypeAlias

import numpy as np

from hydroelastic.physics.plate import Plate, Point, Polygon, scaled_point
from hydroelastic.physics.scales import Scales
from hydroelastic.physics.tank import Top


@dataclass(frozen=True, kw_only=True)
class Box:
    """A rectangular plan, 0 < x < length, 0 < y < width."""

    length: float  # m
    width: float  # m

    @property
    def unit(self) -> float:
        """The unit of length of the dimensionless tank, m; in units of a plan's own it is 1."""
        return self.length

    @property
    def area(self) -> float:
        """Its area, m²."""
        return self.length * self.width

    def scaled(self, length: float) -> Box:
        """Return it in units of a length."""
        return Box(length=self.length / length, width=self.width / length)


@dataclass(frozen=True, kw_only=True)
class Cylinder:
    """A circular plan, or a ring about an inner cylinder."""

    radius: float  # m
    inner_radius: float = 0.0  # m; 0 without an inner cylinder

    @property
    def unit(self) -> float:
        """The unit of length of the dimensionless tank, m."""
        return self.radius

    @property
    def area(self) -> float:
        """Its area, m²."""
        return pi * (self.radius**2 - self.inner_radius**2)

    def scaled(self, length: float) -> Cylinder:
        """Return it in units of a length."""
        return Cylinder(radius=self.radius / length, inner_radius=self.inner_radius / length)


@dataclass(frozen=True, kw_only=True)
class PolygonPlan(Polygon):
    """A plan with straight walls."""

    @property
    def unit(self) -> float:
        """The unit of length of the dimensionless tank, m: the larger side of the box around it."""
        return float(np.ptp(np.array(self.points), axis=0).max())

    def scaled(self, length: float) -> PolygonPlan:
        """Return it in units of a length."""
        return PolygonPlan(points=tuple(scaled_point(point, length) for point in self.points))


@dataclass(frozen=True, kw_only=True)
class FilePlan:
    """The still surface of a tank that a file describes."""

    file: Path  # solid of CAD, the inside of the tank, or mesh of the liquid; in m
    fill: float  # height of the still surface above the lowest point, m
    length: float  # the larger side of the box around the still surface, m
    middle: Point  # x and y of the middle of that box, m
    area: float  # of the still surface, m²
    size: Point = (0.0, 0.0)  # both sides of that box, along x and y, m
    baffles: float = 0.0  # area of the thin walls that a mesh declares, m²
    metres: float = 1.0  # the unit of the other lengths, m

    @property
    def unit(self) -> float:
        """The unit of length of the dimensionless tank, m."""
        return self.length

    @property
    def measures(self) -> str:
        """What the file holds, as far as a wrong unit or a forgotten wall would show."""
        along, across = self.size
        baffles = f", with {self.baffles:.5g} m² of baffles" if self.baffles else ""
        return f"{along:.5g} m × {across:.5g} m at the still surface, {self.fill:.5g} m deep{baffles}"

    def scaled(self, length: float) -> FilePlan:
        """Return it in units of a length."""
        return replace(
            self,
            fill=self.fill / length,
            length=self.length / length,
            middle=scaled_point(self.middle, length),
            area=self.area / length**2,
            size=scaled_point(self.size, length),
            baffles=self.baffles / length**2,
            metres=self.metres * length,
        )


Plan: TypeAlias = Box | Cylinder | PolygonPlan | FilePlan
"""The plan of a tank: of all but one of a file, its walls are upright."""


@dataclass(frozen=True, kw_only=True)
class LevelTank:
    """One liquid in an upright tank with a level bed, with plates on its surface; in SI units or those of `scaled`."""

    plan: Plan  # the inside of its walls
    depth: float  # H, m
    density: float  # ρ, kg/m³
    gravity: float  # g, m/s²
    top: Top = "free"  # boundary condition beside the plates
    plates: tuple[Plate, ...] = ()  # without overlap

    @property
    def units(self) -> Scales:
        """The units in which the extent of the plan, gravity and density are 1: the scales of a tank in two dimensions.

        The unit of mass per area is that of its mass per length and metre of width, and D has the unit of EI.
        """
        return Scales(length=self.plan.unit, density=self.density, gravity=self.gravity)

    def scaled(self) -> LevelTank:
        """Return the tank in these units."""
        units = self.units
        return replace(
            self,
            plan=self.plan.scaled(units.length),
            depth=self.depth / units.length,
            density=1.0,
            gravity=1.0,
            plates=tuple(plate.scaled(units) for plate in self.plates),
        )


def middle_of(plan: Plan) -> Point:
    """Return the middle of a plan: of a box, the axis of a cylinder, of the box around a polygon."""
    if isinstance(plan, Box):
        return 0.5 * plan.length, 0.5 * plan.width
    if isinstance(plan, Cylinder):
        return 0.0, 0.0
    if isinstance(plan, FilePlan):
        return plan.middle
    x, y = zip(*plan.points, strict=True)
    return 0.5 * (min(x) + max(x)), 0.5 * (min(y) + max(y))
