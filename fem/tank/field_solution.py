"""Solve a scene at one resolution: a whole tank, or the two halves of a tank that is its own mirror image.

Modes of the halves are sorted into one ascending list, with the amplitudes of the bodies of the whole tank.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import NamedTuple

import numpy as np

from hydroelastic.fem.inertia import count_below
from hydroelastic.fem.mode_set import Mode, ModeSet
from hydroelastic.fem.modes import HIDDEN, solve_modes
from hydroelastic.fem.pencil import CoupledPencil
from hydroelastic.fem.surfaces import Body, LiquidSurface
from hydroelastic.fem.tank.field_model import build_field_model, build_half_models, moving_parities, whole_bodies
from hydroelastic.fem.tank.resolution import Resolution
from hydroelastic.meshes.distribute import TankMesh
from hydroelastic.physics.symmetry import (
    Parity,
    left_bodies,
    shapes_of_twins,
    twin_of,
)
from hydroelastic.physics.tank import Tank

PartPencils = dict[Parity | None, CoupledPencil]
"""The eigenproblems of a scene by the symmetry of their modes; ``None`` is all of them, on the whole tank."""


Origin = tuple[int, int]
"""Index of the part of a mode, and its index among the modes of that part."""


@dataclass(frozen=True, kw_only=True)
class Part:
    """One eigenproblem of a scene.

    Attributes:
        parity: symmetry of its modes; ``None`` is all of them, on the whole tank.
        pencil: matrices of the part.
        modes: modes of the part, with energies of its part of the tank.
    """

    parity: Parity | None
    pencil: CoupledPencil
    modes: ModeSet


@dataclass(frozen=True, kw_only=True)
class FieldSolution:
    """The modes of a scene at one resolution.

    Attributes:
        mesh: mesh of the liquid, or of its left half.
        parts: the eigenproblems.
        bodies: the bodies of the whole tank.
        modes: the lowest modes of all parts, ascending, in the bodies of the whole tank at unit generalized mass.
        origins: of each mode.
        growing_origins: of each growing mode.
    """

    mesh: TankMesh
    parts: tuple[Part, ...]
    bodies: tuple[Body, ...]
    modes: ModeSet
    origins: tuple[Origin, ...]
    growing_origins: tuple[Origin, ...] = ()

    @property
    def dofs(self) -> int:
        """Number of unknowns of ψ and of the surfaces, over all parts."""
        return sum(part.pencil.liquid.size + part.pencil.size for part in self.parts)

    @property
    def surface_unknowns(self) -> int:
        """Number of unknowns of the surfaces, over all parts."""
        return sum(part.pencil.size for part in self.parts)

    @property
    def half(self) -> bool:
        """Whether the mesh is that of the left half of the tank."""
        return self.parts[0].parity is not None

    @property
    def surfaces(self) -> tuple[LiquidSurface, ...]:
        """The surfaces of the liquids that move under gravity."""
        return self.parts[0].pencil.surfaces

    def parity(self, index: int) -> Parity | None:
        """Return the symmetry of a mode; ``None`` where the whole tank was solved."""
        return self.parts[self.origins[index][0]].parity


def solve_field(
    mesh: TankMesh,
    tank: Tank,
    resolution: Resolution,
    count: int,
    *,
    half: bool,
    models: Callable[..., PartPencils] | None = None,
) -> FieldSolution:
    """Assemble and solve for the lowest modes (collective)."""
    pencils = (models or part_models)(mesh, tank, resolution.degree, resolution.shapes, half=half)
    return solve_parts(mesh, tank, resolution.shapes, pencils, count)


def part_models(
    mesh: TankMesh,
    tank: Tank,
    degree: int,
    shapes: tuple[int, ...],
    *,
    half: bool,
    infinite_frequency: bool = False,
) -> PartPencils:
    """Assemble the problems of a tank by their symmetries: one of the whole tank, or those of its halves that have
    unknowns (collective)."""
    if not half:
        pencil = build_field_model(mesh, tank, degree=degree, shapes=shapes, infinite_frequency=infinite_frequency)
        return {None: pencil}
    shapes = shapes_of_twins(tank, shapes)
    parities = moving_parities(tank, shapes, infinite_frequency=infinite_frequency)
    pencils = build_half_models(
        mesh, tank, degree=degree, shapes=shapes, infinite_frequency=infinite_frequency, parities=parities
    )
    return dict(zip(parities, pencils, strict=True))


def solve_parts(
    mesh: TankMesh,
    tank: Tank,
    shapes: tuple[int, ...],
    pencils: PartPencils,
    count: int,
) -> FieldSolution:
    """Solve the problems of `part_models`, made with the same arguments, for the lowest modes (collective)."""
    if None not in pencils:
        shapes = shapes_of_twins(tank, shapes)
    return _merged(mesh, tank, shapes, _solved_parts(pencils, count), count)


def _solved_parts(pencils: PartPencils, count: int) -> list[Part]:
    """Solve each part for its share of the modes, and for more where the shares are not enough."""
    # Symmetric and antisymmetric modes alternate, except for a rigid motion or two.
    shares = [count if len(pencils) == 1 else count // 2 + 2] * len(pencils)
    parts = [
        Part(parity=parity, pencil=pencil, modes=solve_modes(pencil, share, shapes=0))
        for (parity, pencil), share in zip(pencils.items(), shares, strict=True)
    ]
    while True:
        limit = _rounding_limit(parts)
        # A part that gives fewer than requested has no more above rounding.
        reached = [
            min(part.modes.eigenvalues[-1], limit) if len(part.modes.eigenvalues) == share else limit
            for part, share in zip(parts, shares, strict=True)
        ]
        complete = sum(int(np.sum(part.modes.eigenvalues <= min(reached))) for part in parts)
        if complete >= count or min(reached) >= limit:
            return parts
        short = int(np.argmin(reached))
        shares[short] += max(4, count - complete)
        parts[short] = replace(parts[short], modes=solve_modes(parts[short].pencil, shares[short], shapes=0))


def _rounding_limit(parts: list[Part]) -> float:
    """Return the λ above which modes are lost in the rounding of the lowest mode of all parts."""
    lowest = (float(part.modes.eigenvalues[0]) for part in parts if len(part.modes.eigenvalues))
    return min(lowest, default=np.inf) / HIDDEN


def _merged(mesh: TankMesh, tank: Tank, shapes: tuple[int, ...], parts: list[Part], count: int) -> FieldSolution:
    values = np.concatenate([part.modes.eigenvalues for part in parts])
    # Of equal ones that of the first part comes first.
    order = np.argsort(values, kind="stable")[: min(count, np.count_nonzero(values <= _rounding_limit(parts)))]
    places = [(number, index) for number, part in enumerate(parts) for index in range(len(part.modes.eigenvalues))]
    origins = tuple(places[place] for place in order)
    bodies = whole_bodies(tank, shapes)
    extensions = [extension(tank, bodies, part.parity, len(part.pencil.surfaces)) for part in parts]
    amplitudes = np.concatenate(
        [part.modes.elastic_amplitudes @ one.amplitudes.T for part, one in zip(parts, extensions, strict=True)]
    )

    def completed(place: int) -> Mode:
        number, index = origins[place]
        mode = parts[number].modes.completed(index)
        return mode if parts[number].parity is None else _extended(mode, extensions[number])

    return FieldSolution(
        mesh=mesh,
        parts=tuple(parts),
        bodies=bodies,
        modes=ModeSet(
            eigenvalues=values[order],
            elastic_amplitudes=amplitudes[order],
            modes=(),
            completed=completed,
            zero_modes=sum(part.modes.zero_modes for part in parts),
            converged=sum(part.modes.converged for part in parts),
            growing=tuple(
                _extended(mode, one) for part, one in zip(parts, extensions, strict=True) for mode in part.modes.growing
            ),
        ),
        origins=origins,
        growing_origins=tuple(
            (number, place) for number, part in enumerate(parts) for place in range(len(part.modes.growing))
        ),
    )


def _extended(mode: Mode, extension: Extension) -> Mode:
    """Return a mode in the unknowns of all bodies; its ζ and ψ are those of its part, at unit generalized mass
    there."""
    # `replace` takes twice as long, and a sweep asks for thousands of modes.
    return Mode(
        eigenvalue=mode.eigenvalue,
        values=mode.values,
        displaced=mode.displaced,
        shaped=mode.shaped,
        residual=mode.residual,
        body_amplitudes=extension.amplitudes @ mode.body_amplitudes,
        energy=extension.energies @ mode.energy,
    )


class Extension(NamedTuple):
    """How the unknowns of a part become those of the whole tank.

    Attributes:
        amplitudes: matrix from the body unknowns of the part, each at unit generalized mass, shape (unknowns of the
            whole tank, unknowns of the part).
        energies: from shares in the potential energy, of body unknowns one by one and then of each surface.
    """

    amplitudes: np.ndarray
    energies: np.ndarray


def extension(tank: Tank, bodies: tuple[Body, ...], parity: Parity | None, surfaces: int = 0) -> Extension:
    """Return how the unknowns of a part become those of the whole tank."""
    if parity is None:
        size = sum(body.size for body in bodies)
        return Extension(np.eye(size), np.eye(size + surfaces))
    twins = tuple((body, twin_of(tank, body)) for body in left_bodies(tank))
    return _extension(tuple(body.parities for body in bodies), twins, parity, surfaces)


@lru_cache(maxsize=64)
def _extension(
    shapes: tuple[tuple[Parity, ...], ...], twins: tuple[tuple[int, int], ...], parity: Parity, surfaces: int
) -> Extension:
    offsets = np.cumsum([0, *map(len, shapes)])
    columns = []
    for body, twin in twins:
        for number, own in enumerate(shapes[body]):
            if twin == body and own != parity:
                continue
            column = np.zeros(offsets[-1])
            column[offsets[body] + number] = np.sqrt(0.5)
            if twin != body:
                # In the mirror image odd shapes change their sign.
                column[offsets[twin] + number] = np.sqrt(0.5) if own == parity else -np.sqrt(0.5)
            columns.append(column)
    amplitudes = np.array(columns).reshape(len(columns), offsets[-1]).T
    of_whole, of_part = amplitudes.shape
    energies = np.zeros((of_whole + surfaces, of_part + surfaces))
    # Energies are like the squares of amplitudes.
    energies[:of_whole, :of_part] = amplitudes**2 / (amplitudes**2).sum(axis=0)
    energies[of_whole:, of_part:] = np.eye(surfaces)
    for matrix in (amplitudes, energies):
        matrix.flags.writeable = False
    return Extension(amplitudes, energies)


def count_is_confirmed(solution: FieldSolution) -> bool:
    """Whether the inertia of K − σM in each part confirms the number of modes below σ, of `counted_below`."""
    shift = counted_below(solution.modes.eigenvalues)
    return counts_agree(solution, shift, [count_below(part.pencil, shift) for part in solution.parts])


def counted_below(eigenvalues: np.ndarray) -> float:
    """Return σ, below which modes are counted: in the widest of the last gaps between them."""
    if len(eigenvalues) < 2:
        return 2.0 * float(eigenvalues[-1]) if len(eigenvalues) else 1.0
    last = eigenvalues[-4:]
    widest = int(np.argmax(last[1:] / last[:-1]))
    return float(np.sqrt(last[widest] * last[widest + 1]))


def counts_agree(solution: FieldSolution, shift: float, counts: Sequence[int]) -> bool:
    """Return whether the numbers of modes below σ, counted in each part, are those of the modes found."""
    return all(
        count == np.count_nonzero(part.modes.eigenvalues < shift) + len(part.modes.growing)
        for part, count in zip(solution.parts, counts, strict=True)
    )
