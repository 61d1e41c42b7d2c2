"""The solution of the scene of a tank in three dimensions."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from typing import TYPE_CHECKING

from mpi4py import MPI

from hydroelastic.fem.progress import Report
from hydroelastic.modal.plate.closed_forms import exact_frequencies
from hydroelastic.modal.plate.estimates import plate_estimates
from hydroelastic.output.level_tank.floats import FloatAtRest, floats_at_rest
from hydroelastic.physics.volume_tank import VolumeTank
from hydroelastic.scenes.errors import Problem, SceneError, UnsolvedError, cannot_be_meshed
from hydroelastic.scenes.models.level_tank import LevelTankScene
from hydroelastic.scenes.models.level_tank_physics import physical_level_tank
from hydroelastic.scenes.models.round_tank import OrderedTankScene

if TYPE_CHECKING:
    from hydroelastic.fem.level_bed.solution import LevelSolution
    from hydroelastic.modal.plate.closed_forms import ExactMode
    from hydroelastic.modal.plate.estimates import PlateEstimate


@dataclass(frozen=True, kw_only=True)
class SolvedLevelTank:
    """The field solution of a tank in three dimensions, and closed forms and estimates for comparison.

    Attributes:
        scene: the scene.
        tank: its field solution.
        floats: those with draught, at rest.
        exact: the frequencies of a closed form, if there is one, ascending.
        estimates: those of the plates.
    """

    scene: LevelTankScene | OrderedTankScene
    tank: LevelSolution
    floats: tuple[FloatAtRest, ...] = ()
    exact: tuple[ExactMode, ...] = ()
    estimates: tuple[PlateEstimate, ...] = ()

    @property
    def reasons(self) -> tuple[str, ...]:
        """Reasons why the tolerance is not kept; empty if it is."""
        return self.tank.reasons


def solve_level_scene(scene: LevelTankScene, comm: MPI.Comm, report: Report) -> SolvedLevelTank:
    """Solve a tank in three dimensions and estimate it (collective)."""
    require_treated(scene)
    from hydroelastic.fem.plan.solve import solve_smallest_model
    from hydroelastic.fem.solver_error import EigenSolverError, TooLargeError
    from hydroelastic.meshes.tagged_mesh import MeshError

    physical = physical_level_tank(scene)
    exact: tuple[ExactMode, ...] = ()
    estimates: tuple[PlateEstimate, ...] = ()
    if not isinstance(physical, VolumeTank) or physical.is_level:
        exact = exact_frequencies(physical, scene.accuracy.modes)
        estimates = plate_estimates(physical)
    try:
        with misplacements():
            solution = solve_smallest_model(
                physical, tolerance=scene.accuracy.tolerance, modes=scene.accuracy.modes, comm=comm, report=report
            )
    except (EigenSolverError, TooLargeError) as error:
        raise UnsolvedError(f"the tank could not be solved: {error}") from error
    except MeshError as error:
        raise cannot_be_meshed(error, scene) from error
    if not solution.modes:
        wrong = "nothing oscillates: no water is free, and no plate can move against a restoring force"
        raise SceneError(Problem(key="[[body]]", wrong=wrong, remedy="Leave a part of the top free"), file=None)
    return SolvedLevelTank(
        scene=scene,
        tank=solution,
        floats=floats_at_rest(physical),
        exact=exact,
        estimates=estimates,
    )


def require_treated(scene: LevelTankScene) -> None:
    """Refuse a tank that no solver takes."""
    from hydroelastic.fem.level_bed.choice import NotTreatedError, level_model

    try:
        level_model(physical_level_tank(scene))
    except NotTreatedError as error:
        raise SceneError(Problem(key="[[body]]", wrong=str(error), allowed=TREATED), file=None) from error


@contextmanager
def misplacements() -> Iterator[None]:
    """Turn what only the making of a volume shows, such as a baffle beside the tank, into an error of the scene."""
    from hydroelastic.meshes.tagged_mesh import MisplacedError

    try:
        yield
    except MisplacedError as error:
        remedy = "Move it, or change its size"
        raise SceneError(Problem(key="[tank]", wrong=str(error), remedy=remedy), file=None) from error


TREATED = (
    "strips and rectangles in a box; discs and rings about the axis of a cylinder; rectangles, discs, rings and free "
    "polygons that keep off the walls or cover the plan; tanks without plates; strips and polygons with sides on walls "
    'also beside others, with model = "volume" in [tank]'
)
"""Tanks that are solved."""
