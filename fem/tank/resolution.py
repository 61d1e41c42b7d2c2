"""Initial resolution of a tank and its refinement: degree, grading and number of dry modes."""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Callable
from dataclasses import dataclass, replace
from math import ceil, e, log10
from typing import TYPE_CHECKING

from hydroelastic.fem.bodies.registry import body_model, toned_bodies
from hydroelastic.physics.local_waves import (
    LevelPiece,
    modes_below,
    moving_parts,
    moving_pieces,
    squared_frequency_of_mode,
)
from hydroelastic.physics.tank import Piece, StillLevel, Tank

if TYPE_CHECKING:
    from hydroelastic.physics.hulls import Hull

HIGHEST_DEGREE = 10
MOST_SHAPES = 400
# Below this radius, coordinates of a ring's nodes have fewer than three digits of their distance from the tip.
SMALLEST_TIP = 1e-13
# The tolerance over the rounding error, so that other errors have a part of it too.
_ROOM_FOR_ROUNDING = 5.0
# κ₁ l of the first elastic dry mode.
_FIRST_ROOT = 4.73
# Number of modes per beam that contain its pressure-release tone: below it are rigid motions and modes of softer beams.
_MODES_OF_A_BEAM = 6
# Most modes below a first elastic tone that is sought; with more of them the tone is spread over many modes.
MOST_MODES_TO_TONE = 200
# Most modes below a float's motion, or twice the requested modes, for its mode to be sought.
MOST_MODES_TO_MOTION = 40
# Exponent α below which the radii of rings decrease more slowly.
_SHARP = 0.75
# α of a tank without singular points, on which nothing depends.
_SMOOTH = 2.0
# Largest element along a contour, in parts of a float's larger extent.
_OF_CONTOUR = 0.35


@dataclass(frozen=True, kw_only=True)
class Resolution:
    """Degree, sizes of elements and numbers of modes.

    Attributes:
        degree: polynomial degree of ψ.
        surface_sizes: largest element on each piece of the still levels, for a float along its contour; in tank
            lengths.
        bulk_size: largest element anywhere, in tank lengths.
        tip_size: radius of the innermost ring around the sharpest tips, in tank lengths; ``None`` without rings.
        ring_size: radius of the outermost ring, in tank lengths.
        ring_ratio: ratio of the radii of successive rings.
        shapes: number of dry modes of each beam, 0 for a float.
        modes: number of modes that are solved for.
        reaches_tones: whether the first elastic tone of each beam is expected among them.
        widened: whether modes were added because a tone was not found among the planned ones.
    """

    degree: int
    surface_sizes: tuple[float, ...]
    bulk_size: float
    tip_size: float | None
    shapes: tuple[int, ...]
    modes: int
    reaches_tones: tuple[bool, ...]
    ring_ratio: float = 0.3
    ring_size: float = 1.0
    widened: bool = False

    def with_degree(self, more: int) -> Resolution:
        """Return a higher degree on the same mesh."""
        return replace(self, degree=min(self.degree + more, HIGHEST_DEGREE))

    def with_smaller_elements(self) -> Resolution:
        """Return a finer mesh with more rings around the tips."""
        return replace(
            self,
            surface_sizes=tuple(0.6 * size for size in self.surface_sizes),
            bulk_size=0.6 * self.bulk_size,
            ring_ratio=self.ring_ratio**0.6,
        )

    def with_tips(self, factor: float) -> Resolution:
        """Return smaller innermost rings around the tips."""
        if self.tip_size is None:
            return self
        return replace(self, tip_size=max(factor * self.tip_size, SMALLEST_TIP))

    def with_shapes(self, factor: float) -> Resolution:
        """Return more dry modes."""
        return replace(self, shapes=tuple(min(MOST_SHAPES, ceil(factor * count)) for count in self.shapes))


def rounding_error(degree: int, depth: float) -> float:
    """Return the relative rounding error of a frequency in double precision, measured on tanks with known modes.

    It grows with the condition of the Laplace matrix: about like the fifth power of the degree, and in thin layers,
    where long waves hold little energy in each cell, like (L/H)^{3/2}.
    """
    return 3e-13 * (degree / 4.0) ** 5 * max(1.0, 0.1 / depth) ** 1.5


def workable_tolerance(tolerance: float, depth: float) -> float:
    """Return the requested relative tolerance, or the smallest one that double precision can be expected to keep."""
    return max(tolerance, _ROOM_FOR_ROUNDING * rounding_error(HIGHEST_DEGREE - 2, depth))


def initial_resolution(
    tank: Tank, tolerance: float, *, modes: int, tones: tuple[float, ...] = (), motions: tuple[float, ...] = ()
) -> Resolution:
    """Return the resolution for a number of modes, for elastic tones and for motions of floats.

    Elements are as long as their degree resolves the shortest wave to the tolerance; the innermost rings are as small
    as the singularity at the tips requires.
    """
    sought = sought_modes(tank, modes=modes, tones=tones, motions=motions)
    moving = moving_pieces(tank)
    highest = squared_frequency_of_mode(moving, sought.reported) if moving else 0.0
    tolerance = workable_tolerance(tolerance, tank.depth)
    wavenumbers = tuple(_wavenumber(tank, level, piece, highest) for level in tank.levels for piece in level.pieces)
    resolution = resolution_for(
        tank, tolerance, wavenumbers, exponent=sharpest_exponent(tank, infinite_frequency=False)
    )
    return sought.with_elements(resolution)


@dataclass(frozen=True, kw_only=True)
class SoughtModes:
    """The modes to solve for.

    Attributes:
        modes: their number.
        reported: number of those that must be accurate; the others, above, identify a tone.
        reaches_tones: whether the first elastic tone of each beam is expected among them.
    """

    modes: int
    reported: int
    reaches_tones: tuple[bool, ...]

    def with_elements(self, resolution: Resolution) -> Resolution:
        """Return the elements and dry modes of a resolution for these modes."""
        return replace(resolution, modes=self.modes, reaches_tones=self.reaches_tones, widened=False)


def sought_modes(tank: Tank, *, modes: int, tones: tuple[float, ...], motions: tuple[float, ...]) -> SoughtModes:
    """Return the modes to solve for, with the arguments of `initial_resolution`."""
    moving = moving_pieces(tank)
    # With too many modes below it, a tone or a float's motion is not sought unless more modes are requested.
    tone = _highest(tones, lambda value: _modes_to_tone(moving, value) <= MOST_MODES_TO_TONE)
    most_to_motion = max(MOST_MODES_TO_MOTION, 2 * modes)
    motion = _highest(motions, lambda value: _modes_to_motion(moving, value) <= most_to_motion)
    to_motion = [_modes_to_motion(moving, motion)] if motion is not None else []
    return SoughtModes(
        modes=max([modes, *([_modes_to_tone(moving, tone)] if tone is not None else []), *to_motion]),
        reported=max([modes, *([ceil(modes_below(moving, tone)) + 1] if tone is not None else []), *to_motion]),
        reaches_tones=tuple(tone is not None and other <= tone for other in tones),
    )


def _modes_to_tone(moving: tuple[LevelPiece, ...], tone: float) -> int:
    """Number of modes that contain a tone, and enough above it where participations decrease as on a resonance
    curve."""
    return ceil(1.25 * modes_below(moving, tone)) + 4


def _modes_to_motion(moving: tuple[LevelPiece, ...], motion: float) -> int:
    return ceil(modes_below(moving, motion)) + 2


def _highest(values: tuple[float, ...], reached: Callable[[float], bool]) -> float | None:
    """The highest value that is reached, by bisection: all below it are reached too."""
    ordered = sorted(values)
    count = bisect_left(ordered, True, key=lambda value: not reached(value))
    return ordered[count - 1] if count else None


def infinite_frequency_resolution(tank: Tank, tolerance: float, tones: tuple[float, ...]) -> Resolution:
    """Return the resolution of the infinite-frequency limit: without waves beside the bodies, with sharper
    singularities."""
    expected = dict.fromkeys(tank.elastic, 0.0) | dict(zip(toned_bodies(tank), tones, strict=False))
    wavenumbers = tuple(
        max(_FIRST_ROOT / piece.length, _wavenumber(tank, level, piece, expected[piece.body]))
        if piece.body in expected
        else 0.0
        for level in tank.levels
        for piece in level.pieces
    )
    exponent = sharpest_exponent(tank, infinite_frequency=True)
    resolution = resolution_for(tank, workable_tolerance(tolerance, tank.depth), wavenumbers, exponent=exponent)
    return replace(resolution, modes=_MODES_OF_A_BEAM * len(tones))


def sharpest_exponent(tank: Tank, *, infinite_frequency: bool) -> float:
    """Return the smallest α of ψ ~ r^α at a tip, a corner or a contact point."""
    if not tank.hulls:
        return 0.5 if infinite_frequency or tank.top == "pressure_release" else 1.0
    from hydroelastic.fem.closed.outline import unsized
    from hydroelastic.fem.tank.singularities import tank_singular_points

    points = tank_singular_points(tank, unsized(tank), half=False, infinite_frequency=infinite_frequency)
    return min((point.exponent for point in points), default=_SMOOTH)


def _wavenumber(tank: Tank, level: StillLevel, piece: Piece, squared_frequency: float) -> float:
    """Return the largest dimensionless wavenumber on a piece of a still level, up to λ."""
    waves = (moving.wavenumber(squared_frequency) for moving in moving_parts(tank, level, piece))
    return max(waves, default=0.0)


def resolution_for(tank: Tank, tolerance: float, wavenumbers: tuple[float, ...], *, exponent: float) -> Resolution:
    """Return elements, rings and dry modes for the shortest waves on the pieces of the still levels.

    Where ψ ~ r^α at a tip, the error falls like the radius of the innermost ring to the power 2α: like its square
    beside a free surface or a lid, ψ ~ r ln r, like the radius itself beside a surface with ψ = 0, ψ ~ r^{1/2}.
    """
    # Measured on tanks with known modes: the cheapest degree for each tolerance.
    degree = ceil(1.5 - 0.75 * log10(tolerance))
    degree = min(max(degree, 4), HIGHEST_DEGREE - 1)
    # In thin layers the rounding of a high degree exceeds its gain.
    while degree > 6 and rounding_error(degree, tank.depth) > 0.3 * tolerance:
        degree -= 1
    sizes = tuple(
        _contour_size(tank.hulls[piece.body])
        if piece.body in tank.hulls
        # Never fewer than two elements on a piece.
        else min(radians(degree, tolerance) / max(wavenumber, 1e-9), 0.5 * piece.length, 0.25)
        for piece, wavenumber in zip(tank.pieces, wavenumbers, strict=True)
    )
    on_bodies = {piece.body: wavenumber for piece, wavenumber in zip(tank.pieces, wavenumbers, strict=True)}
    shapes = tuple(
        min(MOST_SHAPES, body_model(tank, index).dry_mode_count(on_bodies[index], tolerance))
        for index in range(len(tank.bodies))
    )
    shortest = min((piece.length for piece in tank.pieces if piece.body not in tank.hulls), default=1.0)
    outermost = min(0.45 * shortest, 0.45 * tank.depth, *sizes)
    return Resolution(
        degree=degree,
        surface_sizes=sizes,
        bulk_size=0.5 * max(1.0, *(layer.depth for layer in tank.layers)),
        tip_size=max(outermost * _innermost(exponent, tolerance), SMALLEST_TIP),
        ring_size=outermost,
        shapes=shapes,
        modes=0,
        reaches_tones=(),
        ring_ratio=0.4 if exponent < _SHARP else 0.3,
    )


def _innermost(exponent: float, tolerance: float) -> float:
    """Radius of the innermost ring over that of the outermost; measured at tips of beams with α = 1 and 1/2."""
    return min((5.0 + 10.0 * exponent) * float(tolerance ** (0.5 / exponent)), 0.25)


def _contour_size(hull: Hull) -> float:
    """Largest element along a contour, in tank lengths; where it is curved, the mesh takes smaller ones."""
    left, right, low, high = hull.bounds
    return min(_OF_CONTOUR * max(right - left, high - low), 0.25)


def radians(degree: int, tolerance: float) -> float:
    """Return the size kh of elements, in radians of a wave, for which the error (e kh/(4p))^{2p} keeps the
    tolerance."""
    return 4.0 / e * degree * float((0.1 * tolerance) ** (0.5 / degree))
