"""Sparse direct solution of symmetric systems: PETSc's interface to MUMPS, on any number of processes."""

from __future__ import annotations

from petsc4py import PETSc


def direct_solver(matrix: PETSc.Mat) -> PETSc.KSP:
    """Cholesky factorization of a symmetric positive definite matrix."""
    matrix.setOption(PETSc.Mat.Option.SPD, True)
    solver = PETSc.KSP().create(matrix.comm)
    solver.setOperators(matrix)
    configure_direct(solver)
    return solver


def configure_direct(solver: PETSc.KSP) -> None:
    """Make a solver one application of a sparse Cholesky factorization."""
    solver.setType("preonly")
    solver.getPC().setType("cholesky")
    solver.getPC().setFactorSolverType("mumps")
