"""Shapes of modes in SI units, at a generalized mass of 1 kg per metre of width.

The largest displacement of a body, or without bodies of the lowest surface, is positive: upwards, to the right or
anticlockwise. Dimensions: `mode`, the modes asked for, and `growing_mode`, for which variables begin with "growing_".
"""

from __future__ import annotations

from collections import Counter
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray
from scipy.linalg import block_diag

from hydroelastic.fem.closed.tones import first_elastic
from hydroelastic.fem.core.sampling import tessellated
from hydroelastic.fem.sweep.mode_vectors import ModeVectors
from hydroelastic.physics.contours import POINTS, points_along
from hydroelastic.physics.dofs import PLACES, body_name, dof_names

if TYPE_CHECKING:
    from hydroelastic.fem.closed.section import SectionSolution

Array = NDArray[np.float64]

# Both ends of a beam move alike in modes of a symmetric tank: relative difference of what counts as equal.
_EQUAL = 1e-9
# What moves less than this part of the waves moves by rounding, and is not to choose the sign of a mode.
_STILL = 1e-6
# Gauss points of each free piece of a still level: more than two for the shortest of 60 half waves.
_POINTS_OF_VECTORS = 128


def mode_shapes(solution: SectionSolution) -> xr.Dataset:
    """Displacements along surfaces, beams and contours of floats, and the matrices of floats (collective)."""
    tank, length = solution.tank, solution.physical.length
    numbers, scale = shown_modes(solution), _metres(solution)
    amplitudes = solution.found.amplitudes[numbers]
    bodies, waves, leading = _Curves(), _Curves(), list[Array]()
    motions, counts = list[Array](), Counter[str]()
    stops = np.cumsum([body.size for body in solution.found.section.bodies])[:-1]
    parts = np.split(amplitudes, stops, axis=1) if tank.bodies else []
    for index, (body, own) in enumerate(zip(solution.found.section.bodies, parts, strict=True)):
        name = body_name(index + 1)
        if index in tank.hulls:
            hull = tank.floats[index]
            contour = points_along(hull.hull.contour.arcs)
            units = np.array([hull.displacement(motion, contour.T) for motion in hull.motions])
            units = units.reshape(-1, *contour.T.shape)
            motions.append(own @ body.motions.T)
            # Points of the contour say nothing of the sign: by roll, some rise as far as others sink.
            leading.append(_largest(motions[-1] * np.hypot(units[:, 0], units[:, 1]).max(axis=1, initial=0.0)))
            moved = np.einsum("mi,ixp->mpx", motions[-1], units)
            bodies.fixed[f"contour_of_{name}"] = ((f"point_on_{name}", "axis"), contour * length)
            bodies.moved[f"displacement_of_{name}"] = ((f"point_on_{name}", "axis"), moved, {})
        else:
            piece, level = tank.piece_of(index), tank.level_of(index)
            x = np.linspace(piece.start, piece.end, POINTS, dtype=np.float64)
            shapes = body.shapes(np.column_stack([x, np.full_like(x, level.height)]), np.zeros_like(x))[:, 1]
            leading.append(_largest(own @ shapes))
            bodies.add("deflection", name, x * length, own @ shapes, level.height * length)
    lowest: list[Array] = [np.zeros((len(numbers), 1))]
    levels = [level for level in tank.levels if level.moves and level.is_open]
    for level in levels:
        kind = "free_surface" if level.above is None else "interface"
        for piece in level.pieces:
            if piece.body is None:
                counts[kind] += 1
                x = np.linspace(piece.start, piece.end, POINTS, dtype=np.float64)
                moved = solution.elevations(numbers, level, x)
                waves.add("elevation", f"{kind}_{counts[kind]}", x * length, moved, level.height * length)
                lowest += [moved] * (level is levels[0])
    of_bodies, of_waves = _largest(np.column_stack([np.zeros(len(numbers)), *leading])), _largest(np.hstack(lowest))
    sign = np.where(np.abs(of_bodies) > _STILL * np.abs(of_waves), np.sign(of_bodies), np.sign(of_waves))
    sign[sign == 0.0] = 1.0
    moved_ones = {**bodies.moved, **waves.moved, "sign": ((), sign / scale, {})}
    if tank.rigid:
        turns = np.concatenate([tank.floats[index].is_rotation for index in tank.rigid])
        moved_ones["motion"] = (("dof",), np.hstack(motions) / length**turns, {})
    variables: dict[str, Any] = {**bodies.fixed, **waves.fixed}
    asked = len(numbers) - solution.found.modes.growing
    for prefix, which in (("", slice(0, asked)), ("growing_", slice(asked, None))):
        for name, (dimensions, values, attributes) in moved_ones.items() if len(numbers[which]) else ():
            signed = values[which] * scale * sign[which].reshape(-1, *[1] * (values.ndim - 1)) ** (name != "sign")
            variables[prefix + name] = ((f"{prefix}mode", *dimensions), signed, attributes)
    data = xr.Dataset(variables, coords={"axis": ["x", "y"]} if tank.rigid else {})
    return data.merge(_matrices(solution)) if tank.rigid else data


def liquid_samples(solution: SectionSolution) -> xr.Dataset | None:
    """ψ and ∇ψ of the modes asked for, then of growing ones, on triangles of the whole tank, on rank 0 (collective).

    Returns:
        as `fem.core.sampling.tessellated`, in m, and ψ in m² of modes of that normalisation.
    """
    numbers, length, scale = shown_modes(solution), solution.physical.length, _metres(solution)
    data = tessellated(solution.liquid, [solution.field(number) for number in numbers])
    shapes = solution.shapes
    if data is None:
        return None
    if solution.found.section.half:
        odd = np.array([solution.found.modes.origins[number][0] == "antisymmetric" for number in numbers])
        image = data.assign(
            position=data.position * [-1.0, 1.0] + [1.0, 0.0],
            # A mirror image reverses the orientation of triangles.
            vertex=data.vertex[:, ::-1] + data.sizes["point"],
            potential=data.potential * np.where(odd, -1.0, 1.0)[:, None],
            displacement=data.displacement * np.where(odd, -1.0, 1.0)[:, None, None] * [-1.0, 1.0],
        )
        both = {
            name: xr.concat([data[name], image[name]], dim)
            for name, dim in (("position", "point"), ("vertex", "triangle"), ("liquid", "triangle"))
        }
        both |= {name: np.sqrt(0.5) * xr.concat([data[name], image[name]], "point") for name in _OF_MODES}
        data = xr.Dataset(both)
    signs = [shapes[name].values for name in ("sign", "growing_sign") if name in shapes]
    sign = xr.DataArray(np.concatenate([np.empty(0), *signs]), dims="mode")
    return data.assign(
        position=data.position * length,
        potential=data.potential * sign * scale * length,
        displacement=data.displacement * sign * scale,
    )


_OF_MODES = ("potential", "displacement")


def shown_modes(solution: SectionSolution) -> list[int]:
    """Numbers of the modes asked for, then of the growing ones, among all."""
    growing, found = solution.found.modes.growing, len(solution.found.values)
    return [*range(growing, growing + min(solution.count, found)), *range(growing)]


def mode_vectors(solution: SectionSolution) -> ModeVectors:
    """All modes in the K-inner product, those above the requested ones too (collective)."""
    tank, found, data = solution.tank, solution.found, solution.dataset
    growing, scale = found.modes.growing, 1.0 / np.sqrt(found.values)[:, None]
    amplitudes, bodies = found.amplitudes[growing:], found.section.bodies
    stops = np.cumsum([0, *(body.size for body in bodies)])
    blocks = {
        f"body {number + 1}": amplitudes[:, own[0] : own[1]] * np.sqrt(np.abs(body.stiffness)) * scale
        for number, (body, own) in enumerate(zip(bodies, pairwise(stops), strict=True))
    }
    at, weights = np.polynomial.legendre.leggauss(_POINTS_OF_VECTORS)
    for level in tank.levels:
        # Pieces are called by the bodies on their left, so that they have their names wherever these move.
        left: list[int] = []
        for piece in level.pieces:
            if piece.body is not None:
                left.append(piece.body + 1)
            elif level.moves:
                x = piece.start + 0.5 * (at + 1.0) * piece.length
                elevation = solution.elevations(range(growing, growing + len(found.values)), level, x)
                roots = np.sqrt(level.jump * 0.5 * weights * piece.length)
                blocks[f"{level.name} right of {left}"] = elevation * roots * scale
    firsts = [first_elastic(bodies, body) for body in tank.elastic]
    parts = [
        bodies[body].stiffness[first] * amplitudes[:, place] ** 2 / found.values
        for body, (first, place) in zip(tank.elastic, firsts, strict=True)
    ]
    released = [solution.limit.tone(number) if solution.limit else None for number in range(len(tank.elastic))]
    return ModeVectors(
        omega=data.omega.values,
        relative_error=data.relative_error.values,
        symmetry=np.array([{"symmetric": 1.0, "antisymmetric": -1.0}.get(own, 0.0) for own in data.symmetry.values]),
        blocks=blocks,
        participation=np.array(parts).reshape(len(parts), len(found.values)),
        pressure_release=np.array(
            [np.nan if own is None else np.sqrt(own[0]) * solution.physical.units.frequency for own in released]
        ),
    )


def _metres(solution: SectionSolution) -> float:
    """What a displacement of 1 in units of the tank is in m: generalized mass 1 is ρL⁴ for a displacement of L."""
    units = solution.physical.units
    return 1.0 / (units.length * float(np.sqrt(units.density)))


class _Curves:
    """What is at rest, and what moves, by name."""

    def __init__(self) -> None:
        self.fixed: dict[str, tuple[Any, Array]] = {}
        self.moved: dict[str, tuple[tuple[str, ...], Array, dict[str, float]]] = {}

    def add(self, quantity: str, name: str, x: Array, moved: Array, height: float) -> None:
        place = f"position_on_{name}"
        self.fixed[place] = (place, x)
        self.moved[f"{quantity}_of_{name}"] = ((place,), moved, {"level_at_rest": height})


def _largest(displacements: Array) -> Array:
    """Of each row the value that is largest without its sign; of those that rounding alone tells apart the first."""
    sizes = np.abs(displacements)
    if not displacements.size:
        return np.zeros(len(displacements))
    first = np.argmax(sizes >= (1.0 - _EQUAL) * sizes.max(axis=1, keepdims=True), axis=1)
    return np.asarray(displacements[np.arange(len(displacements)), first])


def _matrices(solution: SectionSolution) -> xr.Dataset:
    """Inertia and hydrostatic stiffness of the floats in the order of their motions."""
    floats = [solution.physical.floats[index] for index in solution.tank.rigid]
    dofs = dof_names(() if body.is_elastic else body.rigid_motions for body in solution.tank.bodies)
    names = [dof.capitalised for dof in dofs]
    places = [[PLACES[motion] for motion in body.motions] for body in floats]
    inertia = block_diag(*(np.diag(body.inertia[own]) for body, own in zip(floats, places, strict=True)))
    stiffness = block_diag(
        *(body.hydrostatics.stiffness[np.ix_(own, own)] for body, own in zip(floats, places, strict=True))
    )
    both = ("influenced_dof", "radiating_dof")
    return xr.Dataset(
        {"inertia_matrix": (both, inertia), "hydrostatic_stiffness": (both, stiffness)},
        coords=dict.fromkeys(("dof", *both), names),
    )
