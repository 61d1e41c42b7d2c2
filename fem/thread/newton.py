"""Newton's method for the equations of a thread: limited steps, both the step and the residual must be small."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import ufl
from dolfinx import fem
from dolfinx.fem.petsc import assemble_matrix, assemble_vector, create_matrix
from mpi4py import MPI
from numpy.typing import NDArray
from petsc4py import PETSc

from hydroelastic.fem.kernels import compiled_form
from hydroelastic.meshes.compat import collapsed

# Largest displacement of a node in one step, of the thread's length.
STEP_LIMIT = 0.3
# The last step of a position and the residual, in units of the length and of the characteristic tension.
STEP_TOLERANCE = 1e-10
RESIDUAL_TOLERANCE = 1e-9
# Bending layers far shorter than the thread increase rounding: iteration then ends where steps no longer reduce it.
_ROUNDING = 1e-6
_MOST_STEPS = 40
# A step may increase the residual by this factor: far from the solution converging iterations do so too.
_GROWTH = 10.0
_MOST_HALVINGS = 6
_ROOM = 200
_PREFIX = "hydroelastic_thread_"


class ThreadSolverError(RuntimeError):
    """No equilibrium was found; the message says why."""


class NewtonSolver:
    """F(w) = 0 by PETSc's SNES: Newton's method with derivatives by UFL and a direct solution in each step.

    Args:
        residual: F, a form with one argument.
        unknowns: w in the mixed space of a thread whose length is one; its fixed components must have their values.
        fixed: prescribed unknowns, one or more boundary conditions.
        update: called before each assembly to update coefficients of F that depend on w.
        disturbance: D, a form with one argument, a small perturbation of F.

    Attributes:
        jacobian: matrix of the last linear system.
        values: F at the solution, owned unknowns.
        response: of the solution to the disturbance, y of F'(w) y = D, a function like w.
    """

    def __init__(
        self, residual: Any, unknowns: Any, fixed: list[Any], update: Callable[[], None], disturbance: Any
    ) -> None:
        self._residual = compiled_form(residual)
        self._derivative = compiled_form(ufl.derivative(residual, unknowns))
        self._unknowns, self._fixed, self._update = unknowns, fixed, update
        space = unknowns.function_space
        self._comm = space.mesh.comm
        self._owned = space.dofmap.index_map.size_local * space.dofmap.index_map_bs
        held = np.concatenate([_indices(condition) for condition in fixed]) if fixed else np.empty(0, dtype=np.int32)
        self._held = held[held < self._owned]
        positions = collapsed(space, 0)[1]
        self._positions = positions[positions < self._owned]
        self.jacobian = create_matrix(self._derivative)
        self.values = np.zeros(self._owned)
        self._disturbance = compiled_form(disturbance)
        self.response = fem.Function(space)
        # Largest entries of the residual, of that before, and of the last step's positions; whether the residual is
        # that of w.
        self._size = self._before = np.inf
        self._length, self._is_known = 0.0, False

    def solve(self) -> int:
        """Change w until F vanishes."""
        place, value = self.jacobian.createVecs()
        place.array[:] = self._unknowns.x.array[: self._owned]
        self._length, self._is_known = 0.0, False
        solver = self._solver(value)
        try:
            solver.solve(None, place)
            reason, count = solver.getConvergedReason(), solver.getIterationNumber()
            if reason > 0:
                self._respond(solver.getKSP(), place)
        except PETSc.Error as error:
            raise ThreadSolverError("a linear system of Newton's method could not be factored") from error
        finally:
            # The two objects refer to each other: the cycle must be broken to free them.
            for part in (solver, place, value):
                part.destroy()
        if reason <= 0:
            raise ThreadSolverError(self._words(reason, count))
        return int(count)

    def _solver(self, value: PETSc.Vec) -> PETSc.SNES:
        solver = PETSc.SNES().create(self._comm)
        solver.setType("newtonls")
        # The step is limited before it is taken, by `_limit`; there is no further search along it.
        solver.setOptionsPrefix(_PREFIX)
        PETSc.Options(_PREFIX)["snes_linesearch_type"] = "basic"
        solver.setFromOptions()
        solver.setFunction(self._function, value)
        solver.setJacobian(self._derive, self.jacobian)
        solver.setLineSearchPreCheck(self._limit)
        solver.setConvergenceTest(self._test)
        solver.setTolerances(max_it=_MOST_STEPS)
        linear = solver.getKSP()
        linear.setType("preonly")
        factors = linear.getPC()
        factors.setType("lu")
        factors.setFactorSolverType("mumps")
        linear.setOperators(self.jacobian)
        factors.setFactorSetUpSolverType()
        # Additional memory for pivots, per cent: much of the diagonal is zero.
        factors.getFactorMatrix().setMumpsIcntl(14, _ROOM)
        return solver

    def _function(self, _: PETSc.SNES, place: PETSc.Vec, value: PETSc.Vec) -> None:
        if not self._is_known:
            self._move(place.array_r)
        self._is_known = False
        value.array[:] = self.values

    def _derive(self, _: PETSc.SNES, __: PETSc.Vec, matrix: PETSc.Mat, ___: PETSc.Mat) -> None:
        # The residual was found last, and at the same place.
        matrix.zeroEntries()
        assemble_matrix(matrix, self._derivative, self._fixed)
        matrix.assemble()

    def _limit(self, place: PETSc.Vec, step: PETSc.Vec) -> bool:
        """Shorten a step that moves the thread far or makes the residual grow; True if it is shorter."""
        start, direction, self._before = place.array_r, step.array.copy(), self._size
        self._length = self._largest(direction[self._positions])
        part = min(1.0, STEP_LIMIT / max(self._length, STEP_LIMIT))
        for _ in range(_MOST_HALVINGS + 1):
            self._move(start - part * direction)
            if self._size < _GROWTH * max(self._before, RESIDUAL_TOLERANCE):
                break
            part *= 0.5
        else:
            part *= 2.0
        self._is_known = True
        step.array[:] = part * direction
        return part < 1.0

    def _test(self, _: PETSc.SNES, count: int, __: tuple[float, float, float]) -> int:
        reasons = PETSc.SNES.ConvergedReason
        if not np.isfinite(self._size):
            return int(reasons.DIVERGED_FNORM_NAN)
        allowed = _ROUNDING if self._size > 0.25 * self._before else RESIDUAL_TOLERANCE
        done = count > 0 and self._length < STEP_TOLERANCE and self._size < allowed
        return int(reasons.CONVERGED_FNORM_ABS if done else reasons.ITERATING)

    def _move(self, values: NDArray[np.float64]) -> None:
        self._unknowns.x.array[: self._owned] = values
        self._unknowns.x.scatter_forward()
        self._update()
        vector = self._assembled(self._residual)
        self.values = vector.array.copy()
        vector.destroy()
        self.values[self._held] = 0.0
        self._size = self._largest(self.values)

    def _respond(self, linear: PETSc.KSP, place: PETSc.Vec) -> None:
        """Solve with the matrix of the last step, which was taken within `STEP_TOLERANCE` of the solution."""
        right, left = self._assembled(self._disturbance), place.duplicate()
        right.array[self._held] = 0.0
        linear.solve(right, left)
        self.response.x.array[: self._owned] = left.array_r
        self.response.x.scatter_forward()
        right.destroy()
        left.destroy()

    def _assembled(self, form: Any) -> PETSc.Vec:
        vector = assemble_vector(form)
        vector.ghostUpdate(addv=PETSc.InsertMode.ADD, mode=PETSc.ScatterMode.REVERSE)
        return vector

    def _words(self, reason: int, count: int) -> str:
        reasons = PETSc.SNES.ConvergedReason
        if reason == reasons.DIVERGED_LINEAR_SOLVE or not np.isfinite(self._length):
            return f"the linear system of Newton's step {count + 1} is singular"
        if not np.isfinite(self._size):
            place = "along a step of Newton's method" if self._length > 0.0 else "at the start"
            return f"the equations have no finite value {place}"
        return (
            f"Newton's method did not converge in {count} steps: the last one moved the thread by "
            f"{self._length:.1e} of its length, with a residual of {self._size:.1e} of the characteristic tension"
        )

    def _largest(self, values: NDArray[np.float64]) -> float:
        local = float(np.max(np.abs(values))) if len(values) else 0.0
        # MPI's maximum may drop NaN.
        local = local if np.isfinite(local) else np.inf
        return float(self._comm.allreduce(local, op=MPI.MAX))


def _indices(condition: Any) -> NDArray[np.int32]:
    indices: NDArray[np.int32] = condition.dof_indices()[0]
    return indices
