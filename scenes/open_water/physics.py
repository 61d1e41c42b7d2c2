"""From a scene with open ends to what the solvers of open water take."""

from __future__ import annotations

from mpi4py import MPI

from hydroelastic.fem.open_water.problem import OpenWaterProblem
from hydroelastic.scenes.models.physical import physical_tank
from hydroelastic.scenes.models.tank_parts import TankParts


def open_water_problem(scene: TankParts, comm: MPI.Comm) -> OpenWaterProblem:
    """Return the open water of a scene, to be solved to its tolerance."""
    return OpenWaterProblem(comm=comm, tank=physical_tank(scene), tolerance=scene.accuracy.tolerance)
