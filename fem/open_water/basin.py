"""Truncation of open water: a basin around the bodies, and an absorbing layer around the basin.

The basin is a closed tank with all bodies; its walls, and its bottom or lid where a liquid continues beyond them, are
surrounded by an absorbing layer in which coordinates are rotated into the complex plane, see `complex_scaling`. The
absorbing layer consists of layers of cells. The first is as wide as the part of the shortest wave that an element
resolves, and widths grow by a constant factor: where cells are too long for a wave, it has decayed. The last layer ends
where the longest wave has decayed, and where ψ ~ 1/r of deep water is below the tolerance.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, exp, inf, isfinite, isinf, log, pi, sin

import numpy as np

from hydroelastic.meshes.geometry import BOTTOM, LEFT_WALL, LID, RIGHT_WALL
from hydroelastic.meshes.open_sea import CellLayers
from hydroelastic.modal.liquid.travelling_waves import TravellingWave, travelling_waves
from hydroelastic.modal.liquid.two_layer import TwoLayers
from hydroelastic.modal.tank_estimates import two_layers
from hydroelastic.physics.scales import Scales
from hydroelastic.physics.tank import Tank
from hydroelastic.physics.tank import tank as closed_tank

# Distance of the basin's sides from the bodies, in parts of their extent.
_MARGIN = 0.5
_LEAST_MARGIN = 0.1
# Upper limit of that distance in radians of the shortest wave: a basin of many wavelengths would need many elements.
_MARGIN_IN_RADIANS = 6.0
# Depth of the basin of a picture, in parts of its length.
_DRAWN_DEPTH = 0.35
# A liquid that is deeper than the basin by more than this part of the basin's length continues in the absorbing layer.
_DEEPER = 1.0
# Layers of cells are stretched to end at a bed or a lid that is up to so many times as far as the last one.
_NEARLY = 1.5
CUT = 0.03
"""Part of the tolerance that the truncation of the absorbing layer may take at each of both ends."""


@dataclass(frozen=True, kw_only=True)
class OpenBasin:
    """The part of open water around the bodies."""

    tank: Tank  # the basin as a closed tank, in units of its length
    units: Scales  # units of `tank`
    origin: float  # abscissa of the basin's left side in the open water, m
    phase_at: float  # abscissa in the open water at which the crest of an incident wave is at t = 0, m
    layers: TwoLayers  # the liquids of the open water, in SI units
    # depths of the liquids of the open water, from the bottom up, in basin lengths; may be infinite
    depths: tuple[float, ...]

    @property
    def walls(self) -> tuple[str, ...]:
        """Names of the vertical sides, through which waves leave: one of them where the other is an axis."""
        return (RIGHT_WALL,) if self.tank.geometry.is_revolved else (LEFT_WALL, RIGHT_WALL)

    @property
    def sides(self) -> tuple[str, ...]:
        """Names of the sides of the basin that the absorbing layer extends."""
        deeper = [depth > layer.depth for depth, layer in zip(self.depths, self.tank.layers, strict=True)]
        return self.walls + (BOTTOM,) * deeper[0] + (LID,) * (len(deeper) > 1 and deeper[-1])

    @property
    def scaled_layers(self) -> TwoLayers:
        """The liquids of the open water, dimensionless in units of the basin."""
        two = self.layers
        return TwoLayers(
            density_below=1.0,
            density_above=two.density_above / two.density_below,
            depth_below=self.depths[0],
            depth_above=self.depths[1] if len(self.depths) > 1 else inf,
            gravity=1.0,
            top=two.top,
        )

    @property
    def bounds(self) -> tuple[tuple[float, float], tuple[float, float]]:
        """Lower and upper bounds (x, y), in basin lengths, within which coordinates are real; infinite at a bed or a
        top."""
        tank = self.tank
        floor = tank.layers[0].floor if BOTTOM in self.sides else -inf
        ceiling = tank.layers[-1].ceiling if LID in self.sides else inf
        # In a liquid of finite depth only x is rotated.
        if not isinf(self.depths[0]):
            floor = -inf
        if not isinf(self.depths[-1]):
            ceiling = inf
        return (-inf if self.tank.geometry.is_revolved else 0.0, floor), (1.0, ceiling)

    @property
    def far_sides(self) -> tuple[str, ...]:
        """Names of the outer sides of the absorbing layer that lie in a liquid, on which ψ = 0."""
        deep = (BOTTOM,) * isinf(self.depths[0]) + (LID,) * (len(self.depths) > 1 and isinf(self.depths[-1]))
        return (*self.walls, *deep)

    def waves(self, omega: float) -> tuple[TravellingWave, ...]:
        """The travelling waves at a dimensionless frequency ω, in units of the basin."""
        return travelling_waves(self.scaled_layers, omega)


def open_basin(
    water: Tank, shortest: float, *, drawn: float | None = None, reach: tuple[float, float] | None = None
) -> OpenBasin:
    """Cut a basin out of open water."""
    left, right, low, high = extent_of_bodies(water)
    solid = water.geometry.is_revolved
    extent = max(right if solid else 0.5 * (right - left), -low, high)
    margin = _MARGIN * extent
    if shortest * margin > _MARGIN_IN_RADIANS:
        margin = max(_MARGIN_IN_RADIANS / shortest, _LEAST_MARGIN * extent)
    margins = (margin, margin)
    if drawn is not None:
        most = max(margin, drawn / shortest if shortest else inf)
        least = _LEAST_MARGIN * extent
        margins = (
            min(max(left - water.start, least), most),
            min(max(water.start + water.length - right, least), most),
        )
    if reach is not None:
        margins = max(margins[0], left - reach[0]), max(margins[1], reach[1] - right)
    if solid:
        left, margins = 0.0, (0.0, margins[1])
    length = right - left + sum(margins)
    margin = max(margin, _DRAWN_DEPTH * length) if drawn is not None else margin
    distances = (margin - low, margin + high)
    depths = [layer.depth for layer in water.layers]
    # A free or pressure-release top is part of the basin.
    goes_on = (True, isinf(depths[-1]) or water.top == "rigid")
    kept = [
        distance if open_end and depth > distance + _DEEPER * length else depth
        for depth, distance, open_end in zip(depths, distances, goes_on, strict=False)
    ]
    origin = left - margins[0]
    basin = closed_tank(
        length=length,
        gravity=water.gravity,
        is_open=False,
        liquids=tuple((layer.density, depth) for layer, depth in zip(water.layers, kept, strict=True)),
        top=water.top,
        bodies=tuple(body.moved(-origin) for body in water.bodies),
        geometry=water.geometry,
    )
    return OpenBasin(
        tank=basin.scaled(),
        units=basin.units,
        origin=origin,
        phase_at=water.phase_at,
        layers=two_layers(water),
        depths=tuple(depth / length for depth in depths),
    )


def extent_of_bodies(water: Tank) -> tuple[float, float, float, float]:
    """Return smallest and largest x, smallest and largest y of all bodies, and of the still levels at which they
    float."""
    bounds = []
    for index, body in enumerate(water.bodies):
        (left, right), height = body.waterplane, water.level_of(index).height
        low, high = height, height
        if body.hull is not None:
            lowest, rightmost, low, high = body.hull.bounds
            left, right = (left, right) if body.hull.is_thin else (lowest, rightmost)
        bounds.append((left, right, min(low, 0.0), max(high, 0.0)))
    lefts, rights, lows, highs = zip(*bounds, strict=True)
    return min(lefts), max(rights), min(lows), max(highs)


@dataclass(frozen=True, kw_only=True)
class AbsorbingLayer:
    """Dimensions of the absorbing layer around a basin."""

    angle: float  # angle α of the complex scaling, rad
    first: float  # width of the first layer of cells, in basin lengths
    growth: float  # ratio of the distances of successive layers of cells from the basin
    farthest: float  # width of the whole absorbing layer, in basin lengths

    def stages(self, basin: OpenBasin) -> list[tuple[tuple[str, ...], CellLayers]]:
        """Return layers of cells in stages, each with the names of the sides that it extends.

        A stage surrounds the basin with all earlier stages. Where a bed or a lid is reached, the next stages extend the
        other sides only; otherwise cells along the bed would be thin and long.
        """
        count = max(int(np.ceil(log(self.farthest / self.first) / log(self.growth))), 1)
        distances = self.first * (self.farthest / self.first) ** (np.arange(count + 1) / count)
        further = {
            BOTTOM: basin.depths[0] - basin.tank.layers[0].depth,
            LID: basin.depths[-1] - basin.tank.layers[-1].depth,
        }
        open_sides = {side: further[side] for side in (BOTTOM, LID) if side in basin.sides}
        stages, start = [], 0.0
        while len(distances):
            sides = (*basin.walls, *open_sides)
            count = int(np.searchsorted(distances, min(open_sides.values(), default=inf))) + 1
            sideways, distances = distances[:count] - start, distances[count:]
            ended = {side: end for side, end in open_sides.items() if end <= _NEARLY * (start + sideways[-1])}
            below, above = (
                sideways * (ended[side] - start) / sideways[-1] if side in ended else sideways for side in (BOTTOM, LID)
            )
            stages.append((sides, CellLayers(sideways=sideways, below=below, above=above)))
            open_sides = {side: end for side, end in open_sides.items() if side not in ended}
            start += float(sideways[-1])
        return stages

    def reflected(self, basin: OpenBasin, wavenumber: float) -> tuple[float, float]:
        """Return the parts of the power of outgoing waves, and of the energy beside them, that its ends reflect.

        Of waves e^{−2kX sin α}, of the slowest evanescent mode e^{−πX cos α/H} between a bed and a free top, in deep
        liquids (kX)⁻² of ψ ~ 1/(kX), about an axis k⁻²X⁻³ of ψ ~ 1/(kX²). Measured on beams: at both ends the
        exponentials are 1.0 to 2 times the error, the power 20 times; they count one and a half times and by half.
        About an axis a wave a that is reflected by r comes back as r a (2J − H), and changes a by 2ra².
        """
        reach, bounded = wavenumber * self.farthest, sum(depth for depth in basin.depths if isfinite(depth))
        evanescent = exp(-pi * self.farthest * cos(self.angle) / bounded) if bounded else 0.0
        deep = 0.0 if all(isfinite(depth) for depth in basin.depths) else reach**-2
        # There is no end at the axis.
        ends, power = (2.0, deep / self.farthest) if basin.tank.geometry.is_revolved else (3.0, deep)
        return ends * exp(-2.0 * reach * sin(self.angle)), ends * evanescent + power


def sized_absorbing_layer(
    basin: OpenBasin, wavenumbers: tuple[float, float], *, first: float, growth: float, angle: float, tolerance: float
) -> AbsorbingLayer:
    """Return the absorbing layer that a tolerance needs."""
    longest, shortest = wavenumbers
    decades = log(1.0 / (CUT * tolerance))
    # A wave passes the layer twice, outgoing and reflected. So do evanescent modes e^{−κx} with κ > π/(2H), H the whole
    # depth between the bed and a free top: that bound is reached at infinite frequency.
    farthest = [decades / (2.0 * longest * sin(angle))]
    farthest.append(decades * sum(depth for depth in basin.depths if not isinf(depth)) / (pi * cos(angle)))
    if any(isinf(depth) for depth in basin.depths):
        farthest.append((1.0 + 1.0 / longest) * (CUT * tolerance) ** -0.5)
    return AbsorbingLayer(angle=angle, first=min(first / shortest, 0.5), growth=growth, farthest=max(farthest))
