"""A tank that needs a mesh of its volume: a shaped bed, the shape of a file, or no reduction wanted."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TypeAlias

from hydroelastic.physics.level_tank import FilePlan, LevelTank
from hydroelastic.physics.obstacles import Baffle
from hydroelastic.physics.plate import Disc, Point, Rectangle
from hydroelastic.physics.scales import Scales
from hydroelastic.physics.solid_floats import SolidFloat


@dataclass(frozen=True, kw_only=True)
class SlopingBed:
    """A plane bed, z = −H + s·(x − x₀) with the middle x₀ of the box around the plan."""

    slope: Point  # s, rise of the bed per length along x and along y

    def scaled(self, _length: float) -> SlopingBed:
        """Return it in units of a length: slopes have none."""
        return self


@dataclass(frozen=True, kw_only=True)
class SurveyedBed:
    """A bed through points, smooth between them; H is the depth over the lowest of them."""

    points: tuple[tuple[float, float, float], ...]  # x, y and height above any level, m

    def scaled(self, length: float) -> SurveyedBed:
        """Return it in units of a length."""
        return replace(self, points=tuple((x / length, y / length, z / length) for x, y, z in self.points))


Bed: TypeAlias = SlopingBed | SurveyedBed
"""The bed of an upright tank that is not level."""


@dataclass(frozen=True, kw_only=True)
class LowerLiquid:
    """The lower one of two liquids."""

    density: float  # ρ, kg/m³, more than that of the upper one
    depth: float  # its own, m


@dataclass(frozen=True, kw_only=True)
class VolumeTank(LevelTank):
    """One or two liquids in a tank whose volume is meshed; in SI units, or in those of `scaled`.

    Depth is that of both liquids together, density that of the upper one.
    """

    bed: Bed | None = None  # of an upright tank; ``None`` where it is level, or part of a file
    floats: tuple[SolidFloat, ...] = ()  # solids with draught; as bodies they come after the plates
    columns: tuple[Rectangle | Disc, ...] = ()  # outlines of columns from the bed to above the still surface
    baffles: tuple[Baffle, ...] = ()  # thin rigid plates in the liquid
    lower: LowerLiquid | None = None  # the lower liquid of two

    @property
    def is_level(self) -> bool:
        """Whether it is an upright tank with a level bed and plates all the same."""
        other = self.floats or self.columns or self.baffles or self.lower
        return self.bed is None and not other and not isinstance(self.plan, FilePlan)

    @property
    def interface(self) -> float | None:
        """z of the interface of two liquids."""
        return None if self.lower is None else self.lower.depth - self.depth

    def scaled(self) -> VolumeTank:
        """Return the tank in its own units."""
        units: Scales = self.units
        level = super().scaled()
        assert isinstance(level, VolumeTank)
        return replace(
            level,
            bed=None if self.bed is None else self.bed.scaled(units.length),
            floats=tuple(solid.scaled(units) for solid in self.floats),
            columns=tuple(outline.scaled(units.length) for outline in self.columns),
            baffles=tuple(baffle.scaled(units.length) for baffle in self.baffles),
            lower=None
            if self.lower is None
            else LowerLiquid(density=self.lower.density / self.density, depth=self.lower.depth / units.length),
        )
