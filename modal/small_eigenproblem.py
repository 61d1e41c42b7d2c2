"""The symmetric eigenproblem of two small matrices, by NumPy: SciPy's import takes longer than all estimates."""

from __future__ import annotations

import numpy as np

from hydroelastic.physics.arrays import FloatArray


def definite_eigh(matrix: FloatArray, definite: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Solve A x = μ B x.

    Args:
        matrix: A, symmetric, shape (n, n).
        definite: B, symmetric and positive definite, shape (n, n).

    Returns:
        The eigenvalues μ, ascending, and the eigenvectors as columns with XᵀBX = 1.

    Raises:
        LinAlgError: if B is not definite.
    """
    # Scaled, stiff and soft unknowns weigh alike.
    scale = 1.0 / np.sqrt(np.diag(definite))
    factor = np.linalg.cholesky(definite * np.outer(scale, scale))
    half = np.linalg.solve(factor, matrix * np.outer(scale, scale))
    values, vectors = np.linalg.eigh(np.linalg.solve(factor, half.T))
    return values, scale[:, None] * np.linalg.solve(factor.T, vectors)
