"""Natural modes by SLEPc: Krylov–Schur on the added-mass form of the pencil, LAPACK where it is small."""

from __future__ import annotations

from functools import cache, partial
from typing import TYPE_CHECKING

import numpy as np
from petsc4py import PETSc

from hydroelastic.fem.added_mass import CondensedKinetics
from hydroelastic.fem.dense_modes import FEW, DenseModes, DenseSolution, dense_potentials
from hydroelastic.fem.direct import configure_direct
from hydroelastic.fem.liquid_answer import LiquidAnswer
from hydroelastic.fem.mode_energies import energy_shares, residual_of
from hydroelastic.fem.mode_set import Mode, ModeSet
from hydroelastic.fem.pencil import CoupledPencil
from hydroelastic.fem.solver_error import EigenSolverError
from hydroelastic.meshes.interrupts import interrupts_deferred

if TYPE_CHECKING:
    from slepc4py import SLEPc

HIDDEN = 1e-14
"""Part of the largest 1/λ below which double precision cannot tell one from zero."""

# Of the Krylov space for growing motions: with 14 one that grows 10⁴ times faster than waves travel was not found in
# 1400 solutions of Laplace's equation, with 120 in one pass.
_GROWING_VECTORS = 120
# Neighbouring modes whose ψ is computed together where the answer of the liquid is known.
_AT_ONCE = 12


def solve_modes(
    pencil: CoupledPencil,
    count: int,
    *,
    shapes: int | None = None,
    tolerance: float = 1e-12,
) -> ModeSet:
    """Lowest modes of the coupled problem.

    Solves (M + M_a) ζ = μ K ζ for the largest μ = 1/λ: only the liquid is factorized, the Krylov space lives on the
    surface, and nothing is shifted. Where the answer of the liquid to all surface unknowns is known and they are few,
    LAPACK finds all modes.
    """
    if pencil.answer is not None and not len(pencil.unstable):
        return _answered_modes(pencil, pencil.answer, (count, shapes), tolerance)
    from slepc4py import SLEPc  # slow to import

    kinetics = CondensedKinetics(pencil)
    available = pencil.size - len(pencil.constraints) - pencil.zero_mode_count - kinetics.negative
    count = min(count, available)
    if count == 0:
        return _no_modes(pencil, kinetics, tolerance)
    solver = krylov_schur(pencil, kinetics, count, tolerance, SLEPc.EPS.Which.LARGEST_REAL)
    converged, inverses = converged_inverses(solver, count, tolerance)
    order = np.argsort(-inverses)
    count = _visible(inverses)
    order = order[:count]
    eigenvalues = 1.0 / inverses[order]
    displacement, force = pencil.stiffness.createVecs()
    displacements, amplitudes = [], []
    for place, number in enumerate(order):
        solver.getEigenvector(int(number), displacement)
        # Unit generalized mass: ζᵀ(M + M_a)ζ = ζᵀKζ/λ = 1. Motions without stiffness do not enter.
        pencil.stiffness.mult(displacement, force)
        displacement.scale(np.sqrt(eigenvalues[place] / displacement.dot(force)))
        displacements.append(displacement.copy())
        amplitudes.append(pencil.body_values(displacement))

    def completed(place: int) -> Mode:
        return completed_mode(
            pencil, kinetics, solver.getST().getKSP(), float(eigenvalues[place]), displacements[place]
        )

    return ModeSet(
        eigenvalues=eigenvalues,
        elastic_amplitudes=np.array(amplitudes).reshape(count, pencil.body_size),
        modes=tuple(completed(place) for place in range(count if shapes is None else min(shapes, count))),
        completed=completed,
        zero_modes=pencil.zero_mode_count,
        converged=converged,
        growing=_growing(pencil, kinetics, tolerance),
        eigenvectors=tuple(displacements),
    )


def _visible(inverses: np.ndarray) -> int:
    """How many 1/λ are eigenvalues: M + M_a is positive, and those that are not, or nearly zero, are rounding of the
    largest."""
    largest = inverses.max(initial=0.0)
    count = int(np.sum(inverses > HIDDEN * largest))
    if count == 0:
        raise EigenSolverError(f"no eigenvalue 1/ω² is positive; the largest is {largest:g}")
    return count


def _answered_modes(
    pencil: CoupledPencil, answer: LiquidAnswer, asked: tuple[int, int | None], tolerance: float
) -> ModeSet:
    """A number of the lowest modes, and their shapes, where the answer of the liquid is known."""
    count, shapes = asked
    count = min(count, pencil.size - len(pencil.constraints) - pencil.zero_mode_count)
    return _mode_set(pencil, answer, *_dense_solution(DenseModes(pencil, answer), count, tolerance), shapes)


def _dense_solution(dense: DenseModes, count: int, tolerance: float) -> tuple[DenseSolution, int]:
    """The whole problem, and the number of modes that are not lost in rounding."""
    operator = dense.operator()
    inverses, vectors = _largest(operator, count, tolerance) if count else (np.empty(0), np.empty((len(operator), 0)))
    count = min(count, _visible(inverses)) if count else 0
    found = dense.completed(1.0 / inverses[:count], vectors[:, :count])
    return DenseSolution(
        inverses=inverses,
        modes=found,
        amplitudes=dense.amplitudes(found),
        displacements=partial(dense.displacements, found),
        energies=partial(dense.energies, found),
    ), count


def _mode_set(
    pencil: CoupledPencil, answer: LiquidAnswer, found: DenseSolution, count: int, shapes: int | None
) -> ModeSet:
    eigenvalues, residuals = found.modes.eigenvalues[:count], found.modes.residuals

    @cache
    def shaped(first: int) -> tuple[np.ndarray, np.ndarray]:
        some = slice(first, first + _AT_ONCE)
        return found.displacements(some), found.energies(some)

    @cache
    def potentials(first: int) -> np.ndarray:
        pressures = found.modes.pressures[:, first : first + _AT_ONCE]
        return dense_potentials(pencil, answer, shaped(first)[0], pressures)

    def completed(number: int) -> Mode:
        place = number % _AT_ONCE
        displacements, energies = shaped(number - place)

        return Mode(
            eigenvalue=float(eigenvalues[number]),
            values=displacements[:, place],
            displaced=lambda: _filled(pencil.coupling.createVecRight(), displacements[:, place]),
            shaped=lambda: _filled(pencil.coupling.createVecLeft(), potentials(number - place)[:, place]),
            residual=float(residuals[number]),
            body_amplitudes=displacements[: pencil.body_size, place],
            energy=energies[:, place],
        )

    return ModeSet(
        eigenvalues=eigenvalues,
        elastic_amplitudes=found.amplitudes[:count],
        modes=tuple(completed(place) for place in range(count if shapes is None else min(shapes, count))),
        completed=completed,
        zero_modes=pencil.zero_mode_count,
        converged=count,
    )


def _filled(vector: PETSc.Vec, values: np.ndarray) -> PETSc.Vec:
    vector.array[:] = values
    return vector


def _largest(operator: np.ndarray, count: int, tolerance: float) -> tuple[np.ndarray, np.ndarray]:
    """The largest eigenvalues of a dense matrix, descending, and their vectors; of a small one LAPACK finds all."""
    if len(operator) <= FEW:
        inverses, columns = np.linalg.eigh(operator)
        return inverses[::-1], columns[:, ::-1]
    from slepc4py import SLEPc

    matrix = PETSc.Mat().createDense(operator.shape, array=operator, comm=PETSc.COMM_SELF)
    solver = SLEPc.EPS().create(PETSc.COMM_SELF)
    solver.setOperators(matrix)
    solver.setProblemType(SLEPc.EPS.ProblemType.HEP)
    solver.setWhichEigenpairs(SLEPc.EPS.Which.LARGEST_REAL)
    solver.setTolerances(tolerance, 200)
    solver.setDimensions(count, min(2 * count + 12, len(operator)))
    _, inverses = converged_inverses(solver, count, tolerance)
    order = np.argsort(-inverses)
    vector = matrix.createVecRight()
    found = []
    for number in order:
        solver.getEigenvector(int(number), vector)
        found.append(vector.array_r.copy())
    return inverses[order], np.array(found).T


def _no_modes(pencil: CoupledPencil, kinetics: CondensedKinetics, tolerance: float) -> ModeSet:
    """The result where nothing oscillates: motions without stiffness, and growing ones."""

    def completed(place: int) -> Mode:
        raise IndexError(f"there is no mode {place}")

    return ModeSet(
        eigenvalues=np.empty(0),
        elastic_amplitudes=np.empty((0, pencil.body_size)),
        modes=(),
        completed=completed,
        zero_modes=pencil.zero_mode_count,
        converged=0,
        growing=_growing(pencil, kinetics, tolerance),
    )


def _growing(pencil: CoupledPencil, kinetics: CondensedKinetics, tolerance: float) -> tuple[Mode, ...]:
    """The modes with λ < 0: as many as K has negative directions that keep the volumes, for M + M_a is positive."""
    count = kinetics.negative
    if count == 0:
        return ()
    from slepc4py import SLEPc

    solver = krylov_schur(pencil, kinetics, count, tolerance, SLEPc.EPS.Which.SMALLEST_REAL)
    # Fast growth is a 1/λ close to zero, beside the largest of slow waves: a few vectors do not separate it from the
    # rest.
    solver.setDimensions(count, min(count + _GROWING_VECTORS, pencil.size))
    _, inverses = converged_inverses(solver, count, tolerance)
    displacement, force = pencil.stiffness.createVecs()
    modes = []
    for number in np.argsort(-inverses):
        solver.getEigenvector(int(number), displacement)
        pencil.stiffness.mult(displacement, force)
        eigenvalue = float(1.0 / inverses[number])
        displacement.scale(np.sqrt(eigenvalue / displacement.dot(force)))
        modes.append(completed_mode(pencil, kinetics, solver.getST().getKSP(), eigenvalue, displacement))
    return tuple(modes)


def converged_inverses(solver: SLEPc.EPS, count: int, tolerance: float) -> tuple[int, np.ndarray]:
    """Solve; return how many eigenpairs converged, and 1/λ of the first ones."""
    with interrupts_deferred():
        solver.solve()
    converged = solver.getConverged()
    if converged < count:
        raise EigenSolverError(
            f"{converged} of {count} eigenpairs converged to {tolerance:g} in {solver.getIterationNumber()} restarts"
        )
    return converged, np.array([solver.getEigenvalue(number).real for number in range(count)])


def krylov_schur(
    pencil: CoupledPencil,
    kinetics: CondensedKinetics,
    count: int,
    tolerance: float,
    which: SLEPc.EPS.Which,
) -> SLEPc.EPS:
    """Return a solver of M_c ζ = μ K ζ that was not started (collective)."""
    from slepc4py import SLEPc

    stable = len(pencil.unstable) == 0
    context = kinetics if stable else _Turned(kinetics)
    operator = PETSc.Mat().createPython(pencil.stiffness.getSizes(), context, comm=pencil.stiffness.comm)
    operator.setUp()
    solver = SLEPc.EPS().create(pencil.stiffness.comm)
    solver.setOperators(operator, kinetics.definite_stiffness)
    solver.setProblemType(SLEPc.EPS.ProblemType.GHEP if stable else SLEPc.EPS.ProblemType.PGNHEP)
    solver.setWhichEigenpairs(which)
    solver.setTolerances(tolerance, 200)
    # Measured from 5 to 200 modes: slightly more than twice the requested pairs needs the fewest solutions of Laplace's
    # equation.
    solver.setDimensions(count, min(2 * count + 12, pencil.size))
    # Purification would need one more solution for each pair, to remove components that `recover` removes anyway.
    solver.setPurify(False)
    configure_direct(solver.getST().getKSP())
    kinetics.definite_stiffness.setOption(PETSc.Mat.Option.SPD, True)
    return solver


class _Turned:
    """J(M + M_a) with J = ±1, so that K = J|K|: (M + M_a) ζ = μ K ζ becomes J(M + M_a) ζ = μ |K| ζ.

    It is not symmetric, but its eigenvalues are real, for M + M_a is positive.
    """

    def __init__(self, kinetics: CondensedKinetics) -> None:
        self._kinetics = kinetics

    def mult(self, matrix: PETSc.Mat | None, displacement: PETSc.Vec, result: PETSc.Vec) -> None:
        """``result`` ← J(M + M_a) ``displacement``."""
        self._kinetics.mult(matrix, displacement, result)
        self._kinetics.flip_unstable(result)


def completed_mode(
    pencil: CoupledPencil,
    kinetics: CondensedKinetics,
    solver: PETSc.KSP,
    eigenvalue: float,
    eigenvector: PETSc.Vec,
    known: PETSc.Vec | None = None,
) -> Mode:
    """Complete an eigenvector of unit generalized mass by rigid motions and ψ, and compute its residual by a
    factorization of K; its ψ without rigid motions, if it is known, is changed (collective)."""
    displacement, force = eigenvector.copy(), eigenvector.duplicate()
    potential = pencil.coupling.createVecLeft() if known is None else known
    kinetics.recover(displacement, potential, known=known is not None)
    pencil.stiffness.mult(displacement, force)
    return Mode(
        eigenvalue=eigenvalue,
        values=displacement.array_r,
        displaced=lambda: displacement,
        shaped=lambda: potential,
        residual=residual_of(pencil, solver, eigenvalue, displacement, potential, force),
        body_amplitudes=pencil.body_values(displacement),
        energy=energy_shares(pencil, displacement, force),
    )
