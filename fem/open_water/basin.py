"""Truncation of open water: a basin around the bodies, the frames of cells around it, and how far they reach.

The basin is a closed tank with all bodies; its walls, and its bottom or lid where a liquid goes on, are then
surrounded by frames of cells in which coordinates are turned into the complex plane, see `fem.complex_scaling`. Frames
begin with what an element resolves of the shortest wave, and grow by a constant factor: where they are too long for a
wave it has decayed. They end where the longest wave has decayed, and where deep water's ψ ~ 1/r is below the tolerance.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, inf, isinf, log, pi, sin

import numpy as np

from hydroelastic.meshes.geometry import BOTTOM, LEFT_WALL, LID, RIGHT_WALL
from hydroelastic.meshes.open_sea import Frames
from hydroelastic.modal.liquid.travelling_waves import TravellingWave, travelling_waves
from hydroelastic.modal.liquid.two_layer import TwoLayers
from hydroelastic.modal.tank_estimates import two_layers
from hydroelastic.physics.scales import Scales
from hydroelastic.physics.tank import Tank
from hydroelastic.physics.tank import tank as closed_tank

# Distance of the basin's sides from the bodies, in parts of their extent.
_MARGIN = 0.5
_LEAST_MARGIN = 0.1
# The same in radians of the shortest wave: in short waves a wide basin would be full of them.
_MARGIN_IN_RADIANS = 6.0
# What is drawn is so deep, in parts of its length.
_DRAWN_DEPTH = 0.35
# A layer that is deeper than the basin by more than this part of the basin's length goes on in frames.
_DEEPER = 1.0
# A bed or a lid that is a little further than a frame ends with it.
_NEARLY = 1.5
CUT = 0.03
"""Part of the tolerance below which is kept what is cut off far away, each of two ends."""


@dataclass(frozen=True, kw_only=True)
class OpenBasin:
    """The part of open water around the bodies.

    Attributes:
        tank: the basin as a closed tank, in units of its length.
        units: those units.
        origin: abscissa of the basin's left side in the open water, m.
        layers: the liquids of the open water, m and kg/m³.
        depths: of the liquids of the open water, from the bottom up, in basin lengths; may be infinite.
    """

    tank: Tank
    units: Scales
    origin: float
    layers: TwoLayers
    depths: tuple[float, ...]

    @property
    def sides(self) -> tuple[str, ...]:
        """The sides that are extended in both directions at once."""
        deeper = [depth > layer.depth for depth, layer in zip(self.depths, self.tank.layers, strict=True)]
        return (LEFT_WALL, RIGHT_WALL) + (BOTTOM,) * deeper[0] + (LID,) * (len(deeper) > 1 and deeper[-1])

    @property
    def scaled_layers(self) -> TwoLayers:
        """The liquids in units of the basin."""
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
        """Lower and upper bounds in x and y of where coordinates are real; infinite where a bed or a top ends them."""
        tank = self.tank
        floor = tank.layers[0].floor if BOTTOM in self.sides else -inf
        ceiling = tank.layers[-1].ceiling if LID in self.sides else inf
        # A liquid of finite depth goes on downwards as it is: only sideways it is turned.
        if not isinf(self.depths[0]):
            floor = -inf
        if not isinf(self.depths[-1]):
            ceiling = inf
        return (0.0, floor), (1.0, ceiling)

    @property
    def endless(self) -> tuple[str, ...]:
        """The sides beyond which nothing is modelled."""
        deep = (BOTTOM,) * isinf(self.depths[0]) + (LID,) * (len(self.depths) > 1 and isinf(self.depths[-1]))
        return (LEFT_WALL, RIGHT_WALL, *deep)

    def waves(self, omega: float) -> tuple[TravellingWave, ...]:
        """The travelling waves at a dimensionless frequency, in units of the basin."""
        return travelling_waves(self.scaled_layers, omega)


def open_basin(water: Tank, shortest: float, *, drawn: float | None = None) -> OpenBasin:
    """Cut a basin out of open water.

    Args:
        water: open water in SI units, with at least one body.
        shortest: the largest wavenumber of the waves that leave, 1/m; 0 where none does.
        drawn: if it is to hold the whole stretch of interest, and not only what forces and motions need: for so many
            radians of that wave to each side at most.
    """
    left, right, low, high = _extent(water)
    extent = max(0.5 * (right - left), -low, high)
    margin = _MARGIN * extent
    if shortest * margin > _MARGIN_IN_RADIANS:
        margin = max(_MARGIN_IN_RADIANS / shortest, _LEAST_MARGIN * extent)
    margins = (margin, margin)
    if drawn is not None:
        most = max(margin, drawn / shortest if shortest else inf)
        least = _LEAST_MARGIN * extent
        margins = (min(max(left, least), most), min(max(water.length - right, least), most))
    length = right - left + sum(margins)
    margin = max(margin, _DRAWN_DEPTH * length) if drawn is not None else margin
    reaches = (margin - low, margin + high)
    depths = [layer.depth for layer in water.layers]
    # A top that moves, or holds the pressure, is part of the basin.
    goes_on = (True, isinf(depths[-1]) or water.top == "rigid")
    kept = [
        reach if open_end and depth > reach + _DEEPER * length else depth
        for depth, reach, open_end in zip(depths, reaches, goes_on, strict=False)
    ]
    origin = left - margins[0]
    basin = closed_tank(
        length=length,
        gravity=water.gravity,
        is_open=False,
        liquids=tuple((layer.density, depth) for layer, depth in zip(water.layers, kept, strict=True)),
        top=water.top,
        bodies=tuple(body.moved(-origin) for body in water.bodies),
    )
    return OpenBasin(
        tank=basin.scaled(),
        units=basin.units,
        origin=origin,
        layers=two_layers(water),
        depths=tuple(depth / length for depth in depths),
    )


def _extent(water: Tank) -> tuple[float, float, float, float]:
    """Smallest and largest x, smallest and largest y of all bodies, and the still levels at which they float."""
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
class Reach:
    """How frames are laid.

    Attributes:
        angle: α by which coordinates are turned.
        first: width of the first frame, in basin lengths.
        growth: ratio of the distances of successive frames.
        farthest: distance of the last one.
    """

    angle: float
    first: float
    growth: float
    farthest: float

    def stages(self, basin: OpenBasin) -> list[tuple[tuple[str, ...], Frames]]:
        """Frames one after another, and the sides of the basin, widened by those before, that they extend.

        A bed or a lid is not followed beyond its distance: frames that go on sideways alone would else be thin and long
        there.
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
            sides = (LEFT_WALL, RIGHT_WALL, *open_sides)
            frames = int(np.searchsorted(distances, min(open_sides.values(), default=inf))) + 1
            sideways, distances = distances[:frames] - start, distances[frames:]
            ended = {side: end for side, end in open_sides.items() if end <= _NEARLY * (start + sideways[-1])}
            below, above = (
                sideways * (ended[side] - start) / sideways[-1] if side in ended else sideways for side in (BOTTOM, LID)
            )
            stages.append((sides, Frames(sideways=sideways, below=below, above=above)))
            open_sides = {side: end for side, end in open_sides.items() if side not in ended}
            start += float(sideways[-1])
        return stages


def reach(
    basin: OpenBasin, wavenumbers: tuple[float, float], *, first: float, growth: float, angle: float, tolerance: float
) -> Reach:
    """How far frames must reach.

    Args:
        basin: the basin.
        wavenumbers: smallest and largest of the waves that leave, in units of the basin.
        first: radians of the shortest wave that the first frame holds.
        growth: ratio of the distances of successive frames.
        angle: α.
        tolerance: largest relative error that is accepted.
    """
    longest, shortest = wavenumbers
    decades = log(1.0 / (CUT * tolerance))
    # A wave goes out and comes back. So does what decays by itself, like e^{−κx} with κ > π/(2H), H all the depth
    # between the bed and a free top: that bound is reached far above the waves.
    farthest = [decades / (2.0 * longest * sin(angle))]
    farthest.append(decades * sum(depth for depth in basin.depths if not isinf(depth)) / (pi * cos(angle)))
    if any(isinf(depth) for depth in basin.depths):
        farthest.append((1.0 + 1.0 / longest) * (CUT * tolerance) ** -0.5)
    return Reach(angle=angle, first=min(first / shortest, 0.5), growth=growth, farthest=max(farthest))
