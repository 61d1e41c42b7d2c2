"""Solve the scene of a hanging string, by series or as a field."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from hydroelastic.fem.progress import Report
from hydroelastic.modal.string.solution import StringSolution, series_solution
from hydroelastic.scenes.errors import UnsolvedError
from hydroelastic.scenes.models.string import StringScene
from hydroelastic.scenes.string.physics import end_motion
from hydroelastic.scenes.string.results import StringResult

if TYPE_CHECKING:
    from mpi4py import MPI


def solve_string(scene: StringScene, comm: MPI.Comm, report: Report = lambda _message: None) -> StringResult:
    """Solve for the displacement and the free motions by the method of the scene (collective)."""
    report(scene.method)
    if scene.method == "series":
        return StringResult(scene=scene, solution=solve_series(scene))
    return StringResult(scene=scene, solution=solve_string_field(scene, comm, report))


def solve_series(
    scene: StringScene, positions: NDArray[np.float64] | None = None, times: NDArray[np.float64] | None = None
) -> StringSolution:
    """Sum the series of a scene with a uniform resistance and no tip mass."""
    return series_solution(
        scene.string.physical,
        end_motion(scene),
        np.array(scene.positions) if positions is None else positions,
        np.array(scene.times) if times is None else times,
        tolerance=scene.accuracy.tolerance,
        modes=scene.accuracy.modes,
    )


def solve_string_field(scene: StringScene, comm: MPI.Comm, report: Report = lambda _message: None) -> StringSolution:
    """Solve a scene as a field, whatever its method (collective)."""
    # A series needs neither dolfinx nor PETSc.
    from hydroelastic.fem.solver_error import EigenSolverError
    from hydroelastic.fem.string.solution import field_solution

    try:
        return field_solution(
            comm,
            scene.string.physical,
            end_motion(scene),
            np.array(scene.positions),
            np.array(scene.times),
            tolerance=scene.accuracy.tolerance,
            modes=scene.accuracy.modes,
            report=report,
        )
    except EigenSolverError as error:
        raise UnsolvedError(f"the eigen-solver failed: {error}") from error
