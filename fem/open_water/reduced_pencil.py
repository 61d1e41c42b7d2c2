"""Reduced basis of open water: Galerkin's method on solutions at a few frequencies.

With a basis V of solutions at some frequencies, (VᵀAV − λVᵀMV) y = Vᵀf gives ψ ≈ Vy at any other. The matrices are
complex symmetric, so that H = Fᵀψ is exact with its first derivative where solutions are in V, and
elsewhere its error is of second order in that of ψ.

Source: A. Bultheel and M. Van Barel, J. Comput. Appl. Math. 14 (1986) 401 (rational
interpolation by projection); Y. Maday et al. on reduced bases.
"""

from __future__ import annotations

import numpy as np
from mpi4py import MPI

from hydroelastic.fem.open_water.complex_scaling import complex_product
from hydroelastic.fem.open_water.pencil import OpenPencil

# A vector whose part orthogonal to the basis is smaller, relative to its norm, is not added.
_DEPENDENT = 1e-11
# Part of the largest response below which one is rounding.
_NO_RESPONSE = 1e-8


class ReducedPencil:
    """A basis that grows by solutions, and the pencil projected on it.

    Args:
        pencil: the problem.
    """

    def __init__(self, pencil: OpenPencil) -> None:
        """Start with an empty basis."""
        own = len(pencil.free)
        self._pencil = pencil
        self._basis: np.ndarray = np.zeros((0, own), dtype=complex)
        diagonal = pencil.laplace.real.getDiagonal().array_r + 1j * pencil.laplace.imaginary.getDiagonal().array_r
        self._weights = 1.0 / np.sqrt(np.abs(diagonal))
        # Products AV and MV, and the projections VᵀAV and VᵀMV.
        self._images: list[np.ndarray] = [self._basis, self._basis]
        self._projected: list[np.ndarray] = [np.zeros((0, 0), dtype=complex)] * 2

    @property
    def size(self) -> int:
        """Number of basis vectors."""
        return len(self._basis)

    def add(self, eigenvalue: complex, potentials: np.ndarray, loads: np.ndarray) -> None:
        """Add solutions of (A − λM)ψ = f to the basis (collective).

        Aψ is computed as λMψ + f: in elongated cells A is large, and the product with a nearly constant ψ would be lost
        in rounding.

        Args:
            eigenvalue: λ.
            potentials: ψ, complex, shape (solutions, own free unknowns).
            loads: f, complex, of the same shape.
        """
        masses = np.array([complex_product(self._pencil.mass, potential) for potential in potentials])
        for columns in zip(potentials, eigenvalue * masses + loads, masses, strict=True):
            self._append(np.array(columns))
        self._projected = [self._pencil.products(self._basis, image) for image in self._images]

    def _append(self, columns: np.ndarray) -> None:
        """Add a solution ψ with Aψ and Mψ, shape (3, own free unknowns), after orthogonalization."""
        columns = columns / self._norm(columns[0])
        # Gram-Schmidt twice keeps orthogonality to rounding.
        for _ in range(2):
            known = self._pencil.products(self._basis.conj(), columns[:1])[:, 0]
            columns = columns - np.array([known @ part for part in (self._basis, *self._images)])
        left = self._norm(columns[0])
        if left > _DEPENDENT:
            vector, laplace, mass = columns[:, None] / left
            self._basis = np.vstack([self._basis, vector])
            self._images = [np.vstack([self._images[0], laplace]), np.vstack([self._images[1], mass])]

    def project(self, loads: np.ndarray) -> np.ndarray:
        """Return Vᵀf of loads of shape (loads, own free unknowns): shape (loads, basis) (collective)."""
        return self._pencil.products(loads.astype(complex), self._basis)

    def operator(self, eigenvalue: complex) -> np.ndarray:
        """Return VᵀAV − λVᵀMV, shape (basis, basis)."""
        laplace, mass = self._projected
        return laplace - eigenvalue * mass

    def solve(self, eigenvalue: complex, projected: np.ndarray) -> np.ndarray:
        """Return coordinates y of the solutions for projected loads, both of shape (loads, basis)."""
        coordinates: np.ndarray = np.linalg.solve(self.operator(eigenvalue), projected.T).T
        return coordinates

    def potentials(self, coordinates: np.ndarray) -> np.ndarray:
        """Return ψ of coordinates of shape (solutions, basis): shape (solutions, own free unknowns)."""
        potentials: np.ndarray = coordinates @ self._basis
        return potentials

    def residuals(self, eigenvalue: complex, loads: np.ndarray, coordinates: np.ndarray) -> np.ndarray:
        """Return relative residuals |rᵀ D⁻¹ r̄|^{1/2}/|fᵀψ|^{1/2} with the residual r and D = |diag A|, shape (loads,).

        With (A − λM)⁻¹ instead of D⁻¹ the square would be the relative error of fᵀψ (collective).
        """
        responses = np.abs(np.einsum("lv,lv->l", self.project(loads), coordinates))
        # Loads that move hardly any water are compared with the others.
        floor = max(_NO_RESPONSE * float(responses.max(initial=0.0)), np.finfo(float).tiny)
        return self.misfits(eigenvalue, loads, coordinates) / np.sqrt(np.maximum(responses, floor))

    def misfits(self, eigenvalue: complex, loads: np.ndarray, coordinates: np.ndarray) -> np.ndarray:
        """Return |rᵀ D⁻¹ r̄|^{1/2} of solutions, shape (loads,) (collective)."""
        laplace, mass = self._images
        rest = (loads - coordinates @ (laplace - eigenvalue * mass)) * self._weights
        return np.array([self._norm(left) for left in rest])

    def _norm(self, vector: np.ndarray) -> float:
        return float(np.sqrt(self._pencil.comm.allreduce(np.vdot(vector, vector).real, op=MPI.SUM)))
