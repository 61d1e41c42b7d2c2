"""Modes from approximate ones, by Rayleigh–Ritz's method on them and on what their residuals add.

With approximate eigenvectors as the first vectors v of a basis, orthonormal in K, each step takes the Ritz pairs
(θ, x) of M_c x = μ K x in it, and adds the residuals K⁻¹M_c x − θ x of those that have not converged. A product with
M_c is one solution of Laplace's equation; ψ of it is kept, and ψ of a mode is a combination of those of the basis.
Modes of the same frequency are found like others, where both are among the approximate ones.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from itertools import product

import numpy as np
from petsc4py import PETSc

from hydroelastic.fem.added_mass import CondensedKinetics
from hydroelastic.fem.direct import direct_solver
from hydroelastic.fem.mode_set import Mode, ModeSet
from hydroelastic.fem.modes import completed_mode
from hydroelastic.fem.pencil import CoupledPencil
from hydroelastic.fem.progress import Report
from hydroelastic.fem.solver_error import EigenSolverError

# Vectors of the basis for each mode, beyond which it does not converge.
_MOST_VECTORS = 12
# Of a mode that only shows what is beyond the others: its residual over theirs, and the largest.
_OF_BEYOND, _MOST_OF_BEYOND = 10.0, 3e-2
# Part of a vector that is left when those before it are taken out, below which it is rounding.
_DEPENDENT = 1e-8


@dataclass
class _Basis:
    pencil: CoupledPencil
    kinetics: CondensedKinetics
    solver: PETSc.KSP
    vectors: list[PETSc.Vec] = field(default_factory=list)
    forces: list[PETSc.Vec] = field(default_factory=list)
    images: list[PETSc.Vec] = field(default_factory=list)
    potentials: list[PETSc.Vec | None] = field(default_factory=list)

    def add(self, given: PETSc.Vec) -> None:
        """Add what a vector has beyond the others, if it has any (collective)."""
        vector, force = given.copy(), given.duplicate()
        size = self._energy(vector, force)
        for _ in range(2):
            if self.vectors:
                vector.maxpy([-float(part) for part in vector.mDot(self.forces)], self.vectors)
        rest = self._energy(vector, force)
        if rest <= _DEPENDENT * size:
            return
        vector.scale(1.0 / rest)
        force.scale(1.0 / rest)
        image, kept = force.duplicate(), len(self.kinetics.potentials)
        self.kinetics.mult(None, vector, image)
        # A known answer of the liquid gives products without ψ.
        self.potentials.append(self.kinetics.potentials[-1] if len(self.kinetics.potentials) > kept else None)
        self.vectors.append(vector)
        self.forces.append(force)
        self.images.append(_solved(self.solver, image))

    def _energy(self, vector: PETSc.Vec, force: PETSc.Vec) -> float:
        """√(vᵀKv), and ``force`` ← Kv."""
        self.kinetics.definite_stiffness.mult(vector, force)
        return float(np.sqrt(max(vector.dot(force), 0.0)))

    def ritz(self, count: int) -> tuple[np.ndarray, np.ndarray]:
        """The largest Ritz values, descending, and their vectors as columns (collective)."""
        matrix = np.array([image.mDot(self.forces) for image in self.images])
        values, columns = np.linalg.eigh(0.5 * (matrix + matrix.T))
        return values[::-1][:count], columns[:, ::-1][:, :count]

    def combined(self, weights: np.ndarray, vectors: list[PETSc.Vec]) -> PETSc.Vec:
        """Their combination."""
        total = vectors[0].duplicate()
        total.set(0.0)
        total.maxpy(list(map(float, weights)), vectors)
        return total

    def residual(self, value: float, column: np.ndarray) -> tuple[PETSc.Vec, float]:
        """K⁻¹M_c x − θ x, and its norm in K."""
        residual = self.combined(column, self.images)
        residual.axpy(-value, self.combined(column, self.vectors))
        return residual, self._energy(residual, residual.duplicate())


def _solved(solver: PETSc.KSP, load: PETSc.Vec) -> PETSc.Vec:
    answer = load.duplicate()
    solver.solve(load, answer)
    return answer


def refined_modes(
    pencil: CoupledPencil,
    approximate: list[PETSc.Vec],
    residual: float,
    *,
    beyond: bool = False,
    report: Report = lambda _message: None,
) -> ModeSet:
    """Return as many of the lowest modes as there are approximate ones (collective)."""
    before, count = pencil.solver.solves, len(approximate)
    kinetics = CondensedKinetics(pencil, keeps=True)
    basis = _Basis(pencil, kinetics, direct_solver(kinetics.definite_stiffness))
    limits = np.full(count, residual)
    if beyond:
        limits[-1] = max(residual, min(_OF_BEYOND * residual, _MOST_OF_BEYOND))
    fresh = approximate
    while True:
        known = len(basis.vectors)
        for vector in fresh:
            basis.add(vector)
        # One more shows what is beyond.
        values, columns = basis.ritz(count + 1)
        residuals, norms = zip(
            *(basis.residual(value, column) for value, column in zip(values, columns.T, strict=True)), strict=True
        )
        sizes = np.array(norms)
        some = min(count, len(values))
        missing = np.flatnonzero(sizes[:some] > limits[:some] * values[:some])
        largest = float((sizes[:some] / values[:some]).max())
        solves = pencil.solver.solves - before
        report(f"{some - len(missing)} of {count} modes, residuals to {largest:.0e}, {solves} solutions")
        if len(values) >= count and not len(missing):
            break
        if len(basis.vectors) in (known, _MOST_VECTORS * count) or len(basis.vectors) > _MOST_VECTORS * count:
            raise EigenSolverError(f"{len(missing)} of {count} modes did not converge to {residual:g}")
        fresh = [residuals[place] for place in missing]
    found = _as_modes(basis, values[:count], columns[:, :count])
    return replace(found, bounds=residual_bounds(values, sizes)[:count])


def _as_modes(basis: _Basis, values: np.ndarray, columns: np.ndarray) -> ModeSet:
    pencil, eigenvalues = basis.pencil, 1.0 / values
    # Unit generalized mass: ζᵀKζ = λ.
    columns = columns * np.sqrt(eigenvalues)
    displacements = [basis.combined(column, basis.vectors) for column in columns.T]
    known = [one for one in basis.potentials if one is not None]
    shapes = [basis.combined(column, known) for column in columns.T] if len(known) == len(basis.potentials) else None
    basis.kinetics.potentials.clear()

    def completed(place: int) -> Mode:
        shape = None if shapes is None else shapes[place].copy()
        return completed_mode(
            pencil, basis.kinetics, basis.solver, float(eigenvalues[place]), displacements[place], shape
        )

    return ModeSet(
        eigenvalues=eigenvalues,
        elastic_amplitudes=np.array([pencil.body_values(one) for one in displacements]).reshape(
            len(eigenvalues), pencil.body_size
        ),
        modes=(),
        completed=completed,
        zero_modes=pencil.zero_mode_count,
        converged=len(eigenvalues),
        eigenvectors=tuple(displacements),
    )


def residual_bounds(values: np.ndarray, residuals: np.ndarray) -> np.ndarray:
    """Bound the relative errors of the largest eigenvalues μ by the residuals of Ritz pairs.

    Of some neighbouring Ritz values, where the residuals' norm is R = √(Σr²), and θ⁺, θ⁻ those next above and below,

        |μ_i − θ_i| ≤ R²/min(θ⁺ − θ_i, θ_i − θ⁻)        (R. Mathias, SIAM J. Matrix Anal. Appl. 19 (1998) 541)

    and r_i is a bound of some eigenvalue in any case. The smallest of these is returned. That no other eigenvalue is
    between those found is for a count of them to confirm.
    """
    count, squares = len(values), residuals**2
    above, below = np.append(np.inf, values), np.append(values[1:], 0.0)
    bounds = residuals.copy()
    for place, value in enumerate(values):
        for first, last in product(range(place + 1), range(place, count - 1)):
            gap = min(above[first] - value, value - below[last])
            if gap > 0.0:
                bounds[place] = min(bounds[place], squares[first : last + 1].sum() / gap)
    relative: np.ndarray = bounds / values
    return relative
