"""Added mass in open water far above the waves: ψ = 0 on an open top, liquids that move as one, no damping."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from mpi4py import MPI

from hydroelastic.fem.added_mass import body_responses
from hydroelastic.fem.liquid import compile_form
from hydroelastic.scenes.certainty import FrequencyErrors, boundary_error, energies_missed
from hydroelastic.scenes.field_model import build_field_model, distributed_mesh
from hydroelastic.scenes.field_solution import Stopwatch
from hydroelastic.scenes.models import TankScene
from hydroelastic.scenes.open_attempts import Attempt, attempted
from hydroelastic.scenes.open_basin import open_basin, reach
from hydroelastic.scenes.open_model import ANGLE, GROWTH, OpenModel, open_mesh
from hydroelastic.scenes.plan import Resolution, resolution_for, rounding_error, sharpest_exponent, workable_tolerance

# Nothing travels; in units of the basin this is a length like its own.
_NO_WAVE = 1.0


def released_added_mass(
    comm: MPI.Comm, scene: TankScene, shapes: tuple[int, ...], watch: Stopwatch
) -> tuple[np.ndarray, float]:
    """Solve to the scene's tolerance.

    Args:
        comm: MPI communicator.
        scene: with open ends.
        shapes: number of dry modes of each beam, 0 for floats.
        watch: told the time.

    Returns:
        a(∞) in the bodies' unknowns and in units of a basin as long as that of long waves, and its relative error
        (collective).
    """
    basin = open_basin(scene, 0.0)
    tank = basin.tank
    tolerance = workable_tolerance(scene.accuracy.tolerance, tank.depth)
    exponent = sharpest_exponent(tank, released=True)
    first = resolution_for(tank, tolerance, (0.0,) * len(tank.pieces), exponent=exponent)

    def solve(resolution: Resolution) -> Attempt[np.ndarray]:
        frames = reach(basin, (_NO_WAVE, _NO_WAVE), first=0.5, growth=GROWTH, angle=ANGLE, tolerance=tolerance)
        with watch.stage("mesh"):
            mesh = distributed_mesh(comm, lambda: open_mesh(basin, resolution, frames, released=True))
        with watch.stage("forms"):
            compile_form(mesh, resolution.degree, glued=tank.moves_as_one)
        with watch.stage("added mass"):
            pencil = build_field_model(mesh, tank, degree=resolution.degree, shapes=shapes, pressure_release=True)
            matrix, potentials = body_responses(pencil)
            away, tips = energies_missed(pencil.liquid, potentials, tank, resolution, half=False, released=True)
        scale = np.maximum(np.diag(matrix), np.finfo(float).tiny)
        causes = FrequencyErrors(
            liquid=away / scale + boundary_error(mesh, tank),
            tips=tips / scale,
            truncation=np.zeros(len(scale)),
            rounding=np.full(len(scale), 2.0 * rounding_error(resolution.degree, min(tank.depth, 1.0))),
        )
        return Attempt(result=matrix, causes=causes, resolution=resolution)

    best = attempted(solve, replace(first, shapes=shapes), tolerance, exponent)
    return best.result, best.error
