"""The matrices of a solved tank outside of the solver, and the eigenvalues that they have."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
import scipy.sparse
import scipy.sparse.linalg
from petsc4py import PETSc

from hydroelastic.benchmarks.tank.surface_modes import SurfaceModes, SurfaceProblem, lowest_eigenvalues
from hydroelastic.fem.cell_matrices import CellMatrices
from hydroelastic.fem.liquid import constrained_dofs
from hydroelastic.fem.liquid_matrices import laplace_matrix
from hydroelastic.fem.numbering import numbered
from hydroelastic.fem.pencil import CoupledPencil
from hydroelastic.physics.arrays import FloatArray

Solve = Callable[[FloatArray], FloatArray]
"""Right side → solution, on the free unknowns of ψ."""


@dataclass(frozen=True, kw_only=True)
class BarePencil:
    """K, M, C and A of a `CoupledPencil` on one process, without the constrained unknowns of C and A.

    Attributes:
        stiffness: K.
        mass: M.
        coupling: C, times √ρ, so that M_a = CᵀA⁻¹C.
        laplace: A, positive definite.
        free_rigid: unknowns without stiffness.
        volume: displaced by a unit of each unknown, if the liquid keeps its volume, else ``None``.
    """

    stiffness: scipy.sparse.csr_matrix
    mass: scipy.sparse.csr_matrix
    coupling: scipy.sparse.csr_matrix
    laplace: scipy.sparse.csr_matrix
    free_rigid: np.ndarray
    volume: FloatArray | None

    @property
    def unknowns(self) -> int:
        """Of ψ and of the surface."""
        return int(sum(self.coupling.shape))

    @staticmethod
    def of(pencil: CoupledPencil) -> BarePencil:
        """Copy the matrices of a pencil, on all unknowns: those inside of cells are not condensed."""
        condensed = pencil.liquid
        everything = CellMatrices(numbering=numbered(condensed.space, condensed=False))
        liquid = replace(condensed, cells=everything)
        laplace = _csr(laplace_matrix(liquid))
        coupling = scipy.sparse.lil_matrix((laplace.shape[0], pencil.size))
        coupling[condensed.numbering.owned_dofs] = _csr(pencil.coupling)
        coupling = coupling.tocsr()
        free = np.setdiff1d(np.arange(laplace.shape[0]), constrained_dofs(liquid))
        return BarePencil(
            stiffness=_csr(pencil.stiffness),
            mass=_csr(pencil.mass),
            coupling=coupling[free],
            laplace=laplace[free][:, free].tocsr(),
            free_rigid=pencil.free_rigid,
            volume=pencil.constraints[0].volume.array_r.copy() if pencil.constraints else None,
        )

    def lowest_modes(self, solve: Solve, count: int, tolerance: float) -> SurfaceModes:
        """Lowest eigenvalues λ of K ζ = λ(M + CᵀA⁻¹C) ζ, with a given solution of A."""
        definite = self.stiffness.tolil()
        definite[self.free_rigid, self.free_rigid] = 1.0
        factor = scipy.sparse.linalg.splu(definite.tocsc())
        transposed = self.coupling.T.tocsr()

        def without_rigid(vector: FloatArray) -> FloatArray:
            vector[self.free_rigid] = 0.0
            return vector

        def respond(vector: FloatArray, _weighed: FloatArray) -> tuple[FloatArray, FloatArray]:
            momentum = self.mass @ vector + transposed @ solve(self.coupling @ vector)
            return momentum[self.free_rigid], without_rigid(factor.solve(momentum))

        volume = np.zeros(len(definite.rows)) if self.volume is None else self.volume
        problem = SurfaceProblem(
            size=len(volume),
            free_rigid=self.free_rigid,
            weigh=lambda vector: self.stiffness @ vector,
            respond=respond,
            volume=self.volume,
            volume_response=without_rigid(factor.solve(volume)),
        )
        return lowest_eigenvalues(problem, count, tolerance=tolerance)


def _csr(matrix: PETSc.Mat) -> scipy.sparse.csr_matrix:
    starts, columns, values = matrix.getValuesCSR()
    return scipy.sparse.csr_matrix((values, columns, starts), shape=matrix.getSize())
