"""Complex symmetric systems with the real build of PETSc: the real form, factorized by MUMPS.

    (P + iQ)(u + iv) = f + ig    as    [ P  −Q ] [u]   [ f ]
                                       [−Q  −P ] [v] = [−g ]

is symmetric, so that one LDLᵀ serves.
"""

from __future__ import annotations

import numpy as np
from petsc4py import PETSc

from hydroelastic.fem.complex_scaling import ComplexMatrix
from hydroelastic.fem.direct import configure_indefinite


class ShiftedSolver:
    """(A − λM)⁻¹ for one λ after another, real or complex; the structure is analysed once.

    Args:
        stiffness: A.
        mass: M, of the same size.
    """

    def __init__(self, stiffness: ComplexMatrix, mass: ComplexMatrix) -> None:
        """Lay out the real form (collective)."""
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
        self._matrix = self._constant.copy()
        self._matrix.setOption(PETSc.Mat.Option.SYMMETRIC, True)
        self._solver = PETSc.KSP().create(self._matrix.comm)
        self._solver.setOperators(self._matrix)
        factor = configure_indefinite(self._solver)
        # Pivots of an indefinite matrix may need more room than its structure says.
        factor.setMumpsIcntl(14, 80)
        self._load, self._answer = self._matrix.createVecs()
        self._size = self._matrix.getLocalSize()[0] // 2
        self.factorizations = 0

    def shift(self, eigenvalue: complex) -> None:
        """Factorize A − λM (collective)."""
        self._constant.copy(self._matrix, structure=PETSc.Mat.Structure.SAME_NONZERO_PATTERN)
        for factor, part in zip((eigenvalue.real, eigenvalue.imag), self._masses, strict=True):
            if factor:
                self._matrix.axpy(-factor, part, structure=PETSc.Mat.Structure.SUBSET_NONZERO_PATTERN)
        self._solver.setOperators(self._matrix)
        self._solver.setUp()
        self.factorizations += 1

    def solve(self, load: np.ndarray) -> np.ndarray:
        """Solve for a load, own entries of this process (collective)."""
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
