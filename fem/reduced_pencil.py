"""The pencil of open water on a few of its own solutions: Galerkin's method between frequencies.

With a basis V of solutions at some frequencies, (VᵀAV − λVᵀMV) y = Vᵀf gives ψ ≈ Vy at any other. The matrices are complex
symmetric, so that H = Fᵀψ of loads whose solutions are in V is met there with its derivative, and its error elsewhere is
of second order in that of ψ. Source: A. Bultheel and M. Van Barel, J. Comput. Appl. Math. 14 (1986) 401 (rational
interpolation by projection); Y. Maday et al. on reduced bases.
"""

from __future__ import annotations

import numpy as np
from mpi4py import MPI

from hydroelastic.fem.complex_scaling import complex_product
from hydroelastic.fem.open_pencil import OpenPencil

# What is left of a vector after the basis is taken out, below which it says nothing new.
_DEPENDENT = 1e-11


class ReducedPencil:
    """A growing basis and the pencil on it.

    Args:
        pencil: the problem.
    """

    def __init__(self, pencil: OpenPencil) -> None:
        """Start with nothing."""
        own = len(pencil.free)
        self._pencil = pencil
        self._basis = np.zeros((0, own), dtype=complex)
        self._images = (self._basis, self._basis)
        self._projected = (np.zeros((0, 0), dtype=complex), np.zeros((0, 0), dtype=complex))

    @property
    def size(self) -> int:
        """Number of basis vectors."""
        return len(self._basis)

    def add(self, potentials: np.ndarray) -> None:
        """Take solutions into the basis, (solutions, own free unknowns) (collective)."""
        new = []
        for potential in potentials:
            vector = potential / self._norm(potential)
            # Twice is enough.
            for _ in range(2):
                known = np.vstack([self._basis, *new])
                vector = vector - self._pencil.products(known.conj(), vector[None])[:, 0] @ known
            left = self._norm(vector)
            if left > _DEPENDENT:
                new.append(vector[None] / left)
        if not new:
            return
        added = np.vstack(new)
        self._basis = np.vstack([self._basis, added])
        self._images = tuple(
            np.vstack([image, [complex_product(matrix, vector) for vector in added]])
            for image, matrix in zip(self._images, (self._pencil.laplace, self._pencil.mass), strict=True)
        )
        self._projected = tuple(self._pencil.products(self._basis, image) for image in self._images)

    def project(self, loads: np.ndarray) -> np.ndarray:
        """Vᵀf of some loads, shape (loads, basis) (collective)."""
        return self._pencil.products(loads.astype(complex), self._basis)

    def operator(self, eigenvalue: complex) -> np.ndarray:
        """VᵀAV − λVᵀMV."""
        laplace, mass = self._projected
        return laplace - eigenvalue * mass

    def solve(self, eigenvalue: complex, projected: np.ndarray) -> np.ndarray:
        """Coordinates of the solutions for projected loads, shape (loads, basis)."""
        coordinates: np.ndarray = np.linalg.solve(self.operator(eigenvalue), projected.T).T
        return coordinates

    def potentials(self, coordinates: np.ndarray) -> np.ndarray:
        """ψ of some coordinates, shape (solutions, own free unknowns)."""
        potentials: np.ndarray = coordinates @ self._basis
        return potentials

    def residuals(self, eigenvalue: complex, loads: np.ndarray, coordinates: np.ndarray) -> np.ndarray:
        """‖f − (A − λM)Vy‖/‖f‖ of each load (collective)."""
        laplace, mass = self._images
        rest = loads - coordinates @ (laplace - eigenvalue * mass)
        return np.array([self._norm(left) / self._norm(load) for left, load in zip(rest, loads, strict=True)])

    def _norm(self, vector: np.ndarray) -> float:
        return float(np.sqrt(self._pencil.comm.allreduce(np.vdot(vector, vector).real, op=MPI.SUM)))
