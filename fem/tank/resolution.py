"""Initial resolution of a tank and its refinement: degree, grading and number of dry modes."""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import ceil, log10
from typing import TYPE_CHECKING

from hydroelastic.fem.bodies.registry import body_model, toned_bodies
from hydroelastic.fem.closed.discretization import (
    FIRST_ROOT,
    SoughtModes,
    radians,
    shortest_wavenumber,
    sought_modes,
)
from hydroelastic.physics.local_waves import (
    moving_pieces,
    squared_frequency_of_mode,
)
from hydroelastic.physics.tank import Tank

if TYPE_CHECKING:
    from hydroelastic.physics.hulls import Hull

HIGHEST_DEGREE = 10
MOST_SHAPES = 400
# Below this radius, coordinates of a ring's nodes have fewer than three digits of their distance from the tip.
SMALLEST_TIP = 1e-13
# The tolerance over the rounding error, so that other errors have a part of it too.
_ROOM_FOR_ROUNDING = 5.0
# Number of modes per beam that contain its pressure-release tone: below it are rigid motions and modes of softer beams.
_MODES_OF_A_BEAM = 6
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
    highest = squared_frequency_of_mode(moving, sought.accurate) if moving else 0.0
    tolerance = workable_tolerance(tolerance, tank.depth)
    wavenumbers = tuple(
        shortest_wavenumber(tank, level, piece, highest) for level in tank.levels for piece in level.pieces
    )
    resolution = resolution_for(
        tank, tolerance, wavenumbers, exponent=sharpest_exponent(tank, infinite_frequency=False)
    )
    return of_modes(resolution, sought)


def of_modes(resolution: Resolution, sought: SoughtModes) -> Resolution:
    """Return the elements and dry modes of a resolution for the modes sought."""
    return replace(resolution, modes=sought.modes, reaches_tones=sought.reaches_tones, widened=False)


def infinite_frequency_resolution(tank: Tank, tolerance: float, tones: tuple[float, ...]) -> Resolution:
    """Return the resolution of the infinite-frequency limit: without waves beside the bodies, with sharper
    singularities."""
    expected = dict.fromkeys(tank.elastic, 0.0) | dict(zip(toned_bodies(tank), tones, strict=False))
    wavenumbers = tuple(
        max(FIRST_ROOT / piece.length, shortest_wavenumber(tank, level, piece, expected[piece.body]))
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
