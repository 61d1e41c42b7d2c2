"""An independent count of the modes below a frequency, by the inertia of one matrix."""

from __future__ import annotations

import sys

import numpy as np
from petsc4py import PETSc

from hydroelastic.fem.direct import configure_indefinite
from hydroelastic.fem.liquid_answer import LiquidAnswer
from hydroelastic.fem.pencil import CoupledPencil
from hydroelastic.fem.solver_error import EigenSolverError

# Measured: unless SciPy is there already, its import takes longer than the eigenvalues of so small a matrix. By either
# way the count is that of the exact matrix, unless an eigenvalue is rounding.
_FEW = 150
# Columns that LAPACK eliminates at once.
_COLUMNS = 64


def count_below(pencil: CoupledPencil, eigenvalue: float) -> int:
    """Number of modes with λ < ``eigenvalue``, from the inertia of one factorization.

    The matrix [[K − σM, −σρCᵀ], [−σρC, σρA]] has as many negative pivots as there are modes below σ, zero modes
    included, and one more where the constant of ψ multiplies the volume constraint. It is independent of the iterative
    solution.
    """
    if pencil.answer is not None:
        below = _dense_count(pencil, pencil.answer, eigenvalue)
        if below is None:
            raise EigenSolverError(f"the shift {eigenvalue:g} is an eigenvalue to working precision")
        return below
    block = pencil.stiffness.copy()
    block.axpy(-eigenvalue, pencil.mass, structure=PETSc.Mat.Structure.DIFFERENT_NONZERO_PATTERN)
    rows = _unconstrained(pencil)
    # Copies are needed: PETSc returns the matrix itself where all of it is requested.
    laplace = pencil.laplace.createSubMatrix(rows, rows).copy()
    weights = laplace.createVecLeft()
    weights.array[:] = eigenvalue * _densities(pencil)[rows.getIndices() - pencil.laplace.getOwnershipRange()[0]]
    laplace.diagonalScale(L=weights)
    columns = PETSc.IS().createStride(
        pencil.stiffness.getLocalSize()[0],
        first=pencil.stiffness.getOwnershipRange()[0],
        step=1,
        comm=pencil.laplace.comm,
    )
    coupling = pencil.momentum.createSubMatrix(rows, columns).copy()
    coupling.scale(-eigenvalue)
    transpose = coupling.transpose(PETSc.Mat())
    whole = PETSc.Mat().createNest([[block, transpose], [coupling, laplace]], comm=block.comm).convert("aij")
    whole.setOption(PETSc.Mat.Option.SYMMETRIC, True)
    solver = PETSc.KSP().create(whole.comm)
    solver.setOperators(whole)
    factored = configure_indefinite(solver)
    factored.setMumpsIcntl(24, 1)  # a null pivot would be reported, not divided by
    factored.setMumpsIcntl(13, 1)  # without ScaLAPACK for the last block, which does not give the signs of its pivots
    solver.setUp()
    negative, zero, _ = factored.getInertia()
    if zero:
        raise EigenSolverError(f"the shift {eigenvalue:g} is an eigenvalue to working precision")
    return int(negative) - len(pencil.constraints) - pencil.zero_mode_count


def _unconstrained(pencil: CoupledPencil) -> PETSc.IS:
    """Unknowns of ψ off surfaces with ψ = 0, without one of each layer whose constant is arbitrary."""
    first, last = pencil.laplace.getOwnershipRange()
    fixed = np.union1d(pencil.liquid.zero_dofs(), pencil.free_constants)
    free = np.setdiff1d(np.arange(last - first, dtype=np.int32), fixed)
    return PETSc.IS().createGeneral((free + first).astype(PETSc.IntType), comm=pencil.laplace.comm)


def _densities(pencil: CoupledPencil) -> np.ndarray:
    densities: np.ndarray = np.array(pencil.liquid.densities)[pencil.liquid.owned_layer_of]
    return densities


def _dense_count(pencil: CoupledPencil, answer: LiquidAnswer, eigenvalue: float) -> int | None:
    """As `count_below`, by Sylvester's law from K − σ(M + M_a) bordered by the volume constraints; ``None`` where σ is
    an eigenvalue to working precision."""
    block, bodies = -eigenvalue * answer.added_mass, pencil.body_size
    block[:bodies, :bodies] -= eigenvalue * pencil.body_mass
    # Scaled so that stiff shapes and small elements weigh alike.
    stiffness = np.concatenate([pencil.body_stiffness, np.diag(pencil.dense_restoring)])
    scale = 1.0 / np.sqrt(np.abs(stiffness) - np.diag(block))
    block[np.diag_indices(bodies)] += pencil.body_stiffness
    block[bodies:, bodies:] += pencil.dense_restoring
    volumes = pencil.volumes * scale
    volumes /= np.linalg.norm(volumes, axis=1, keepdims=True)
    corner = np.zeros((len(volumes), len(volumes)))
    block = scale[:, None] * block * scale
    negative = _negative(np.block([[block, volumes.T], [volumes, corner]]))
    return None if negative is None else negative - len(pencil.constraints) - pencil.zero_mode_count


def _negative(matrix: np.ndarray) -> int | None:
    """Number of negative eigenvalues of a symmetric matrix; ``None`` where one is zero to working precision."""
    if len(matrix) <= _FEW and "scipy.linalg" not in sys.modules:
        signs = np.linalg.eigvalsh(matrix)
        return None if np.abs(signs).min(initial=np.inf) <= np.finfo(float).eps else int(np.sum(signs < 0.0))
    from scipy.linalg import lapack

    # Bunch and Kaufman: a pivot of two rows, which negative numbers mark, has one negative eigenvalue. In less space
    # LAPACK would eliminate one column at a time.
    factor, rows, _ = lapack.dsytrf(matrix, lower=1, lwork=_COLUMNS * len(matrix))
    pivots = np.diag(factor)[rows > 0]
    if np.abs(pivots).min(initial=np.inf) <= np.finfo(float).eps:
        return None
    return int(np.count_nonzero(pivots < 0.0) + np.count_nonzero(rows < 0) // 2)
