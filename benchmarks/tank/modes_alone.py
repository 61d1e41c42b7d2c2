"""The tanks on this solver, as far as the scripts of the peers go: one solution of planned resolution, and no more.

Mesh, matrices and modes are those of `solve_scene`; left out are estimate, count, pressure-release tone and first
elastic tone.
"""

from __future__ import annotations

import numpy as np
from mpi4py import MPI

from hydroelastic.benchmarks.cases import Answer, Case
from hydroelastic.benchmarks.tank import hydroelastic as hydroelastic_tank
from hydroelastic.benchmarks.tank.cases import MODES
from hydroelastic.benchmarks.tank.hydroelastic import versions as versions
from hydroelastic.fem.tank.field_solution import solve_field
from hydroelastic.fem.tank.liquids import ANEW
from hydroelastic.fem.tank.resolution import initial_resolution
from hydroelastic.physics.symmetry import is_mirror_image
from hydroelastic.scenes.models.physical import physical_tank
from hydroelastic.scenes.models.tank import TankScene


def prepare(case: Case) -> TankScene:
    """The tank of a case as a scene."""
    return hydroelastic_tank.prepare(case)


def solve(scene: TankScene) -> Answer:
    """The ten lowest frequencies."""
    physical = physical_tank(scene)
    tank = physical.scaled()
    half = is_mirror_image(tank)
    resolution = initial_resolution(tank, scene.accuracy.tolerance, modes=MODES)
    mesh = ANEW.mesh(MPI.COMM_WORLD, tank, resolution, half=half)
    field = solve_field(mesh, tank, resolution, MODES, half=half)
    return Answer(
        values=tuple(map(float, np.sqrt(field.modes.eigenvalues) * physical.units.frequency)),
        unknowns=field.dofs,
    )
