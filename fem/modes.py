"""Natural modes: SLEPc's Krylov–Schur method on the added-mass form of the pencil, and an independent count."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from petsc4py import PETSc
from scipy.linalg import lapack
from slepc4py import SLEPc

from hydroelastic.fem.added_mass import CondensedKinetics, Operator, dense
from hydroelastic.fem.direct import configure_direct, configure_indefinite
from hydroelastic.fem.pencil import CoupledPencil
from hydroelastic.meshes.interrupts import interrupts_deferred

HIDDEN = 1e-14
"""Part of the largest 1/λ below which double precision cannot tell one from zero."""

# Of the Krylov space for growing motions: with 14 one that grows 10⁴ times faster than waves travel was not found in
# 1400 solutions of Laplace's equation, with 120 in one pass.
_GROWING_VECTORS = 120
# Seed of the random vector from which modes are sought once more; SLEPc begins with another one.
_SECOND_START = 2


class EigenSolverError(RuntimeError):
    """The eigen-solver did not converge."""


@dataclass(frozen=True, kw_only=True)
class Mode:
    """One natural mode with its shape, scaled to unit generalized mass.

    Attributes:
        eigenvalue: λ = ω².
        displacement: surface unknowns ζ.
        potential: ψ, its constant included.
        residual: relative residual ‖Kζ − λ(Mζ + (ρC)ᵀψ)‖ / ‖Kζ‖ in the norm of K⁻¹.
        body_amplitudes: the body part of ζ, on every process.
        energy: share in the potential energy: body unknowns one by one, then each surface of the liquids.
    """

    eigenvalue: float
    displacement: PETSc.Vec
    potential: PETSc.Vec
    residual: float
    body_amplitudes: np.ndarray
    energy: np.ndarray


@dataclass(frozen=True, kw_only=True)
class ModeSet:
    """The lowest modes, in ascending order, and how they were found.

    Attributes:
        eigenvalues: λ of all modes found.
        elastic_amplitudes: body part of each mode at unit generalized mass, free rigid motions left out, shape
            (modes, body unknowns).
        modes: the lowest modes with their shapes.
        completed: returns any other mode with its shape, by index, at the cost of one solution of Laplace's equation
            (collective).
        zero_modes: how many motions without stiffness exist (not reported as modes).
        growing: the motions of an unstable float, λ < 0, that grow like e^{√(−λ) t}.
        converged: number of converged eigenpairs.
        iterations: restarts of the Krylov–Schur method.
        solves: solutions of Laplace's equation; those of a known answer are counted too.
    """

    eigenvalues: np.ndarray
    elastic_amplitudes: np.ndarray
    modes: tuple[Mode, ...]
    completed: Callable[[int], Mode]
    zero_modes: int
    converged: int
    iterations: int
    solves: int
    growing: tuple[Mode, ...] = ()
    eigenvectors: tuple[PETSc.Vec, ...] = ()


Products = Callable[[Operator], Operator]
"""Makes an operator with the same products of another one, which it keeps or counts, say."""


def as_made(operator: Operator) -> Operator:
    """Return the operator itself."""
    return operator


def solve_modes(
    pencil: CoupledPencil,
    count: int,
    *,
    shapes: int | None = None,
    tolerance: float = 1e-12,
    products: Products = as_made,
) -> ModeSet:
    """Lowest modes of the coupled problem.

    Solves (M + M_a) ζ = μ K ζ for the largest μ = 1/λ: only the liquid is factorized, the Krylov space lives on the
    surface, and nothing is shifted.

    Args:
        pencil: the coupled problem.
        count: number of modes; fewer are returned if the model has fewer, or the highest are lost in rounding.
        shapes: number of modes with shapes, each at the cost of one solution of Laplace's equation; all by default.
        tolerance: relative residual at which an eigenpair counts as converged.
        products: of the operator, which may be read instead of made; see `fem.checkpoint`.

    Returns:
        The modes (collective).

    Raises:
        EigenSolverError: if SLEPc stops before enough pairs have converged.
    """
    kinetics = CondensedKinetics(pencil)
    available = pencil.size - len(pencil.constraints) - pencil.zero_mode_count - kinetics.negative
    count = min(count, available)
    before = pencil.solver.solves
    if count == 0:
        return _no_modes(pencil, kinetics, tolerance)
    solver = _krylov_schur(pencil, kinetics, count, tolerance, SLEPc.EPS.Which.LARGEST_REAL, products)
    converged, inverses = _inverses(solver, count, tolerance)
    order = np.argsort(-inverses)
    # M + M_a is positive: eigenvalues that are not, or nearly zero, are rounding of the largest.
    count = int(np.sum(inverses > HIDDEN * inverses.max(initial=0.0)))
    if count == 0:
        raise EigenSolverError(f"no eigenvalue 1/ω² is positive; the largest is {inverses.max(initial=0.0):g}")
    order = order[:count]
    eigenvalues = 1.0 / inverses[order]
    wanted = count if shapes is None else min(shapes, count)
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
        return _complete(pencil, kinetics, solver, float(eigenvalues[place]), displacements[place])

    return ModeSet(
        eigenvalues=eigenvalues,
        elastic_amplitudes=np.array(amplitudes).reshape(count, pencil.body_size),
        modes=tuple(completed(place) for place in range(wanted)),
        completed=completed,
        zero_modes=pencil.zero_mode_count,
        converged=converged,
        iterations=solver.getIterationNumber(),
        solves=pencil.solver.solves - before if pencil.answer is None else pencil.size,
        growing=_growing(pencil, kinetics, tolerance),
        eigenvectors=tuple(displacements),
    )


def lowest_beyond(pencil: CoupledPencil, modes: ModeSet, tolerance: float, products: Products = as_made) -> float:
    """Return λ of the lowest mode that is orthogonal to some modes, from another start vector (collective).

    A mode that was missed, one of two with the same frequency say, has a part in a random vector.

    Args:
        pencil: the coupled problem, of bodies without growing motions.
        modes: its lowest modes.
        tolerance: relative residual that is accepted.
        products: of the operator; see `solve_modes`.

    Raises:
        EigenSolverError: if SLEPc stops before it has converged.
    """
    kinetics = CondensedKinetics(pencil)
    found = len(modes.eigenvectors)
    if found >= pencil.size - len(pencil.constraints) - pencil.zero_mode_count:
        return np.inf
    solver = _krylov_schur(pencil, kinetics, 1, tolerance, SLEPc.EPS.Which.LARGEST_REAL, products)
    solver.setDeflationSpace(list(modes.eigenvectors))
    start = pencil.stiffness.createVecRight()
    start.array[:] = np.random.default_rng([_SECOND_START, start.comm.rank]).standard_normal(start.local_size)
    solver.setInitialSpace([start])
    _, (inverse,) = _inverses(solver, 1, tolerance)
    return float(1.0 / inverse) if inverse > 0.0 else np.inf


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
        iterations=0,
        solves=0,
        growing=_growing(pencil, kinetics, tolerance),
    )


def _growing(pencil: CoupledPencil, kinetics: CondensedKinetics, tolerance: float) -> tuple[Mode, ...]:
    """The modes with λ < 0: as many as K has negative directions that keep the volumes, for M + M_a is positive."""
    count = kinetics.negative
    if count == 0:
        return ()
    solver = _krylov_schur(pencil, kinetics, count, tolerance, SLEPc.EPS.Which.SMALLEST_REAL)
    # Fast growth is a 1/λ close to zero, beside the largest of slow waves: a few vectors do not separate it from the
    # rest.
    solver.setDimensions(count, min(count + _GROWING_VECTORS, pencil.size))
    _, inverses = _inverses(solver, count, tolerance)
    displacement, force = pencil.stiffness.createVecs()
    modes = []
    for number in np.argsort(-inverses):
        solver.getEigenvector(int(number), displacement)
        pencil.stiffness.mult(displacement, force)
        eigenvalue = float(1.0 / inverses[number])
        displacement.scale(np.sqrt(eigenvalue / displacement.dot(force)))
        modes.append(_complete(pencil, kinetics, solver, eigenvalue, displacement))
    return tuple(modes)


def _inverses(solver: SLEPc.EPS, count: int, tolerance: float) -> tuple[int, np.ndarray]:
    """Solve; return how many eigenpairs converged, and 1/λ of the first ones."""
    with interrupts_deferred():
        solver.solve()
    converged = solver.getConverged()
    if converged < count:
        raise EigenSolverError(
            f"{converged} of {count} eigenpairs converged to {tolerance:g} in {solver.getIterationNumber()} restarts"
        )
    return converged, np.array([solver.getEigenvalue(number).real for number in range(count)])


def _krylov_schur(
    pencil: CoupledPencil,
    kinetics: CondensedKinetics,
    count: int,
    tolerance: float,
    which: SLEPc.EPS.Which,
    products: Products = as_made,
) -> SLEPc.EPS:
    stable = len(pencil.unstable) == 0
    if stable and pencil.answer is not None:
        operator = PETSc.Mat().createDense(pencil.stiffness.getSizes(), array=kinetics.matrix(), comm=PETSc.COMM_SELF)
    else:
        context = products(kinetics if stable else _Turned(kinetics))
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


def _complete(
    pencil: CoupledPencil, kinetics: CondensedKinetics, solver: SLEPc.EPS, eigenvalue: float, eigenvector: PETSc.Vec
) -> Mode:
    """Complete an eigenvector by rigid motions and ψ, and compute its residual."""
    displacement, force = eigenvector.copy(), eigenvector.duplicate()
    potential = pencil.coupling.createVecLeft()
    kinetics.recover(displacement, potential)
    pencil.stiffness.mult(displacement, force)
    return Mode(
        eigenvalue=eigenvalue,
        displacement=displacement,
        potential=potential,
        residual=_residual(pencil, solver, eigenvalue, displacement, potential, force),
        body_amplitudes=pencil.body_values(displacement),
        energy=_energy_shares(pencil, displacement, force),
    )


def _residual(
    pencil: CoupledPencil,
    solver: SLEPc.EPS,
    eigenvalue: float,
    displacement: PETSc.Vec,
    potential: PETSc.Vec,
    force: PETSc.Vec,
) -> float:
    residual, image = force.copy(), force.duplicate()
    pencil.momentum.multTranspose(potential, image)
    residual.axpy(-eigenvalue, image)
    pencil.mass.mult(displacement, image)
    residual.axpy(-eigenvalue, image)
    solver.getST().getKSP().solve(residual, image)
    return float(np.sqrt(abs(residual.dot(image) / force.dot(displacement))))


def _energy_shares(pencil: CoupledPencil, displacement: PETSc.Vec, force: PETSc.Vec) -> np.ndarray:
    total = displacement.dot(force)
    bodies = pencil.body_values(displacement) * pencil.body_values(force)
    comm = displacement.comm.tompi4py()
    local = displacement.array_r * force.array_r
    stops = np.cumsum([len(local) - sum(pencil.surface_sizes), *pencil.surface_sizes])
    surfaces = [comm.allreduce(float(local[start:stop].sum())) for start, stop in pairwise(stops)]
    return np.array([*bodies, *surfaces]) / total


def count_below(pencil: CoupledPencil, eigenvalue: float) -> int:
    """Number of modes with λ < ``eigenvalue``, from the inertia of one factorization.

    The matrix [[K − σM, −σρCᵀ], [−σρC, σρA]] has as many negative pivots as there are modes below σ, zero modes
    included, and one more where the constant of ψ multiplies the volume constraint. It is independent of the iterative
    solution.

    Args:
        pencil: the coupled problem.
        eigenvalue: σ > 0, not itself an eigenvalue.

    Returns:
        The count, without zero modes; modes that grow have λ < 0 and count (collective).
    """
    if pencil.answer is not None:
        return _dense_count(pencil, pencil.answer.added_mass, eigenvalue)
    block = pencil.stiffness.copy()
    block.axpy(-eigenvalue, pencil.mass, structure=PETSc.Mat.Structure.DIFFERENT_NONZERO_PATTERN)
    rows = _unconstrained(pencil)
    # Copies are needed: PETSc returns the matrix itself where all of it is requested.
    laplace = pencil.laplace.createSubMatrix(rows, rows).copy()
    weights = laplace.createVecLeft()
    weights.array[:] = eigenvalue * _densities(pencil)[rows.getIndices() - pencil.laplace.getOwnershipRange()[0]]
    laplace.diagonalScale(L=weights)
    columns = PETSc.IS().createStride(
        pencil.stiffness.getLocalSize()[0],
        first=pencil.stiffness.getOwnershipRange()[0],
        step=1,
        comm=pencil.laplace.comm,
    )
    coupling = pencil.momentum.createSubMatrix(rows, columns).copy()
    coupling.scale(-eigenvalue)
    transpose = coupling.transpose(PETSc.Mat())
    whole = PETSc.Mat().createNest([[block, transpose], [coupling, laplace]], comm=block.comm).convert("aij")
    whole.setOption(PETSc.Mat.Option.SYMMETRIC, True)
    solver = PETSc.KSP().create(whole.comm)
    solver.setOperators(whole)
    factored = configure_indefinite(solver)
    factored.setMumpsIcntl(24, 1)  # a null pivot would be reported, not divided by
    factored.setMumpsIcntl(13, 1)  # without ScaLAPACK for the last block, which does not give the signs of its pivots
    solver.setUp()
    negative, zero, _ = factored.getInertia()
    if zero:
        raise EigenSolverError(f"the shift {eigenvalue:g} is an eigenvalue to working precision")
    return int(negative) - len(pencil.constraints) - pencil.zero_mode_count


def _dense_count(pencil: CoupledPencil, added_mass: np.ndarray, eigenvalue: float) -> int:
    """As `count_below`, from the factorization LDLᵀ of K − σ(M + M_a) bordered by the volume constraints."""
    volumes = np.array([constraint.volume.array_r for constraint in pencil.constraints]).reshape(-1, pencil.size)
    stiffness, inertia = dense(pencil.stiffness), eigenvalue * (dense(pencil.mass) + added_mass)
    # Sylvester's law: scaled so that stiff shapes and small elements weigh alike.
    scale = 1.0 / np.sqrt(np.abs(np.diag(stiffness)) + np.diag(inertia))
    block = scale[:, None] * (stiffness - inertia) * scale
    volumes = volumes * scale
    volumes /= np.linalg.norm(volumes, axis=1, keepdims=True)
    corner = np.zeros((len(volumes), len(volumes)))
    whole = np.block([[0.5 * (block + block.T), volumes.T], [volumes, corner]])
    # Bunch and Kaufman: a pivot of two rows, which negative numbers mark, has one negative eigenvalue.
    factor, rows, _ = lapack.dsytrf(whole, lower=1)
    pivots = np.diag(factor)[rows > 0]
    if np.abs(pivots).min(initial=np.inf) <= np.finfo(float).eps:
        raise EigenSolverError(f"the shift {eigenvalue:g} is an eigenvalue to working precision")
    negative = np.count_nonzero(pivots < 0.0) + np.count_nonzero(rows < 0) // 2
    return int(negative) - len(pencil.constraints) - pencil.zero_mode_count


def _unconstrained(pencil: CoupledPencil) -> PETSc.IS:
    """Unknowns of ψ off surfaces with ψ = 0, without one of each layer whose constant is arbitrary."""
    first, last = pencil.laplace.getOwnershipRange()
    fixed = np.union1d(pencil.liquid.zero_dofs(), pencil.free_constants)
    free = np.setdiff1d(np.arange(last - first, dtype=np.int32), fixed)
    return PETSc.IS().createGeneral((free + first).astype(PETSc.IntType), comm=pencil.laplace.comm)


def _densities(pencil: CoupledPencil) -> np.ndarray:
    """ρ at each owned unknown of ψ."""
    densities: np.ndarray = np.array(pencil.liquid.densities)[pencil.liquid.owned_layer_of]
    return densities
