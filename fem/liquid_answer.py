"""The answer of a liquid to all of its surface unknowns at once, as dense matrices of one process."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from petsc4py import PETSc

# Of a smaller triangle the inverse takes less time than its blocks.
_SMALL = 48


@dataclass(frozen=True, kw_only=True)
class LiquidAnswer:
    """The answer of the liquid to each surface unknown, on one process. Bodies of other stiffness and mass share it.

    Attributes:
        potentials: A⁺C, shape (N, n).
        added_mass: M_a = (ρC)ᵀA⁺C, shape (n, n).
        root: R with RᵀK_ηR = 1, where K_η is the stiffness of the surfaces of the liquids, shape (surface unknowns,
            surface unknowns).
        scaled: M_a with the unknowns of these surfaces scaled by R, shape (n, n).
    """

    potentials: np.ndarray
    added_mass: np.ndarray
    root: np.ndarray
    scaled: np.ndarray


def liquid_answer(potentials: np.ndarray, added_mass: np.ndarray, restoring: np.ndarray) -> LiquidAnswer:
    """Return an answer."""
    bodies = len(added_mass) - len(restoring)
    added_mass = 0.5 * (added_mass + added_mass.T)
    root = _inverse_of_lower(np.linalg.cholesky(restoring)).T
    scaled = added_mass.copy()
    scaled[:, bodies:] = scaled[:, bodies:] @ root
    scaled[bodies:] = root.T @ scaled[bodies:]
    return LiquidAnswer(potentials=potentials, added_mass=added_mass, root=root, scaled=scaled)


def _inverse_of_lower(triangle: np.ndarray) -> np.ndarray:
    """The inverse of a lower triangle, block by block: NumPy alone would invert it as a full matrix."""
    size, half = len(triangle), len(triangle) // 2
    if size <= _SMALL:
        inverse: np.ndarray = np.linalg.inv(triangle)
        return inverse
    first, last = _inverse_of_lower(triangle[:half, :half]), _inverse_of_lower(triangle[half:, half:])
    inverse = np.zeros((size, size))
    inverse[:half, :half], inverse[half:, half:] = first, last
    inverse[half:, :half] = -last @ triangle[half:, :half] @ first
    return inverse


def dense(matrix: PETSc.Mat) -> np.ndarray:
    """A matrix of one process as a dense array, in Fortran's order."""
    # The array lives as long as the matrix.
    full = matrix.convert("dense", PETSc.Mat())
    values: np.ndarray = full.getDenseArray().copy(order="F")
    return values
