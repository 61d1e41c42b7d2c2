"""A scene in units of the tank: its layers, its still levels cut into pieces, and what floats there."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

from hydroelastic.scenes.models.bodies import BeamSection
from hydroelastic.scenes.models.tank import Beam, Float, Level, TankScene, level_segments
from hydroelastic.scenes.tank.beam_shapes import jointed_beam
from hydroelastic.scenes.tank.scaling import Scales, scaled_beam, scales
from hydroelastic.scenes.tank.waves import LevelPiece

if TYPE_CHECKING:
    from hydroelastic.scenes.tank.scaled_float import ScaledFloat


MIDDLE = 0.5
"""Abscissa of the mirror plane of a symmetric tank."""

# α where the slope of a beam jumps, and where its curvature does.
_KINK, _STEP = 2.0, 3.0

ROUNDING = 1e-14
"""Lengths that decimal input means to be equal differ by a few units of the last place."""


@dataclass(frozen=True, kw_only=True)
class ScaledLayer:
    """A layer of liquid: density in that of the lowest layer, bed and depth in tank lengths."""

    density: float
    floor: float
    depth: float

    @property
    def ceiling(self) -> float:
        """Ordinate of its upper side."""
        return self.floor + self.depth


@dataclass(frozen=True, kw_only=True)
class Piece:
    """A piece of a still level from left to right: a body's, or what lies beside the bodies.

    Attributes:
        start: its left end, in tank lengths.
        end: its right end; that of a thin float is its start.
        body: index of the body in the scene, or ``None``.
    """

    start: float
    end: float
    body: int | None

    @property
    def length(self) -> float:
        """Its length."""
        return self.end - self.start


@dataclass(frozen=True, kw_only=True)
class StillLevel:
    """The upper side of a layer at rest.

    Attributes:
        height: its ordinate.
        below: index of the layer below.
        above: index of the layer above, ``None`` at the top.
        kind: what it is beside the bodies: "interface", or the condition of the top.
        jump: ρ below less ρ above.
        pieces: from left to right.
    """

    height: float
    below: int
    above: int | None
    kind: str
    jump: float
    pieces: tuple[Piece, ...]

    @property
    def moves(self) -> bool:
        """Whether waves travel on it beside the bodies."""
        return self.kind in ("free", "interface")

    @property
    def is_open(self) -> bool:
        """Whether there is something beside the bodies."""
        return any(piece.body is None for piece in self.pieces)


@dataclass(frozen=True, kw_only=True)
class ScaledTank:
    """A scene in units of the tank: L = g = 1, and the density of the lowest layer.

    Attributes:
        layers: from the bottom up.
        levels: the upper sides of the layers, from the bottom up.
        bodies: in the scene's order.
    """

    layers: tuple[ScaledLayer, ...]
    levels: tuple[StillLevel, ...]
    bodies: tuple[Beam | ScaledFloat, ...]

    @property
    def depth(self) -> float:
        """Depth of the thinnest layer: rounding grows in it, and cells follow it."""
        return min(layer.depth for layer in self.layers)

    @property
    def top(self) -> str:
        """What lies on the uppermost layer beside the bodies."""
        return self.levels[-1].kind

    @cached_property
    def beams(self) -> dict[int, Beam]:
        """The beams by their index among the bodies."""
        return {index: body for index, body in enumerate(self.bodies) if isinstance(body, Beam)}

    @cached_property
    def floats(self) -> dict[int, ScaledFloat]:
        """The floats by their index among the bodies."""
        return {index: body for index, body in enumerate(self.bodies) if not isinstance(body, Beam)}

    @property
    def has_high_frequency_limit(self) -> bool:
        """Whether there is something that moves freely far above the waves: open water, or an interface."""
        return len(self.layers) > 1 or (self.top != "rigid" and self.levels[-1].is_open)

    @property
    def moves_as_one(self) -> bool:
        """Whether two liquids meet beside the bodies, and so move as one far above the waves."""
        return len(self.layers) > 1 and self.levels[0].is_open

    @property
    def pieces(self) -> tuple[Piece, ...]:
        """The pieces of all levels, from the bottom up and from left to right."""
        return tuple(piece for level in self.levels for piece in level.pieces)

    def level_of(self, body: int) -> StillLevel:
        """The level at which a body floats."""
        return self._places[body][0]

    def piece_of(self, body: int) -> Piece:
        """The part of its level that a body takes."""
        return self._places[body][1]

    @cached_property
    def _places(self) -> dict[int, tuple[StillLevel, Piece]]:
        """Level and piece of each body, by its index."""
        return {piece.body: (level, piece) for level in self.levels for piece in level.pieces if piece.body is not None}

    def nodes_of(self, body: int) -> dict[float, float]:
        """Abscissae of the steps and joints of a beam, with α of ψ ~ r^α there; none of other bodies.

        Where the slope of a beam jumps, ψ has a term r² ln r, and r³ ln r where its curvature does.
        """
        if body not in self.beams or self.beams[body].is_uniform:
            return {}
        beam, start = jointed_beam(self.beams[body]), self.piece_of(body).start
        joints = {beam.node_of(joint) for joint in beam.joints}
        return {
            _snapped(start + edge): _KINK if number in joints else _STEP
            for number, edge in enumerate(beam.edges)
            if 0 < number < len(beam.edges) - 1
        }

    def moving_pieces(self, level: StillLevel, piece: Piece) -> tuple[LevelPiece, ...]:
        """How waves travel on a piece, on each section of a beam; none where none do."""
        layers = self._layers_at(level)
        if piece.body in self.beams:
            beam = self.beams[piece.body]
            return tuple(
                LevelPiece(length=part.length, beam=_uniform_beam(part, beam), jump=level.jump, layers=layers)
                for part in beam.parts
            )
        if piece.body is not None or not level.moves:
            return ()
        return (LevelPiece(length=piece.length, beam=None, jump=level.jump, layers=layers),)

    @cached_property
    def moving(self) -> tuple[LevelPiece, ...]:
        """The pieces on which waves travel."""
        return tuple(
            moving for level in self.levels for piece in level.pieces for moving in self.moving_pieces(level, piece)
        )

    def _layers_at(self, level: StillLevel) -> tuple[tuple[float, float], ...]:
        """Density and depth of the layers that move with a level; at a top over two of them, as if they were one."""
        if level.above is None:
            return ((self.layers[-1].density, sum(layer.depth for layer in self.layers)),)
        return tuple((self.layers[number].density, self.layers[number].depth) for number in (level.below, level.above))


def _uniform_beam(part: BeamSection, beam: Beam) -> Beam:
    """A section of a beam as a beam of its own."""
    return Beam(start=0.0, **dict(part), hydrostatic=beam.hydrostatic, ends=beam.ends)


def scaled_tank(scene: TankScene) -> ScaledTank:
    """The scene in units of the tank."""
    units = scales(scene)
    depths = [layer.depth / units.length for layer in scene.layers]
    floors = [-depths[0], 0.0]
    layers = tuple(
        ScaledLayer(density=layer.density / units.density, floor=floor, depth=depth)
        for layer, floor, depth in zip(scene.layers, floors, depths, strict=False)
    )
    names: tuple[Level, ...] = ("surface",) if len(layers) == 1 else ("interface", "surface")
    levels = tuple(_level(scene, units, layers, number, name) for number, name in enumerate(names))
    place = {piece.body: piece for level in levels for piece in level.pieces if piece.body is not None}
    return ScaledTank(
        layers=layers,
        levels=levels,
        bodies=tuple(_scaled_body(scene, units, index, place[index]) for index in range(len(scene.body))),
    )


def _level(scene: TankScene, units: Scales, layers: tuple[ScaledLayer, ...], number: int, name: Level) -> StillLevel:
    above = number + 1 if number + 1 < len(layers) else None
    pieces = tuple(
        Piece(
            start=_snapped(segment.start / units.length),
            end=1.0 if segment.end == scene.tank.length else _snapped(segment.end / units.length),
            body=segment.body,
        )
        for segment in level_segments(scene, name)
    )
    return StillLevel(
        height=0.0 if number == 0 else layers[number].ceiling,
        below=number,
        above=above,
        kind=scene.top if above is None else "interface",
        jump=layers[number].density - (layers[above].density if above is not None else 0.0),
        pieces=pieces,
    )


def _snapped(x: float) -> float:
    """The middle of the tank for what lies there but for rounding: a mirror plane must not miss a thin float."""
    return MIDDLE if abs(x - MIDDLE) <= ROUNDING else x


def _scaled_body(scene: TankScene, units: Scales, index: int, piece: Piece) -> Beam | ScaledFloat:
    body = scene.body[index]
    if isinstance(body, Float):
        # Contours need SciPy's root finders, which take a while to import.
        from hydroelastic.scenes.tank.scaled_float import scaled_float

        return scaled_float(scene, index, units, (piece.start, piece.end))
    return scaled_beam(body, units, piece.start, piece.end)
