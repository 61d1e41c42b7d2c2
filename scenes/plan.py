"""What resolution a scene starts from, and how it is refined: degree, grading and number of dry modes."""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import ceil, log10, pi

from hydroelastic.scenes.models import Beam, TankScene, top_segments
from hydroelastic.scenes.scaling import scaled_beam, scales
from hydroelastic.scenes.waves import TopPiece, modes_below, squared_frequency_of_mode

HIGHEST_DEGREE = 10
MOST_SHAPES = 400
# Below this the coordinates of a ring's nodes keep fewer than three digits of their distance from the tip.
SMALLEST_TIP = 1e-13
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
        tip_size: innermost ring around the tips; ``None`` leaves the mesh uniform, for studies.
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
    widened: bool = False

    def coarser(self) -> Resolution:
        """The comparison solution: one degree less and a fifth fewer dry modes, on the same mesh."""
        return replace(
            self,
            degree=self.degree - 1,
            shapes=tuple(max(count - max(2, count // 5), min(count, 4)) for count in self.shapes),
        )

    def finer(self) -> Resolution | None:
        """The next attempt: two degrees and half as many dry modes more, then smaller elements; ``None`` at the end."""
        shapes = tuple(min(MOST_SHAPES, ceil(1.5 * count)) for count in self.shapes)
        if self.degree < HIGHEST_DEGREE:
            return replace(self, degree=min(self.degree + 2, HIGHEST_DEGREE), shapes=shapes)
        if shapes == self.shapes and min(self.surface_sizes) < 1e-3 * self.bulk_size:
            return None
        return replace(
            self,
            surface_sizes=tuple(0.5 * size for size in self.surface_sizes),
            bulk_size=0.5 * self.bulk_size,
            tip_size=None if self.tip_size is None else max(1e-2 * self.tip_size, SMALLEST_TIP),
            shapes=shapes,
        )


def initial_resolution(scene: TankScene, *, modes: int, tones: tuple[float, ...] = ()) -> Resolution:
    """Resolution for a number of modes, and for the elastic tones expected at (dimensionless) λ.

    Elements hold as many radians of the shortest wave as their degree resolves to the tolerance, and the innermost
    ring is small enough for the r^{1/2} of a pressure-release surface, whose error falls only like its radius.
    """
    tank = scaled_tank(scene)
    tolerance = scene.accuracy.tolerance
    # Measured on tanks with known modes: each degree gains a factor of 5 to 10 with rings of ratio 0.3.
    degree = min(max(ceil(-log10(tolerance)) + 1, 4), 9)
    # Enough above each tone to hold its flank: the part in each mode falls off like a resonance curve.
    expected = [ceil(1.25 * modes_below(tank.moving, tank.depth, tone)) + 4 for tone in tones]
    reaches_tones = tuple(count <= MOST_MODES_TO_TONE for count in expected)
    modes = max([modes, *(count for count in expected if count <= MOST_MODES_TO_TONE)])
    highest = squared_frequency_of_mode(tank.moving, tank.depth, modes)
    sizes, wavenumbers = [], {}
    for start, end, body in tank.pieces:
        piece = TopPiece(length=end - start, beam=None if body is None else tank.beams[body])
        wavenumber = piece.wavenumber(highest, tank.depth) if body is not None or tank.top == "free" else 0.0
        # 0.4 radians per degree; never fewer than two elements on a piece.
        sizes.append(min(0.4 * degree / max(wavenumber, 1e-9), 0.5 * piece.length, 0.25))
        if body is not None:
            wavenumbers[body] = wavenumber
    shapes = tuple(
        min(MOST_SHAPES, _shapes_for(beam, wavenumbers[index], tolerance)) for index, beam in enumerate(tank.beams)
    )
    shortest = min((end - start for start, end, _ in tank.pieces), default=1.0)
    return Resolution(
        degree=degree,
        surface_sizes=tuple(sizes),
        bulk_size=0.5 * max(1.0, tank.depth),
        tip_size=max(1e-2 * tolerance * min(shortest, tank.depth), SMALLEST_TIP),
        shapes=shapes,
        modes=modes,
        reaches_tones=reaches_tones,
    )


def _shapes_for(beam: Beam, wavenumber: float, tolerance: float) -> int:
    """Dry modes of one beam: those up to the shortest wave, and a tail whose error falls like N⁻⁷."""
    return ceil(1.2 * wavenumber * beam.length / pi + 3.0 * tolerance ** (-1.0 / 7.0)) + 2
