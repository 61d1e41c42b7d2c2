"""Mode shapes of a solution in SI units on one process, for pictures and files."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from hydroelastic.fem.liquid import as_functions
from hydroelastic.fem.mode_set import Mode
from hydroelastic.fem.sampling import LiquidSample, SurfaceTrace, sample_liquid
from hydroelastic.fem.shape_curves import (
    FloatSection,
    SurfaceCurve,
    body_shapes,
    sample_level,
    sign_of,
    wave_curves,
    wave_levels,
)
from hydroelastic.fem.tank.solve import TankSolution
from hydroelastic.physics.symmetry import Parity
from hydroelastic.physics.tank import StillLevel


@dataclass(frozen=True, kw_only=True)
class ModeShapes:
    """The requested modes, then the growing ones, in SI units at a generalized mass of 1 kg per metre of width.

    Attributes:
        liquid: ψ and ∇ψ at the points of the liquid.
        curves: for each mode, the displaced surfaces and beams.
        floats: for each mode, the displaced floats.
        motions: for each mode and float, the motions that it has of heave, m, sway, m, and roll, rad, in this order.
        growing: number of growing modes, which are the last ones, the fastest first.
        length: length of the tank, m.
        depths: depths of the liquids from the bottom up, m.
        densities: densities of the liquids, kg/m³.
        lid: left and right end of each piece of a rigid top, m.
    """

    liquid: LiquidSample
    curves: tuple[tuple[SurfaceCurve, ...], ...]
    floats: tuple[tuple[FloatSection, ...], ...]
    motions: tuple[tuple[np.ndarray, ...], ...]
    growing: int
    length: float
    depths: tuple[float, ...]
    densities: tuple[float, ...]
    lid: tuple[tuple[float, float], ...]


def sample_shapes(solution: TankSolution) -> ModeShapes | None:
    """Sample the requested and the growing modes (collective).

    The largest displacement of a body, or without bodies of the lowest surface, is positive: upwards, to the right or
    anticlockwise.
    """
    tank, field = solution.tank, solution.field
    growing = sorted(
        zip(solution.modes.growing, field.growing_origins, strict=True), key=lambda found: found[0].eigenvalue
    )
    modes = [*solution.asked, *(mode for mode, _ in growing)]
    parities = [field.parity(index) for index in range(len(solution.asked))]
    parities += [field.parts[part].parity for _, (part, _) in growing]
    sampled = _sampled(solution, modes, parities)
    if sampled is None:
        return None
    liquid, levels = sampled
    units = solution.units
    length, root_density = units.length, np.sqrt(units.density)
    # Generalized mass 1 in units of the tank is ρL⁴ for a displacement of L: divide by its root.
    to_metres = 1.0 / (length * root_density)
    liquid = replace(
        liquid,
        points=liquid.points * length,
        potential=liquid.potential / root_density,
        displacement=liquid.displacement * to_metres,
    )
    curves, floats, motions = [], [], []
    for number, mode in enumerate(modes):
        bodies = body_shapes(tank, field.bodies, mode.body_amplitudes)
        waves = tuple(wave for level, trace in levels for wave in wave_curves(level, trace, number, mode.eigenvalue))
        sign = sign_of(bodies, waves)
        liquid.potential[number] *= sign
        liquid.displacement[number] *= sign
        curves.append(tuple(curve.scaled(length, sign * to_metres) for curve in (*bodies.beams, *waves)))
        floats.append(tuple(section.scaled(length, sign * to_metres) for section in bodies.floats))
        motions.append(
            tuple(
                sign * to_metres * moved / length**body.is_rotation
                for body, moved in zip(tank.floats.values(), bodies.motions, strict=True)
            )
        )
    top = tank.levels[-1]
    return ModeShapes(
        liquid=liquid,
        curves=tuple(curves),
        floats=tuple(floats),
        motions=tuple(motions),
        growing=len(growing),
        length=length,
        depths=tuple(layer.depth for layer in solution.physical.layers),
        densities=tuple(layer.density for layer in solution.physical.layers),
        lid=tuple(
            (piece.start * length, piece.end * length)
            for piece in top.pieces
            if top.kind == "rigid" and piece.body is None
        ),
    )


def _sampled(
    solution: TankSolution, modes: list[Mode], parities: list[Parity | None]
) -> tuple[LiquidSample, list[tuple[StillLevel, SurfaceTrace]]] | None:
    """Sample modes in all liquids and along the moving still levels, in units of the tank (collective)."""
    # Both halves of a symmetric tank share mesh and space.
    space = solution.field.parts[0].pencil.liquid
    functions = as_functions(space, [mode.potential for mode in modes])
    liquid = sample_liquid(space, functions)
    traces = [(level, sample_level(solution.tank, level, space, functions)) for level in wave_levels(solution.tank)]
    if liquid is None:
        return None
    levels = [(level, trace) for level, trace in traces if trace is not None]
    if not solution.field.half:
        return liquid, levels
    signs = np.array([1.0 if parity == "symmetric" else -1.0 for parity in parities])
    return _mirrored_liquid(liquid, signs), [(level, _mirrored_trace(trace, signs)) for level, trace in levels]


def _mirrored_liquid(half: LiquidSample, signs: np.ndarray) -> LiquidSample:
    """Both halves of a tank, at unit generalized mass of the whole, from the left half at its own."""
    flipped = half.points * [-1.0, 1.0] + [1.0, 0.0]
    sign = signs[:, None] * np.sqrt(0.5)
    mirrored = half.displacement * (sign[:, :, None] * [-1.0, 1.0])
    return LiquidSample(
        points=np.vstack([half.points, flipped]),
        # A mirror image reverses the orientation of triangles.
        triangles=np.vstack([half.triangles, half.triangles[:, ::-1] + len(half.points)]),
        liquid=np.concatenate([half.liquid, half.liquid]),
        potential=np.hstack([np.sqrt(0.5) * half.potential, sign * half.potential]),
        displacement=np.hstack([np.sqrt(0.5) * half.displacement, mirrored]),
    )


def _mirrored_trace(half: SurfaceTrace, signs: np.ndarray) -> SurfaceTrace:
    back = (slice(None, None, -1), slice(None, None, -1))
    mirrored = signs[:, None, None] * half.potential[:, *back]
    return SurfaceTrace(
        x=np.concatenate([half.x, 1.0 - half.x[back]]),
        potential=np.sqrt(0.5) * np.concatenate([half.potential, mirrored], axis=1),
    )
