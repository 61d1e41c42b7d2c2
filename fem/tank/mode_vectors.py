"""The modes of a closed tank as vectors of the K-inner product; see `fem.sweep.mode_vectors`."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache

import numpy as np
from scipy.interpolate import Akima1DInterpolator

from hydroelastic.fem.closed.tones import participations
from hydroelastic.fem.surfaces import LiquidSurface
from hydroelastic.fem.sweep.mode_vectors import ModeVectors
from hydroelastic.fem.tank.solve import TankSolution
from hydroelastic.meshes.geometry import INTERFACE
from hydroelastic.physics.tank import StillLevel

# Of each free piece of a still level: more than two for the shortest of 60 half waves.
_POINTS = 128
_SIGNS = {None: 0.0, "symmetric": 1.0, "antisymmetric": -1.0}


def mode_vectors(solution: TankSolution) -> ModeVectors:
    """Return all modes of a solution as vectors, those above the requested ones too (collective)."""
    field, modes = solution.field, solution.modes
    count = len(modes.eigenvalues)
    scale = 1.0 / np.sqrt(modes.eigenvalues)[:, None]
    stiffness = np.sqrt(np.abs(np.concatenate([body.stiffness for body in field.bodies] or [np.empty(0)])))
    entries = modes.elastic_amplitudes * stiffness * scale
    stops = np.cumsum([body.size for body in field.bodies])[:-1]
    blocks = dict(
        zip((f"body {n + 1}" for n in range(len(field.bodies))), np.split(entries, stops, axis=1), strict=False)
    )
    levels = [level for level in solution.tank.levels if level.moves and level.is_open]
    shapes = [modes.completed(place).values for place in range(count)] if levels else []
    for level in levels:
        blocks |= {name: values * scale for name, values in _waves(solution, level, shapes)}
    beams = solution.tank.elastic
    return ModeVectors(
        omega=np.array([solution.omega(value) for value in modes.eigenvalues]),
        relative_error=solution.relative_errors,
        symmetry=np.array([_SIGNS[field.parity(index)] for index in range(count)]),
        blocks=blocks,
        participation=np.array(
            [participations(modes.eigenvalues, modes.elastic_amplitudes, field.bodies, beam) for beam in beams]
        ).reshape(len(beams), count),
        pressure_release=np.array(
            [
                np.nan if tone.pressure_release is None else solution.omega(tone.pressure_release)
                for tone in solution.tones
            ]
        ),
    )


def _waves(solution: TankSolution, level: StillLevel, shapes: list[np.ndarray]) -> Iterator[tuple[str, np.ndarray]]:
    """Name and √(Δρ g w) η of each free piece of a level, shape (modes, points).

    A piece is called by the bodies on its left, so that it has its name wherever they move, and whether or not there
    are other pieces.
    """
    places, elevations = _elevations(solution, level, shapes)
    at, weights = _gauss_points()
    left: list[int] = []
    for piece in level.pieces:
        if piece.body is not None:
            left.append(piece.body + 1)
            continue
        inside = (places >= piece.start) & (places <= piece.end)
        points = piece.start + 0.5 * (at + 1.0) * piece.length
        roots = np.sqrt(level.jump * 0.5 * weights * piece.length)
        at_nodes, first = np.unique(places[inside], return_index=True)
        curve = Akima1DInterpolator(at_nodes, elevations[:, inside][:, first], axis=1, method="makima")
        # The last node may miss the end of the piece by rounding.
        values = curve(np.clip(points, at_nodes[0], at_nodes[-1]))
        yield f"{level.name} right of {left}", roots * values


@cache
def _gauss_points() -> tuple[np.ndarray, np.ndarray]:
    """Points and weights on [−1, 1]."""
    return np.polynomial.legendre.leggauss(_POINTS)


def _elevations(solution: TankSolution, level: StillLevel, shapes: list[np.ndarray]) -> tuple[np.ndarray, np.ndarray]:
    """Abscissae of the unknowns of η on a level, ascending, and η there in all modes, at unit generalized mass of the
    whole tank."""
    field = solution.field
    # Both halves of a symmetric tank share mesh and space.
    pencil = field.parts[0].pencil
    number = next(place for place, one in enumerate(pencil.surfaces) if _is_on(one, level))
    surface, liquid, comm = pencil.surfaces[number], pencil.liquid, pencil.liquid.tank.mesh.comm
    dofs = liquid.surface_dofs((surface.surface,), surface.below)
    x = np.concatenate(comm.allgather(liquid.unknown_positions()[dofs, 0]))
    order = np.argsort(x, kind="stable")
    behind = sum(pencil.surface_sizes[number:])
    rows = []
    for shape, (part, _) in zip(shapes, field.origins, strict=True):
        first = len(shape) - behind
        values = np.concatenate(comm.allgather(shape[first : first + pencil.surface_sizes[number]]))[order]
        if field.half:
            values = np.sqrt(0.5) * np.concatenate([values, _SIGNS[field.parts[part].parity] * values[::-1]])
        rows.append(values)
    places = np.concatenate([x[order], 1.0 - x[order][::-1]]) if field.half else x[order]
    return places, np.array(rows).reshape(len(rows), len(places))


def _is_on(surface: LiquidSurface, level: StillLevel) -> bool:
    return (surface.surface == INTERFACE) == (level.above is not None)
