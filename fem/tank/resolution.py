"""What resolution a scene starts from, and how it is refined: degree, grading and number of dry modes."""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Callable
from dataclasses import dataclass, replace
from math import ceil, e, log10
from typing import TYPE_CHECKING

from hydroelastic.fem.bodies.registry import body_model
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
# Below this the coordinates of a ring's nodes keep fewer than three digits of their distance from the tip.
SMALLEST_TIP = 1e-13
# Every cause of error has a part of the tolerance, rounding too.
_ROOM_FOR_ROUNDING = 5.0
# κ₁ l of the first elastic dry mode.
_FIRST_ROOT = 4.73
# Below the pressure-release tone of a beam lie at most its rigid motions, and with several beams modes of softer ones.
_MODES_OF_A_BEAM = 6
# More modes than this below the first elastic tone are not searched: the tone has then no individual meaning.
MOST_MODES_TO_TONE = 200
# More than this below a float's motion, or than twice the modes asked for, are not looked at to find its mode.
MOST_MODES_TO_MOTION = 40
# Tips with a smaller α get rings that shrink more slowly.
_SHARP = 0.75
# α of a scene without singular points: nothing depends on it.
_SMOOTH = 2.0
# Elements along a contour, in parts of a float's larger extent.
_OF_CONTOUR = 0.35


@dataclass(frozen=True, kw_only=True)
class Resolution:
    """How finely a scene is resolved.

    Attributes:
        degree: polynomial degree of ψ.
        surface_sizes: largest element on each piece of the still levels, on that of a float along its contour; in tank
            lengths.
        bulk_size: largest element anywhere.
        tip_size: innermost ring around the sharpest tips; ``None`` on a mesh that is not graded by rings.
        ring_size: outermost ring that goes with it.
        ring_ratio: ratio of the radii of successive rings.
        shapes: number of dry modes of each beam, 0 for a float.
        modes: how many modes are solved for.
        reaches_tones: whether the first elastic tone of each beam is expected among them.
        widened: whether modes were added because the tone was not found among those first planned.
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
        """A higher degree on the same mesh."""
        return replace(self, degree=min(self.degree + more, HIGHEST_DEGREE))

    def with_smaller_elements(self) -> Resolution:
        """A finer mesh, and more rings around the tips."""
        return replace(
            self,
            surface_sizes=tuple(0.6 * size for size in self.surface_sizes),
            bulk_size=0.6 * self.bulk_size,
            ring_ratio=self.ring_ratio**0.6,
        )

    def with_tips(self, factor: float) -> Resolution:
        """Smaller rings around the tips."""
        if self.tip_size is None:
            return self
        return replace(self, tip_size=max(factor * self.tip_size, SMALLEST_TIP))

    def with_shapes(self, factor: float) -> Resolution:
        """More dry modes."""
        return replace(self, shapes=tuple(min(MOST_SHAPES, ceil(factor * count)) for count in self.shapes))


def rounding_error(degree: int, depth: float) -> float:
    """What double precision leaves of a frequency, relative; measured on tanks with known modes.

    It grows with the condition of the Laplace matrix: about like the fifth power of the degree, and in thin layers,
    where long waves hold little energy in each cell, like (L/H)^{3/2}.
    """
    return 3e-13 * (degree / 4.0) ** 5 * max(1.0, 0.1 / depth) ** 1.5


def workable_tolerance(tolerance: float, depth: float) -> float:
    """The tolerance to work towards: what is asked, or what double precision can be expected to keep."""
    return max(tolerance, _ROOM_FOR_ROUNDING * rounding_error(HIGHEST_DEGREE - 2, depth))


def initial_resolution(
    tank: Tank, tolerance: float, *, modes: int, tones: tuple[float, ...] = (), motions: tuple[float, ...] = ()
) -> Resolution:
    """Resolution for a number of modes, for elastic tones and for motions of floats.

    Elements hold as many radians of the shortest wave as their degree resolves to the tolerance; rings reach as far
    into the tips as the singularity there asks for.

    Args:
        tank: of unit length.
        tolerance: asked relative error.
        modes: how many are asked for.
        tones: about the (dimensionless) λ of the first elastic tone of each beam.
        motions: up to which λ modes are looked at to find those of each motion of a float.
    """
    moving = moving_pieces(tank)
    # Where other waves are many below a tone or a float's motion it is not searched for: one may ask for more modes.
    tone = _highest(tones, lambda value: _modes_to_tone(moving, value) <= MOST_MODES_TO_TONE)
    most_to_motion = max(MOST_MODES_TO_MOTION, 2 * modes)
    motion = _highest(motions, lambda value: _modes_to_motion(moving, value) <= most_to_motion)
    to_motion = [_modes_to_motion(moving, motion)] if motion is not None else []
    # The modes above the highest one reported show where the tone is, but need not be accurate.
    reported = max([modes, *([ceil(modes_below(moving, tone)) + 1] if tone is not None else []), *to_motion])
    modes = max([modes, *([_modes_to_tone(moving, tone)] if tone is not None else []), *to_motion])
    reaches_tones = tuple(tone is not None and other <= tone for other in tones)
    highest = squared_frequency_of_mode(moving, reported) if moving else 0.0
    tolerance = workable_tolerance(tolerance, tank.depth)
    wavenumbers = tuple(_wavenumber(tank, level, piece, highest) for level in tank.levels for piece in level.pieces)
    resolution = resolution_for(
        tank, tolerance, wavenumbers, exponent=sharpest_exponent(tank, infinite_frequency=False)
    )
    return replace(resolution, modes=modes, reaches_tones=reaches_tones)


def _modes_to_tone(moving: tuple[LevelPiece, ...], tone: float) -> int:
    """Enough above a tone to hold its flank: the part in each mode falls off like a resonance curve."""
    return ceil(1.25 * modes_below(moving, tone)) + 4


def _modes_to_motion(moving: tuple[LevelPiece, ...], motion: float) -> int:
    return ceil(modes_below(moving, motion)) + 2


def _highest(values: tuple[float, ...], reached: Callable[[float], bool]) -> float | None:
    """The highest value that is reached, as all below it are: a few of many values are tried."""
    ordered = sorted(values)
    count = bisect_left(ordered, True, key=lambda value: not reached(value))
    return ordered[count - 1] if count else None


def infinite_frequency_resolution(tank: Tank, tolerance: float, tones: tuple[float, ...]) -> Resolution:
    """Resolution of the infinite-frequency limit: no waves beside the bodies, but sharper tips.

    Args:
        tank: the scene.
        tolerance: asked relative error.
        tones: about the (dimensionless) λ of the first elastic tone of each beam.
    """
    expected = dict(zip(tank.elastic, tones, strict=True))
    wavenumbers = tuple(
        max(_FIRST_ROOT / piece.length, _wavenumber(tank, level, piece, expected[piece.body]))
        if piece.body in expected
        else 0.0
        for level in tank.levels
        for piece in level.pieces
    )
    exponent = sharpest_exponent(tank, infinite_frequency=True)
    resolution = resolution_for(tank, workable_tolerance(tolerance, tank.depth), wavenumbers, exponent=exponent)
    return replace(resolution, modes=_MODES_OF_A_BEAM * len(tank.elastic))


def sharpest_exponent(tank: Tank, *, infinite_frequency: bool) -> float:
    """The smallest α with which ψ ~ r^α at a tip, a corner or a contact point.

    Args:
        tank: the scene.
        infinite_frequency: whether gravity is left out: ψ = 0 on the top, and liquids move as one.
    """
    if not tank.hulls:
        return 0.5 if infinite_frequency or tank.top == "pressure_release" else 1.0
    from hydroelastic.fem.tank.outline import unsized
    from hydroelastic.fem.tank.singularities import tank_singular_points

    points = tank_singular_points(tank, unsized(tank), half=False, infinite_frequency=infinite_frequency)
    return min((point.exponent for point in points), default=_SMOOTH)


def _wavenumber(tank: Tank, level: StillLevel, piece: Piece, squared_frequency: float) -> float:
    """The shortest wave on a piece of a still level, up to λ."""
    waves = (moving.wavenumber(squared_frequency) for moving in moving_parts(tank, level, piece))
    return max(waves, default=0.0)


def resolution_for(tank: Tank, tolerance: float, wavenumbers: tuple[float, ...], *, exponent: float) -> Resolution:
    """Elements, rings and dry modes for the shortest waves on the pieces of the still levels.

    Where ψ ~ r^α at a tip, the error falls like the power 2α of the innermost ring: like its square beside water under
    gravity or a lid, ψ ~ r ln r, like the ring itself beside a surface with ψ = 0, ψ ~ r^{1/2}.
    """
    # Measured on tanks with known modes: the cheapest degree for each tolerance.
    degree = ceil(1.5 - 0.75 * log10(tolerance))
    degree = min(max(degree, 4), HIGHEST_DEGREE - 1)
    # In thin layers rounding takes more than a high degree gives.
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
    """The innermost ring in parts of the outermost one; measured at beams' tips, with α = 1 and 1/2."""
    return min((5.0 + 10.0 * exponent) * float(tolerance ** (0.5 / exponent)), 0.25)


def _contour_size(hull: Hull) -> float:
    """Largest element along a contour; where it bends, the mesh takes smaller ones."""
    left, right, low, high = hull.bounds
    return min(_OF_CONTOUR * max(right - left, high - low), 0.25)


def radians(degree: int, tolerance: float) -> float:
    """How much of a wave one element resolves: the error of polynomials on it is about (e kh/(4p))^{2p}."""
    return 4.0 / e * degree * float((0.1 * tolerance) ** (0.5 / degree))
