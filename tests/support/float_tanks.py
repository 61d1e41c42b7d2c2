"""Tanks with one or two liquids, rigid floats and beams, cut into liquids, levels and corners; SI units.

The geometry of `float_reference`: which pieces bound each liquid, and where its potentials are singular.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from typing import Any, Literal

import numpy as np
from float_sections import Arc, Section, line, section, thin_section
from harmonic_trial import Boundary, Corner, Slit, Trial, nodes_on


@dataclass(frozen=True, kw_only=True)
class Fineness:
    """How finely the reference is resolved.

    Attributes:
        corner: poles at each corner.
        inner: poles inside of each section.
        waves: cosines at the top and at the bottom of each liquid.
        powers: integers that are added to the exponents of a corner.
        halves: see `Trial`.
        bending: polynomials of a beam's deflection.
        steepness: of the clusters of poles.
        reach: panels' length over their distance from the next pole.
        tolerance: see `energy_basis`.
    """

    corner: int = 20
    inner: int = 40
    waves: int = 60
    powers: int = 6
    halves: bool = False
    bending: int = 32
    steepness: float = 4.0
    reach: float = 0.7
    tolerance: float = 1e-14


@dataclass(frozen=True, kw_only=True)
class BeamPlace:
    """A beam of a scene: its span, EI, mass per length, level, and whether buoyancy restores it."""

    start: float
    end: float
    rigidity: float
    mass: float
    at: str
    restoring: bool


@dataclass(frozen=True, kw_only=True)
class FloatTank:
    """A tank as the keys of a scene give it, SI units.

    Attributes:
        length, gravity, top: of the tank.
        densities, depths: of the liquids, from the bottom up.
        sections: floats on the lowest level with their motions, from left to right.
        beams: from left to right.
    """

    length: float
    gravity: float
    top: Literal["free", "rigid"]
    densities: tuple[float, ...]
    depths: tuple[float, ...]
    sections: tuple[tuple[Section, tuple[str, ...]], ...]
    beams: tuple[BeamPlace, ...] = ()

    @property
    def levels(self) -> tuple[str, ...]:
        """What moves: interface and surface, from below."""
        interface = ("interface",) if len(self.depths) == 2 else ()
        # A rigid lid over one liquid lies beside its bodies: nothing but they moves.
        return interface if self.top == "rigid" and interface else (*interface, "surface")

    @property
    def floating(self) -> str:
        """The level of the floats."""
        return self.levels[0]

    def height(self, level: str) -> float:
        """Of a level, y."""
        return self.depths[1] if level == "surface" and len(self.depths) == 2 else 0.0

    def density_step(self, level: str) -> float:
        """Density below a level less that above it."""
        upper = self.densities[1] if level == "interface" else 0.0
        return (self.densities[0] if level == self.floating else self.densities[-1]) - upper

    def touching(self, level: str) -> tuple[tuple[int, float], ...]:
        """Liquids that touch a level, with +1 for those that lie below it and −1 above."""
        if level == "interface":
            return ((0, 1.0), (1, -1.0))
        return ((len(self.depths) - 1, 1.0),)


def float_tank(scene: dict[str, Any]) -> FloatTank:
    """The tank of a scene's keys."""
    liquids, gravity = scene["liquid"], scene["tank"]["gravity"]
    densities = [liquid["density"] for liquid in liquids]
    bodies = scene.get("body", [])
    floats = []
    for body in bodies:
        if body["kind"] == "float":
            make = thin_section if body.get("boundary") == "thin" else section
            part = make(body, (densities[0], densities[1] if len(densities) == 2 else 0.0), gravity)
            floats.append((part, tuple(body.get("motions", ["heave"]))))
    beams = [
        BeamPlace(
            start=body["start"],
            end=body["start"] + body["length"],
            rigidity=body["flexural_rigidity"],
            mass=body["mass_per_length"],
            at=body.get("at", "interface" if len(liquids) == 2 else "surface"),
            restoring=body["hydrostatic"],
        )
        for body in bodies
        if body["kind"] == "beam"
    ]
    return FloatTank(
        length=scene["tank"]["length"],
        gravity=gravity,
        top=scene["tank"]["top"],
        densities=tuple(densities),
        depths=tuple(liquid["depth"] for liquid in liquids),
        sections=tuple(sorted(floats, key=lambda item: item[0].centre.real)),
        beams=tuple(sorted(beams, key=lambda beam: beam.start)),
    )


@dataclass(frozen=True, kw_only=True)
class Level:
    """Nodes of a level between floats.

    Attributes:
        boundary: nodes, with the normal upwards.
        beam: number of the beam at each node, −1 for none, shape (n,).
    """

    boundary: Boundary
    beam: np.ndarray


@dataclass(frozen=True, kw_only=True)
class Side:
    """A piece of a liquid's boundary: the hull of a float, a level (by their numbers), or rigid."""

    boundary: Boundary
    kind: Literal["hull", "level", "rigid"]
    number: int = 0
    sign: float = 1.0


@dataclass(frozen=True, kw_only=True)
class Liquid:
    """A liquid: its trial potentials, density, and all of its boundary but the side walls."""

    trial: Trial
    density: float
    sides: tuple[Side, ...]


def discretized(tank: FloatTank, fineness: Fineness) -> tuple[list[Level], list[Liquid]]:
    """Levels from below, and liquids from below."""
    trials = [_trial(tank, layer, fineness) for layer in range(len(tank.depths))]
    grid = _Grid(tank=tank, trials=tuple(trials), fineness=fineness)
    levels = [grid.level(name) for name in tank.levels]
    liquids = []
    for layer, trial in enumerate(trials):
        chains = [_chain(part, layer) for part, _ in tank.sections]
        sides = [Side(boundary=grid.nodes(chain, (layer,)), kind="hull", number=i) for i, chain in enumerate(chains)]
        for number, name in enumerate(tank.levels):
            for touching, sign in tank.touching(name):
                if touching == layer:
                    boundary = levels[number].boundary.turned(sign)
                    sides.append(Side(boundary=boundary, kind="level", number=number, sign=sign))
        rigid = [(trial.low, -1.0)] if layer == 0 else []
        rigid += [(trial.high, 1.0)] if layer == 1 and tank.top == "rigid" else []
        sides += [Side(boundary=grid.straight(0.0, tank.length, *end, (layer,)), kind="rigid") for end in rigid]
        liquids.append(Liquid(trial=trial, density=tank.densities[layer], sides=tuple(sides)))
    return levels, liquids


@dataclass(frozen=True, kw_only=True)
class _Grid:
    """Nodes on pieces of the boundary, fine enough for the trial functions of the liquids there."""

    tank: FloatTank
    trials: tuple[Trial, ...]
    fineness: Fineness

    def nodes(self, arcs: list[Arc], layers: tuple[int, ...]) -> Boundary:
        """Nodes on arcs with the liquid to their right."""
        near = np.concatenate([self.trials[layer].attractors for layer in layers])
        mirrored = np.concatenate([near, -near.conj(), 2 * self.tank.length - near.conj()])
        # Eight radians of the shortest wave, of which 16 Gauss nodes integrate products to rounding.
        longest = 8.0 * self.tank.length / (np.pi * self.fineness.waves)
        return nodes_on(arcs, mirrored, longest, reach=self.fineness.reach)

    def straight(self, start: Any, end: Any, height: float, up: float, layers: tuple[int, ...]) -> Boundary:
        """Nodes on a horizontal piece, with the normal upwards or downwards."""
        first, last = (np.clongdouble(x) + 1j * np.longdouble(height) for x in (start, end))
        return self.nodes([line(first, last)], layers).turned(up)

    def level(self, name: str) -> Level:
        """Nodes of a level."""
        layers = tuple(layer for layer, _ in self.tank.touching(name))
        parts, numbers = [], []
        for start, end, number in _pieces(self.tank, name):
            parts.append(self.straight(start, end, self.tank.height(name), 1.0, layers))
            numbers.append(np.full(len(parts[-1].points), number))
        return Level(boundary=Boundary.joined(parts), beam=np.concatenate(numbers))


def _pieces(tank: FloatTank, name: str) -> list[tuple[Any, Any, int]]:
    """Pieces of a level from left to right: start, end, number of the beam or −1."""
    floats = [(*part.ends, None) for part, _ in tank.sections] if name == tank.floating else []
    beams = [(beam.start, beam.end, number) for number, beam in enumerate(tank.beams) if beam.at == name]
    pieces: list[tuple[Any, Any, int]] = []
    place: Any = 0.0
    for start, end, number in sorted(floats + beams, key=lambda stop: float(stop[0])):
        if start - place > 1e-9 * tank.length:
            pieces.append((place, start, -1))
        if number is not None:
            pieces.append((start, end, number))
        place = end
    if tank.length - place > 1e-9 * tank.length:
        pieces.append((place, tank.length, -1))
    return [piece for piece in pieces if tank.top != "rigid" or name == "interface" or piece[2] >= 0]


def _chain(part: Section, layer: int) -> list[Arc]:
    return part.below if layer == 0 else part.above


def _trial(tank: FloatTank, layer: int, fineness: Fineness) -> Trial:
    thick = [part for part, _ in tank.sections if not part.thin]
    slits = [_chain(part, layer)[0] for part, _ in tank.sections if part.thin]
    corners = [corner for part in thick for corner in _section_corners(part, layer)]
    return Trial(
        length=tank.length,
        low=-tank.depths[0] if layer == 0 else 0.0,
        high=0.0 if layer == 0 else tank.depths[1],
        corners=(*corners, *_beam_corners(tank, layer)),
        slits=tuple(Slit(tip=arc.at(1.0), end=arc.at(0.0)) for arc in slits),
        inner=np.concatenate([np.zeros(0), *(part.inner(fineness.inner) for part in thick)]),
        clustered=fineness.corner,
        steepness=fineness.steepness,
        waves=fineness.waves,
        powers=fineness.powers,
        halves=fineness.halves,
    )


def _section_corners(part: Section, layer: int) -> list[Corner]:
    """Corners of a liquid at a float."""
    chain = _chain(part, layer)
    # Along the boundary the liquid lies to the right: the level is followed eastwards below it, westwards above it.
    along = 1.0 if layer == 0 else -1.0
    directions = [(along, chain[0].direction(0.0))]
    directions += [(before.direction(1.0), after.direction(0.0)) for before, after in pairwise(chain)]
    directions += [(chain[-1].direction(1.0), along)]
    places = [arc.at(0.0) for arc in chain] + [chain[-1].at(1.0)]
    corners = []
    for place, (before, after) in zip(places, directions, strict=True):
        turn = float(np.angle(complex(after / before)))
        if abs(turn) > 1e-8:
            outward = 1j * (before + after) / abs(before + after)
            room = _room(part, place, outward, layer)
            corners.append(Corner(place=place, outward=outward, room=room, exponent=np.pi / (np.pi + turn)))
    return corners


def _beam_corners(tank: FloatTank, layer: int) -> list[Corner]:
    """Ends of beams, where the boundary is straight and the flux is not smooth."""
    return [
        Corner(
            place=np.clongdouble(end) + 1j * np.longdouble(tank.height(beam.at)),
            outward=1j * sign,
            room=beam.end - beam.start,
            exponent=1.0,
        )
        for beam in tank.beams
        for touching, sign in tank.touching(beam.at)
        if touching == layer
        for end in (beam.start, beam.end)
    ]


def _room(part: Section, corner: complex, outward: complex, layer: int) -> float:
    """How far poles may go from a corner before they come into the liquid."""
    arcs = part.below + part.above
    outline = np.concatenate([arc.point(np.linspace(0, 1, 40, dtype=np.longdouble)[:-1]) for arc in arcs])
    distances = part.size * np.linspace(0.0103, 0.9987, 100)
    places = corner + distances * outward
    beyond = places.imag > 0 if layer == 0 else places.imag < 0
    out = np.flatnonzero(~(_inside(outline, places) | beyond))
    return float(0.7 * distances[out[0]]) if len(out) else float(distances[-1])


def _inside(outline: np.ndarray, places: np.ndarray) -> np.ndarray:
    """Whether places lie inside of a closed polygon."""
    ahead = np.roll(outline, -1)
    turns = np.angle(((ahead[:, None] - places) / (outline[:, None] - places)).astype(complex))
    return np.abs(turns.sum(axis=0)) > np.pi
