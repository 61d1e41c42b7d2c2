"""Solve a scene with open ends."""

from __future__ import annotations

from mpi4py import MPI

from hydroelastic.fem.open_water.decay import DriftingFloatError, UnstableFloatError
from hydroelastic.fem.open_water.solve import solve_open_water
from hydroelastic.fem.progress import Report
from hydroelastic.fem.solver_error import EigenSolverError
from hydroelastic.fem.time_domain.motion import UnsolvedMotionError
from hydroelastic.meshes.tagged_mesh import MeshError
from hydroelastic.scenes.errors import Problem, SceneError, UnsolvedError, cannot_be_meshed
from hydroelastic.scenes.models.tank_parts import TankParts
from hydroelastic.scenes.open_water.physics import open_water_problem
from hydroelastic.scenes.open_water.results import OpenSolution


def solve_open(scene: TankParts, comm: MPI.Comm, report: Report) -> OpenSolution:
    """Solve all analyses of a scene with open ends (collective)."""
    requests = tuple(analysis.request for analysis in scene.analyses)
    try:
        solved = solve_open_water(open_water_problem(scene, comm), requests, report)
    except MeshError as error:
        raise cannot_be_meshed(error) from error
    except EigenSolverError as error:
        raise UnsolvedError(f"the eigen-solver failed: {error}") from error
    except UnsolvedMotionError as error:
        raise UnsolvedError(f"a motion in waves grows without bound: {error}") from error
    except UnstableFloatError:
        wrong, remedy = "a float is unstable and would capsize", "Lower its centre of mass"
    except DriftingFloatError as error:
        motions = " and ".join(error.motions)
        wrong = f"the float would drift away: the release excites {motions}, without restoring force"
        remedy = f"Leave {motions} out of motions, or release it in another motion"
    else:
        return OpenSolution(scene=scene, **vars(solved))
    raise SceneError(Problem(key='[[analysis]] key "displacement"', wrong=wrong, remedy=remedy))
