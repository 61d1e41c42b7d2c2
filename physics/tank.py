"""A tank, or open water: its liquids, their still levels divided into pieces, and the floating bodies."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from math import inf
from typing import TYPE_CHECKING, Literal, TypeAlias

from hydroelastic.physics.attachments import Attachment
from hydroelastic.physics.beams import Beam
from hydroelastic.physics.bodies import Body
from hydroelastic.physics.dofs import Level
from hydroelastic.physics.floats import RigidFloat
from hydroelastic.physics.geometry import PLANE, Geometry
from hydroelastic.physics.scales import Scales

if TYPE_CHECKING:
    from hydroelastic.physics.hulls import Hull

Top: TypeAlias = Literal["free", "rigid", "pressure_release"]

ROUND_OFF = 1e-9
"""Lengths below this part of the tank's length count as zero: decimal input is not exact."""

MIDDLE = 0.5
"""Abscissa of the mirror plane of a symmetric tank, in tank lengths."""

# An order in which no rigid body moves.
_NO_MOTION = 2

ROUNDING = 1e-14
"""Lengths that decimal input means to be equal differ by a few units of the last place."""


@dataclass(frozen=True, kw_only=True)
class Layer:
    """A layer of ideal incompressible liquid."""

    density: float  # kg/m³
    floor: float  # ordinate of its lower side, m
    depth: float  # m; may be infinite in open water

    @property
    def ceiling(self) -> float:
        """Ordinate of its upper side."""
        return self.floor + self.depth


@dataclass(frozen=True, kw_only=True)
class Piece:
    """A piece of a still level from left to right: a body's, or open surface."""

    start: float  # its left end, m
    end: float  # its right end, m; that of a thin float is its start
    body: int | None  # index of the body, or ``None``

    @property
    def length(self) -> float:
        """Its length."""
        return self.end - self.start


@dataclass(frozen=True, kw_only=True)
class StillLevel:
    """The upper side of a layer at rest."""

    height: float  # ordinate y, m or dimensionless as the tank
    below: int  # index of the layer below
    above: int | None  # index of the layer above, ``None`` at the top
    kind: Literal["interface"] | Top  # "interface", or the boundary condition of the top
    jump: float  # ρ below less ρ above, kg/m³
    pieces: tuple[Piece, ...]  # from left to right

    def scaled(self, units: Scales, layers: tuple[Layer, ...]) -> StillLevel:
        """Return the level between layers in other units, in which the tank ends exactly at 1."""
        length = units.length
        pieces = tuple(
            replace(
                piece,
                start=_snapped(piece.start / length),
                end=1.0 if piece.end == length else _snapped(piece.end / length),
            )
            for piece in self.pieces
        )
        height = 0.0 if self.below == 0 else layers[self.below].ceiling
        return replace(self, height=height, jump=density_jump(layers, self.below), pieces=pieces)

    @property
    def name(self) -> Level:
        """Its name in the attribute `level` of bodies."""
        return "surface" if self.above is None else "interface"

    @property
    def moves(self) -> bool:
        """Whether its open part carries waves."""
        return self.kind in ("free", "interface")

    @property
    def is_open(self) -> bool:
        """Whether the bodies leave part of it open."""
        return any(piece.body is None for piece in self.pieces)


@dataclass(frozen=True, kw_only=True)
class Tank:
    """Liquids at rest with floating bodies, per metre of width or of revolution; in SI units or those of `scaled`."""

    length: float  # between the walls, or of the stretch of open water that is of interest, m; of revolution the radius
    gravity: float  # g, m/s²
    is_open: bool  # whether waves leave to both sides, instead of being reflected by walls
    layers: tuple[Layer, ...]  # from the bottom up
    levels: tuple[StillLevel, ...]  # the upper sides of the layers, from the bottom up
    bodies: tuple[Body, ...]  # beams and floats
    start: float = 0.0  # abscissa of the left wall, or of the left end of that stretch, m
    phase_at: float = 0.0  # abscissa at which the crest of an incident wave is at t = 0, m
    attachments: tuple[Attachment, ...] = ()  # springs and dampers that hold the bodies, in SI units
    geometry: Geometry = PLANE  # what the section stands for; of revolution, x is the distance from the axis
    # corners (x, y) of the bed from the left to the right wall, m; "sphere" of a tank of revolution that is the part of
    # a sphere under the surface; ``None`` where it is level
    bed: tuple[tuple[float, float], ...] | Literal["sphere"] | None = None

    @cached_property
    def units(self) -> Scales:
        """The units in which length, gravity and the density of the lowest layer are 1."""
        dimensions = 3 if self.geometry.is_whole else 2
        return Scales(length=self.length, density=self.layers[0].density, gravity=self.gravity, dimensions=dimensions)

    @property
    def orders(self) -> tuple[int, ...]:
        """Azimuthal orders of the bodies' motions, ascending; a section has one, 0."""
        if not self.geometry.is_revolved:
            return (0,)
        return tuple(sorted({order for body in self.bodies for order in body.orders}))

    def of_order(self, order: int) -> Tank:
        """Return the problem of one azimuthal order, or of one number of half waves across an extruded section.

        Rigid bodies have the motions of that order alone; across the whole width they move in order 0 only.
        """
        if self.geometry.kind == "plane":
            return self
        is_fixed = order > 0 and not self.geometry.is_revolved
        bodies = tuple(
            body.of_order(_NO_MOTION if is_fixed else order) if self.geometry.is_revolved or is_fixed else body
            for body in self.bodies
        )
        return replace(self, bodies=bodies, geometry=replace(self.geometry, order=order))

    def scaled(self) -> Tank:
        """Return the tank in these units; it is made once."""
        return self._scaled

    @cached_property
    def _scaled(self) -> Tank:
        units = self.units
        layers = tuple(
            Layer(
                density=layer.density / units.density,
                floor=layer.floor / units.length,
                depth=layer.depth / units.length,
            )
            for layer in self.layers
        )
        levels = tuple(level.scaled(units, layers) for level in self.levels)
        places = {piece.body: piece for level in levels for piece in level.pieces}
        return replace(
            self,
            length=1.0,
            gravity=1.0,
            layers=layers,
            levels=levels,
            geometry=replace(self.geometry, width=self.geometry.width / units.length),
            bed=tuple((x / units.length, y / units.length) for x, y in self.bed)
            if isinstance(self.bed, tuple)
            else self.bed,
            bodies=tuple(
                body.scaled(units, places[index].start, places[index].end) for index, body in enumerate(self.bodies)
            ),
        )

    @property
    def depth(self) -> float:
        """Depth of the thinnest layer, which determines rounding errors and the size of cells."""
        return min(layer.depth for layer in self.layers)

    @property
    def top(self) -> Top:
        """Boundary condition of the uppermost layer beside the bodies."""
        kind = self.levels[-1].kind
        assert kind != "interface"
        return kind

    @cached_property
    def elastic(self) -> tuple[int, ...]:
        """Indices of the bodies that bend."""
        return tuple(index for index, body in enumerate(self.bodies) if body.is_elastic)

    @cached_property
    def rigid(self) -> tuple[int, ...]:
        """Indices of the bodies that do not bend."""
        return tuple(index for index, body in enumerate(self.bodies) if not body.is_elastic)

    @cached_property
    def beams(self) -> dict[int, Beam]:
        """The beams, for theories of beams alone, by their index among the bodies."""
        return {index: body for index, body in enumerate(self.bodies) if isinstance(body, Beam)}

    @cached_property
    def floats(self) -> dict[int, RigidFloat]:
        """The rigid floats, for theories of floats alone, by their index among the bodies."""
        if not self.hulls:
            return {}

        return {index: body for index, body in enumerate(self.bodies) if isinstance(body, RigidFloat)}

    @cached_property
    def hulls(self) -> dict[int, Hull]:
        """The hulls of bodies with draught, by their index among the bodies."""
        return {index: body.hull for index, body in enumerate(self.bodies) if body.hull is not None}

    @property
    def has_waves(self) -> bool:
        """Whether waves travel on an open surface or interface."""
        return any(level.moves and level.is_open for level in self.levels)

    @property
    def has_infinite_frequency_limit(self) -> bool:
        """Whether bodies have an infinite-frequency added mass: beside an open top that is not a lid, or with two
        liquids."""
        return len(self.layers) > 1 or (self.top != "rigid" and self.levels[-1].is_open)

    @property
    def has_continuous_pressure(self) -> bool:
        """Whether there is open interface beside the bodies, across which ρψ is continuous at infinite frequency."""
        return len(self.layers) > 1 and self.levels[0].is_open

    @property
    def levels_from_top(self) -> tuple[StillLevel, ...]:
        """The still levels from the top down, without the surface of an upper liquid that has no end."""
        return tuple(level for level in reversed(self.levels) if level.height < inf)

    @property
    def pieces(self) -> tuple[Piece, ...]:
        """The pieces of all levels, from the bottom up and from left to right."""
        return tuple(piece for level in self.levels for piece in level.pieces)

    def density_at(self, level: StillLevel) -> float:
        """ρ of the liquids that meet at a still level together."""
        return sum(self.layers[layer].density for layer in (level.below, level.above) if layer is not None)

    def level_of(self, body: int) -> StillLevel:
        """The level at which a body floats."""
        return self._places[body][0]

    def piece_of(self, body: int) -> Piece:
        """The part of its level that a body takes."""
        return self._places[body][1]

    @cached_property
    def _places(self) -> dict[int, tuple[StillLevel, Piece]]:
        return {piece.body: (level, piece) for level in self.levels for piece in level.pieces if piece.body is not None}

    def nodes_of(self, body: int) -> dict[float, float]:
        """Abscissae at which the slope or curvature of a body jumps, with α of ψ ~ r^α there."""
        start = self.piece_of(body).start
        return {_snapped(start + place): exponent for place, exponent in self.bodies[body].nodes.items()}


def density_jump(layers: tuple[Layer, ...], below: int) -> float:
    """ρ of a layer less that of the one above it, if there is one."""
    return layers[below].density - (layers[below + 1].density if below + 1 < len(layers) else 0.0)


def tank(
    *,
    length: float,
    gravity: float,
    is_open: bool,
    liquids: tuple[tuple[float, float], ...],
    top: Top,
    bodies: tuple[Body, ...],
    geometry: Geometry = PLANE,
) -> Tank:
    """Cut the still levels of a tank into pieces.

    Args:
        length: m.
        gravity: m/s².
        is_open: whether waves leave to both sides.
        liquids: density, kg/m³, and depth, m, from the bottom up; the second lies on y = 0.
        top: boundary condition of the uppermost liquid beside the bodies.
        bodies: in any order, each at its level, without overlap.
        geometry: what the section stands for.
    """
    floors = [-liquids[0][1], 0.0]
    layers = tuple(
        Layer(density=density, floor=floor, depth=depth)
        for (density, depth), floor in zip(liquids, floors, strict=False)
    )
    ends = (-inf, inf) if is_open else (0.0, length)
    if geometry.is_revolved:
        ends = (0.0, ends[1])
    names: tuple[Level, ...] = ("surface",) if len(layers) == 1 else ("interface", "surface")
    levels = []
    for number, name in enumerate(names):
        above = number + 1 if number + 1 < len(layers) else None
        levels.append(
            StillLevel(
                height=0.0 if number == 0 else layers[number].ceiling,
                below=number,
                above=above,
                kind=top if above is None else "interface",
                jump=density_jump(layers, number),
                pieces=tuple(_pieces(bodies, name, ends, 0.0 if is_open else ROUND_OFF * length)),
            )
        )
    return Tank(
        length=length,
        gravity=gravity,
        is_open=is_open,
        layers=layers,
        levels=tuple(levels),
        bodies=bodies,
        geometry=geometry,
    )


def _pieces(bodies: tuple[Body, ...], name: Level, ends: tuple[float, float], negligible: float) -> Iterator[Piece]:
    """A still level from end to end, which are infinite in open water, without gaps.

    A body takes up its waterplane. One whose end is within a negligible distance of an end ends exactly there, and one
    on the axis of revolution begins there.
    """
    left, right = ends
    places = []
    for index, body in enumerate(bodies):
        if body.level != name:
            continue
        start, end = body.waterplane
        places.append((start if start > left + negligible else left, end if end < right - negligible else right, index))
    reached = left
    for start, end, index in sorted(places):
        if start > reached:
            yield Piece(start=reached, end=start, body=None)
        yield Piece(start=start, end=end, body=index)
        reached = end
    if reached < right:
        yield Piece(start=reached, end=right, body=None)


def _snapped(x: float) -> float:
    """The middle of the tank for points within rounding of it: a thin float must lie on the mirror plane exactly."""
    return MIDDLE if abs(x - MIDDLE) <= ROUNDING else x
