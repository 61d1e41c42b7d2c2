"""How a section is discretized for a tolerance: before the first solution, and after each estimate of its errors."""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from math import ceil, e, log10, pi

from hydroelastic.fem.core.bodies import dry_mode_count
from hydroelastic.modal.beam.beam_shapes import first_bending
from hydroelastic.physics.dofs import PLACES
from hydroelastic.physics.floats import RigidFloat
from hydroelastic.physics.local_waves import (
    LevelPiece,
    modes_below,
    moving_parts,
    moving_pieces,
    squared_frequency_of_mode,
)
from hydroelastic.physics.tank import Piece, StillLevel, Tank

LOWEST_DEGREE, HIGHEST_DEGREE = 4, 10
MOST_SHAPES = 400
MOST_MODES_TO_TONE = 200
"""Most modes below a first elastic tone that is sought; with more of them it is spread over many modes."""
FAR_ENOUGH = 1.5
"""Limit of λ to which the mode of a float's motion is sought, as a multiple of its λ at infinite frequency."""

# Most modes below a float's motion, or twice the requested modes, for its mode to be sought.
_MOST_MODES_TO_MOTION = 40
# κ₁ l of the first elastic dry mode.
FIRST_ROOT = 4.73
# Added mass per ρ l of dry mode 1 and of heave, and between them, on deep open water with ψ = 0 beside the beam.
_DEEP_ELASTIC, _DEEP_HEAVE, _DEEP_COUPLING = 0.12787, 0.39270, 0.114
# Added mass of a float's heave in ρ times the square of its waterplane's width: that of any half-immersed ellipse.
_ADDED_IN_HEAVE = pi / 8.0
# Causes smaller than this part of the tolerance are not refined.
_NEGLIGIBLE = 0.3
# By which sizes of cells are refined at the highest degree.
_FINER = 0.65

CAUSES = ("liquid", "dry_modes", "geometry", "rounding")
"""Causes of the errors of a section."""


@dataclass(frozen=True, kw_only=True)
class Discretization:
    """What the loop refines."""

    degree: int  # of ψ
    # largest cells on each piece of the still levels, along a float's contour; in tank lengths
    sizes: tuple[float, ...]
    bulk: float  # largest cells anywhere
    near: float  # size of cells at singular points, in parts of the distance to the next corner
    geometry_degree: int  # of curved cells
    dry_modes: tuple[int, ...]  # number of those of each beam, 0 for floats

    @property
    def triangles(self) -> tuple[object, ...]:
        return self.sizes, self.bulk, self.near

    def refined(self, causes: Mapping[str, float]) -> Discretization | None:
        found = self
        if causes["dry_modes"] > _NEGLIGIBLE:
            factor = min(max(1.3, (2.0 * causes["dry_modes"]) ** (1.0 / 6.0)), 2.0)
            found = replace(found, dry_modes=tuple(min(MOST_SHAPES, ceil(factor * count)) for count in found.dry_modes))
        if causes["geometry"] > _NEGLIGIBLE and found.geometry_degree < HIGHEST_DEGREE:
            found = replace(found, geometry_degree=found.geometry_degree + 2)
        if causes["liquid"] > _NEGLIGIBLE:
            # One degree gains about a factor of ten.
            more = 1 if causes["liquid"] < 8.0 else 2
            if found.degree + more > HIGHEST_DEGREE:
                found = replace(
                    found,
                    degree=max(HIGHEST_DEGREE - 1, found.degree),
                    sizes=tuple(_FINER * size for size in found.sizes),
                    bulk=_FINER * found.bulk,
                    near=_FINER * found.near,
                )
            else:
                found = replace(found, degree=found.degree + more)
        return None if found == self else found


@dataclass(frozen=True, kw_only=True)
class SoughtModes:
    modes: int  # their number
    accurate: int  # number of those that must be accurate; the others, above, identify a tone
    reaches_tones: tuple[bool, ...]  # of each beam, whether its first elastic tone is expected among them


def sought_modes(
    tank: Tank, *, modes: int, tones: tuple[float, ...] = (), motions: tuple[float, ...] = ()
) -> SoughtModes:
    """The modes asked for, and those up to the first elastic tones and the motions of floats, both by their λ."""
    moving = moving_pieces(tank)
    # With too many modes below it, a tone or a float's motion is not sought unless more modes are requested.
    tone = _highest(tones, lambda value: _modes_to_tone(moving, value) <= MOST_MODES_TO_TONE)
    most = max(_MOST_MODES_TO_MOTION, 2 * modes)
    motion = _highest(motions, lambda value: ceil(modes_below(moving, value)) + 2 <= most)
    to_motion = [ceil(modes_below(moving, motion)) + 2] if motion is not None else []
    return SoughtModes(
        modes=max([modes, *([_modes_to_tone(moving, tone)] if tone is not None else []), *to_motion]),
        accurate=max([modes, *([ceil(modes_below(moving, tone)) + 1] if tone is not None else []), *to_motion]),
        reaches_tones=tuple(tone is not None and other <= tone for other in tones),
    )


def _modes_to_tone(moving: tuple[LevelPiece, ...], tone: float) -> int:
    """Modes that contain a tone, and enough above it where participations decrease as on a resonance curve."""
    return ceil(1.25 * modes_below(moving, tone)) + 4


def _highest(values: tuple[float, ...], reached: Callable[[float], bool]) -> float | None:
    """The highest value that is reached, by bisection: all below it are reached too."""
    ordered = sorted(values)
    count = bisect_left(ordered, True, key=lambda value: not reached(value))
    return ordered[count - 1] if count else None


def expected_tone(tank: Tank, index: int) -> float:
    """λ of dry mode 1 of a beam coupled with heave, on deep open liquids with ψ = 0 beside it."""
    beam, level = tank.beams[index], tank.level_of(index)
    liquid = beam.length * tank.density_at(level)
    elastic = beam.mass_per_length + _DEEP_ELASTIC * liquid
    heave = beam.mass_per_length + _DEEP_HEAVE * liquid
    inertia = elastic - (_DEEP_COUPLING * liquid) ** 2 / heave
    return (first_bending(beam) + float(beam.hydrostatic) * level.jump) / inertia


def ends_of_motions(tank: Tank, index: int) -> tuple[float, ...]:
    """λ up to which the mode of each restored motion of a float is sought."""
    body, level = tank.bodies[index], tank.level_of(index)
    assert isinstance(body, RigidFloat)
    width = body.hydrostatics.heave_stiffness / level.jump
    ends = []
    for motion in body.motions:
        place = PLACES[motion]
        if body.stiffness[place, place] > 0.0:
            added = _ADDED_IN_HEAVE * tank.density_at(level) * width**2 if motion == "heave" else 0.0
            ends.append(FAR_ENOUGH * float(body.stiffness[place, place] / (body.inertia[place] + added)))
    return tuple(ends)


def discretization_of_modes(tank: Tank, tolerance: float, sought: SoughtModes) -> Discretization:
    """Cells that resolve the shortest wave of the modes, and dry modes up to it with a tail."""
    moving = moving_pieces(tank)
    highest = squared_frequency_of_mode(moving, sought.accurate) if moving else 0.0
    return _discretization(
        tank,
        tolerance,
        [shortest_wavenumber(tank, level, piece, highest) for level in tank.levels for piece in level.pieces],
    )


def discretization_of_limit(tank: Tank, tolerance: float) -> Discretization:
    """Of the limit of infinite frequency: no waves beside the bodies, and sharper singular points."""
    found = _discretization(
        tank,
        tolerance,
        [
            max(FIRST_ROOT / piece.length, shortest_wavenumber(tank, level, piece, expected_tone(tank, piece.body)))
            if piece.body in tank.elastic
            else 0.0
            for level in tank.levels
            for piece in level.pieces
        ],
    )
    return found


def shortest_wavenumber(tank: Tank, level: StillLevel, piece: Piece, squared_frequency: float) -> float:
    return max((part.wavenumber(squared_frequency) for part in moving_parts(tank, level, piece)), default=0.0)


def radians(degree: int, tolerance: float) -> float:
    """Size kh of cells, in radians of a wave, for which the error (e kh/(4p))^{2p} keeps a tolerance."""
    return 4.0 / e * degree * float((0.1 * tolerance) ** (0.5 / degree))


def rounding_error(degree: int, depth: float) -> float:
    """Relative rounding of a frequency in double precision, measured on tanks with known modes.

    It grows with the condition of A, and in thin layers, where long waves hold little energy in each cell, like
    (L/H)^{3/2}.
    """
    return 3e-14 * (degree / 4.0) ** 3 * max(1.0, 0.1 / depth) ** 1.5


def _discretization(tank: Tank, tolerance: float, wavenumbers: list[float]) -> Discretization:
    degree = min(max(ceil(2.0 - 0.75 * log10(tolerance)), LOWEST_DEGREE + 1), HIGHEST_DEGREE - 1)
    sizes = tuple(
        _contour_size(tank, piece.body)
        if piece.body in tank.hulls
        else min(0.8 * radians(degree, tolerance) / max(wavenumber, 1e-9), 0.5 * piece.length, 0.2)
        for piece, wavenumber in zip(tank.pieces, wavenumbers, strict=True)
    )
    of_bodies = {piece.body: wavenumber for piece, wavenumber in zip(tank.pieces, wavenumbers, strict=True)}
    return Discretization(
        degree=degree,
        sizes=sizes,
        bulk=0.25 * max(1.0, *(layer.depth for layer in tank.layers)),
        near=0.12,
        geometry_degree=6,
        dry_modes=tuple(
            min(MOST_SHAPES, dry_mode_count(body, of_bodies[index], tolerance)) if body is not None else 0
            for index, body in ((index, tank.beams.get(index)) for index in range(len(tank.bodies)))
        ),
    )


def _contour_size(tank: Tank, body: int) -> float:
    left, right, low, high = tank.hulls[body].bounds
    return min(0.5 * max(right - left, high - low), 0.25)
