"""The solution of the scene of a tank of revolution, as that of any tank in three dimensions."""

from __future__ import annotations

from mpi4py import MPI

from hydroelastic.fem.progress import Report
from hydroelastic.modal.liquid.sloping_walls import lowest_between_slopes
from hydroelastic.modal.plate.round_estimates import round_plate_estimates
from hydroelastic.scenes.errors import UnsolvedError, cannot_be_meshed
from hydroelastic.scenes.level_tank.solve import SolvedLevelTank
from hydroelastic.scenes.models.physical import physical_tank
from hydroelastic.scenes.models.round_tank import OrderedTankScene


def solve_round_scene(scene: OrderedTankScene, comm: MPI.Comm, report: Report) -> SolvedLevelTank:
    """Solve a tank of revolution, or of one section over a width, and estimate it (collective)."""
    from hydroelastic.fem.solver_error import EigenSolverError
    from hydroelastic.fem.tank.round_solution import round_solution
    from hydroelastic.meshes.tagged_mesh import MeshError

    asked, physical = scene.accuracy, physical_tank(scene)
    try:
        solution = round_solution(physical, tolerance=asked.tolerance, modes=asked.modes, comm=comm, report=report)
    except MeshError as error:
        raise cannot_be_meshed(error, scene) from error
    except EigenSolverError as error:
        raise UnsolvedError(f"the eigen-solver failed: {error}") from error
    exact = lowest_between_slopes(physical)
    estimates = tuple(round_plate_estimates(physical, solution.physical))
    return SolvedLevelTank(scene=scene, tank=solution, exact=exact, estimates=estimates)
