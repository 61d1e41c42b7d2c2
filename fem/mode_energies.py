"""The residual of a mode, and what has its potential energy."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from petsc4py import PETSc

from hydroelastic.fem.pencil import CoupledPencil


def residual_of(
    pencil: CoupledPencil,
    solver: PETSc.KSP,
    eigenvalue: float,
    displacement: PETSc.Vec,
    potential: PETSc.Vec,
    force: PETSc.Vec,
) -> float:
    """Relative residual of a mode in the norm of K⁻¹ (collective)."""
    residual, image = force.copy(), force.duplicate()
    pencil.momentum.multTranspose(potential, image)
    residual.axpy(-eigenvalue, image)
    pencil.mass.mult(displacement, image)
    residual.axpy(-eigenvalue, image)
    solver.solve(residual, image)
    return float(np.sqrt(abs(residual.dot(image) / force.dot(displacement))))


def energy_shares(pencil: CoupledPencil, displacement: PETSc.Vec, force: PETSc.Vec) -> np.ndarray:
    """Shares in the potential energy, from ζ and Kζ: body unknowns one by one, then each surface (collective)."""
    total = displacement.dot(force)
    bodies = pencil.body_values(displacement) * pencil.body_values(force)
    comm = displacement.comm.tompi4py()
    local = displacement.array_r * force.array_r
    stops = np.cumsum([len(local) - sum(pencil.surface_sizes), *pencil.surface_sizes])
    surfaces = [comm.allreduce(float(local[start:stop].sum())) for start, stop in pairwise(stops)]
    return np.array([*bodies, *surfaces]) / total
