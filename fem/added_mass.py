"""The added-mass operator M_a = (ρC)ᵀ A⁺ C, and the kinetic operator M + M_a condensed for the eigenproblem."""

from __future__ import annotations

import numpy as np
from petsc4py import PETSc

from hydroelastic.fem.direct import direct_solver
from hydroelastic.fem.pencil import CoupledPencil


def kinetic(pencil: CoupledPencil, displacement: PETSc.Vec, momentum: PETSc.Vec, potential: PETSc.Vec | None) -> None:
    """``momentum`` ← (M + (ρC)ᵀ A⁺ C) ``displacement``; ``potential`` ← A⁺ C ``displacement``, if it is there."""
    _liquid_momentum(pencil, displacement, momentum, potential)
    pencil.mass.multAdd(displacement, momentum, momentum)


def _liquid_momentum(
    pencil: CoupledPencil, displacement: PETSc.Vec, momentum: PETSc.Vec, potential: PETSc.Vec | None
) -> None:
    """``momentum`` ← (ρC)ᵀ A⁺ C ``displacement``; ``potential`` ← A⁺ C ``displacement``, if it is there."""
    if pencil.answer is not None:
        momentum.array[:] = pencil.answer.added_mass @ displacement.array_r
        if potential is not None:
            potential.array[:] = pencil.answer.potentials @ displacement.array_r
        return
    potential = pencil.coupling.createVecLeft() if potential is None else potential
    load = pencil.coupling.createVecLeft()
    pencil.coupling.mult(displacement, load)
    pencil.solver.solve(load, potential)
    pencil.momentum.multTranspose(potential, momentum)


def body_added_mass(pencil: CoupledPencil) -> np.ndarray:
    """Added-mass matrix of the body shapes with the free surface fixed."""
    return body_responses(pencil)[0]


def body_responses(pencil: CoupledPencil, unknowns: np.ndarray | None = None) -> tuple[np.ndarray, list[PETSc.Vec]]:
    """As `body_added_mass`, of all or of some body unknowns, with ψ for a unit displacement of each (collective)."""
    columns = np.arange(pencil.body_size) if unknowns is None else unknowns
    unit, momentum = pencil.stiffness.createVecs()
    rows, potentials = [], []
    for column in columns:
        _set_unit(unit, int(column))
        potential = pencil.coupling.createVecLeft()
        _liquid_momentum(pencil, unit, momentum, potential)
        rows.append(pencil.body_values(momentum)[columns])
        potentials.append(potential)
    return np.array(rows).reshape(len(columns), len(columns)), potentials


def _set_unit(vector: PETSc.Vec, index: int) -> None:
    vector.set(0.0)
    vector.setValue(index, 1.0)
    vector.assemble()


class CondensedKinetics:
    """The operator whose eigenvalues, with K, are 1/λ: kinetic energy with the motions without stiffness condensed.

    Rigid motions without restoring force (K R = 0) and the constants α of ψ carry no potential energy. They follow the
    other unknowns e at once, from Rᵀ(M + M_a)ζ + Vᵣᵀα = 0 and Vᵀζ = 0, where V holds the volumes of the constraints
    and Vᵣ the rigid motions' part of it:

        D (r, α) = −Wᵀ e,     M_c = M + M_a − W D⁻¹ Wᵀ,     W = [(M + M_a) R, V],  D = [[Rᵀ(M + M_a)R, Vᵣ], [Vᵣᵀ, 0]]

    Constraints, or combinations of them, in which no such motion takes part stay with e, and are kept by the
    K-orthogonal projection. M_c is symmetric and semi-definite; the condensed motions have eigenvalue zero, the
    smallest one.
    """

    def __init__(self, pencil: CoupledPencil, *, keeps: bool = False) -> None:
        """Solve for the potential of each condensed motion (collective)."""
        self.pencil = pencil
        self.potentials: list[PETSc.Vec] = []
        self._keeps = keeps
        self.free_rigid = pencil.free_rigid
        self.definite_stiffness = _definite(pencil)
        # A known answer of the liquid gives the momentum without it.
        self._potential = pencil.coupling.createVecLeft() if pencil.answer is None else None
        self._projected, self._momentum = pencil.stiffness.createVecs()
        self._turn, with_rigid = pencil.rigid_constraints
        # Negative directions of K under the volume constraints: the number of growing modes.
        self.negative = len(pencil.unstable)
        volumes = [self._combined(column) for column in self._turn.T]
        self._columns = [*self._rigid_columns(), *volumes[:with_rigid]]
        self._dense = self._dense_block()
        self._kept = volumes[with_rigid:]
        self._corrections = self._projection(self._kept)

    def _combined(self, weights: np.ndarray) -> PETSc.Vec:
        volume = self._momentum.duplicate()
        volume.set(0.0)
        for weight, constraint in zip(weights, self.pencil.constraints, strict=True):
            volume.axpy(float(weight), constraint.volume)
        return volume

    def _rigid_columns(self) -> list[PETSc.Vec]:
        columns = []
        for index in self.free_rigid:
            _set_unit(self._projected, int(index))
            column = self._momentum.duplicate()
            kinetic(self.pencil, self._projected, column, self._potential)
            columns.append(column)
            self._keep()
        self._of_rigid, self.potentials = self.potentials, []
        return columns

    def _keep(self) -> None:
        if self._keeps and self._potential is not None:
            self.potentials.append(self._potential.copy())

    def _dense_block(self) -> np.ndarray:
        size, rigid = len(self._columns), len(self.free_rigid)
        block = np.zeros((size, size))
        for number, column in enumerate(self._columns):
            block[:rigid, number] = self.pencil.body_values(column)[self.free_rigid]
        block[rigid:, :rigid] = block[:rigid, rigid:].T
        return 0.5 * (block + block.T)

    def _projection(self, volumes: list[PETSc.Vec]) -> list[PETSc.Vec]:
        """K⁻¹V (VᵀK⁻¹V)⁻¹: displacements that compensate a unit of one volume and none of the others."""
        if not volumes:
            return []
        solver = direct_solver(self.definite_stiffness)
        raw = []
        for volume in volumes:
            correction = volume.duplicate()
            solver.solve(volume, correction)
            # The unit diagonal of a free rigid motion is not a stiffness.
            set_entries(correction, self.free_rigid, np.zeros(len(self.free_rigid)))
            self.flip_unstable(correction)
            raw.append(correction)
        answers = np.array([[volume.dot(correction) for correction in raw] for volume in volumes])
        # Sylvester's law: on the displacements that keep the volumes K has this number fewer negative directions.
        self.negative -= int(np.sum(np.linalg.eigvalsh(0.5 * (answers + answers.T)) < 0.0))
        inverse = np.linalg.inv(answers)
        corrections = []
        for column in inverse.T:
            correction = raw[0].duplicate()
            correction.set(0.0)
            correction.maxpy(list(map(float, column)), raw)
            corrections.append(correction)
        return corrections

    def _follow(self, displacement: PETSc.Vec) -> np.ndarray:
        if not self._columns:
            return np.empty(0)
        return np.linalg.solve(self._dense, np.array([column.dot(displacement) for column in self._columns]))

    def mult(self, _matrix: PETSc.Mat | None, displacement: PETSc.Vec, result: PETSc.Vec) -> None:
        """``result`` ← M_c ``displacement`` (the signature is that of a PETSc shell matrix)."""
        displacement.copy(self._projected)
        self._project(self._projected)
        kinetic(self.pencil, self._projected, result, self._potential)
        self._keep()
        for column, factor in zip(self._columns, self._follow(self._projected), strict=True):
            result.axpy(-factor, column)
        set_entries(result, self.free_rigid, np.zeros(len(self.free_rigid)))
        for volume, pressure in zip(self._kept, [c.dot(result) for c in self._corrections], strict=True):
            result.axpy(-pressure, volume)

    def _project(self, displacement: PETSc.Vec) -> None:
        """Project onto e: remove free rigid motions, and volume where a constraint acts on e."""
        set_entries(displacement, self.free_rigid, np.zeros(len(self.free_rigid)))
        taken = [volume.dot(displacement) for volume in self._kept]
        for correction, volume in zip(self._corrections, taken, strict=True):
            displacement.axpy(-volume, correction)

    def flip_unstable(self, vector: PETSc.Vec) -> None:
        """Change the sign of the unstable motions' entries: from |K| to K, or back."""
        if len(self.pencil.unstable):
            values = self.pencil.body_values(vector)
            set_entries(vector, self.pencil.unstable, -values[self.pencil.unstable])

    def recover(self, displacement: PETSc.Vec, potential: PETSc.Vec, *, known: bool = False) -> None:
        """Complete an eigenvector: fill in the condensed rigid motions, and ψ with its constants."""
        self._project(displacement)
        follow = -self._follow(displacement)
        rigid = len(self.free_rigid)
        set_entries(displacement, self.free_rigid, follow[:rigid])
        if known:
            potential.maxpy(list(map(float, follow[:rigid])), self._of_rigid)
            self.pencil.momentum.multTranspose(potential, self._momentum)
            self.pencil.mass.multAdd(displacement, self._momentum, self._momentum)
        else:
            kinetic(self.pencil, displacement, self._momentum, potential)
        held = [-correction.dot(self._momentum) for correction in self._corrections]
        pressures = self._turn @ np.array([*follow[rigid:], *held])
        layer_of = self.pencil.liquid.owned_layer_of
        values = potential.array
        for constraint, pressure in zip(self.pencil.constraints, pressures, strict=True):
            values[layer_of == constraint.layer] += pressure / constraint.density


def set_entries(vector: PETSc.Vec, indices: np.ndarray, values: np.ndarray) -> None:
    """Set body entries of a surface vector; they lie on rank 0."""
    if vector.comm.rank == 0 and len(indices):
        vector.array[indices] = values
    vector.assemble()


def _definite(pencil: CoupledPencil) -> PETSc.Mat:
    """K with ones on the diagonal at body unknowns whose row is zero, and without the signs of the unstable ones."""
    matrix, free, unstable = pencil.stiffness, pencil.free_rigid, pencil.unstable
    if not len(free) and not len(unstable):
        return matrix
    diagonal = matrix.getDiagonal()
    set_entries(diagonal, free, np.ones(len(free)))
    set_entries(diagonal, unstable, -pencil.body_stiffness[unstable])
    copy = matrix.copy()
    copy.setOption(PETSc.Mat.Option.NEW_NONZERO_LOCATION_ERR, False)
    copy.setDiagonal(diagonal)
    copy.assemble()
    return copy
