"""ψ = 0 on the water of a plan of triangles; see `released`."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from petsc4py import PETSc

from hydroelastic.fem.direct import direct_solver
from hydroelastic.fem.pencil import CoupledPencil
from hydroelastic.fem.plan.plan_pencil import PlanLiquid, PlanPlate, PlanSpace, plan_pencil, water_unknowns
from hydroelastic.fem.plan.released import ReleasedOperator
from hydroelastic.modal.liquid.vertical_poles import VerticalPoles
from hydroelastic.physics.arrays import FloatArray


def released_plan_pencil(
    space: PlanSpace, poles: VerticalPoles, plates: tuple[PlanPlate, ...]
) -> CoupledPencil[PlanLiquid]:
    """Return the coupled problem of a symmetry class of a plan in which the plates move, alike on each process."""
    pencil = plan_pencil(space, poles, plates, waves=False, comm=None)
    assert pencil is not None
    return replace(pencil, solver=_released_plan(pencil.liquid), constraints=())


@dataclass(frozen=True, kw_only=True)
class _PoleStiffness:
    """A = 1/f_h of the plan's Laplacian: α K₂ + β M₂ − Σ_i γ_i M₂ (K₂ + δ_i M₂)⁻¹ M₂ with f_h(−δ_i) = 0."""

    liquid: PlanLiquid

    @cached_property
    def _parts(self) -> tuple[float, FloatArray, FloatArray]:
        """α, γ and δ."""
        poles = self.liquid.poles
        roots = np.sqrt(poles.weights / poles.weights.sum())
        others = np.linalg.svd(roots[None])[2][1:].T
        zeros = np.linalg.eigvalsh(others.T @ (poles.shifts[:, None] * others))
        factors = 1.0 / (poles.weights / (poles.shifts - zeros[:, None]) ** 2).sum(axis=1)
        return 1.0 / float(poles.weights.sum()), factors, zeros

    @cached_property
    def _solvers(self) -> list[PETSc.KSP]:
        return [_factorized(self.liquid.space.stiffness, self.liquid.space.mass, shift) for shift in self._parts[2]]

    def product(self, values: PETSc.Vec) -> FloatArray:
        """Return A ψ."""
        space = self.liquid.space
        slope, factors, zeros = self._parts
        mass, part = space.mass * values, values.duplicate()
        total = slope * (space.stiffness * values).array_r + (factors / zeros).sum() * mass.array_r
        for factor, solver in zip(factors, self._solvers, strict=True):
            solver.solve(mass, part)
            total = total - factor * (space.mass * part).array_r
        return np.asarray(total)


def _released_plan(liquid: PlanLiquid) -> ReleasedOperator:
    """P by the same poles under the plates with ψ = 0 at their edges."""
    space = liquid.space
    free = np.setdiff1d(np.arange(liquid.size), water_unknowns(space))
    rows = PETSc.IS().createGeneral(free.astype(PETSc.IntType), comm=PETSc.COMM_SELF)
    stiffness, mass = (matrix.createSubMatrix(rows, rows) for matrix in (space.stiffness, space.mass))
    solvers = [_factorized(stiffness, mass, shift) for shift in liquid.poles.shifts]
    operator, whole = _PoleStiffness(liquid=liquid), space.mass.createVecRight()
    right, left = mass.createVecs()

    def apply(values: FloatArray) -> FloatArray:
        whole.array[free] = values
        return operator.product(whole)[free]

    def precondition(values: FloatArray) -> FloatArray:
        left.array[:] = values
        total = np.zeros_like(values)
        for weight, solver in zip(liquid.poles.weights, solvers, strict=True):
            solver.solve(left, right)
            total += weight * right.array_r
        return total

    return ReleasedOperator(free=free, apply=apply, precondition=precondition)


def _factorized(stiffness: PETSc.Mat, mass: PETSc.Mat, shift: float) -> PETSc.KSP:
    matrix = stiffness.copy()
    matrix.axpy(float(shift), mass, structure=PETSc.Mat.Structure.SAME_NONZERO_PATTERN)
    solver = direct_solver(matrix)
    solver.setUp()
    return solver
