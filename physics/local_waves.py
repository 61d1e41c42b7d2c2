"""Wavenumbers and mode counts from the local dispersion relation.

In a piece of a still level of length s, waves of wavenumber k(ω) fit about k s/π times. Summed over the pieces this
counts the modes below ω well enough to choose a mesh; the a-posteriori estimate then judges the choice.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import lru_cache, partial
from math import exp, log, pi, tanh

from hydroelastic.physics.beam_parts import Section
from hydroelastic.physics.tank import Piece, StillLevel, Tank

# Bounds of dimensionless wavenumbers: waves longer than a million tank lengths are left out.
_LEAST, _LARGEST = 1e-6, 1e12
_TINY = 1e-300


@dataclass(frozen=True, kw_only=True)
class LevelPiece:
    """A piece of a still level that moves, in units of the tank."""

    length: float
    beam: Section | None  # the section of a beam that floats there; ``None`` is a surface of the liquids
    jump: float  # ρ below less ρ above it, the hydrostatic restoring
    restored: bool  # whether the hydrostatic restoring acts on the beam too
    layers: tuple[tuple[float, float], ...]  # density and depth of each adjoining layer

    @property
    def dispersion(self) -> tuple[object, ...]:
        """All but the length."""
        return self.beam, self.jump, self.restored, self.layers

    def squared_frequency(self, wavenumber: float) -> float:
        """λ of a wave: (EI k⁴ + Δρ)/(m + Σ ρⱼ/(k tanh khⱼ)), the beam's terms where there is one, and T k²."""
        liquid = 0.0
        # A search asks hundreds of times, and the sum of a generator takes twice as long.
        for density, depth in self.layers:
            liquid += density / (wavenumber * tanh(wavenumber * depth))
        if self.beam is None:
            return self.jump / liquid
        stiffness = self.beam.stiffness(wavenumber) + float(self.restored) * self.jump
        return stiffness / (self.beam.mass_per_length + liquid)

    def wavenumber(self, squared_frequency: float) -> float:
        """The wavenumber k at λ, to 1e-9 of it; zero where even the longest wave has a larger λ."""
        if self.squared_frequency(_LEAST) >= squared_frequency:
            return 0.0
        return _where_reached(self.squared_frequency, squared_frequency, (_LEAST, _LARGEST), 1e-9)


def moving_pieces(tank: Tank) -> tuple[LevelPiece, ...]:
    """The pieces of the still levels that carry waves, those of one dispersion as one of their total length."""
    alike: dict[object, LevelPiece] = {}
    for level in tank.levels:
        for moving in (part for piece in level.pieces for part in moving_parts(tank, level, piece)):
            kind = moving.dispersion
            alike[kind] = replace(moving, length=alike[kind].length + moving.length) if kind in alike else moving
    return tuple(alike.values())


def moving_parts(tank: Tank, level: StillLevel, piece: Piece) -> tuple[LevelPiece, ...]:
    """The parts of a piece of a level that carry waves, one for each section of a beam; empty where there are none."""
    layers = _layers_at(tank, level)
    if piece.body is not None:
        body = tank.bodies[piece.body]
        return tuple(
            LevelPiece(length=part.length, beam=part, jump=level.jump, restored=body.is_restored, layers=layers)
            for part in body.flexural_sections
        )
    if not level.moves:
        return ()
    return (LevelPiece(length=piece.length, beam=None, jump=level.jump, restored=True, layers=layers),)


def _layers_at(tank: Tank, level: StillLevel) -> tuple[tuple[float, float], ...]:
    """Density and depth of the layers at a level; at a free surface above two layers these count as one."""
    if level.above is None:
        return ((tank.layers[-1].density, sum(layer.depth for layer in tank.layers)),)
    return tuple((tank.layers[number].density, tank.layers[number].depth) for number in (level.below, level.above))


@lru_cache(maxsize=16)
def modes_below(pieces: tuple[LevelPiece, ...], squared_frequency: float) -> float:
    """Approximate number of modes below λ."""
    return _mode_count(pieces, squared_frequency)


def _mode_count(pieces: tuple[LevelPiece, ...], squared_frequency: float) -> float:
    return sum(piece.wavenumber(squared_frequency) * piece.length / pi for piece in pieces)


@lru_cache(maxsize=16)
def squared_frequency_of_mode(pieces: tuple[LevelPiece, ...], number: int) -> float:
    """Approximate λ of a mode, counted from 1; an overestimate by about one mode."""
    # End effects shift modes upwards.
    return _where_reached(partial(_mode_count, pieces), number + 1.0, (1e-30, 1e60), 1e-6)


def _where_reached(rising: Callable[[float], float], wanted: float, bounds: tuple[float, float], step: float) -> float:
    """The first value of a geometric sequence with steps e^step between bounds where a rising function has reached
    what is wanted; the upper bound where it has not."""
    low, high = bounds

    def excess(number: int) -> float:
        return log(max(rising(low * exp(step * number)), _TINY) / wanted)

    below, above = 0, round(log(high / low) / step)
    first, last, side = excess(below), excess(above), 0
    if first >= 0.0 or last < 0.0:
        return low if first >= 0.0 else high
    # The rule of false position on logarithmic scales, in which functions are nearly straight; an end that stays twice
    # counts half (Illinois).
    while above - below > 1:
        between = below + round((above - below) * first / (first - last))
        number = min(max(between, below + 1), above - 1)
        value = excess(number)
        if value < 0.0:
            below, first, last, side = number, value, last * (0.5 if side < 0 else 1.0), -1
        else:
            above, last, first, side = number, value, first * (0.5 if side > 0 else 1.0), 1
    return low * exp(step * above)
