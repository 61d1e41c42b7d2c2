"""What moves at the still levels in a mode, in units of the tank: surfaces of the liquids, beams, rigid floats."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from dolfinx import fem
from numpy.typing import NDArray

from hydroelastic.fem.liquid import LiquidSpace
from hydroelastic.fem.pictures.mode import FloatSection, SurfaceCurve
from hydroelastic.fem.sampling import SurfaceTrace, sample_surface
from hydroelastic.fem.surfaces import Body
from hydroelastic.meshes.geometry import FREE_SURFACE, INTERFACE
from hydroelastic.physics.contours import POINTS, points_along
from hydroelastic.physics.floats import RigidFloat
from hydroelastic.physics.tank import StillLevel, Tank

# Both ends of a beam move alike in modes of a symmetric tank: relative difference of what counts as equal.
_EQUAL = 1e-9
# What moves less than this part of the waves moves by rounding, and is not to choose the sign of a mode.
_STILL = 1e-6

Array = NDArray[np.float64]


def wave_levels(tank: Tank) -> tuple[StillLevel, ...]:
    """The still levels on which waves travel beside the bodies."""
    return tuple(level for level in tank.levels if level.moves and level.is_open)


def sample_level(
    tank: Tank, level: StillLevel, liquid: LiquidSpace, functions: list[fem.Function]
) -> SurfaceTrace | None:
    """(ρψ below − ρψ above)/(ρ below − ρ above) along a still level, which is its elevation over λ."""
    name = FREE_SURFACE if level.above is None else INTERFACE
    below = sample_surface(liquid, functions, name, level.below)
    above = sample_surface(liquid, functions, name, level.above) if level.above is not None else None
    if below is None:
        return None
    pressure: Array = tank.layers[level.below].density * below.potential
    if level.above is not None and above is not None:
        # Facets of both sides are the same.
        pressure = pressure - tank.layers[level.above].density * above.potential
    return SurfaceTrace(x=below.x, potential=(1.0 / level.jump) * pressure)


def wave_curves(level: StillLevel, trace: SurfaceTrace, number: int, eigenvalue: float) -> Iterator[SurfaceCurve]:
    """The displaced pieces of a still level in one mode."""
    for piece in level.pieces:
        if piece.body is None:
            x, potential = trace.between(piece.start, piece.end)
            yield SurfaceCurve(
                kind="free_surface" if level.above is None else "interface",
                x=x,
                displacement=eigenvalue * potential[number],
                level=level.height,
            )


@dataclass(frozen=True, kw_only=True)
class BodyShapes:
    """The bodies in one mode.

    Attributes:
        beams: their displaced lines.
        floats: their displaced sections.
        motions: of each float, by its motions in the order of the scene's model.
        leading: the largest displacement of a body, with its sign; 0 without bodies.
    """

    beams: tuple[SurfaceCurve, ...]
    floats: tuple[FloatSection, ...]
    motions: tuple[Array, ...]
    leading: float


def body_shapes(tank: Tank, bodies: tuple[Body, ...], amplitudes: Array) -> BodyShapes:
    """Displace the bodies of a tank."""
    beams, floats, motions, leading = [], [], [], [0.0]
    parts = np.split(amplitudes, np.cumsum([body.size for body in bodies])[:-1]) if bodies else []
    for index, (body, own) in enumerate(zip(bodies, parts, strict=True)):
        if index in tank.hulls:
            motions.append(body.motions @ own)
            section, largest = _displaced_float(tank.floats[index], motions[-1])
            floats.append(section)
            leading.append(largest)
        else:
            beams.append(_displaced_beam(tank, index, body, own))
            leading.append(largest_of(beams[-1].displacement))
    return BodyShapes(
        beams=tuple(beams), floats=tuple(floats), motions=tuple(motions), leading=largest_of(np.array(leading))
    )


def largest_of(displacement: Array) -> float:
    """The value that is largest without its sign; of those that rounding alone tells apart the first."""
    sizes = np.abs(displacement)
    return float(displacement[np.argmax(sizes >= (1.0 - _EQUAL) * sizes.max())])


def sign_of(bodies: BodyShapes, waves: tuple[SurfaceCurve, ...]) -> float:
    """Sign by which the largest displacement of a body becomes positive; without, of the lowest surface."""
    lowest = [wave.displacement for wave in waves if wave.level == waves[0].level]
    leading = largest_of(np.concatenate(lowest)) if lowest else 0.0
    if abs(bodies.leading) > _STILL * abs(leading):
        leading = bodies.leading
    return float(np.sign(leading)) or 1.0


def _displaced_beam(tank: Tank, index: int, body: Body, amplitudes: Array) -> SurfaceCurve:
    piece, level = tank.piece_of(index), tank.level_of(index)
    x: Array = np.linspace(piece.start, piece.end, POINTS, dtype=np.float64)
    points = np.vstack([x, np.full_like(x, level.height)])
    upwards = np.vstack([np.zeros_like(x), np.ones_like(x)])
    displacement = amplitudes @ body.shapes(points, upwards)
    return SurfaceCurve(kind="body", x=x, displacement=displacement, level=level.height)


def _displaced_float(body: RigidFloat, amplitudes: Array) -> tuple[FloatSection, float]:
    """A float displaced by its motions, and the largest displacement of its contour by one of them, with its sign.

    The contour's points say nothing of the sign: by roll, some rise as far as others sink.
    """
    contour = points_along(body.hull.contour.arcs)
    moved = [
        amplitude * body.displacement(motion, contour.T)
        for motion, amplitude in zip(body.motions, amplitudes, strict=True)
    ]
    sizes = np.array([np.hypot(*part).max() for part in moved]) * np.sign(amplitudes)
    slit = np.array([[body.waterplane[0], y] for y in body.hull.slit]) if body.hull.is_thin else None
    displacement = np.sum(moved, axis=0).T
    section = FloatSection(contour=contour, displacement=displacement, waterplane=body.waterplane, slit=slit)
    return section, largest_of(sizes)
