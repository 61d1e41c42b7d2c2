"""Resonances of open water: eigenvalues of the coupled pencil by SLEPc's Krylov–Schur method near a target.

    (A − λM) ψ = F a,    K a = λ (Fᵀψ + M_b a)        complex symmetric but for a factor, linear in λ

is inverted at a target σ by one factorization of A − σM and a small Schur complement for the bodies. With the real
build of PETSc a complex operator acts on (Re x, Im x); that has the eigenvalues θ of the operator and their conjugates,
and the part v₁ + iv₂ of an eigenvector (v₁, v₂) vanishes for the latter.

The continuous spectrum of outgoing waves depends on the angle α of the complex scaling, resonances do not: dλ/dα, which
follows from the eigenvector alone, distinguishes both, and measures how well a resonance is resolved.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import inf

import numpy as np
from mpi4py import MPI
from petsc4py import PETSc
from scipy.linalg import eig
from slepc4py import SLEPc

from hydroelastic.fem.open_water.complex_direct import ShiftedSolver
from hydroelastic.fem.open_water.complex_scaling import complex_product
from hydroelastic.fem.open_water.pencil import OpenPencil
from hydroelastic.fem.solver_error import EigenSolverError
from hydroelastic.meshes.interrupts import interrupts_deferred

# Relative norm of v₁ + iv₂ below which an eigenvector is that of a conjugate.
_CONJUGATE = 1e-6
# Newton's steps double the digits until rounding stops them: one below the second that does not fall is rounding, which
# is 1e-10 of strongly damped resonances.
_STEP, _ROUNDED = 1e-11, 1e-8
_MOST_STEPS = 12


@dataclass(frozen=True, kw_only=True)
class Eigenpair:
    """An eigenvalue of the pencil."""

    eigenvalue: complex
    bodies: np.ndarray  # a, on every process, shape (body unknowns,)
    potential: np.ndarray  # ψ on own free unknowns, shape (free unknowns,)
    norm: complex  # xᵀT'(λ)x of the symmetric form T = [[λ(A − λM), −λF], [−λFᵀ, K − iωB − λM_b]]
    drift: float  # |dλ/dα|/|λ|
    participation: float  # |λaᵀM_b a|/|λ xᵀT'x|, zero for resonances of the water around bodies at rest
    residual: float  # relative: of the first equation as SLEPc leaves it, or the last step of Newton's method


class ResonanceSearch:
    """Eigenvalues near targets.

    Args:
        pencil: the liquid and the loads of the bodies.
        stiffness: K of the bodies, shape (body unknowns, body unknowns); shape (0, 0) for fixed bodies.
        mass: M_b, of the same shape.
        damping: B of forces from outside, of the same shape; ``None`` for none.
    """

    def __init__(
        self, pencil: OpenPencil, stiffness: np.ndarray, mass: np.ndarray, damping: np.ndarray | None = None
    ) -> None:
        """Assemble the derivatives with respect to α (collective)."""
        self._pencil = pencil
        self._damping = np.zeros_like(stiffness) if damping is None else damping
        self._stiffness, self._mass = stiffness, mass
        self._loads = pencil.loads[: len(stiffness)].astype(complex)
        self._solver: ShiftedSolver = pencil.solver()
        self._turning = pencil.turning()

    @property
    def is_damped(self) -> bool:
        """Whether there is damping from outside."""
        return bool(self._damping.any())

    def near(self, target: complex, count: int, tolerance: float = 1e-9) -> list[Eigenpair]:
        """Return the eigenpairs nearest to a target, with the damping of its frequency (collective)."""
        restoring = self._stiffness - 1j * np.sqrt(target) * self._damping
        operator = _InvertedOperator(self._pencil, self._solver, self._loads, restoring, self._mass, target)
        solver = SLEPc.EPS().create(self._pencil.comm)
        solver.setOperators(operator.matrix)
        solver.setProblemType(SLEPc.EPS.ProblemType.NHEP)
        solver.setType(SLEPc.EPS.Type.KRYLOVSCHUR)
        solver.setWhichEigenpairs(SLEPc.EPS.Which.LARGEST_MAGNITUDE)
        # Each eigenvalue comes with its conjugate.
        solver.setDimensions(2 * count, max(4 * count + 16, 48))
        solver.setTolerances(tolerance, 200)
        with interrupts_deferred():
            solver.solve()
        converged = solver.getConverged()
        if converged < 2 * count:
            raise EigenSolverError(f"{converged // 2} of {count} resonances converged near {target:g}")
        pairs = []
        for index in range(converged):
            inverse = solver.getEigenvalue(index)
            vector = operator.eigenvector(solver, index)
            if vector is not None:
                pairs.append(self.pair(target + 1.0 / inverse, *vector))
        # PETSc and the operator reference each other, and the factorization, until one of them is destroyed.
        solver.destroy()
        operator.matrix.destroy()
        return pairs

    def refined(self, eigenvalue: complex) -> Eigenpair:
        """Return the resonance next to a value λ, by Newton's method on the dynamic stiffness of the bodies
        (collective).

        Of D(λ) = K − iωB − λ(M_b + H(λ)), with dH/dλ = ΨᵀMΨ and Ψ = (A − λM)⁻¹F, the step δ solves (D + δD') a = 0.
        """
        products, before = self._pencil.products, inf
        for _ in range(_MOST_STEPS):
            self._solver.shift(eigenvalue)
            radiated = np.array([self._solver.solve(load) for load in self._loads])
            images = np.array([complex_product(self._pencil.mass, potential) for potential in radiated])
            added, slope = products(self._loads, radiated), products(radiated, images)
            omega = np.sqrt(eigenvalue)
            dynamic = self._stiffness - 1j * omega * self._damping - eigenvalue * (self._mass + added)
            change = self._mass + added + eigenvalue * slope + 0.5j / omega * self._damping
            steps, vectors = eig(dynamic, change)
            nearest = int(np.argmin(np.abs(steps)))
            step, bodies = complex(steps[nearest]), vectors[:, nearest]
            eigenvalue += step
            size = abs(step / eigenvalue)
            if size <= _STEP or before <= size <= _ROUNDED:
                return replace(self.pair(eigenvalue, bodies @ radiated, bodies), residual=size)
            before = size
        raise EigenSolverError(f"Newton's method does not converge to a resonance near {eigenvalue:g}")

    def pair(self, eigenvalue: complex, potential: np.ndarray, bodies: np.ndarray) -> Eigenpair:
        """Return an eigenpair of a λ with its ψ and a (collective)."""
        pencil = self._pencil
        laplace, mass = (complex_product(matrix, potential) for matrix in (pencil.laplace, pencil.mass))
        turned = [complex_product(matrix, potential) for matrix in self._turning]
        load = bodies @ self._loads

        def with_potential(other: np.ndarray) -> complex:
            return complex(pencil.products(potential[None], other[None])[0, 0])

        own = complex(bodies @ self._mass @ bodies)
        damped = 0.5j / np.sqrt(eigenvalue) * complex(bodies @ self._damping @ bodies)
        norm = with_potential(laplace) - 2.0 * eigenvalue * with_potential(mass) - 2.0 * with_potential(load)
        norm -= own + damped
        drift = (with_potential(turned[0]) - eigenvalue * with_potential(turned[1])) / norm
        rest = laplace - eigenvalue * mass - load
        sizes = [np.sqrt(pencil.comm.allreduce(np.vdot(part, part).real, op=MPI.SUM)) for part in (rest, load, laplace)]
        return Eigenpair(
            eigenvalue=eigenvalue,
            bodies=bodies,
            potential=potential,
            norm=norm,
            drift=abs(drift),
            participation=abs(own / norm),
            residual=float(sizes[0] / max(sizes[1:])),
        )


class _InvertedOperator:
    """x ↦ (𝒜 − σℬ)⁻¹ℬx for 𝒜 = [[A, −F], [0, K]], ℬ = [[M, 0], [Fᵀ, M_b]], on real and imaginary parts."""

    def __init__(
        self,
        pencil: OpenPencil,
        solver: ShiftedSolver,
        loads: np.ndarray,
        stiffness: np.ndarray,
        mass: np.ndarray,
        target: complex,
    ) -> None:
        self._pencil, self._solver, self._loads, self._target, self._mass = pencil, solver, loads, target, mass
        solver.shift(target)
        self._radiated = np.array([solver.solve(load) for load in loads]).reshape(loads.shape)
        self._dynamic = stiffness - target * (mass + pencil.products(loads, self._radiated))
        self._own = len(pencil.free)
        # The bodies' few unknowns lie on the first process.
        self._bodies = len(loads) if pencil.comm.rank == 0 else 0
        local = 2 * (self._own + self._bodies)
        self.matrix = PETSc.Mat().createPython(
            ((local, PETSc.DETERMINE), (local, PETSc.DETERMINE)), context=self, comm=pencil.comm
        )
        self.matrix.setUp()

    def mult(self, _matrix: PETSc.Mat, source: PETSc.Vec, target: PETSc.Vec) -> None:
        """The signature is that of a PETSc shell matrix."""
        potential, bodies = self._complex(source.array_r)
        products = self._pencil.products
        answer = self._solver.solve(complex_product(self._pencil.mass, potential))
        right = products(self._loads, potential[None])[:, 0] + self._mass @ bodies
        right = right + self._target * products(self._loads, answer[None])[:, 0]
        moved = np.linalg.solve(self._dynamic, right) if len(right) else right
        self._store(target, answer + moved @ self._radiated, moved)

    def eigenvector(self, solver: SLEPc.EPS, index: int) -> tuple[np.ndarray, np.ndarray] | None:
        """ψ and a of an eigenpair; ``None`` for a conjugate one (collective)."""
        real, imaginary = self.matrix.createVecs()
        solver.getEigenvector(index, real, imaginary)
        first, second = self._complex(real.array_r), self._complex(imaginary.array_r)
        # v₁ + iv₂ with v = real + i imaginary.
        potential, bodies = first[0] + 1j * second[0], first[1] + 1j * second[1]
        size = self._pencil.comm.allreduce(np.vdot(potential, potential).real, op=MPI.SUM)
        whole = real.norm() ** 2 + imaginary.norm() ** 2
        if size <= _CONJUGATE * whole:
            return None
        return potential, bodies

    def _complex(self, values: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        own = self._own
        potential = values[:own] + 1j * values[own : 2 * own]
        rest = values[2 * own :]
        bodies = rest[: self._bodies] + 1j * rest[self._bodies :]
        return potential, np.asarray(self._pencil.comm.bcast(bodies, root=0))

    def _store(self, vector: PETSc.Vec, potential: np.ndarray, bodies: np.ndarray) -> None:
        own = [potential.real, potential.imag]
        vector.array[:] = np.concatenate([*own, bodies.real, bodies.imag] if self._bodies else own)
