"""The solution of the scene of a tank of revolution, as that of any tank in three dimensions."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from mpi4py import MPI

from hydroelastic.fem.stopwatch import Report
from hydroelastic.scenes.errors import Problem, SceneError, UnsolvedError
from hydroelastic.scenes.models.physical import physical_tank
from hydroelastic.scenes.models.round_tank import RoundTankScene

if TYPE_CHECKING:
    from hydroelastic.fem.level_bed.solution import LevelSolution


@dataclass(frozen=True, kw_only=True)
class SolvedRoundTank:
    """The field solution of a tank of revolution.

    Attributes:
        scene: the scene.
        tank: its field solution.
    """

    scene: RoundTankScene
    tank: LevelSolution
    exact: tuple[()] = ()
    estimates: tuple[()] = ()

    @property
    def reasons(self) -> tuple[str, ...]:
        """Reasons why the tolerance is not kept; empty if it is."""
        return self.tank.reasons

    @property
    def seconds(self) -> dict[str, float]:
        """Time by stage, s."""
        return self.tank.seconds


def solve_round_scene(scene: RoundTankScene, comm: MPI.Comm, report: Report) -> SolvedRoundTank:
    """Solve a tank of revolution (collective).

    Raises:
        SceneError: if no mesh can be made.
        UnsolvedError: if the eigen-solver fails.
    """
    from hydroelastic.fem.modes import EigenSolverError
    from hydroelastic.fem.tank.round_solution import round_solution
    from hydroelastic.meshes.tagged_mesh import MeshError

    asked = scene.accuracy
    try:
        solution = round_solution(
            physical_tank(scene), tolerance=asked.tolerance, modes=asked.modes, comm=comm, report=report
        )
    except MeshError as error:
        problem = Problem(wrong=f"no mesh could be made: {error}", remedy="Please report this scene")
        raise SceneError(problem) from error
    except EigenSolverError as error:
        raise UnsolvedError(f"the eigen-solver failed: {error}") from error
    return SolvedRoundTank(scene=scene, tank=solution)
