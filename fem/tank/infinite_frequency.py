"""The infinite-frequency limit of a tank: ψ = 0 on an open top, the pressure continuous across interfaces, no waves.

It has a mesh of its own: without refinement for waves, but with stronger grading at tips; a single uniform beam needs
none, see `released_beam`. It gives the pressure-release
tones of beams: in a tank with waves the elastic energy of a stiff beam is spread over several modes, here it is in one
mode, which depends smoothly on all parameters. It gives the added mass of floats beside fixed beams, by the Ritz method
from below: M_a − M_a,h = ρ∫|∇(ψ − ψ_h)|², the energy error.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from mpi4py import MPI

from hydroelastic.fem.added_mass import body_responses
from hydroelastic.fem.bodies.registry import toned_bodies
from hydroelastic.fem.closed.tones import ElasticTone, elastic_tone
from hydroelastic.fem.progress import Report
from hydroelastic.fem.surfaces import Body
from hydroelastic.fem.tank.attempts import Attempt, best_attempt
from hydroelastic.fem.tank.error_estimates import (
    ROUNDING_OF_SPREAD,
    FrequencyErrors,
    added_mass_errors,
    frequency_errors,
    joined_errors,
)
from hydroelastic.fem.tank.field_model import whole_bodies
from hydroelastic.fem.tank.field_solution import PartPencils, extension, solve_parts
from hydroelastic.fem.tank.liquids import ANEW, Liquids
from hydroelastic.fem.tank.released_beam import ReleasedModes, released_modes
from hydroelastic.fem.tank.resolution import Resolution
from hydroelastic.meshes.distribute import TankMesh
from hydroelastic.physics.symmetry import Parity
from hydroelastic.physics.tank import Tank

_MOST_ATTEMPTS = 5
# Added mass below this part of ρ times the square (roll: fourth power) of the float's extent is rounding.
_NO_LIQUID = 1e-9


@dataclass(frozen=True, kw_only=True)
class PressureReleaseTone:
    """The first elastic tone of a beam with ψ = 0 on the free surface.

    Attributes:
        eigenvalue: dimensionless λ.
        error: estimated relative error of ω.
    """

    eigenvalue: float
    error: float


@dataclass(frozen=True, kw_only=True)
class InfiniteFrequencyAddedMass:
    """Added mass of all motions of all floats, in units of the tank.

    Attributes:
        matrix: symmetric, shape (motions, motions), the floats in the order of the tank; beams are fixed.
        error: estimated error of each entry (i, j), relative to the root of the product of the diagonal entries i and
            j.
    """

    matrix: np.ndarray
    error: float

    def block(self, tank: Tank, body: int) -> np.ndarray:
        """Return the block of one float, shape (motions, motions)."""
        first = sum(len(tank.bodies[index].rigid_motions) for index in tank.rigid if index < body)
        own = slice(first, first + len(tank.bodies[body].rigid_motions))
        return self.matrix[own, own]

    def principal(self, tank: Tank, body: int, motions: np.ndarray) -> np.ndarray:
        """Return the added mass of each principal motion of a float, shape (motions,), from `Body.motions`."""
        added: np.ndarray = np.diag(motions.T @ self.block(tank, body) @ motions)
        return added


@dataclass(frozen=True, kw_only=True)
class InfiniteFrequencyLimit:
    """Results of the limit.

    Attributes:
        tones: tone of each beam, ``None`` where it is not among the modes of the model or is lost in rounding; empty in
            a tank without waves, whose limit is the tank itself.
        eigenvalues: dimensionless λ of the lowest modes, if there are tones.
        added_mass: added mass of the floats; ``None`` without floats, or under a lid, where there is no such limit.
    """

    tones: tuple[PressureReleaseTone | None, ...] = ()
    eigenvalues: tuple[float, ...] = ()
    added_mass: InfiniteFrequencyAddedMass | None = None


def infinite_frequency_limit(
    comm: MPI.Comm,
    tank: Tank,
    first: Resolution,
    tolerance: float,
    *,
    half: bool,
    user_mesh: TankMesh | None = None,
    liquids: Liquids = ANEW,
    report: Report = lambda _message: None,
) -> InfiniteFrequencyLimit:
    """Solve the limit to a tolerance, or return the best of a few attempts (collective)."""
    # About an axis nothing moves in some orders.
    moving = [index for index in tank.rigid if tank.bodies[index].rigid_motions]
    has_tones, has_added_mass = toned_bodies(tank) and tank.has_waves, moving and tank.has_infinite_frequency_limit
    if not has_tones and not has_added_mass:
        return InfiniteFrequencyLimit()
    if has_tones:
        report("pressure-release tone")
    if has_added_mass:
        report("added mass at infinite frequency")

    def solve(resolution: Resolution) -> Attempt[InfiniteFrequencyLimit]:
        if user_mesh is None and not has_added_mass:
            released = released_modes(tank, resolution.shapes[0])
            if released is not None:
                return _released(tank, released, resolution, tolerance)
        mesh = user_mesh or liquids.mesh(comm, tank, resolution, half=half, infinite_frequency=True)
        shapes = resolution.shapes if has_tones else (0,) * len(tank.bodies)
        pencils = liquids.pencils(mesh, tank, resolution.degree, shapes, half=half, infinite_frequency=True)
        limit, causes = InfiniteFrequencyLimit(), []
        if has_tones:
            limit, of_tones = _with_tones(limit, mesh, tank, resolution, pencils, tolerance)
            causes.append(of_tones)
        if has_added_mass:
            added_mass, of_added_mass = _added_mass(tank, resolution, shapes, pencils)
            limit = replace(limit, added_mass=added_mass)
            causes.append(of_added_mass)
        return Attempt(
            result=limit, causes=joined_errors(causes), resolution=resolution, missing=limit.tones.count(None)
        )

    remesh = user_mesh is None
    return best_attempt(
        tank,
        tolerance,
        solve,
        first,
        rounds=_MOST_ATTEMPTS,
        infinite_frequency=True,
        remesh=remesh,
    ).result


def _released(
    tank: Tank, modes: ReleasedModes, resolution: Resolution, tolerance: float
) -> Attempt[InfiniteFrequencyLimit]:
    found = elastic_tone(modes.eigenvalues, modes.elastic_amplitudes, modes.bodies, 0)
    errors, tone = modes.errors_of(found.index), None
    if not _is_hidden(modes.eigenvalues, found, tolerance):
        tone = PressureReleaseTone(eigenvalue=float(modes.eigenvalues[found.index]), error=errors.largest_total)
    return Attempt(
        result=InfiniteFrequencyLimit(tones=(tone,), eigenvalues=tuple(map(float, modes.eigenvalues))),
        causes=errors,
        resolution=resolution,
        missing=int(tone is None),
    )


def _with_tones(
    limit: InfiniteFrequencyLimit,
    mesh: TankMesh,
    tank: Tank,
    resolution: Resolution,
    pencils: PartPencils,
    tolerance: float,
) -> tuple[InfiniteFrequencyLimit, FrequencyErrors]:
    """Solve for more modes until they contain the tone of each beam."""
    count = resolution.modes
    while True:
        field = solve_parts(mesh, tank, resolution.shapes, pencils, count)
        values, amplitudes = field.modes.eigenvalues, field.modes.elastic_amplitudes
        found = [elastic_tone(values, amplitudes, field.bodies, body) for body in toned_bodies(tank)]
        if all(tone.certain for tone in found) or len(field.modes.eigenvalues) < count:
            break
        count *= 2
    seen = [tone.certain and not _is_hidden(field.modes.eigenvalues, tone, tolerance) for tone in found]
    indices = sorted({tone.index for tone, is_seen in zip(found, seen, strict=True) if is_seen})
    modes = [field.modes.completed(index) for index in indices]
    causes = frequency_errors(
        field, modes, [field.origins[index] for index in indices], resolution, tank, infinite_frequency=True
    )
    tones = {
        index: PressureReleaseTone(eigenvalue=mode.eigenvalue, error=float(error))
        for index, mode, error in zip(indices, modes, causes.total, strict=True)
    }
    return replace(
        limit,
        tones=tuple(tones[tone.index] if is_seen else None for tone, is_seen in zip(found, seen, strict=True)),
        eigenvalues=tuple(field.modes.eigenvalues),
    ), causes


def _is_hidden(values: np.ndarray, tone: ElasticTone, tolerance: float) -> bool:
    """Whether a beam is rigid to double precision: its tone is lost in the rounding of the lowest mode."""
    return bool(ROUNDING_OF_SPREAD * values[tone.index] > tolerance * values[0])


def _added_mass(
    tank: Tank, resolution: Resolution, shapes: tuple[int, ...], pencils: PartPencils
) -> tuple[InfiniteFrequencyAddedMass, FrequencyErrors]:
    """Return the added mass of the floats, with its relative errors."""
    bodies = whole_bodies(tank, shapes)
    of_floats = np.repeat([index in tank.rigid for index in range(len(bodies))], [body.size for body in bodies])
    matrix = np.zeros((of_floats.sum(), of_floats.sum()))
    causes = []
    for parity, pencil in pencils.items():
        restriction = _restriction(tank, bodies, parity)[of_floats]
        moving = np.flatnonzero(restriction.any(axis=0))
        restriction = restriction[:, moving]
        added, potentials = body_responses(pencil, moving)
        matrix += restriction @ added @ restriction.T
        relevant = np.flatnonzero(_is_relevant(tank, restriction, added))
        own = [potentials[place] for place in relevant]
        diagonal = np.diag(added)[relevant]
        causes.append(added_mass_errors(pencil.liquid, own, diagonal, tank, resolution, half=parity is not None))
    errors = joined_errors(causes)
    from scipy.linalg import block_diag  # slow to import

    turns = block_diag(*(bodies[index].motions for index in tank.rigid))
    physical = np.linalg.solve(turns.T, np.linalg.solve(turns.T, matrix).T)
    return InfiniteFrequencyAddedMass(matrix=0.5 * (physical + physical.T), error=errors.largest_total), errors


def _restriction(tank: Tank, bodies: tuple[Body, ...], parity: Parity | None) -> np.ndarray:
    """Return the map from motions of the whole tank to those of a part (columns), with which energies of parts add
    up."""
    columns = extension(tank, bodies, parity).amplitudes
    if parity is None:
        return columns
    # A body cut by the mirror plane has the same motion in both halves; of two mirrored bodies each half has the
    # mean, or the difference.
    restriction: np.ndarray = np.sqrt(2.0) * np.sign(columns) / np.count_nonzero(columns, axis=0)
    return restriction


def _is_relevant(tank: Tank, restriction: np.ndarray, added: np.ndarray) -> np.ndarray:
    """Whether each motion of a part moves liquid, shape (motions,): a circle that rotates about its centre does not."""
    scales = np.array(
        [
            tank.hulls[index].smallest_extent ** (4 if motion.is_rotation else 2)
            for index in tank.rigid
            for motion in tank.bodies[index].rigid_motions
        ]
    )
    own = np.abs(np.sign(restriction)).T @ scales
    relevant: np.ndarray = np.diag(added) > _NO_LIQUID * own
    return relevant
