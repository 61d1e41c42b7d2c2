"""The motion of the hanging string in time on one mesh: w = U − f, by collocation.

    M w'' + C w' + K w = −f'' M·1 − f' C·1,    w = 0 at the upper end

Steps end at all output times and at the breaks of the motion. There f and f' may jump while U and U_t of the string
below its upper end do not, so that w and w' jump by as much the other way: a step is nothing but such an initial state.

Collocation at Gauss points for M w'' + C w' + K w = F(t): order 2s with s stages, and no numerical damping.

With Butcher's matrix a, nodes c and weights b of the interval [t, t + h] the accelerations A of the stages satisfy

    M A + C (v + h a A) + K (w + h c v + h² a² A) = F(t + c h),
    v ← v + h bᵀA,    w ← w + h v + h² bᵀa A.

In the eigenvectors of a they decouple into one system M + hλC + h²λ²K for each eigenvalue λ, of which one in each
conjugate pair is solved; all have Re λ > 0. On a linear problem without loads a step is the diagonal Padé approximant
of the exponential: energy is kept where C = 0, and never grows.

Source: E. Hairer and G. Wanner, Solving Ordinary Differential Equations II, IV.5, IV.8.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import inf

import numpy as np
from numpy.polynomial import legendre
from numpy.typing import NDArray
from petsc4py import PETSc

from hydroelastic.fem.direct import direct_solver
from hydroelastic.fem.open_water.complex_direct import DefiniteSolver
from hydroelastic.fem.open_water.complex_scaling import ComplexMatrix
from hydroelastic.fem.string.end_motion import EndMotion, after, jumps
from hydroelastic.fem.string.pencil import StringPencil
from hydroelastic.fem.string.probe import StringProbe

STAGES = 4
"""Stages of the collocation: order 8."""

Solve = Callable[[NDArray[np.complex128]], NDArray[np.complex128]]


@dataclass(frozen=True, kw_only=True)
class TimeHistory:
    """The string at the output times."""

    values: NDArray[np.float64]  # U at the positions, m, shape (positions, times)
    # of w, ½∫m w_t² + ½M w_t² + ½∫T w_x², in units of ρgl² with w in metres over l, shape (times,)
    energies: NDArray[np.float64]
    steps: int  # number of time steps
    factorizations: int  # number of factorized complex systems


@dataclass(frozen=True, kw_only=True)
class StepControl:
    """Length of the time steps."""

    longest: float  # largest step while waves from a break of the motion travel, s
    decay_time: float = inf  # time after a break when they have decayed, s; infinite without resistance


# Factor on the steps when only the motion itself and slow decays remain.
_STRETCH = 10.0


def schedule(motion: EndMotion, times: NDArray[np.float64], control: StepControl) -> list[tuple[float, float, int]]:
    """Intervals between output times, breaks and beginnings of decay_time: start, end, number of steps."""
    first, last = float(motion.breaks[0]), float(times[-1])
    starts = np.array([float(time) for time in motion.breaks])
    stops = {*map(float, times), *starts, *(starts + control.decay_time)}
    known = np.array(sorted(stop for stop in stops if first <= stop <= last))
    since = known - starts[np.searchsorted(starts, known, side="right") - 1]
    steps = np.where(since >= control.decay_time, _STRETCH * control.longest, control.longest)
    counts = np.maximum(1, np.ceil(np.diff(known) / steps[:-1] - 1e-9)).astype(int)
    return list(zip(known[:-1].tolist(), known[1:].tolist(), counts.tolist(), strict=True))


def integrate_motion(
    pencil: StringPencil,
    probe: StringProbe,
    motion: EndMotion,
    times: NDArray[np.float64],
    control: StepControl,
    *,
    stages: int = STAGES,
) -> TimeHistory:
    """Integrate the motion of the string in time (collective)."""
    unit, size = pencil.string.time_unit, len(pencil.free)
    collocation = Collocation(pencil.mass, pencil.resistance, pencil.stiffness, stages)
    field = pencil.zeros()
    displacement: NDArray[np.float64] = np.zeros(size)
    velocity: NDArray[np.float64] = np.zeros(size)
    values, energies = {}, {}
    breaks, wanted = set(motion.breaks), set(times)
    intervals = schedule(motion, times, control)
    for start, end, count in [*intervals, (float(times[-1]), None, 0)]:
        if start in breaks:
            jump, kick = jumps(motion, start)
            displacement, velocity = displacement - jump, velocity - kick * unit
        if start in wanted:
            field.array[:] = displacement
            values[start] = probe.values(field) + after(motion.value, start)
            energies[start] = collocation.energy(displacement, velocity)
        if end is None:
            break
        # One step for equal intervals between output times, whatever the rounding of their difference.
        step = float(f"{(end - start) / count:.13g}")
        stage_times = start + step * (np.arange(count)[:, None] + collocation.rule.nodes)
        slopes, curvatures = motion.slope(stage_times), motion.curvature(stage_times)
        for slope, curvature in zip(slopes, curvatures, strict=True):
            loads = -unit * np.outer(slope, pencil.resistance_load)
            loads -= unit**2 * np.outer(curvature, pencil.mass_load)
            displacement, velocity = collocation.advance(displacement, velocity, step / unit, loads)
    return TimeHistory(
        values=np.array([values[time] for time in times]).T,
        energies=np.array([energies[time] for time in times]),
        steps=sum(count for _, _, count in intervals),
        factorizations=collocation.factorizations,
    )


@dataclass(frozen=True, kw_only=True)
class GaussRule:
    """A collocation rule in the eigenvectors of its matrix, one of each conjugate pair."""

    nodes: NDArray[np.float64]  # c, shape (stages,)
    eigenvalues: NDArray[np.complex128]  # λ with Im λ ≥ 0, shape (systems,)
    to_systems: NDArray[np.complex128]  # loads of the systems from those of the stages, shape (systems, stages)
    # weights of the solutions of the systems in the increment of v over h, doubled for conjugate pairs
    velocity: NDArray[np.complex128]
    displacement: NDArray[np.complex128]  # the same of w over h²


def gauss_rule(stages: int) -> GaussRule:
    """Return the rule of order twice the number of stages."""
    points, weights = legendre.leggauss(stages)
    nodes = 0.5 * (points + 1.0)
    powers = np.arange(1, stages + 1)
    # ∫₀^{c_i} of the polynomials through the nodes, exact for all powers below the number of stages.
    matrix = (nodes[:, None] ** powers / powers) @ np.linalg.inv(nodes[:, None] ** (powers - 1))
    eigenvalues, vectors = np.linalg.eig(matrix)
    inverse = np.linalg.inv(vectors)
    chosen = eigenvalues.imag > -1e-12
    pairs = np.where(np.abs(eigenvalues.imag) > 1e-12, 2.0, 1.0)
    velocity = pairs * (0.5 * weights @ vectors)
    return GaussRule(
        nodes=nodes,
        eigenvalues=eigenvalues[chosen],
        to_systems=inverse[chosen],
        velocity=velocity[chosen],
        displacement=(velocity * eigenvalues)[chosen],
    )


class Collocation:
    """Time steps of one oscillating system.

    Args:
        mass: M, symmetric and positive.
        resistance: C, symmetric and positive semidefinite.
        stiffness: K, symmetric and positive.
        stages: s.
    """

    def __init__(self, mass: PETSc.Mat, resistance: PETSc.Mat, stiffness: PETSc.Mat, stages: int) -> None:
        self.rule = gauss_rule(stages)
        self._mass, self._resistance, self._stiffness = mass, resistance, stiffness
        self._source, self._image = mass.createVecs()
        self._step = 0.0
        self._solvers: list[Solve] = []
        self.factorizations = 0
        self.solves = 0

    def advance(
        self,
        displacement: NDArray[np.float64],
        velocity: NDArray[np.float64],
        step: float,
        loads: NDArray[np.float64] | None,
    ) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """One step (collective)."""
        if step != self._step:
            self._factorize(step)
        rule = self.rule
        rest = self._times(self._resistance, velocity) + self._times(self._stiffness, displacement)
        slope = step * self._times(self._stiffness, velocity)
        # The loads of the systems from parts that are the same in all stages, and the others.
        same, rising = rule.to_systems.sum(axis=1), rule.to_systems @ rule.nodes
        added_velocity, added_displacement = np.zeros_like(velocity), step * velocity
        for number, solve in enumerate(self._solvers):
            load = -same[number] * rest - rising[number] * slope
            if loads is not None:
                load += rule.to_systems[number] @ loads
            acceleration = solve(load)
            added_velocity += step * (rule.velocity[number] * acceleration).real
            added_displacement += step**2 * (rule.displacement[number] * acceleration).real
        self.solves += len(self._solvers)
        return displacement + added_displacement, velocity + added_velocity

    def energy(self, displacement: NDArray[np.float64], velocity: NDArray[np.float64]) -> float:
        """Return ½vᵀMv + ½wᵀKw, dimensionless, of own entries v and w, shape (own entries,) (collective)."""
        kinetic = velocity @ self._times(self._mass, velocity)
        elastic = displacement @ self._times(self._stiffness, displacement)
        return float(0.5 * self._mass.comm.tompi4py().allreduce(kinetic + elastic))

    def _times(self, matrix: PETSc.Mat, values: NDArray[np.float64]) -> NDArray[np.float64]:
        self._source.array[:] = values
        matrix.mult(self._source, self._image)
        return np.array(self._image.array_r)

    def _factorize(self, step: float) -> None:
        self._solvers = [self._system(step * eigenvalue) for eigenvalue in self.rule.eigenvalues]
        self._step = step
        self.factorizations += len(self._solvers)

    def _system(self, scaled: complex) -> Solve:
        """Return the solver of M + hλC + h²λ²K, multiplied by a phase so that its real part is positive definite and no
        pivoting is needed."""
        if abs(scaled.imag) < 1e-12 * abs(scaled):
            return self._real_system(scaled.real)
        # The angles of the three terms become −θ, 0 and θ, and that of λ is acute.
        turn = np.conj(scaled) / abs(scaled)
        factors = turn * np.array([1.0, scaled, scaled**2])
        solver = DefiniteSolver(ComplexMatrix(real=self._sum(factors.real), imaginary=self._sum(factors.imag)))
        return lambda load: solver.solve(turn * load)

    def _real_system(self, scaled: float) -> Solve:
        solver = direct_solver(self._sum(np.array([1.0, scaled, scaled**2])))

        def solve(load: NDArray[np.complex128]) -> NDArray[np.complex128]:
            self._source.array[:] = load.real
            solver.solve(self._source, self._image)
            return np.array(self._image.array_r, dtype=complex)

        return solve

    def _sum(self, factors: NDArray[np.float64]) -> PETSc.Mat:
        total = self._stiffness.copy()
        total.scale(factors[2])
        for factor, matrix in zip(factors, (self._mass, self._resistance), strict=False):
            total.axpy(factor, matrix, structure=PETSc.Mat.Structure.SAME_NONZERO_PATTERN)
        return total
