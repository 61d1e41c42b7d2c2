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
    """Products of loads f on the surfaces of bodies with each other and with a basis V."""

    loads: np.ndarray  # f on `OpenPencil.wet`, shape (loads, wet)
    by_basis: np.ndarray  # fᵀV, and the products of D⁻¹AV̄ and D⁻¹MV̄ with f, shape (3, basis, loads)
    gram: np.ndarray  # f̄D⁻¹f, shape (loads, loads)

    @property
    def projected(self) -> np.ndarray:
        """Vᵀf of each load, shape (loads, basis)."""
        projected: np.ndarray = self.by_basis[0].T
        return projected


class ReducedPencil:
    """A basis that grows by solutions, and the pencil projected on it.

    Attributes:
        size: number of basis vectors.
    """

    def __init__(self, pencil: OpenPencil) -> None:
        self.size = 0
        self._pencil = pencil
        # V, AV and MV, with room for more vectors, and on the surfaces of bodies V, D⁻¹AV̄ and D⁻¹MV̄.
        self._stored = np.zeros((3, 0, len(pencil.free)), dtype=complex)
        self._at_bodies = np.zeros((3, 0, len(pencil.wet)), dtype=complex)
        diagonal = pencil.laplace.real.getDiagonal().array_r + 1j * pencil.laplace.imaginary.getDiagonal().array_r
        self._weights = 1.0 / np.abs(diagonal)
        # VᵀAV and VᵀMV, and VᵀĀD⁻¹AV …, shape (2, basis, 2, basis).
        self._projected = np.zeros((2, 0, 0), dtype=complex)
        self._gram = np.zeros((2, 0, 2, 0), dtype=complex)

    @property
    def _basis(self) -> np.ndarray:
        vectors: np.ndarray = self._stored[0, : self.size]
        return vectors

    @property
    def _images(self) -> np.ndarray:
        images: np.ndarray = self._stored[1:, : self.size]
        return images

    def add(self, eigenvalue: complex, potentials: np.ndarray, loads: np.ndarray) -> None:
        """Add solutions of (A − λM)ψ = f to the basis (collective).

        Aψ is computed as λMψ + f: in elongated cells A is large, and the product with a nearly constant ψ would be lost
        in rounding.
        """
        masses = np.array([complex_product(self._pencil.mass, potential) for potential in potentials])
        vectors, mixing, shift = self._orthonormal(potentials)
        images = np.array([mixing @ (eigenvalue * masses + loads), mixing @ masses]) - shift @ self._images
        known, count = self.size, self.size + len(vectors)
        if count > self._stored.shape[1]:
            # Rows that are not written to take no memory.
            larger = np.empty((3, 2 * count, vectors.shape[1]), dtype=complex)
            larger[:, :known] = self._stored[:, :known]
            self._stored = larger
        self._stored[0, known:count], self._stored[1:, known:count], self.size = vectors, images, count
        wet, products = self._pencil.wet, self._pencil.products
        weighed = (images * self._weights).conj()
        at_bodies = np.concatenate([vectors[None, :, wet], weighed[:, :, wet]])
        self._at_bodies = np.concatenate([self._at_bodies, at_bodies], axis=1)
        projected = np.zeros((2, count, count), dtype=complex)
        gram = np.zeros((2, count, 2, count), dtype=complex)
        projected[:, :known, :known], gram[:, :known, :, :known] = self._projected, self._gram
        for place, image in enumerate(self._images):
            projected[place, known:, :known] = products(vectors, image[:known])
            projected[place, :, known:] = products(self._basis, image[known:])
            further = products(image, weighed.reshape(2 * len(vectors), len(self._weights))).conj()
            gram[place, :, :, known:] = further.reshape(count, 2, len(vectors))
        gram[:, known:, :, :known] = gram[:, :known, :, known:].transpose(2, 3, 0, 1).conj()
        self._projected, self._gram = projected, gram

    def _orthonormal(self, potentials: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Return orthonormal vectors Tψ − CV of potentials ψ, orthogonal to the basis V, with T and C, shapes (vectors,
        own free unknowns), (vectors, potentials), (vectors, basis)."""
        norms = np.array([self._norm(potential) for potential in potentials])
        vectors, mixing = potentials / norms[:, None], np.diag(1.0 / norms).astype(complex)
        shift = np.zeros((len(vectors), self.size), dtype=complex)
        # Gram-Schmidt twice keeps orthogonality to rounding.
        for _ in range(2):
            parts = self._pencil.products(vectors.conj(), self._basis).conj()
            vectors, shift, kept = vectors - parts @ self._basis, shift + parts, 0
            for place in range(len(vectors)):
                parts = self._pencil.products(vectors[place : place + 1].conj(), vectors[:kept]).conj()[0]
                rows = [whole[place] - parts @ whole[:kept] for whole in (vectors, mixing, shift)]
                left = self._norm(rows[0])
                if left > _DEPENDENT:
                    vectors[kept], mixing[kept], shift[kept] = (row / left for row in rows)
                    kept += 1
            vectors, mixing, shift = vectors[:kept], mixing[:kept], shift[:kept]
        return vectors, mixing, shift

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

    def misfits(self, eigenvalue: complex, loads: np.ndarray, coordinates: np.ndarray) -> np.ndarray:
        """Return |rᵀ D⁻¹ r̄|^{1/2} of solutions with the residual r and D = |diag A|, shape (loads,) (collective)."""
        laplace, mass = self._images
        rest = (loads - coordinates @ (laplace - eigenvalue * mass)) * np.sqrt(self._weights)
        return np.array([self._norm(left) for left in rest])

    def load_products(self, loads: np.ndarray, known: LoadProducts | None = None) -> LoadProducts:
        """Return products of loads with each other and with the basis (collective)."""
        products, size = self._pencil.products, self.size
        by_basis = products(self._at_bodies.reshape(3 * size, loads.shape[1]), loads).reshape(3, size, len(loads))
        if known is not None:
            loads, by_basis = np.vstack([known.loads, loads]), np.concatenate([known.by_basis, by_basis], axis=2)
        weighed = (loads * self._weights[self._pencil.wet]).conj()
        return LoadProducts(loads=loads, by_basis=by_basis, gram=products(weighed, loads))

    def residuals(
        self, eigenvalue: complex, products: LoadProducts, parts: np.ndarray, coordinates: np.ndarray
    ) -> np.ndarray:
        """Return `misfits` over |fᵀψ|^{1/2} from products alone, shape (combinations,); below 1e-8 they are rounding.

        With (A − λM)⁻¹ instead of D⁻¹ the square would be the relative error of fᵀψ.
        """
        # r = Pf − y(A − λM): −1 and λ are the factors of A and M.
        factors = np.stack([-coordinates, eigenvalue * coordinates], axis=1)
        flat, size = factors.reshape(len(parts), -1), 2 * self.size
        squares = (parts.conj() @ products.gram * parts).sum(axis=1)
        squares += (flat.conj() @ self._gram.reshape(size, size) * flat).sum(axis=1)
        squares += 2.0 * (flat.conj() @ products.by_basis[1:].reshape(size, parts.shape[1]) * parts).sum(axis=1)
        sizes = np.abs((parts @ products.projected * coordinates).sum(axis=1))
        # Loads that move hardly any water are compared with the others.
        floor = max(_NO_RESPONSE * float(sizes.max(initial=0.0)), np.finfo(float).tiny)
        relative: np.ndarray = np.sqrt(np.maximum(squares.real, 0.0) / np.maximum(sizes, floor))
        return relative

    def _norm(self, vector: np.ndarray) -> float:
        return float(np.sqrt(self._pencil.comm.allreduce(np.vdot(vector, vector).real, op=MPI.SUM)))
