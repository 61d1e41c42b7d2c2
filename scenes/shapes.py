"""Mode shapes of a solution in metres, on one process: what is drawn and what is written for ParaView."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import meshio
import numpy as np
from numpy.typing import NDArray

from hydroelastic.fem.liquid import as_functions
from hydroelastic.fem.pictures import Canvas, ModePicture, SurfaceCurve, draw_mode, draw_overview
from hydroelastic.fem.sampling import LiquidSample, SurfaceTrace, sample_liquid, sample_surface
from hydroelastic.meshes.geometry import FREE_SURFACE
from hydroelastic.scenes.solve import TankSolution
from hydroelastic.scenes.summary import Summary

_BEAM_POINTS = 201
_ROUNDING = 1e-12


@dataclass(frozen=True, kw_only=True)
class ModeShapes:
    """The modes asked for, sampled, in SI units and scaled to a generalized mass of 1 kg per metre of width.

    Attributes:
        liquid: ψ and ∇ψ.
        curves: for each mode, the displaced surfaces.
    """

    liquid: LiquidSample
    curves: tuple[tuple[SurfaceCurve, ...], ...]


def sample_shapes(solution: TankSolution) -> ModeShapes | None:
    """Sample the modes asked for; the largest displacement of a body (without bodies, of the water) is positive.

    Returns:
        The shapes on rank 0, ``None`` elsewhere (collective).
    """
    modes, field = solution.asked, solution.field
    # Both halves of a symmetric tank share mesh and space.
    space = field.parts[0].pencil.liquid
    functions = as_functions(space, [mode.potential for mode in modes])
    liquid = sample_liquid(space, functions)
    water = sample_surface(space, functions, FREE_SURFACE) if field.surfaces else None
    if liquid is None:
        return None
    if field.half:
        signs = np.array([1.0 if field.parity(index) == "symmetric" else -1.0 for index in range(len(modes))])
        liquid = _mirrored_liquid(liquid, signs)
        water = _mirrored_trace(water, signs) if water is not None else None
    length, root_density = solution.units.length, np.sqrt(solution.units.density)
    # Generalized mass 1 in units of the tank is ρL⁴ for a displacement of L: divide by its root.
    to_metres = 1.0 / (length * root_density)
    liquid = LiquidSample(
        points=liquid.points * length,
        triangles=liquid.triangles,
        potential=liquid.potential / root_density,
        displacement=liquid.displacement * to_metres,
    )
    curves = []
    for number, mode in enumerate(modes):
        bodies = _body_curves(solution, mode.body_amplitudes)
        waves = _water_curves(solution, water, number, mode.eigenvalue)
        leading = bodies or waves
        largest = max((curve.displacement for curve in leading), key=lambda w: np.abs(w).max())
        sign = np.sign(largest[np.argmax(np.abs(largest))]) or 1.0
        liquid.potential[number] *= sign
        liquid.displacement[number] *= sign
        curves.append(
            tuple(
                SurfaceCurve(kind=curve.kind, x=curve.x * length, displacement=sign * to_metres * curve.displacement)
                for curve in (*bodies, *waves)
            )
        )
    return ModeShapes(liquid=liquid, curves=tuple(curves))


def _mirrored_liquid(half: LiquidSample, signs: np.ndarray) -> LiquidSample:
    """Both halves of a tank, at unit generalized mass of the whole, from the left half at its own."""
    flipped = half.points * [-1.0, 1.0] + [1.0, 0.0]
    sign = signs[:, None] * np.sqrt(0.5)
    mirrored = half.displacement * (sign[:, :, None] * [-1.0, 1.0])
    return LiquidSample(
        points=np.vstack([half.points, flipped]),
        # A mirror image turns the sense of rotation.
        triangles=np.vstack([half.triangles, half.triangles[:, ::-1] + len(half.points)]),
        potential=np.hstack([np.sqrt(0.5) * half.potential, sign * half.potential]),
        displacement=np.hstack([np.sqrt(0.5) * half.displacement, mirrored]),
    )


def _mirrored_trace(half: SurfaceTrace, signs: np.ndarray) -> SurfaceTrace:
    # The mirror plane itself is there already.
    other = slice(-2 if half.x[-1] >= 0.5 - _ROUNDING else -1, None, -1)
    return SurfaceTrace(
        x=np.concatenate([half.x, 1.0 - half.x[other]]),
        potential=np.sqrt(0.5) * np.hstack([half.potential, signs[:, None] * half.potential[:, other]]),
    )


def _body_curves(solution: TankSolution, amplitudes: np.ndarray) -> list[SurfaceCurve]:
    place = {piece.body: (piece.start, piece.end) for piece in solution.tank.pieces}
    curves, first = [], 0
    for index, body in enumerate(solution.field.bodies):
        x: NDArray[np.float64] = np.linspace(*place[index], _BEAM_POINTS, dtype=np.float64)
        points, upwards = np.vstack([x, np.zeros_like(x)]), np.vstack([np.zeros_like(x), np.ones_like(x)])
        own = amplitudes[first : first + body.size]
        displacement = sum(
            (amplitude * body.shapes(points, upwards, number) for number, amplitude in enumerate(own)),
            np.zeros_like(x),
        )
        curves.append(SurfaceCurve(kind="body", x=x, displacement=displacement))
        first += body.size
    return curves


def _water_curves(
    solution: TankSolution, water: SurfaceTrace | None, number: int, eigenvalue: float
) -> list[SurfaceCurve]:
    if water is None:
        return []
    # η = ω² ψ/g, in units of the tank λψ.
    elevation = eigenvalue * water.potential[number]
    curves = []
    for piece in solution.tank.pieces:
        if piece.body is None:
            # Mirrored abscissae miss the ends by rounding.
            inside = (water.x >= piece.start - _ROUNDING) & (water.x <= piece.end + _ROUNDING)
            curves.append(SurfaceCurve(kind="free_surface", x=water.x[inside], displacement=elevation[inside]))
    return curves


def mode_title(number: int, mode: Summary) -> str:
    """Title of a mode's picture."""
    bending = mode["elastic_energy_fraction"]
    share = f" ({100 * bending:.0f} % bending)" if bending >= 0.005 else ""
    return f"Mode {number}: ω = {mode['omega']:.6g} rad/s, {mode['frequency_hz']:.4g} Hz, {mode['kind']}{share}"


def pictures(shapes: ModeShapes, summary: Summary) -> list[ModePicture]:
    """One picture for each mode."""
    return [
        ModePicture(
            points=shapes.liquid.points,
            triangles=shapes.liquid.triangles,
            potential=shapes.liquid.potential[number],
            displacement=shapes.liquid.displacement[number],
            surfaces=shapes.curves[number],
            title=mode_title(number + 1, mode),
            length=summary["scene"]["tank"]["length"],
            depth=summary["scene"]["liquid"][0]["depth"],
        )
        for number, mode in enumerate(summary["modes"])
    ]


def draw_all(shapes: ModeShapes, summary: Summary, folder: Path) -> None:
    """Draw every mode, and all of them on one sheet."""
    folder.mkdir()
    drawn = pictures(shapes, summary)
    with Canvas() as canvas:
        for number, picture in enumerate(drawn, 1):
            draw_mode(picture, folder / f"mode_{number:03d}.png", canvas=canvas)
        draw_overview(drawn, folder / "overview.png", canvas=canvas)


def write_fields(shapes: ModeShapes, folder: Path) -> None:
    """Write one VTU with ψ and ∇ψ of every mode; coordinates in metres, for ParaView."""
    folder.mkdir()
    data = {}
    for number in range(len(shapes.liquid.potential)):
        displacement = shapes.liquid.displacement[number]
        data[f"potential_{number + 1:03d}"] = shapes.liquid.potential[number]
        data[f"displacement_{number + 1:03d}"] = np.column_stack([displacement, np.zeros(len(displacement))])
    points = np.column_stack([shapes.liquid.points, np.zeros(len(shapes.liquid.points))])
    meshio.write(folder / "modes.vtu", meshio.Mesh(points, [("triangle", shapes.liquid.triangles)], point_data=data))
