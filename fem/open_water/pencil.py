"""Matrices of open water: the complex symmetric pencil A − λM of the liquid and the loads of the bodies.

    (A − λM) ψ = F a,    H(λ) = Fᵀ(A − λM)⁻¹F = a + i b/ω,    λ = ω²

with the waves on every surface of the liquids eliminated: η = λψ/g on a free one, and on an interface
(ρ₂ − ρ₁) g η = λ(ρ₂ψ₂ − ρ₁ψ₁), so that

    M = ρ/g ∫ψq over the free surface + ∫[ρψ][ρq]/((ρ₂ − ρ₁) g) over the interface.

A and M are those of `complex_scaling`; the loads of bodies lie within the basin, and are real.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial

import numpy as np
from mpi4py import MPI
from petsc4py import PETSc

from hydroelastic.fem.interface_coupling import density_jump
from hydroelastic.fem.liquid import LiquidSpace
from hydroelastic.fem.open_water.complex_direct import ShiftedSolver
from hydroelastic.fem.open_water.complex_scaling import (
    ComplexMatrix,
    ComplexScaling,
    scaled_laplace,
    scaled_surface_mass,
)
from hydroelastic.fem.shape_loads import shape_loads
from hydroelastic.fem.surfaces import Body, LiquidSurface


@dataclass(frozen=True, kw_only=True)
class OpenPencil:
    """Matrices of the liquid of open water, and the bodies."""

    liquid: LiquidSpace  # the space of ψ
    bodies: tuple[Body, ...]  # the bodies, in the order of their unknowns
    # local indices of the owned unknowns of ψ where ψ = 0 is not prescribed, shape (own free unknowns,)
    free: np.ndarray
    wet: np.ndarray  # places among these of the unknowns on the surfaces of bodies, where loads act, shape (wet,)
    laplace: ComplexMatrix  # A on the free unknowns
    mass: ComplexMatrix  # M on the free unknowns
    loads: np.ndarray  # F, own entries of the free unknowns, shape (body unknowns, own free unknowns)
    # returns the derivatives of A and M with respect to the angle α of the complex scaling
    turning: Callable[[], tuple[ComplexMatrix, ComplexMatrix]]

    @property
    def comm(self) -> MPI.Comm:
        """Communicator of the mesh."""
        return self.liquid.tank.mesh.comm

    @property
    def size(self) -> int:
        """Number of free unknowns."""
        return int(self.laplace.real.getSize()[0])

    def solver(self) -> ShiftedSolver:
        """Return the solver (A − λM)⁻¹ (collective)."""
        return ShiftedSolver(self.laplace, self.mass)

    def products(self, rows: np.ndarray, columns: np.ndarray) -> np.ndarray:
        """Sum products over the free unknowns of all processes, without conjugation: shape (rows, columns)
        (collective)."""
        total = rows @ columns.T
        self.comm.Allreduce(MPI.IN_PLACE, total)
        return np.asarray(total)

    def vector(self, values: np.ndarray) -> PETSc.Vec:
        """Return a real ψ on all unknowns, from its values on the own free unknowns, shape (free unknowns,)
        (collective)."""
        count = self.liquid.space.dofmap.index_map.size_local
        vector = PETSc.Vec().createMPI((count, PETSc.DETERMINE), comm=self.laplace.real.comm)
        vector.array[self.free] = values
        return vector


def build_open_pencil(
    liquid: LiquidSpace, scaling: ComplexScaling, *, bodies: tuple[Body, ...], surfaces: tuple[LiquidSurface, ...]
) -> OpenPencil:
    """Assemble the problem (collective)."""
    zero_potential = liquid.surface_dofs(liquid.zero_potential)
    free = np.setdiff1d(np.arange(liquid.space.dofmap.index_map.size_local, dtype=np.int32), zero_potential)
    matrices = partial(_matrices, liquid, scaling, surfaces, free)
    laplace, mass = matrices(derivative=False)
    loads = [weighed_loads(liquid, body)[:, free] for body in bodies if body.size]
    return OpenPencil(
        liquid=liquid,
        bodies=bodies,
        free=free,
        wet=np.flatnonzero(np.isin(free, liquid.surface_dofs(tuple(body.surface for body in bodies)))),
        laplace=laplace,
        mass=mass,
        loads=np.vstack(loads) if loads else np.zeros((0, len(free))),
        turning=partial(matrices, derivative=True),
    )


def _matrices(
    liquid: LiquidSpace,
    scaling: ComplexScaling,
    surfaces: tuple[LiquidSurface, ...],
    free: np.ndarray,
    *,
    derivative: bool,
) -> tuple[ComplexMatrix, ComplexMatrix]:
    """A and M on the free unknowns, or their derivatives with respect to α."""
    laplace = scaled_laplace(liquid, scaling, derivative=derivative)
    mass = _wave_mass(liquid, scaling, surfaces, laplace, derivative=derivative)
    rows = PETSc.IS().createGeneral(
        (free + laplace.real.getOwnershipRange()[0]).astype(PETSc.IntType), comm=laplace.real.comm
    )
    return _on(laplace, rows), _on(mass, rows)


def weighed_loads(liquid: LiquidSpace, body: Body) -> np.ndarray:
    """Return F of a body, own entries of all unknowns, shape (body unknowns, own unknowns) (collective)."""
    densities = np.array([layer.density for layer in liquid.layers])
    loads: np.ndarray = shape_loads(liquid, body) * densities[liquid.owned_layer_of]
    return loads


def _wave_mass(
    liquid: LiquidSpace,
    scaling: ComplexScaling,
    surfaces: tuple[LiquidSurface, ...],
    like: ComplexMatrix,
    *,
    derivative: bool,
) -> ComplexMatrix:
    parts = []
    for surface in surfaces:
        trace = scaled_surface_mass(liquid, scaling, surface.surface, derivative=derivative)
        parts.append(
            ComplexMatrix(
                real=density_jump(liquid, surface, trace.real), imaginary=density_jump(liquid, surface, trace.imaginary)
            )
        )
    return ComplexMatrix(
        real=_sum([part.real for part in parts], like.real),
        imaginary=_sum([part.imaginary for part in parts], like.real),
    )


def _sum(matrices: list[PETSc.Mat], like: PETSc.Mat) -> PETSc.Mat:
    if not matrices:
        zero = PETSc.Mat().createAIJ(like.getSizes(), nnz=1, comm=like.comm)
        zero.assemble()
        return zero
    total = matrices[0]
    for matrix in matrices[1:]:
        total.axpy(1.0, matrix, structure=PETSc.Mat.Structure.DIFFERENT_NONZERO_PATTERN)
    return total


def _on(matrix: ComplexMatrix, rows: PETSc.IS) -> ComplexMatrix:
    return ComplexMatrix(
        real=matrix.real.createSubMatrix(rows, rows), imaginary=matrix.imaginary.createSubMatrix(rows, rows)
    )
