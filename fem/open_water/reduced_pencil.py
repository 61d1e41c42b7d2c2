"""The pencil of open water on a few of its own solutions: Galerkin's method between frequencies.

With a basis V of solutions at some frequencies, (VᵀAV − λVᵀMV) y = Vᵀf gives ψ ≈ Vy at any other. The matrices are
complex symmetric, so that H = Fᵀψ of loads whose solutions are in V is met there with its derivative, and its error
elsewhere is of second order in that of ψ.

Source: A. Bultheel and M. Van Barel, J. Comput. Appl. Math. 14 (1986) 401 (rational
interpolation by projection); Y. Maday et al. on reduced bases.
"""

from __future__ import annotations

import numpy as np
from mpi4py import MPI

from hydroelastic.fem.open_water.complex_scaling import complex_product
from hydroelastic.fem.open_water.pencil import OpenPencil

# What is left of a vector after the basis is taken out, below which it says nothing new.
_DEPENDENT = 1e-11
# Part of the largest response below which one is rounding.
_NO_RESPONSE = 1e-8


class ReducedPencil:
    """A growing basis and the pencil on it.

    Args:
        pencil: the problem.
    """

    def __init__(self, pencil: OpenPencil) -> None:
        """Start with nothing."""
        own = len(pencil.free)
        self._pencil = pencil
        self._basis: np.ndarray = np.zeros((0, own), dtype=complex)
        diagonal = pencil.laplace.real.getDiagonal().array_r + 1j * pencil.laplace.imaginary.getDiagonal().array_r
        self._weights = 1.0 / np.sqrt(np.abs(diagonal))
        # Of A and M: their products with the basis, and those with the basis on both sides.
        self._images: list[np.ndarray] = [self._basis, self._basis]
        self._projected: list[np.ndarray] = [np.zeros((0, 0), dtype=complex)] * 2

    @property
    def size(self) -> int:
        """Number of basis vectors."""
        return len(self._basis)

    def add(self, eigenvalue: complex, potentials: np.ndarray, loads: np.ndarray) -> None:
        """Take solutions of (A − λM)ψ = f into the basis (collective).

        Aψ is taken from λMψ + f: in elongated cells A is large, and Aψ of a ψ that hardly changes there would be lost
        in rounding.

        Args:
            eigenvalue: λ.
            potentials: ψ, shape (solutions, own free unknowns).
            loads: f, of the same shape.
        """
        masses = np.array([complex_product(self._pencil.mass, potential) for potential in potentials])
        for columns in zip(potentials, eigenvalue * masses + loads, masses, strict=True):
            self._append(np.array(columns))
        self._projected = [self._pencil.products(self._basis, image) for image in self._images]

    def _append(self, columns: np.ndarray) -> None:
        """Take in a solution with its images, shape (3, own free unknowns), less what the basis has of it."""
        columns = columns / self._norm(columns[0])
        # Twice is enough.
        for _ in range(2):
            known = self._pencil.products(self._basis.conj(), columns[:1])[:, 0]
            columns = columns - np.array([known @ part for part in (self._basis, *self._images)])
        left = self._norm(columns[0])
        if left > _DEPENDENT:
            vector, laplace, mass = columns[:, None] / left
            self._basis = np.vstack([self._basis, vector])
            self._images = [np.vstack([self._images[0], laplace]), np.vstack([self._images[1], mass])]

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
        """How wrong solutions of loads f are, |rᵀ D⁻¹ r̄|^{1/2}/|fᵀψ|^{1/2} with the residual r and D = |diag A|.

        D⁻¹ stands for (A − λM)⁻¹, with which the square would be the relative error of fᵀψ (collective).
        """
        responses = np.abs(np.einsum("lv,lv->l", self.project(loads), coordinates))
        # A load that moves hardly any water is compared with the others.
        floor = max(_NO_RESPONSE * float(responses.max(initial=0.0)), np.finfo(float).tiny)
        return self.misfits(eigenvalue, loads, coordinates) / np.sqrt(np.maximum(responses, floor))

    def misfits(self, eigenvalue: complex, loads: np.ndarray, coordinates: np.ndarray) -> np.ndarray:
        """|rᵀ D⁻¹ r̄|^{1/2} of the same, not compared with anything (collective)."""
        laplace, mass = self._images
        rest = (loads - coordinates @ (laplace - eigenvalue * mass)) * self._weights
        return np.array([self._norm(left) for left in rest])

    def _norm(self, vector: np.ndarray) -> float:
        return float(np.sqrt(self._pencil.comm.allreduce(np.vdot(vector, vector).real, op=MPI.SUM)))
