"""Sparse factorizations of a symmetric positive definite matrix: those that this environment has, as equals."""

from __future__ import annotations

from collections.abc import Callable

import scipy.sparse
import scipy.sparse.linalg
from petsc4py import PETSc

from hydroelastic.benchmarks.tank.bare_pencil import Solve
from hydroelastic.physics.arrays import FloatArray

Factorize = Callable[[scipy.sparse.csr_matrix], Solve]


def available_factorizations() -> dict[str, Factorize]:
    """By name; PETSc is built with MUMPS always, with CHOLMOD on some systems."""
    tiny = scipy.sparse.identity(2, format="csr")
    found: dict[str, Factorize] = {"SuperLU": _superlu}
    for name, package in (("MUMPS", "mumps"), ("CHOLMOD", "cholmod"), ("PETSc", "petsc")):
        factorize = _of_petsc(package)
        try:
            factorize(tiny)
        except PETSc.Error:
            continue
        found[name] = factorize
    return found


def _superlu(matrix: scipy.sparse.csr_matrix) -> Solve:
    # The matrix is symmetric: its rows are its columns.
    columns = scipy.sparse.csc_matrix((matrix.data, matrix.indices, matrix.indptr), shape=matrix.shape)
    factor = scipy.sparse.linalg.splu(
        columns, permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options={"SymmetricMode": True}
    )
    solve: Solve = factor.solve
    return solve


def _of_petsc(package: str) -> Factorize:
    def factorize(matrix: scipy.sparse.csr_matrix) -> Solve:
        copy = PETSc.Mat().createAIJ(
            matrix.shape, csr=(matrix.indptr, matrix.indices, matrix.data), comm=PETSc.COMM_SELF
        )
        copy.setOption(PETSc.Mat.Option.SPD, True)
        solver = PETSc.KSP().create(PETSc.COMM_SELF)
        solver.setOperators(copy)
        solver.setType("preonly")
        solver.getPC().setType("cholesky")
        solver.getPC().setFactorSolverType(package)
        solver.setUp()
        load, solution = copy.createVecs()

        def solve(right_side: FloatArray) -> FloatArray:
            load.array[:] = right_side
            solver.solve(load, solution)
            answer: FloatArray = solution.array_r
            return answer

        return solve

    return factorize
