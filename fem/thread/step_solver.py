"""Newton's method for one step of a moving thread: the matrices of all steps have the same sparsity pattern."""

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

# The last change of a mean velocity, times the step, in units of the length: the next one would be rounding.
_TOLERANCE = 1e-9
_MOST_STEPS = 15
# Of the length, for one change of a position: beyond it the predictor was wrong and the step is too long.
_FARTHEST = 3.0
# The least condition number of a matrix that is singular but for rounding, whose pivots may miss zero.
_SINGULAR = 1e14


class HeldUnknowns:
    """Prescribed components of unknowns, whose values change from step to step.

    Args:
        space: mixed space.
        held: part of the mixed space, component, facets.
    """

    def __init__(self, space: Any, held: list[tuple[int, int, NDArray[np.int32]]]) -> None:
        self.values = [fem.Constant(space.mesh, 0.0) for _ in held]
        self.conditions = []
        self.places = []
        for value, (part, axis, facets) in zip(self.values, held, strict=True):
            component = space.sub(part).sub(axis)
            places = fem.locate_dofs_topological(component, 0, facets)
            self.conditions.append(fem.dirichletbc(value, places, component))
            self.places.append(places)

    def set(self, array: NDArray[np.float64]) -> None:
        """Put the values into an array of all unknowns."""
        for value, places in zip(self.values, self.places, strict=True):
            array[places] = value.value


class StepSolver:
    """F(w) = 0 with derivatives by UFL.

    Args:
        residual: F.
        unknown: w, a function; its first part counts for convergence.
        update: called before each assembly to update coefficients of F that depend on w.

    Attributes:
        reaction: F of the last solution, owned unknowns: forces on the thread where it is held.
        solutions: of linear systems so far.
    """

    def __init__(self, residual: Any, unknown: Any, update: Callable[[], None]) -> None:
        self._residual = compiled_form(residual)
        self._derivative = compiled_form(ufl.derivative(residual, unknown))
        self._unknown, self._update = unknown, update
        space = unknown.function_space
        self._comm = space.mesh.comm
        self._owned = space.dofmap.index_map.size_local * space.dofmap.index_map_bs
        positions = collapsed(space, 0)[1]
        self._positions = positions[positions < self._owned]
        self._matrix = create_matrix(self._derivative)
        self._vector, self._change = (unknown.x.petsc_vec.duplicate() for _ in range(2))
        self._solver = PETSc.KSP().create(self._comm)
        self._solver.setOperators(self._matrix)
        self._solver.setType("preonly")
        self._solver.getPC().setType("lu")
        # Measured for 122 unknowns: KLU takes 26 µs, SuperLU 56, UMFPACK 68, MUMPS 113; PETSc's own has no pivots.
        klu = self._comm.size == 1 and any(map(PETSc.Sys.hasExternalPackage, ("suitesparse", "klu")))
        self._solver.getPC().setFactorSolverType("klu" if klu else "mumps")
        self.reaction: NDArray[np.float64] = np.zeros(self._owned)
        self.solutions = 0

    def solve(self, held: HeldUnknowns, step: float) -> int | None:
        """Change w until F vanishes."""
        array = self._unknown.x.array
        held.set(array)
        self._assemble(held)
        for count in range(1, _MOST_STEPS + 1):
            length = self._advance(held) * step
            if not length < _FARTHEST:
                break
            self._assemble(held)
            if length < _TOLERANCE:
                return count
        return None

    def is_singular(self) -> bool:
        """Whether the last matrix A is singular but for rounding (collective): ‖A‖ ‖A⁻¹b‖/‖b‖ of a random b tells."""
        load, response = self._vector.duplicate(), self._vector.duplicate()
        load.setRandom()
        self._solver.solve(load, response)
        norm = PETSc.NormType.NORM_INFINITY
        return bool(self._matrix.norm(norm) * response.norm(norm) > _SINGULAR * load.norm(norm))

    def _assemble(self, held: HeldUnknowns) -> None:
        self._update()
        with self._vector.localForm() as local:
            local.set(0.0)
        assemble_vector(self._vector, self._residual)
        self._vector.ghostUpdate(addv=PETSc.InsertMode.ADD, mode=PETSc.ScatterMode.REVERSE)
        values = self._vector.array
        self.reaction[:] = values
        for places in held.places:
            values[places[places < self._owned]] = 0.0

    def _advance(self, held: HeldUnknowns) -> float:
        self._matrix.zeroEntries()
        assemble_matrix(self._matrix, self._derivative, held.conditions)
        self._matrix.assemble()
        try:
            self._solver.solve(self._vector, self._change)
        except PETSc.Error:
            return np.inf
        self.solutions += 1
        change = self._change.array
        self._unknown.x.array[: self._owned] -= change
        self._unknown.x.scatter_forward()
        local = float(np.max(np.abs(change[self._positions]), initial=0.0))
        # MPI's maximum may drop NaN.
        return float(self._comm.allreduce(local if np.isfinite(local) else np.inf, op=MPI.MAX))
