"""Complex symmetric systems with the real build of PETSc: the real form, factorized by MUMPS.

    (P + iQ)(u + iv) = f + ig    as    [ P  −Q ] [u]   [ f ]
                                       [−Q  −P ] [v] = [−g ]

is symmetric, so that one LDLᵀ factorization solves it.
"""

from __future__ import annotations

import numpy as np
from petsc4py import PETSc

from hydroelastic.fem.direct import configure_indefinite, configure_quasidefinite
from hydroelastic.fem.open_water.complex_scaling import ComplexMatrix


class DefiniteSolver:
    """(P + iQ)⁻¹ for one matrix whose real part is positive, so that its factorization needs no pivots.

    Args:
        matrix: P + iQ, symmetric, P positive definite.
    """

    def __init__(self, matrix: ComplexMatrix) -> None:
        """Factorize (collective)."""
        self._factorization = _Factorization(_real_form(matrix.real, matrix.imaginary), definite=True)
        self._factorization.compute()

    def solve(self, load: np.ndarray) -> np.ndarray:
        """Return the solution for a load, both complex and own entries of this process, shape (own unknowns,)
        (collective)."""
        return self._factorization.solve(load)


class ShiftedSolver:
    """(A − λM)⁻¹ for one λ after another, real or complex; the structure is analysed once.

    Args:
        stiffness: complex symmetric matrix A.
        mass: complex symmetric matrix M, of the same size.
    """

    def __init__(self, stiffness: ComplexMatrix, mass: ComplexMatrix) -> None:
        """Create the real form with the sparsity of all parts (collective)."""
        self._constant = _real_form(stiffness.real, stiffness.imaginary)
        self._masses = (
            _real_form(mass.real, mass.imaginary),
            # That of iM.
            _real_form(_scaled(mass.imaginary, -1.0), mass.real),
        )
        for part in self._masses:
            # PETSc does nothing for a factor of zero, and the pattern must hold all parts.
            room = _scaled(part, 0.0)
            self._constant.axpy(1.0, room, structure=PETSc.Mat.Structure.DIFFERENT_NONZERO_PATTERN)
        self._factorization = _Factorization(self._constant.copy())
        self.factorizations = 0

    def shift(self, eigenvalue: complex) -> None:
        """Factorize A − λM (collective)."""
        matrix = self._factorization.matrix
        self._constant.copy(matrix, structure=PETSc.Mat.Structure.SAME_NONZERO_PATTERN)
        for factor, part in zip((eigenvalue.real, eigenvalue.imag), self._masses, strict=True):
            if factor:
                matrix.axpy(-factor, part, structure=PETSc.Mat.Structure.SUBSET_NONZERO_PATTERN)
        self._factorization.compute()
        self.factorizations += 1

    def solve(self, load: np.ndarray) -> np.ndarray:
        """Return the solution for a load, both complex and own entries of this process, shape (own unknowns,)
        (collective)."""
        return self._factorization.solve(load)


class _Factorization:
    def __init__(self, matrix: PETSc.Mat, *, definite: bool = False) -> None:
        self.matrix = matrix
        matrix.setOption(PETSc.Mat.Option.SYMMETRIC, True)
        self._solver = PETSc.KSP().create(matrix.comm)
        self._solver.setOperators(matrix)
        if definite:
            configure_quasidefinite(self._solver)
        else:
            factor = configure_indefinite(self._solver)
            # Pivoting in an indefinite matrix may need more memory than the symbolic analysis predicts.
            factor.setMumpsIcntl(14, 80)
        self._load, self._answer = matrix.createVecs()
        self._size = matrix.getLocalSize()[0] // 2

    def compute(self) -> None:
        self._solver.setOperators(self.matrix)
        self._solver.setUp()

    def solve(self, load: np.ndarray) -> np.ndarray:
        self._load.array[: self._size] = load.real
        self._load.array[self._size :] = -load.imag
        self._solver.solve(self._load, self._answer)
        values = self._answer.array_r
        answer: np.ndarray = values[: self._size] + 1j * values[self._size :]
        return answer


def _scaled(matrix: PETSc.Mat, factor: float) -> PETSc.Mat:
    copy = matrix.copy()
    copy.scale(factor)
    return copy


def _real_form(real: PETSc.Mat, imaginary: PETSc.Mat) -> PETSc.Mat:
    """[[P, −Q], [−Q, −P]]; on each process the rows of the second block follow those of the first."""
    off = _scaled(imaginary, -1.0)
    return PETSc.Mat().createNest([[real, off], [off, _scaled(real, -1.0)]], comm=real.comm).convert("aij")
