"""Eigenvalues of a symmetric pencil by NumPy alone: SciPy's `linalg` takes as long to import as a tank to solve."""

from __future__ import annotations

import numpy as np

from hydroelastic.physics.arrays import FloatArray


def pencil_modes(matrix: FloatArray, positive: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return λ and v of A v = λ B v: with B = L Lᵀ those of L⁻¹ A L⁻ᵀ.

    Args:
        matrix: A, symmetric, shape (n, n).
        positive: B, symmetric positive definite, shape (n, n).

    Returns:
        λ, ascending, shape (n,), and the v as columns, vᵀBv = 1, shape (n, n).
    """
    factor = np.linalg.cholesky(positive)
    eigenvalues, vectors = np.linalg.eigh(np.linalg.solve(factor, np.linalg.solve(factor, matrix).T))
    return eigenvalues, np.linalg.solve(factor.T, vectors)
