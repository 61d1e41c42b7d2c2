"""Solutions of a study, each with its errors against the reference and its cost."""

from __future__ import annotations

from collections.abc import Callable
from time import perf_counter

import numpy as np
from mpi4py import MPI

from hydroelastic.fem.progress import peak_memory
from hydroelastic.fem.spectral_error import LOWEST_DEGREE
from hydroelastic.fem.study.row import Family, StudyRow
from hydroelastic.fem.study.studied_tank import StudiedTank
from hydroelastic.fem.tank.error_estimates import frequency_errors
from hydroelastic.fem.tank.field_solution import solve_field
from hydroelastic.fem.tank.resolution import Resolution
from hydroelastic.fem.tank.solve import solve_tank
from hydroelastic.meshes.distribute import TankMesh


def mesh_row(
    studied: StudiedTank,
    family: Family,
    resolution: Resolution,
    make_mesh: Callable[[], TankMesh],
    *,
    element_size: float,
    grading: float | None = None,
) -> StudyRow | None:
    """Solve once on a given mesh (collective)."""
    estimate, start = None, perf_counter()
    with peak_memory(MPI.COMM_WORLD) as memory:
        mesh = make_mesh()
        field = solve_field(mesh, studied.tank, resolution, studied.modes, half=studied.half)
        # The estimate assumes that the singularity is within the rings.
        if resolution.degree >= LOWEST_DEGREE and family == "geometric":
            indices = list(range(len(field.modes.eigenvalues)))
            modes = [field.modes.completed(index) for index in indices]
            causes = frequency_errors(
                field, modes, [field.origins[index] for index in indices], resolution, studied.tank
            )
            estimate = float(causes.total.max())
    seconds = perf_counter() - start
    omega = np.sqrt(field.modes.eigenvalues) * studied.physical.units.frequency
    if len(omega) < min(studied.modes, len(studied.reference.omega)):
        return None
    return StudyRow(
        family=family,
        degree=resolution.degree,
        element_size=element_size,
        grading=grading,
        tolerance=None,
        unknowns=field.dofs,
        errors=studied.errors(omega),
        floor=studied.floor(resolution.degree),
        estimate=estimate,
        reasons=(),
        seconds=seconds,
        memory=memory.peak,
    )


def tolerance_row(studied: StudiedTank, tolerance: float) -> StudyRow:
    """Solve to a relative tolerance as a run does, with estimates, count, tones and refinement (collective)."""
    start = perf_counter()
    with peak_memory(MPI.COMM_WORLD) as memory:
        solution = solve_tank(studied.physical, tolerance=tolerance, modes=studied.modes)
    seconds = perf_counter() - start
    omega = np.array([solution.omega(mode.eigenvalue) for mode in solution.asked])
    return StudyRow(
        family="tolerance",
        degree=solution.resolution.degree,
        element_size=max(solution.resolution.surface_sizes),
        grading=None,
        tolerance=tolerance,
        unknowns=solution.field.dofs,
        errors=studied.errors(omega),
        floor=studied.floor(solution.resolution.degree),
        estimate=float(solution.relative_errors[: len(omega)].max()),
        reasons=solution.reasons,
        seconds=seconds,
        memory=memory.peak,
    )
