"""ψ = 0 on the water beside plates: the liquid under the plates alone, their modes and first elastic tones.

With A = k tanh kH of the whole plan, ψ of a load on the plates is A⁻¹ of it among the functions that vanish on the
water. On them A is as large as k tanh kH of the plates' own plan with ψ = 0 at their edges, but for a factor of order
one: both are norms of H^{1/2} (Lions and Magenes). Its inverse P preconditions Davidson's method, in which A is never
inverted: with p = Mv + Cᵀψ the motions of the plates (v, ψ) solve

    [M; C] K⁻¹ p = (1/λ) (Mv, Aψ)

and the residual of each mode, by P, is the next vector: ten of them on any mesh.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from petsc4py import PETSc
from scipy.linalg import block_diag

from hydroelastic.fem.direct import direct_solver
from hydroelastic.fem.plan.plan_pencil import PlanPlate, PlanSpace, water_unknowns
from hydroelastic.fem.surfaces import Body
from hydroelastic.modal.liquid.vertical_poles import VerticalPoles, vertical_poles
from hydroelastic.physics.arrays import FloatArray
from hydroelastic.physics.dofs import FIRST_ELASTIC

_MOST_STEPS = 40
# Part of 1/λ by which the residual of a tone changes it at most, if the next mode is as far as another 1/λ.
_RESIDUAL = 1e-9
# Of the energy of unit vectors, the part that others of the basis may leave of it.
_INDEPENDENT = 1e-12
# Error of the poles of P.
_ROUGH = 0.05
# The softest shapes of each plate, with which the method starts.
_START = 6


@dataclass(frozen=True, kw_only=True)
class ReleasedProblem:
    """A symmetry class with ψ = 0 on the water, in the unknowns of ψ that are zero there.

    Attributes:
        bodies: the plates that move in it.
        free: these unknowns among all of ψ.
        loads: ∫φq of their shapes, shape (shapes, unknowns).
        apply: A.
        precondition: P.
        poles: number of poles of A.
    """

    bodies: tuple[Body, ...]
    free: np.ndarray
    loads: FloatArray
    apply: Callable[[FloatArray], FloatArray]
    precondition: Callable[[FloatArray], FloatArray]
    poles: int = 0

    @property
    def stiffness(self) -> FloatArray:
        """K of all shapes."""
        return np.concatenate([body.stiffness for body in self.bodies])


@dataclass(frozen=True, kw_only=True)
class _PoleStiffness:
    """A = 1/f_h of the plan's Laplacian: α K₂ + β M₂ − Σ_i γ_i M₂ (K₂ + δ_i M₂)⁻¹ M₂ with f_h(−δ_i) = 0."""

    space: PlanSpace
    poles: VerticalPoles

    @cached_property
    def _parts(self) -> tuple[float, FloatArray, FloatArray]:
        poles = self.poles
        roots = np.sqrt(poles.weights / poles.weights.sum())
        others = np.linalg.svd(roots[None])[2][1:].T
        zeros = np.linalg.eigvalsh(others.T @ (poles.shifts[:, None] * others))
        factors = 1.0 / (poles.weights / (poles.shifts - zeros[:, None]) ** 2).sum(axis=1)
        return 1.0 / float(poles.weights.sum()), factors, zeros

    @cached_property
    def _solvers(self) -> list[PETSc.KSP]:
        return [_factorized(self.space.stiffness, self.space.mass, shift) for shift in self._parts[2]]

    def product(self, values: PETSc.Vec) -> FloatArray:
        """Return A ψ."""
        space = self.space
        slope, factors, zeros = self._parts
        mass, part = space.mass * values, values.duplicate()
        total = slope * (space.stiffness * values).array_r + (factors / zeros).sum() * mass.array_r
        for factor, solver in zip(factors, self._solvers, strict=True):
            solver.solve(mass, part)
            total = total - factor * (space.mass * part).array_r
        return np.asarray(total)


def released_plan(space: PlanSpace, poles: VerticalPoles, plates: tuple[PlanPlate, ...]) -> ReleasedProblem:
    """Return the problem of a symmetry class of a plan in which the plates move, alike on each process.

    P is that of a few poles under the plates with ψ = 0 at their edges.
    """
    free = np.setdiff1d(np.arange(space.size), water_unknowns(space))
    rows = PETSc.IS().createGeneral(free.astype(PETSc.IntType), comm=PETSc.COMM_SELF)
    stiffness, mass = (matrix.createSubMatrix(rows, rows) for matrix in (space.stiffness, space.mass))
    few = vertical_poles(1.0 / float(poles.weights[0]), poles.wavenumber, _ROUGH, lowest=1.0)
    solvers = [_factorized(stiffness, mass, shift) for shift in few.shifts]
    operator, whole = _PoleStiffness(space=space, poles=poles), space.mass.createVecRight()
    right, left = mass.createVecs()

    def apply(values: FloatArray) -> FloatArray:
        whole.array[free] = values
        return operator.product(whole)[free]

    def precondition(values: FloatArray) -> FloatArray:
        left.array[:] = values
        total = np.zeros_like(values)
        for weight, solver in zip(few.weights, solvers, strict=True):
            solver.solve(left, right)
            total += weight * right.array_r
        return total

    moving = tuple(plate for plate in plates if plate.body.size)
    return ReleasedProblem(
        bodies=tuple(plate.body for plate in moving),
        free=free,
        loads=np.concatenate([space.loads(plate)[:, free] for plate in moving]),
        apply=apply,
        precondition=precondition,
        poles=len(poles.shifts),
    )


def _factorized(stiffness: PETSc.Mat, mass: PETSc.Mat, shift: float) -> PETSc.KSP:
    matrix = stiffness.copy()
    matrix.axpy(float(shift), mass, structure=PETSc.Mat.Structure.SAME_NONZERO_PATTERN)
    return direct_solver(matrix)


@dataclass(frozen=True, kw_only=True)
class _Motions:
    """Vectors (v, ψ) with their momentum p and Aψ, one in each row."""

    shapes: FloatArray
    potentials: FloatArray
    momentum: FloatArray
    images: FloatArray

    def combined(self, weights: FloatArray) -> _Motions:
        return _Motions(
            shapes=weights @ self.shapes,
            potentials=weights @ self.potentials,
            momentum=weights @ self.momentum,
            images=weights @ self.images,
        )

    def beside(self, other: _Motions) -> _Motions:
        return _Motions(
            shapes=np.vstack([self.shapes, other.shapes]),
            potentials=np.vstack([self.potentials, other.potentials]),
            momentum=np.vstack([self.momentum, other.momentum]),
            images=np.vstack([self.images, other.images]),
        )


@dataclass(frozen=True, kw_only=True)
class ReleasedModes:
    """Modes at unit generalized mass.

    Attributes:
        eigenvalues: λ, shape (modes,).
        errors: the part of each by which its residual may change it, shape (modes,).
        amplitudes: of the shapes, shape (modes, shapes).
        potentials: ψ, shape (modes, unknowns).
    """

    eigenvalues: FloatArray
    errors: FloatArray
    amplitudes: FloatArray
    potentials: FloatArray


def released_tones(problem: ReleasedProblem, places: Sequence[int]) -> ReleasedModes:
    """Return the first elastic tones of some plates."""
    bodies = problem.bodies
    firsts = np.cumsum([0, *(body.size for body in bodies)])
    wanted = [int(firsts[place]) + bodies[place].dofs.index(FIRST_ELASTIC) for place in places]
    softest = [first + np.argsort(body.stiffness)[:_START] for first, body in zip(firsts, bodies, strict=False)]
    start = np.eye(problem.stiffness.size)[np.union1d(np.concatenate(softest), wanted)]
    return released_modes(problem, start, lambda _, shares: shares[:, wanted].argmax(axis=0))


def released_modes(
    problem: ReleasedProblem, start: FloatArray, choose: Callable[[FloatArray, FloatArray], NDArray[np.intp]]
) -> ReleasedModes:
    """Return some modes by Davidson's method.

    Free rigid motions have no momentum: all vectors are projected so, along those that P gives of them.
    """
    stiffness, mass = problem.stiffness, block_diag(*[body.mass for body in problem.bodies])
    free = np.flatnonzero(stiffness == 0.0)
    compliance = np.divide(1.0, stiffness, out=np.zeros_like(stiffness), where=stiffness > 0.0)
    loose = problem.loads[free]

    def motions(shapes: FloatArray, loads: FloatArray) -> _Motions:
        """The vectors that P gives of residuals, at unit energy."""
        potentials = np.array([problem.precondition(load) for load in loads])
        images = np.array([problem.apply(potential) for potential in potentials])
        momentum = shapes @ mass + potentials @ problem.loads.T
        found = _Motions(shapes=shapes, potentials=potentials, momentum=momentum, images=images)
        if len(turned):
            unit = np.eye(len(shapes))
            found = found.beside(rigid).combined(np.hstack([unit, -found.momentum[:, free] @ turned]))
        return found.combined(np.diag(1.0 / np.sqrt(np.diagonal(_energies(found, mass)))))

    turned: FloatArray = np.empty((0, 0))
    if len(free):
        rigid = motions(np.eye(len(stiffness))[free], loose)
        turned = np.linalg.inv(rigid.momentum[:, free])
    start = start[(start * stiffness).any(axis=1)]
    if not len(start):
        none = np.empty(0)
        return ReleasedModes(
            eigenvalues=none, errors=none, amplitudes=np.empty((0, len(stiffness))), potentials=problem.loads[:0]
        )
    basis = motions(start, start @ problem.loads)
    for _ in range(_MOST_STEPS):
        # The same mode may be chosen for two plates that are alike, and its residual gives one vector only.
        lengths, turn = np.linalg.eigh(_energies(basis, mass))
        independent = lengths > _INDEPENDENT * lengths[-1]
        turn = turn[:, independent] / np.sqrt(lengths[independent])
        momentum = turn.T @ basis.momentum
        values, vectors = np.linalg.eigh((momentum * compliance) @ momentum.T)
        vectors = turn @ vectors
        energies = compliance * (vectors.T @ basis.momentum) ** 2
        chosen = choose(values, energies / energies.sum(axis=1)[:, None])
        inverses, modes = values[chosen], basis.combined(vectors[:, chosen].T)
        amplitudes = modes.momentum * compliance
        shapes = amplitudes - inverses[:, None] * modes.shapes
        rests = amplitudes @ problem.loads - inverses[:, None] * modes.images
        answers = motions(shapes, rests)
        # The answers have unit energy: this is that of the residual in the norm of P.
        errors = ((shapes @ mass) * answers.shapes).sum(axis=1) + (rests * answers.potentials).sum(axis=1)
        errors = (errors / inverses) ** 2
        if errors.max() <= _RESIDUAL:
            break
        basis = basis.beside(answers.combined(np.eye(len(errors))[errors > _RESIDUAL]))
    amplitudes /= inverses[:, None]
    if len(free):
        rest = modes.images - amplitudes @ problem.loads
        amplitudes[:, free] = np.linalg.solve(rigid.potentials @ loose.T, rigid.potentials @ rest.T).T
    return ReleasedModes(eigenvalues=1.0 / inverses, errors=errors, amplitudes=amplitudes, potentials=modes.potentials)


def _energies(vectors: _Motions, mass: FloatArray) -> FloatArray:
    whole = vectors.shapes @ mass @ vectors.shapes.T + vectors.potentials @ vectors.images.T
    return np.asarray(0.5 * (whole + whole.T))
