"""Reduced basis of open water: Galerkin's method on solutions at a few frequencies.

With a basis V of solutions at some frequencies, (VᵀAV − λVᵀMV) y = Vᵀf gives ψ ≈ Vy at any other. The matrices are
complex symmetric, so that H = Fᵀψ is exact with its first derivative where solutions are in V, and
elsewhere its error is of second order in that of ψ.

Source: A. Bultheel and M. Van Barel, J. Comput. Appl. Math. 14 (1986) 401 (rational
interpolation by projection); Y. Maday et al. on reduced bases.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from mpi4py import MPI

from hydroelastic.fem.open_water.complex_scaling import complex_product
from hydroelastic.fem.open_water.pencil import OpenPencil

# A vector whose part orthogonal to the basis is smaller, relative to its norm, is not added.
_DEPENDENT = 1e-11
# Part of the largest response below which one is rounding.
_NO_RESPONSE = 1e-8


@dataclass(frozen=True, kw_only=True)
class LoadProducts:
    """Products of loads f with each other and with a basis V.

    Attributes:
        projected: fᵀV, shape (loads, basis).
        gram: f̄D⁻¹f, shape (loads, loads).
        images: products of D⁻¹AV̄ and D⁻¹MV̄ with f, shape (2, basis, loads).
    """

    projected: np.ndarray
    gram: np.ndarray
    images: np.ndarray


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
        # D^{-1/2}AV and D^{-1/2}MV, and their products with each other, VᵀĀD⁻¹AV …, shape (2, basis, 2, basis).
        self._weighed = np.zeros((2, 0, own), dtype=complex)
        self._gram = np.zeros((2, 0, 2, 0), dtype=complex)

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
        known, size = self._weighed.shape[1], self.size
        self._projected = [self._pencil.products(self._basis, image) for image in self._images]
        added = np.array([image[known:] * self._weights for image in self._images])
        self._weighed = np.concatenate([self._weighed, added], axis=1)
        gram = np.zeros((2, size, 2, size), dtype=complex)
        gram[:, :known, :, :known] = self._gram
        rows = self._weighed.reshape(2 * size, -1)
        further = self._pencil.products(rows.conj(), added.reshape(-1, rows.shape[1]))
        gram[:, :, :, known:] = further.reshape(2, size, 2, -1)
        gram[:, known:, :, :] = gram[:, :, :, known:].transpose(2, 3, 0, 1).conj()
        self._gram = gram

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

    def lift(self) -> Callable[[np.ndarray], np.ndarray]:
        """Return `potentials` on the basis as it is now, a function of coordinates."""
        basis = self._basis
        return lambda coordinates: coordinates @ basis

    def residuals(self, eigenvalue: complex, loads: np.ndarray, coordinates: np.ndarray) -> np.ndarray:
        """Return relative residuals |rᵀ D⁻¹ r̄|^{1/2}/|fᵀψ|^{1/2} with the residual r and D = |diag A|, shape (loads,).

        With (A − λM)⁻¹ instead of D⁻¹ the square would be the relative error of fᵀψ (collective).
        """
        responses = np.einsum("lv,lv->l", self.project(loads), coordinates)
        return self._relative(self.misfits(eigenvalue, loads, coordinates), responses)

    def misfits(self, eigenvalue: complex, loads: np.ndarray, coordinates: np.ndarray) -> np.ndarray:
        """Return |rᵀ D⁻¹ r̄|^{1/2} of solutions, shape (loads,) (collective)."""
        laplace, mass = self._images
        rest = (loads - coordinates @ (laplace - eigenvalue * mass)) * self._weights
        return np.array([self._norm(left) for left in rest])

    def load_products(self, loads: np.ndarray) -> LoadProducts:
        """Return products of loads, shape (loads, own free unknowns), with each other and with the basis
        (collective)."""
        wet = np.flatnonzero(loads.any(axis=0))
        weighed, rows = loads[:, wet] * self._weights[wet], self._weighed[:, :, wet].reshape(2 * self.size, len(wet))
        found = self._pencil.products(np.vstack([weighed, rows]).conj(), weighed)
        return LoadProducts(
            projected=self._pencil.products(loads[:, wet], self._basis[:, wet]),
            gram=found[: len(loads)],
            images=found[len(loads) :].reshape(2, self.size, len(loads)),
        )

    def known_residuals(
        self, eigenvalue: complex, products: LoadProducts, parts: np.ndarray, coordinates: np.ndarray
    ) -> np.ndarray:
        """Return `residuals` from products alone; below 1e-8 they are rounding.

        Args:
            eigenvalue: λ.
            products: of some loads.
            parts: combinations of these, shape (combinations, loads).
            coordinates: y of each combination, shape (combinations, basis).
        """
        # r = Pf − y(A − λM): −1 and λ are the factors of A and M.
        factors = np.stack([-coordinates, eigenvalue * coordinates], axis=1)
        flat, size = factors.reshape(len(parts), -1), 2 * self.size
        squares = (parts.conj() @ products.gram * parts).sum(axis=1)
        squares += (flat.conj() @ self._gram.reshape(size, size) * flat).sum(axis=1)
        squares += 2.0 * (flat.conj() @ products.images.reshape(size, -1) * parts).sum(axis=1)
        misfits = np.sqrt(np.maximum(squares.real, 0.0))
        return self._relative(misfits, (parts @ products.projected * coordinates).sum(axis=1))

    @staticmethod
    def _relative(misfits: np.ndarray, responses: np.ndarray) -> np.ndarray:
        sizes = np.abs(responses)
        # Loads that move hardly any water are compared with the others.
        floor = max(_NO_RESPONSE * float(sizes.max(initial=0.0)), np.finfo(float).tiny)
        relative: np.ndarray = misfits / np.sqrt(np.maximum(sizes, floor))
        return relative

    def _norm(self, vector: np.ndarray) -> float:
        return float(np.sqrt(self._pencil.comm.allreduce(np.vdot(vector, vector).real, op=MPI.SUM)))
