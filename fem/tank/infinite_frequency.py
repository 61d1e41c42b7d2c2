"""Added mass of floats far above the waves: no gravity, ψ = 0 on an open top, liquids that move as one.

The Ritz method gives it from below: M_a − M_a,h = ρ∫|∇(ψ − ψ_h)|², the missing energy of the motion.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from mpi4py import MPI
from scipy.linalg import block_diag

from hydroelastic.fem.added_mass import body_responses
from hydroelastic.fem.bodies.rigid_float import principal_motions
from hydroelastic.fem.liquid import compile_form
from hydroelastic.fem.stopwatch import Stopwatch
from hydroelastic.fem.surfaces import Body
from hydroelastic.fem.tank.error_estimates import FrequencyErrors, boundary_error, energies_missed, refined
from hydroelastic.fem.tank.field_model import build_mesh, whole_bodies
from hydroelastic.fem.tank.field_solution import extension, part_models
from hydroelastic.fem.tank.resolution import Resolution, companion_resolution, rounding_error, sharpest_exponent
from hydroelastic.meshes.distribute import TankMesh
from hydroelastic.physics.symmetry import Parity
from hydroelastic.physics.tank import Tank

_MOST_ATTEMPTS = 5
# Added mass below this part of ρ times the square (roll: fourth power) of the float's extent is rounding.
_NO_LIQUID = 1e-9


@dataclass(frozen=True, kw_only=True)
class HighFrequencyAddedMass:
    """Added mass of all motions of all floats, in units of the tank.

    Attributes:
        matrix: symmetric, shape (motions, motions), the floats in the scene's order; beams are held still.
        error: estimated error of each entry, as a part of the root of its row's and column's diagonal entries.
    """

    matrix: np.ndarray
    error: float

    def block(self, tank: Tank, body: int) -> np.ndarray:
        """The part of one float, of its own motions in its own movement, shape (motions, motions)."""
        first = sum(len(tank.floats[index].motions) for index in tank.floats if index < body)
        own = slice(first, first + len(tank.floats[body].motions))
        return self.matrix[own, own]

    def principal(self, tank: Tank, body: int) -> np.ndarray:
        """Added mass of each of a float's principal motions, shape (motions,)."""
        turn = principal_motions(tank.floats[body], tank.floats[body].motions)[0]
        added: np.ndarray = np.diag(turn.T @ self.block(tank, body) @ turn)
        return added


def high_frequency_added_mass(
    comm: MPI.Comm, tank: Tank, tolerance: float, watch: Stopwatch, *, half: bool
) -> HighFrequencyAddedMass:
    """Solve for it to a tolerance, or as near to it as a few attempts come.

    Args:
        comm: MPI communicator.
        tank: the scene; it has floats.
        tolerance: asked relative error.
        watch: told the time.
        half: whether the tank is its own mirror image and is solved as two halves.

    Returns:
        The matrix and its error (collective).
    """
    resolution: Resolution | None = companion_resolution(tank, tolerance, (0.0,) * len(tank.beams))
    exponent = sharpest_exponent(tank, released=True)
    best: HighFrequencyAddedMass | None = None
    for _ in range(_MOST_ATTEMPTS):
        if resolution is None:
            break
        with watch.stage("added mass"):
            mesh = build_mesh(comm, tank, resolution, half=half, released=True)
        with watch.stage("forms"):
            compile_form(mesh, resolution.degree, glued=tank.moves_as_one)
        with watch.stage("added mass"):
            found, causes = _solved(mesh, tank, resolution, half=half)
        if best is None or found.error < best.error:
            best = found
        if found.error <= tolerance:
            break
        resolution = refined(resolution, causes, tolerance, exponent=exponent, own_mesh=True)
    assert best is not None
    return best


def _solved(
    mesh: TankMesh, tank: Tank, resolution: Resolution, *, half: bool
) -> tuple[HighFrequencyAddedMass, FrequencyErrors]:
    shapes = (0,) * len(tank.bodies)
    parities, pencils = part_models(mesh, tank, resolution.degree, shapes, half=half, pressure_release=True)
    bodies = whole_bodies(tank, shapes)
    size = sum(body.size for body in bodies)
    matrix, liquid, tips = np.zeros((size, size)), [np.zeros(0)], [np.zeros(0)]
    for pencil, parity in zip(pencils, parities, strict=True):
        own, potentials = body_responses(pencil)
        restriction = _restriction(tank, bodies, parity)
        matrix += restriction @ own @ restriction.T
        away, at_tips = energies_missed(pencil.liquid, potentials, tank, resolution, half=half, released=True)
        relevant = _relevant(tank, restriction, own)
        liquid.append(away[relevant] / np.diag(own)[relevant])
        tips.append(at_tips[relevant] / np.diag(own)[relevant])
    causes = FrequencyErrors(
        liquid=np.concatenate(liquid) + boundary_error(mesh, tank),
        tips=np.concatenate(tips),
        truncation=np.zeros(1),
        rounding=np.full(1, 2.0 * rounding_error(resolution.degree, tank.depth)),
    )
    turns = block_diag(*(principal_motions(body, body.motions)[0] for body in tank.floats.values()))
    physical = np.linalg.solve(turns.T, np.linalg.solve(turns.T, matrix).T)
    total = sum(causes.largest(cause) for cause in ("liquid", "tips", "rounding"))
    return HighFrequencyAddedMass(matrix=0.5 * (physical + physical.T), error=total), causes


def _restriction(tank: Tank, bodies: tuple[Body, ...], parity: Parity | None) -> np.ndarray:
    """From motions of the whole tank to those of a part (as columns), so that energies of all parts add up."""
    columns = extension(tank, bodies, parity)
    if parity is None:
        return columns
    # A body that the mirror plane cuts moves alike in both halves; of twins each half has the mean, or the difference.
    restriction: np.ndarray = np.sqrt(2.0) * np.sign(columns) / np.count_nonzero(columns, axis=0)
    return restriction


def _relevant(tank: Tank, restriction: np.ndarray, added: np.ndarray) -> np.ndarray:
    """The motions of a part that move liquid: a circle that turns about its centre does not."""
    scales = np.concatenate(
        [
            [body.hull.smallest_extent ** (4 if motion == "roll" else 2) for motion in body.motions]
            for body in tank.floats.values()
        ]
    )
    own = np.abs(np.sign(restriction)).T @ scales
    relevant: np.ndarray = np.diag(added) > _NO_LIQUID * own
    return relevant
