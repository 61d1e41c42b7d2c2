"""The added-mass operator M_a = ρ Cᵀ A⁺ C, and the kinetic operator M + M_a condensed for the eigenproblem."""

from __future__ import annotations

import numpy as np
from petsc4py import PETSc

from hydroelastic.fem.direct import direct_solver
from hydroelastic.fem.pencil import CoupledPencil


def kinetic(pencil: CoupledPencil, displacement: PETSc.Vec, momentum: PETSc.Vec, potential: PETSc.Vec) -> None:
    """``momentum`` ← (M + ρ Cᵀ A⁺ C) ``displacement``; ``potential`` ← A⁺ C ``displacement``."""
    _liquid_momentum(pencil, displacement, momentum, potential)
    pencil.mass.multAdd(displacement, momentum, momentum)


def _liquid_momentum(pencil: CoupledPencil, displacement: PETSc.Vec, momentum: PETSc.Vec, potential: PETSc.Vec) -> None:
    """``momentum`` ← ρ Cᵀ A⁺ C ``displacement``; ``potential`` ← A⁺ C ``displacement``."""
    load = pencil.coupling.createVecLeft()
    pencil.coupling.mult(displacement, load)
    pencil.solver.solve(load, potential)
    pencil.coupling.multTranspose(potential, momentum)
    momentum.scale(pencil.density)


def body_added_mass(pencil: CoupledPencil) -> np.ndarray:
    """Added-mass matrix of the body shapes with the free surface held still.

    Args:
        pencil: the coupled problem. Under ψ = 0 on the water this is the high-frequency added mass; under a lid the
            volume of each shape is spread over the moving surfaces.

    Returns:
        ρ∫φᵢψⱼ, shape (functions, functions), in the pencil's units.
    """
    size = pencil.body_size
    unit, momentum = pencil.stiffness.createVecs()
    potential = pencil.coupling.createVecLeft()
    rows = []
    for column in range(size):
        _set_unit(unit, column)
        _liquid_momentum(pencil, unit, momentum, potential)
        rows.append(pencil.body_values(momentum))
    return np.array(rows).reshape(size, size)


def _set_unit(vector: PETSc.Vec, index: int) -> None:
    vector.set(0.0)
    vector.setValue(index, 1.0)
    vector.assemble()


class CondensedKinetics:
    """The operator whose eigenvalues, with K, are 1/λ: kinetic energy with all that has no stiffness condensed.

    Rigid motions without restoring force (K r = 0) and the constant α of ψ carry no potential energy. They follow the
    other unknowns e at once, from Rᵀ(M + M_a)ζ + α Vᵣ = 0 and Vᵀζ = 0:

        D (r, α) = −Wᵀ e,     M_c = M + M_a − W D⁻¹ Wᵀ,     W = [(M + M_a) R, V],  D = [[Rᵀ(M + M_a)R, Vᵣ], [Vᵣᵀ, 0]]

    When no such rigid motion displaces volume, the constraint Vᵀζ = 0 stays with e, and is kept by the K-orthogonal
    projection. M_c is symmetric and semi-definite; what it condenses has eigenvalue zero, at the far end.
    """

    def __init__(self, pencil: CoupledPencil) -> None:
        """Solve for the liquid's answer to each condensed motion (collective)."""
        self.pencil = pencil
        self.free_rigid = pencil.free_rigid
        self.definite_stiffness = _with_unit_diagonal(pencil.stiffness, self.free_rigid)
        self._closed = pencil.liquid.keeps_volume
        self._potential = pencil.coupling.createVecLeft()
        self._projected, self._momentum = pencil.stiffness.createVecs()
        self.rigid_displaces = pencil.rigid_displaces
        self._columns = self._condensed_columns()
        self._dense = self._dense_block()
        self._correction: PETSc.Vec | None = None
        if self._closed and not self.rigid_displaces:
            self._correction = pencil.stiffness.createVecRight()
            solver = direct_solver(self.definite_stiffness)
            solver.solve(pencil.volume, self._correction)
            self._correction.scale(1.0 / pencil.volume.dot(self._correction))
            # The unit diagonal of a free rigid motion is not a stiffness.
            set_entries(self._correction, self.free_rigid, np.zeros(len(self.free_rigid)))

    def _condensed_columns(self) -> list[PETSc.Vec]:
        columns = []
        for index in self.free_rigid:
            _set_unit(self._projected, int(index))
            column = self._momentum.duplicate()
            kinetic(self.pencil, self._projected, column, self._potential)
            columns.append(column)
        if self._closed and self.rigid_displaces:
            columns.append(self.pencil.volume.copy())
        return columns

    def _dense_block(self) -> np.ndarray:
        size, rigid = len(self._columns), len(self.free_rigid)
        block = np.zeros((size, size))
        for number, column in enumerate(self._columns):
            block[:rigid, number] = self.pencil.body_values(column)[self.free_rigid]
        if size > rigid:
            block[rigid, :rigid] = block[:rigid, rigid]
        return 0.5 * (block + block.T)

    def _follow(self, displacement: PETSc.Vec) -> np.ndarray:
        """D⁻¹ Wᵀ e."""
        if not self._columns:
            return np.empty(0)
        return np.linalg.solve(self._dense, np.array([column.dot(displacement) for column in self._columns]))

    def mult(self, _matrix: PETSc.Mat | None, displacement: PETSc.Vec, result: PETSc.Vec) -> None:
        """``result`` ← M_c ``displacement`` (the signature is that of a PETSc shell matrix)."""
        displacement.copy(self._projected)
        self._project(self._projected)
        kinetic(self.pencil, self._projected, result, self._potential)
        for column, factor in zip(self._columns, self._follow(self._projected), strict=True):
            result.axpy(-factor, column)
        set_entries(result, self.free_rigid, np.zeros(len(self.free_rigid)))
        if self._correction is not None:
            result.axpy(-self._correction.dot(result), self.pencil.volume)

    def _project(self, displacement: PETSc.Vec) -> None:
        """Remove what has no part in e: free rigid motions, and volume where the constraint is on e."""
        set_entries(displacement, self.free_rigid, np.zeros(len(self.free_rigid)))
        if self._correction is not None:
            displacement.axpy(-self.pencil.volume.dot(displacement), self._correction)

    def recover(self, displacement: PETSc.Vec, potential: PETSc.Vec) -> None:
        """Complete an eigenvector: fill in the condensed rigid motions, and ψ with its constant.

        Args:
            displacement: e on entry, ζ on return.
            potential: ψ on return.
        """
        self._project(displacement)
        follow = -self._follow(displacement)
        set_entries(displacement, self.free_rigid, follow[: len(self.free_rigid)])
        kinetic(self.pencil, displacement, self._momentum, potential)
        if not self._closed:
            return
        constant = follow[-1] if self.rigid_displaces else -self._correction.dot(self._momentum)  # type: ignore[union-attr]
        potential.shift(constant / self.pencil.density)


def set_entries(vector: PETSc.Vec, indices: np.ndarray, values: np.ndarray) -> None:
    """Set body entries of a surface vector; they lie on rank 0."""
    if vector.comm.rank == 0 and len(indices):
        vector.array[indices] = values
    vector.assemble()


def _with_unit_diagonal(matrix: PETSc.Mat, indices: np.ndarray) -> PETSc.Mat:
    """A copy with ones on the diagonal at body unknowns whose row is zero."""
    if not len(indices):
        return matrix
    diagonal = matrix.getDiagonal()
    set_entries(diagonal, indices, np.ones(len(indices)))
    copy = matrix.copy()
    copy.setOption(PETSc.Mat.Option.NEW_NONZERO_LOCATION_ERR, False)
    copy.setDiagonal(diagonal)
    copy.assemble()
    return copy
