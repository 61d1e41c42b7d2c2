"""What resolution a scene starts from, and how it is refined: degree, grading and number of dry modes."""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import ceil, e, log10, pi

from hydroelastic.scenes.models import Beam, TankScene, top_segments
from hydroelastic.scenes.scaling import scaled_beam, scales
from hydroelastic.scenes.waves import TopPiece, modes_below, squared_frequency_of_mode

HIGHEST_DEGREE = 10
MOST_SHAPES = 400
# Below this the coordinates of a ring's nodes keep fewer than three digits of their distance from the tip.
SMALLEST_TIP = 1e-13
# Every cause of error has a part of the tolerance, rounding too.
_ROOM_FOR_ROUNDING = 5.0
# Dry modes beyond the shortest wave, in units of its half waves and of tolerance^(-1/7).
_TAIL = 0.45
# κ₁ l of the first elastic dry mode.
_FIRST_ROOT = 4.73
# Below the pressure-release tone of a beam lie at most its rigid motions, and with several beams modes of softer ones.
_COMPANION_MODES = 6
# More modes than this below the first elastic tone are not searched: the tone has then no individual meaning.
MOST_MODES_TO_TONE = 200


@dataclass(frozen=True, kw_only=True)
class ScaledTank:
    """A scene in units of the tank.

    Attributes:
        depth: H/L.
        top: what the top is beside the bodies.
        beams: dimensionless beams in the scene's order.
        pieces: segments of the top from left to right: start, end and the beam's index in the scene, or ``None``.
    """

    depth: float
    top: str
    beams: tuple[Beam, ...]
    pieces: tuple[tuple[float, float, int | None], ...]

    @property
    def moving(self) -> tuple[TopPiece, ...]:
        """The pieces on which waves travel."""
        pieces = []
        for start, end, body in self.pieces:
            if body is not None:
                pieces.append(TopPiece(length=end - start, beam=self.beams[body]))
            elif self.top == "free":
                pieces.append(TopPiece(length=end - start, beam=None))
        return tuple(pieces)


def scaled_tank(scene: TankScene) -> ScaledTank:
    """The scene in units of the tank."""
    units = scales(scene)
    pieces = tuple(
        (
            segment.start / units.length,
            1.0 if segment.end == scene.tank.length else segment.end / units.length,
            segment.body,
        )
        for segment in top_segments(scene)
    )
    place = {body: (start, end) for start, end, body in pieces if body is not None}
    return ScaledTank(
        depth=scene.liquid[0].depth / units.length,
        top=scene.tank.top,
        beams=tuple(scaled_beam(beam, units, *place[index]) for index, beam in enumerate(scene.body)),
        pieces=pieces,
    )


@dataclass(frozen=True, kw_only=True)
class Resolution:
    """How finely a scene is resolved.

    Attributes:
        degree: polynomial degree of ψ.
        surface_sizes: largest element on each piece of the top, in tank lengths.
        bulk_size: largest element anywhere.
        tip_size: innermost ring around the tips; ``None`` on a mesh that is not graded by rings.
        ring_ratio: ratio of the radii of successive rings.
        shapes: number of dry modes of each beam.
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


def initial_resolution(scene: TankScene, *, modes: int, tones: tuple[float, ...] = ()) -> Resolution:
    """Resolution for a number of modes, and for the elastic tones expected at (dimensionless) λ.

    Elements hold as many radians of the shortest wave as their degree resolves to the tolerance; rings reach as far
    into the tips as the singularity there asks for.
    """
    tank = scaled_tank(scene)
    below = [modes_below(tank.moving, tank.depth, tone) for tone in tones]
    # Enough above each tone to hold its flank: the part in each mode falls off like a resonance curve.
    expected = [ceil(1.25 * count) + 4 for count in below]
    reaches_tones = tuple(count <= MOST_MODES_TO_TONE for count in expected)
    # The modes above the highest one reported show where the tone is, but need not be accurate.
    reported = max([modes, *(ceil(count) + 1 for count, reached in zip(below, reaches_tones, strict=True) if reached)])
    modes = max([modes, *(count for count, reached in zip(expected, reaches_tones, strict=True) if reached)])
    highest = squared_frequency_of_mode(tank.moving, tank.depth, reported)
    tolerance = workable_tolerance(scene.accuracy.tolerance, tank.depth)
    wavenumbers = tuple(_wavenumber(tank, piece, highest) for piece in tank.pieces)
    resolution = _resolution_for(tank, tolerance, wavenumbers, sharp=tank.top == "pressure_release")
    return replace(resolution, modes=modes, reaches_tones=reaches_tones)


def companion_resolution(tank: ScaledTank, tolerance: float, tones: tuple[float, ...]) -> Resolution:
    """Resolution for the first elastic tones with ψ = 0 on the water: no waves beside the beams, but sharper tips.

    Args:
        tank: the scene.
        tolerance: asked relative error of the tones.
        tones: about the (dimensionless) λ of each.
    """
    wavenumbers = tuple(
        0.0 if piece[2] is None else max(_FIRST_ROOT / (piece[1] - piece[0]), _wavenumber(tank, piece, tones[piece[2]]))
        for piece in tank.pieces
    )
    resolution = _resolution_for(tank, workable_tolerance(tolerance, tank.depth), wavenumbers, sharp=True)
    return replace(resolution, modes=_COMPANION_MODES * len(tank.beams))


def _wavenumber(tank: ScaledTank, piece: tuple[float, float, int | None], squared_frequency: float) -> float:
    """The shortest wave on a piece of the top, up to λ."""
    start, end, body = piece
    if body is None and tank.top != "free":
        return 0.0
    beam = None if body is None else tank.beams[body]
    return TopPiece(length=end - start, beam=beam).wavenumber(squared_frequency, tank.depth)


def _resolution_for(tank: ScaledTank, tolerance: float, wavenumbers: tuple[float, ...], *, sharp: bool) -> Resolution:
    """Elements, rings and dry modes for the shortest waves on the pieces of the top.

    Beside water under gravity or a lid ψ ~ r ln r at a tip, and the error falls like the square of the innermost ring.
    Beside a surface with ψ = 0 it is ``sharp``: ψ ~ r^{1/2}, and the error falls like the ring itself.
    """
    # Measured on tanks with known modes: the cheapest degree for each tolerance.
    degree = ceil(1.5 - 0.75 * log10(tolerance))
    degree = min(max(degree, 4), HIGHEST_DEGREE - 1)
    # In thin layers rounding takes more than a high degree gives.
    while degree > 6 and rounding_error(degree, tank.depth) > 0.3 * tolerance:
        degree -= 1
    # Never fewer than two elements on a piece.
    sizes = tuple(
        min(_radians(degree, tolerance) / max(wavenumber, 1e-9), 0.5 * (end - start), 0.25)
        for (start, end, _), wavenumber in zip(tank.pieces, wavenumbers, strict=True)
    )
    on_beams = {body: wavenumber for (_, _, body), wavenumber in zip(tank.pieces, wavenumbers, strict=True)}
    shapes = tuple(
        min(MOST_SHAPES, _shapes_for(beam, on_beams[index], tolerance)) for index, beam in enumerate(tank.beams)
    )
    shortest = min((end - start for start, end, _ in tank.pieces), default=1.0)
    outermost = min(0.45 * shortest, 0.45 * tank.depth, *sizes)
    tip = outermost * min(10.0 * tolerance if sharp else 15.0 * tolerance**0.5, 0.25)
    return Resolution(
        degree=degree,
        surface_sizes=sizes,
        bulk_size=0.5 * max(1.0, tank.depth),
        tip_size=max(tip, SMALLEST_TIP),
        shapes=shapes,
        modes=0,
        reaches_tones=(),
        ring_ratio=0.4 if sharp else 0.3,
    )


def _radians(degree: int, tolerance: float) -> float:
    """How much of a wave one element resolves: the error of polynomials on it is about (e kh/(4p))^{2p}."""
    return 4.0 / e * degree * float((0.1 * tolerance) ** (0.5 / degree))


def _shapes_for(beam: Beam, wavenumber: float, tolerance: float) -> int:
    """Dry modes of one beam: those up to the shortest wave, and a tail whose error falls like N⁻⁷."""
    half_waves = wavenumber * beam.length / pi
    return ceil(half_waves + _TAIL * (half_waves + 2.0) * tolerance ** (-1.0 / 7.0)) + 4
