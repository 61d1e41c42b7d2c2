"""Solve the scene of a hanging string by the method that it needs."""

from __future__ import annotations

from typing import TYPE_CHECKING

from hydroelastic.fem.stopwatch import Report
from hydroelastic.scenes.models.string import StringScene
from hydroelastic.scenes.string.results import StringSolution

if TYPE_CHECKING:
    from mpi4py import MPI


def solve_string(scene: StringScene, comm: MPI.Comm, report: Report = lambda _message: None) -> StringSolution:
    """Solve for the displacement and the free motions (collective).

    Args:
        scene: the scene.
        comm: MPI communicator.
        report: told what is being done.

    Raises:
        UnsolvedError: if the eigen-solver of a field solution fails.
    """
    report(scene.method)
    if scene.method == "series":
        from hydroelastic.scenes.string.series import solve_series

        return solve_series(scene)
    # A series needs neither dolfinx nor PETSc.
    from hydroelastic.scenes.string.field import solve_string_field

    return solve_string_field(scene, comm, report)
