"""Natural modes of a pencil on its surface unknowns, by SLEPc, and an independent count by inertia.

    K ζ = λ (M + M_a) ζ  under  V ζ = 0        λ = ω²; negative: a growing motion e^{σt} with σ² = −λ

With ζ = Z z where the columns of Z span the displacements that keep the volumes, and a shift s above all −λ, K + s T is
positive definite, T = M + M_a, and the lowest modes are the largest μ of

    L⁻¹ T L⁻ᵀ h = μ h,    K + s T = L Lᵀ,    λ = 1/μ − s,

whatever the signs of K; motions without stiffness come out as λ = 0, and are not reported. Unknowns are scaled to unit
diagonal first: stiffnesses of high dry modes exceed those of the water by many powers of ten.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise

import numpy as np
from dolfinx import fem
from mpi4py import MPI
from numpy.typing import NDArray
from petsc4py import PETSc
from scipy.linalg import cholesky, lapack, qr, solve_triangular
from slepc4py import SLEPc

from hydroelastic.fem.core.pencil import Pencil
from hydroelastic.fem.solver_error import EigenSolverError

Array = NDArray[np.float64]

HIDDEN = 1e-13
"""Modes with 1/λ below this part of the largest are lost in rounding."""

# Volumes below this part of the largest are rounding.
_NO_WORK = 1e-6
# Up to so many unknowns LAPACK finds all pairs sooner than others some of them.
_FEW = 120
# The shift in parts of the smallest restoring: the lowest λ is of its size.
_SHIFT = 0.05


@dataclass(frozen=True, kw_only=True)
class Modes:
    """The lowest modes of a pencil, ascending, at unit generalized mass.

    Attributes:
        pencil: theirs.
        values: λ, shape (modes,).
        vectors: ζ, shape (n, modes).
        residuals: relative, shape (modes,).
        growing: number of the first ones that grow, λ < 0.
        complete: whether there are no others.
        zero_modes: number of motions without stiffness.
    """

    pencil: Pencil
    values: Array
    vectors: Array
    residuals: Array
    growing: int
    complete: bool
    zero_modes: int

    @property
    def amplitudes(self) -> Array:
        """Body part of ζ, shape (modes, body unknowns)."""
        return self.vectors[: self.pencil.body_size].T

    @cached_property
    def energies(self) -> Array:
        """Shares of each mode in the potential energy: bodies' unknowns, then surfaces; shape (modes, shares)."""
        pencil, size = self.pencil, self.pencil.body_size
        own = self.vectors * (pencil.stiffness @ self.vectors) / self.values
        stops = np.cumsum([size, *(count for _, count in pencil.surfaces)])
        of_surfaces = [own[a:b].sum(axis=0) for a, b in pairwise(stops)]
        return np.vstack([own[:size], *of_surfaces]).T

    def potential(self, number: int) -> fem.Function:
        """ψ of a mode, with the constants of its closed layers (collective)."""
        pencil, liquid = self.pencil, self.pencil.liquid
        zeta, value = self.vectors[:, number], self.values[number]
        psi = pencil.operator.solve((pencil.coupling @ zeta)[:, None])[:, 0]
        # K ζ − λ T ζ = λ Σ ρ c V: the constant c of each closed layer.
        rest = pencil.stiffness @ zeta - value * (pencil.kinetic @ zeta)
        scale = 1.0 / np.sqrt(np.abs(np.diag(pencil.stiffness)) + np.diag(pencil.kinetic))
        constants = np.linalg.lstsq((pencil.volumes * scale).T, scale * rest / value, rcond=1e-9)[0]
        for layer, constant in zip(pencil.closed, constants, strict=True):
            psi[liquid.layer_of == layer] += constant / liquid.densities[layer]
        if (
            len(pencil.closed) > 1
            and np.abs(pencil.volumes.sum(axis=0)).max() < _NO_WORK * np.abs(pencil.volumes).max()
        ):
            # A pressure common to all layers does no work and is arbitrary: its extremes are opposite.
            densities = np.array(liquid.densities)[liquid.layer_of]
            high = liquid.comm.allreduce((densities * psi).max(initial=-np.inf), op=MPI.MAX)
            low = liquid.comm.allreduce((densities * psi).min(initial=np.inf), op=MPI.MIN)
            psi -= 0.5 * (high + low) / densities
        return liquid.function(psi)


def lowest_modes(pencil: Pencil, count: int) -> Modes:
    """Find the lowest modes, growing ones besides (collective)."""
    zero = pencil.zero_modes
    if not pencil.size:
        return _no_modes(pencil)
    shift = _first_shift(pencil)
    found = _shifted(pencil, shift, count, zero)
    positive = found.values[found.values > 0.0]
    if len(positive) and not found.growing and positive[0] < 0.01 * shift:
        found = _shifted(pencil, 2.0 * float(positive[0]), count, zero)
    return found


def _no_modes(pencil: Pencil) -> Modes:
    none = np.empty(0)
    return Modes(
        pencil=pencil,
        values=none,
        vectors=np.empty((pencil.size, 0)),
        residuals=none,
        growing=0,
        complete=True,
        zero_modes=0,
    )


def _first_shift(pencil: Pencil) -> float:
    """More than the largest −λ, which the bodies alone would have; else a part of the restoring of the water."""
    stiffness, mass = np.diag(pencil.stiffness), np.diag(pencil.mass)
    unstable = stiffness < 0.0
    jump = min([1.0, *(surface.jump for surface, _ in pencil.surfaces)])
    return max(_SHIFT * jump, 1.05 * float((-stiffness[unstable] / mass[unstable]).sum()))


def _shifted(pencil: Pencil, shift: float, count: int, zero: int) -> Modes:
    kinetic = pencil.kinetic
    scale = 1.0 / np.sqrt(np.abs(np.diag(pencil.stiffness)) + shift * np.diag(kinetic))
    both = scale[:, None] * scale
    volumes = _Volumes(pencil.volume * scale)
    mass, stiffness = volumes.projected(both * kinetic), volumes.projected(both * pencil.stiffness)
    try:
        factor = cholesky(stiffness + shift * mass, lower=True)
    except np.linalg.LinAlgError as error:
        raise EigenSolverError(
            "the surfaces' matrices are not positive definite to working precision: stiffnesses and densities differ "
            "beyond what double precision resolves"
        ) from error
    operator = np.tril(lapack.dsygst(mass, factor, itype=1, lower=1)[0])
    operator += np.tril(operator, -1).T
    unstable = int(np.count_nonzero(np.diag(pencil.stiffness) < 0.0))
    inverses, vectors = _largest(operator, min(count + zero + unstable + 1, len(operator)))
    residuals = np.linalg.norm(operator @ vectors - inverses * vectors, axis=0) / inverses
    values = 1.0 / inverses - shift
    kept = np.ones(len(values), dtype=bool)
    kept[np.argsort(np.abs(values))[:zero]] = False
    seen = np.where(values > 0.0, values, np.inf)[kept].min(initial=np.inf)
    kept &= (values < 0.0) | (values < seen / HIDDEN)
    order = np.flatnonzero(kept)[np.argsort(values[kept], kind="stable")]
    zeta = scale[:, None] * volumes.whole(solve_triangular(factor, vectors[:, order], lower=True, trans="T"))
    growing = int(np.count_nonzero(values[order] < 0.0))
    return Modes(
        pencil=pencil,
        values=values[order],
        vectors=zeta / np.sqrt(inverses[order]),
        residuals=residuals[order],
        growing=growing,
        complete=len(order) - growing <= count or len(inverses) == len(operator),
        zero_modes=zero,
    )


class _Volumes:
    """Displacements that keep the volumes: of Vᵀ = Q R, the columns of Q beyond R's, by Householder's reflections."""

    def __init__(self, volumes: Array) -> None:
        self._count = len(volumes)
        if self._count:
            (self._reflections, self._factors), _ = qr(volumes.T, mode="raw")

    def _turned(self, matrix: Array, side: str, transposed: str) -> Array:
        own = lapack.dormqr(side, transposed, self._reflections, self._factors, matrix, 64 * max(matrix.shape))
        return np.asarray(own[0])

    def projected(self, matrix: Array) -> Array:
        """Zᵀ (matrix) Z."""
        if not self._count:
            return matrix
        turned = self._turned(self._turned(matrix, "L", "T"), "R", "N")
        return turned[self._count :, self._count :]

    def whole(self, vectors: Array) -> Array:
        """Z (vectors)."""
        if not self._count:
            return vectors
        return self._turned(np.vstack([np.zeros((self._count, vectors.shape[1])), vectors]), "L", "N")


def _largest(operator: Array, count: int) -> tuple[Array, Array]:
    """The largest eigenvalues of a symmetric matrix, descending, and their vectors."""
    matrix = PETSc.Mat().createDense(operator.shape, array=np.asfortranarray(operator), comm=PETSc.COMM_SELF)
    kinds = (SLEPc.EPS.Type.KRYLOVSCHUR, SLEPc.EPS.Type.LAPACK)
    # Also where growth far beyond the waves leaves iterations without convergence.
    for kind in kinds[len(operator) <= max(_FEW, 3 * count) :]:
        solver = SLEPc.EPS().create(PETSc.COMM_SELF)
        solver.setOperators(matrix)
        solver.setProblemType(SLEPc.EPS.ProblemType.HEP)
        solver.setType(kind)
        solver.setWhichEigenpairs(SLEPc.EPS.Which.LARGEST_REAL)
        solver.setDimensions(count)
        solver.setTolerances(1e-14)
        solver.solve()
        if solver.getConverged() >= count:
            break
    else:
        raise EigenSolverError(f"{solver.getConverged()} of {count} modes converged")
    vector = matrix.createVecRight()
    pairs = []
    for number in range(count):
        value = solver.getEigenpair(number, vector).real
        pairs.append((value, vector.array.copy()))
    return np.array([value for value, _ in pairs]), np.array([one for _, one in pairs]).T


def count_below(pencil: Pencil, value: float) -> int:
    """Number of modes with λ below a value, motions without stiffness left out, by the inertia of K − λT.

    By Sylvester's law of inertia of that matrix bordered by the volumes; independent of the iterative solution.
    """
    block = pencil.stiffness - value * pencil.kinetic
    scale = 1.0 / np.sqrt(np.abs(np.diag(pencil.stiffness)) + abs(value) * np.diag(pencil.kinetic))
    volumes = pencil.volume * scale
    if len(volumes):
        volumes /= np.linalg.norm(volumes, axis=1, keepdims=True)
    corner = np.zeros((len(volumes), len(volumes)))
    bordered = np.block([[scale[:, None] * block * scale, volumes.T], [volumes, corner]])
    factor, rows, _ = lapack.dsytrf(bordered, lower=1, lwork=64 * max(len(bordered), 1))
    pivots = np.diag(factor)[rows > 0]
    # A pivot of two rows, which negative numbers mark, has one negative eigenvalue.
    negative = int(np.count_nonzero(pivots < 0.0) + np.count_nonzero(rows < 0) // 2)
    return negative - len(volumes) - pencil.zero_modes
