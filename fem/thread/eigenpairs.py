"""Eigenpairs of the small motions of a thread, by SLEPc with shift-and-invert near zero.

Without velocity terms K y = ω² M y by Krylov–Schur, λ = iω; with them (λ² M + λ C + K) y = 0 by the two-level
orthogonal Arnoldi method. The rows of axial force and curvature are constraints: their eigenvalues are infinite, and
the inverse maps them to zero.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from petsc4py import PETSc
from slepc4py import SLEPc

from hydroelastic.fem.solver_error import EigenSolverError
from hydroelastic.fem.thread.operators import ThreadOperators
from hydroelastic.meshes.interrupts import interrupts_deferred

# Shift, different from zero: a motion without stiffness would make the matrix singular there.
_LINEAR_SHIFT = -1e-2
_QUADRATIC_SHIFT = -1e-3
_TOLERANCE = 1e-12
# Next to a double root the iteration converges to fewer digits; the residuals are checked as well.
_TOLERANCES = (_TOLERANCE, 1e-9, 1e-6)
# Backward error, of the sum of the norms of the terms; measured 1e-15 to 1e-12.
_LARGEST_RESIDUAL = 1e-9
# Part of the magnitude below which the real or the imaginary part of an eigenvalue is rounding.
_PURE = 1e-9
# Beside one and its magnitude: the imaginary part of a real eigenvalue that others come so close to.
_SAME = 1e-6


@dataclass(frozen=True, kw_only=True)
class Eigenpair:
    """One root with its vector."""

    root: complex  # λ in units of the operators, Im λ ≥ 0
    real: PETSc.Vec  # of the vector y, free unknowns
    imaginary: PETSc.Vec  # of the vector y
    residual: float  # backward error


def eigenpairs(operators: ThreadOperators, count: int) -> list[Eigenpair]:
    """The roots of smallest magnitude, as many as needed to have `count` oscillating ones among them."""
    pairs, last = _slowest(operators, count)
    return pairs[: last + 1]


def roots_near_zero(operators: ThreadOperators, count: int) -> NDArray[np.complex128]:
    """The roots of `eigenpairs`, and those that were found beyond the last of them.

    On another mesh a real root may exceed the last oscillating one in magnitude, or fall below it.
    """
    return np.array([pair.root for pair in _slowest(operators, count)[0]], dtype=np.complex128)


def _slowest(operators: ThreadOperators, count: int) -> tuple[list[Eigenpair], int]:
    """Pairs by ascending magnitude, and the place of the last of `count` that oscillate."""
    if count < 1:
        raise ValueError(f"count is {count}: it must be at least 1")
    solve = _linear if operators.damping is None else _quadratic
    wanted = 2 * count + 8
    while True:
        pairs = solve(operators, min(wanted, operators.size))
        oscillating = [number for number, pair in enumerate(pairs) if is_oscillating(pair.root)]
        if len(oscillating) >= count:
            return pairs, oscillating[count - 1]
        if wanted >= operators.size:
            raise EigenSolverError(f"fewer than {count} oscillating motions among {operators.size} unknowns")
        wanted *= 2


def is_oscillating(root: complex) -> bool:
    """Whether a root has an imaginary part above rounding."""
    return abs(root.imag) > _PURE * abs(root)


def stiffness_eigenvalues(operators: ThreadOperators, count: int) -> NDArray[np.float64]:
    """Real κ of K y = κ M y nearest to zero: one of them changes its sign where the equilibrium diverges."""
    solver = _linear_solver(operators, count)
    # Where all motions across a straight thread lose their stiffness at once, Lanczos' method breaks down, and the
    # inner product of a semidefinite M gives no further vectors.
    solver.setProblemType(SLEPc.EPS.ProblemType.GNHEP)
    _run(solver)
    # By their distance from zero: further ones may be infinite eigenvalues with rounding.
    found = range(min(count, solver.getConverged()))
    values = np.array([solver.getEigenvalue(number) for number in found], dtype=np.complex128)
    real = values.real[np.abs(values.imag) <= _SAME * (1.0 + np.abs(values))]
    return np.asarray(np.sort(real) / operators.time_unit**2)


def _linear_solver(operators: ThreadOperators, count: int) -> SLEPc.EPS:
    solver = SLEPc.EPS().create(operators.comm)
    solver.setOperators(operators.stiffness, operators.mass)
    kinds = SLEPc.EPS.ProblemType
    solver.setProblemType(kinds.GHEP if operators.symmetric else kinds.GNHEP)
    solver.setWhichEigenpairs(SLEPc.EPS.Which.TARGET_MAGNITUDE)
    solver.setTarget(_LINEAR_SHIFT)
    solver.setDimensions(count, min(2 * count + 20, operators.size))
    solver.setTolerances(_TOLERANCE, 200)
    _invert(solver.getST())
    return solver


def _linear(operators: ThreadOperators, count: int) -> list[Eigenpair]:
    solver = _linear_solver(operators, count)
    _run(solver)
    pairs: list[Eigenpair] = []
    for number in range(solver.getConverged()):
        real, imaginary = operators.zeros(), operators.zeros()
        square = complex(solver.getEigenpair(number, real, imaginary))
        residual = solver.computeError(number, SLEPc.EPS.ErrorType.BACKWARD)
        if residual > _LARGEST_RESIDUAL:
            continue
        if abs(square.imag) <= _PURE * abs(square):
            imaginary.set(0.0)
            square = complex(square.real)
        root = np.sqrt(-square)
        # Of the two roots ±λ those that are not conjugate to another one.
        roots = [-root, root] if square.real < 0.0 and square.imag == 0.0 else [root if root.imag > 0.0 else -root]
        pairs.extend(
            Eigenpair(root=complex(value), real=real, imaginary=imaginary, residual=residual) for value in roots
        )
    return sorted(pairs, key=lambda pair: abs(pair.root))


def _quadratic(operators: ThreadOperators, count: int) -> list[Eigenpair]:
    solver = SLEPc.PEP().create(operators.comm)
    solver.setOperators([operators.stiffness, operators.damping, operators.mass])
    solver.setProblemType(SLEPc.PEP.ProblemType.GENERAL)
    solver.setType(SLEPc.PEP.Type.TOAR)
    solver.setWhichEigenpairs(SLEPc.PEP.Which.TARGET_MAGNITUDE)
    solver.setTarget(_QUADRATIC_SHIFT)
    solver.setDimensions(count, min(2 * count + 20, 2 * operators.size))
    _invert(solver.getST())
    for tolerance in _TOLERANCES:
        solver.setTolerances(tolerance, 200)
        _run(solver)
        if solver.getConverged() >= count:
            break
    pairs = []
    for number in range(solver.getConverged()):
        real, imaginary = operators.zeros(), operators.zeros()
        root = complex(solver.getEigenpair(number, real, imaginary))
        residual = solver.computeError(number, SLEPc.PEP.ErrorType.BACKWARD)
        if root.imag >= 0.0 and residual <= _LARGEST_RESIDUAL:
            pairs.append(Eigenpair(root=root, real=real, imaginary=imaginary, residual=residual))
    return sorted(pairs, key=lambda pair: abs(pair.root))


def _run(solver: SLEPc.EPS | SLEPc.PEP) -> None:
    try:
        with interrupts_deferred():
            solver.solve()
    except PETSc.Error as error:
        raise EigenSolverError("the matrices of stiffness and mass could not be factored") from error


def _invert(transformation: SLEPc.ST) -> None:
    """Shift-and-invert by LU: the matrix has zeros on its diagonal, and no symmetry in a stream."""
    transformation.setType(SLEPc.ST.Type.SINVERT)
    solver = transformation.getKSP()
    solver.setType(PETSc.KSP.Type.PREONLY)
    solver.getPC().setType(PETSc.PC.Type.LU)
    solver.getPC().setFactorSolverType("mumps")
    # The zeros on the diagonal make MUMPS delay pivots beyond the 20 % of memory that it adds to its estimate.
    solver.setOptionsPrefix("thread_modes_")
    PETSc.Options()["thread_modes_mat_mumps_icntl_14"] = 400
    solver.setFromOptions()
