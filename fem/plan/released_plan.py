"""ψ = 0 on the water of a plan of triangles; see `released`."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from petsc4py import PETSc

from hydroelastic.fem.direct import direct_solver
from hydroelastic.fem.plan.plan_pencil import PlanPlate, PlanSpace, water_unknowns
from hydroelastic.fem.plan.released import ReleasedProblem
from hydroelastic.modal.liquid.vertical_poles import VerticalPoles, vertical_poles
from hydroelastic.physics.arrays import FloatArray

# Error of the poles of P.
_ROUGH = 0.05


@dataclass(frozen=True, kw_only=True)
class _PoleStiffness:
    """A = 1/f_h of the plan's Laplacian: α K₂ + β M₂ − Σ_i γ_i M₂ (K₂ + δ_i M₂)⁻¹ M₂ with f_h(−δ_i) = 0."""

    space: PlanSpace
    poles: VerticalPoles

    @cached_property
    def _parts(self) -> tuple[float, FloatArray, FloatArray]:
        poles = self.poles
        roots = np.sqrt(poles.weights / poles.weights.sum())
        others = np.linalg.svd(roots[None])[2][1:].T
        zeros = np.linalg.eigvalsh(others.T @ (poles.shifts[:, None] * others))
        factors = 1.0 / (poles.weights / (poles.shifts - zeros[:, None]) ** 2).sum(axis=1)
        return 1.0 / float(poles.weights.sum()), factors, zeros

    @cached_property
    def _solvers(self) -> list[PETSc.KSP]:
        return [_factorized(self.space.stiffness, self.space.mass, shift) for shift in self._parts[2]]

    def product(self, values: PETSc.Vec) -> FloatArray:
        """Return A ψ."""
        space = self.space
        slope, factors, zeros = self._parts
        mass, part = space.mass * values, values.duplicate()
        total = slope * (space.stiffness * values).array_r + (factors / zeros).sum() * mass.array_r
        for factor, solver in zip(factors, self._solvers, strict=True):
            solver.solve(mass, part)
            total = total - factor * (space.mass * part).array_r
        return np.asarray(total)


def released_plan(space: PlanSpace, poles: VerticalPoles, plates: tuple[PlanPlate, ...]) -> ReleasedProblem:
    """Return the problem of a symmetry class of a plan in which the plates move, alike on each process.

    P is that of a few poles under the plates with ψ = 0 at their edges.
    """
    free = np.setdiff1d(np.arange(space.size), water_unknowns(space))
    rows = PETSc.IS().createGeneral(free.astype(PETSc.IntType), comm=PETSc.COMM_SELF)
    stiffness, mass = (matrix.createSubMatrix(rows, rows) for matrix in (space.stiffness, space.mass))
    few = vertical_poles(1.0 / float(poles.weights[0]), poles.wavenumber, _ROUGH, lowest=1.0)
    solvers = [_factorized(stiffness, mass, shift) for shift in few.shifts]
    operator, whole = _PoleStiffness(space=space, poles=poles), space.mass.createVecRight()
    right, left = mass.createVecs()

    def apply(values: FloatArray) -> FloatArray:
        whole.array[free] = values
        return operator.product(whole)[free]

    def precondition(values: FloatArray) -> FloatArray:
        left.array[:] = values
        total = np.zeros_like(values)
        for weight, solver in zip(few.weights, solvers, strict=True):
            solver.solve(left, right)
            total += weight * right.array_r
        return total

    moving = tuple(plate for plate in plates if plate.body.size)
    return ReleasedProblem(
        bodies=tuple(plate.body for plate in moving),
        free=free,
        loads=np.concatenate([space.loads(plate)[:, free] for plate in moving]),
        apply=apply,
        precondition=precondition,
        poles=len(poles.shifts),
    )


def _factorized(stiffness: PETSc.Mat, mass: PETSc.Mat, shift: float) -> PETSc.KSP:
    matrix = stiffness.copy()
    matrix.axpy(float(shift), mass, structure=PETSc.Mat.Structure.SAME_NONZERO_PATTERN)
    return direct_solver(matrix)
