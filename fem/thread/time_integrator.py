"""Time integration of a moving thread on one mesh, in the units of its forms.

Consistent initial state of a moving thread: positions and velocities that satisfy its constraints, accelerations.

Given positions r* are moved, and given velocities v* changed, as little as possible in the mean: with forces P

    ∫ η·(r − r*) + ∫ P τ·η_s = 0,  ∫ μ (|r_s| − 1) = 0,      ∫ η·M (v − v*) + ∫ P τ·η_s = 0,  ∫ μ τ·v_s = 0,

the second being the impulse where the velocity of an end jumps. Accelerations a and the axial force S follow from the
equations of motion with the second derivative of |r_s| = 1, τ·a_s + |P v_s|²/|r_s| = 0, or with the law of stretch.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from math import inf
from typing import Any

import numpy as np
import ufl
from dolfinx import fem
from dolfinx.fem.petsc import assemble_vector
from mpi4py import MPI
from numpy.typing import NDArray
from petsc4py import PETSc

from hydroelastic.fem.kernels import compiled_expression, compiled_form
from hydroelastic.fem.thread.forms import ThreadForms, ThreadState, tangent
from hydroelastic.fem.thread.motion_plan import PrescribedEnd
from hydroelastic.fem.thread.step import GeneralisedAlpha, ThreadStep, midpoint_weights
from hydroelastic.fem.thread.step_solver import HeldUnknowns, StepSolver
from hydroelastic.fem.thread.table import gather_elements
from hydroelastic.fem.thread.vortex_shedding import SheddingLoad
from hydroelastic.meshes.compat import collapsed

_ENDS = np.array([[0.0], [1.0]])
# Of the unit of time, for one-sided differences of the prescribed motion of an end.
_DIFFERENCE = 1e-4

# Of the unit of time: convergence of velocities and accelerations is judged by the displacements in this time.
_SHORT_TIME = 1e-4


@dataclass(frozen=True)
class ExternalActions:
    """Prescribed ends and stream as functions of time, in the units of the forms."""

    ends: tuple[PrescribedEnd, PrescribedEnd]  # of A and B
    stream: Callable[[float], float] | None  # factor of the stream by the time, ``None`` for a steady one
    set_stream: Callable[[float], None]  # sets the factor


class TimeIntegrator:
    """State of a moving thread, and steps in time.

    Args:
        actions: prescribed ends and stream by the time.
        alpha: parameters of the generalised-α method, ``None`` for the midpoint rule.
        shedding: the force of vortices.

    Attributes:
        time: of the state.
        step: the equations of a step, with the state in `before` and `speed`.
        force_part: part of a step at which the equilibrium of forces holds.
    """

    def __init__(
        self,
        forms: ThreadForms,
        actions: ExternalActions,
        *,
        alpha: GeneralisedAlpha | None = None,
        shedding: SheddingLoad | None = None,
    ) -> None:
        self.forms, self._actions, self._alpha, self._shedding = forms, actions, alpha, shedding
        self.time = 0.0
        self.force_part = 0.5 if alpha is None else 1.0 - alpha.force_shift
        self.step = ThreadStep(forms, conservative=alpha is None, extra=shedding)
        self._solver = StepSolver(self.step.residual, self.step.unknown, self._update_stream)
        self._consistent = ConsistentState(self.step)
        space = forms.space
        self._places = collapsed(space.mixed, 0)[1]
        self._force_places = collapsed(space.mixed, 1)[1]
        self._dimension = forms.model.dimension
        self._facets = [space.end_tags.find(tag) for tag in (1, 2)]
        self._end_places = [self._places_of_end(facets) for facets in self._facets]
        tests = [ufl.TestFunction(fem.functionspace(space.mesh, ("DG", 0, (count,)))) for count in (4, 3)]
        self._energies = compiled_form(self.step.energies(tests[0]))
        self._powers = compiled_form(self.step.powers(tests[1]))
        state = [*ufl.split(self.step.old_state)[0], *ufl.split(self.step.old_velocity)[0]]
        self._sample = compiled_expression(ufl.as_vector(state), _ENDS)
        self._tension = compiled_expression(self.step.tension, _ENDS)
        self._cells = np.arange(space.mesh.topology.index_map(1).size_local, dtype=np.int32)
        self._held = self._held_now()

    def _places_of_end(self, facets: NDArray[np.int32]) -> list[NDArray[np.int32]]:
        mixed = self.forms.space.mixed
        return [fem.locate_dofs_topological(mixed.sub(0).sub(axis), 0, facets) for axis in range(self._dimension)]

    def _held_now(self) -> HeldUnknowns:
        model = self.forms.model
        held, straight, self._prescribed = [], [], []
        for index, (end, prescribed) in enumerate(zip(model.ends, self._actions.ends, strict=True)):
            kept = prescribed.held(end.held, self.time)
            for axis in (axis for axis in range(self._dimension) if kept[axis]):
                held.append((0, axis, self._facets[index]))
                self._prescribed.append((index, axis))
            let_go = any(end.held) and not any(kept)
            if model.bends and (end.clamp is None or let_go):
                straight += [(2, axis, self._facets[index]) for axis in range(self._dimension)]
        return HeldUnknowns(self.forms.space.mixed, held + straight)

    def _prescribe(self, component: Callable[[Callable[[float], float]], float]) -> None:
        """Set the values of held components, each by a function of the component of the end's position by the time."""
        # The values of the curvature follow those of the ends and stay zero.
        values = iter(self._held.values)
        for index, axis in self._prescribed:
            next(values).value = component(partial(self._end_position, index, axis))

    def _end_position(self, index: int, axis: int, time: float) -> float:
        prescribed = self._actions.ends[index]
        position = self.forms.model.ends[index].position if prescribed.position is None else prescribed.position(time)
        return float(position[axis])

    def _update_stream(self) -> None:
        if self.forms.stream is not None:
            self.forms.stream.update(self.step.position)

    def _apply_loads(self, time: float) -> None:
        if self._actions.stream is not None:
            self._actions.set_stream(self._actions.stream(time))
        for index, prescribed in enumerate(self._actions.ends):
            if prescribed.force is not None:
                vectors = self.forms.space.vectors
                nodes = fem.locate_dofs_topological(vectors, 0, self._facets[index])
                self.forms.point_force.x.array.reshape(-1, self._dimension)[nodes] = prescribed.force(time)

    def project_positions(self) -> float | None:
        """Move the positions to the nearest ones that satisfy the held ends and, if inextensible, |r_s| = 1."""
        self._prescribe(lambda position: position(self.time))
        before = self.step.old_state.x.array
        if self.forms.model.axial_rigidity < inf:
            self._held.set(before)
            return 0.0
        if not self._consistent.project_positions(self._held):
            return None
        return self._replace(before, self.step.unknown.x.array)

    def project_velocities(self) -> float | None:
        """Change the velocities, as by an impulse, to the nearest ones that the held ends and inextensibility allow."""
        self._prescribe(lambda position: _slope(position, self.time))
        if not self._consistent.project_velocities(self._held):
            return None
        return self._replace(self.step.old_velocity.x.array, self.step.unknown.x.array)

    def _replace(self, old: NDArray[np.float64], new: NDArray[np.float64]) -> float:
        change = np.max(np.abs(new[self._places] - old[self._places]), initial=0.0)
        old[self._places] = new[self._places]
        return float(self.forms.space.mesh.comm.allreduce(float(change), op=MPI.MAX))

    def solve_accelerations(self) -> NDArray[np.float64] | None:
        """Solve for accelerations, axial force and curvature in the present state."""
        self._held = self._held_now()
        self._apply_loads(self.time)
        self._prescribe(lambda position: _curvature(position, self.time))
        if not self._consistent.solve_accelerations(self._held):
            return None
        self._keep_rate(self.step.unknown.x.array)
        before = self.step.old_state.x.array
        others = np.setdiff1d(np.arange(len(before)), self._places)
        before[others] = self.step.unknown.x.array[others]
        return self.tensions()

    def tension_without_stretch(self) -> NDArray[np.float64] | None:
        """Tension at the nodes in the present state if the thread were inextensible.

        An extensible thread that starts with its unstretched length initially has no tension.
        """
        self._held = self._held_now()
        self._apply_loads(self.time)
        self._prescribe(lambda position: _curvature(position, self.time))
        return self.tensions() if self._consistent.solve_accelerations(self._held, unstretched=True) else None

    def _keep_rate(self, values: NDArray[np.float64]) -> None:
        self.step.old_acceleration.x.array[self._places] = values[self._places]

    def solve_step(self, length: float) -> int | None:
        """Solve the equations of a step from the present state."""
        alpha = self._alpha
        weights = midpoint_weights(length) if alpha is None else alpha.weights(length)
        self.step.set_weights(weights, length)
        if self._shedding is not None:
            self._shedding.set_step(length)
        self._apply_loads(self.time + self.force_part * length)
        start, end = self.time, self.time + length
        self._prescribe(lambda position: (position(end) - position(start)) / length)
        places, unknown = self._places, self.step.unknown.x.array
        old = unknown.copy()
        unknown[places] = (
            self.step.old_velocity.x.array[places] + 0.5 * length * self.step.old_acceleration.x.array[places]
        )
        solutions = self._solver.solve(self._held, length)
        if solutions is None:
            unknown[:] = old
        return solutions

    def local_error(self, length: float, rate_age: float) -> float:
        """Error of positions that the step adds, Δt³ |r_ttt|/12, by the change of the acceleration (collective)."""
        change = np.max(np.abs(self._new_rate(length) - self.step.old_acceleration.x.array)[self._places], initial=0.0)
        # Between midpoints of steps with the midpoint rule, between their ends with generalised α.
        between = rate_age + 0.5 * length if self._alpha is None else length
        local = length**3 / 12.0 * float(change) / between
        return float(self.forms.space.mesh.comm.allreduce(local, op=MPI.MAX))

    def _new_rate(self, length: float) -> NDArray[np.float64]:
        mean, speed, rate = (
            self.step.unknown.x.array,
            self.step.old_velocity.x.array,
            self.step.old_acceleration.x.array,
        )
        if self._alpha is None:
            new: NDArray[np.float64] = 2.0 * (mean - speed) / length
            return new
        return _combine(self._alpha.end_acceleration(length), (mean, speed, rate))

    def accept(self, length: float) -> None:
        """Advance the state by the solved step."""
        places, before = self._places, self.step.old_state.x.array
        mean, speed, rate = (
            self.step.unknown.x.array,
            self.step.old_velocity.x.array,
            self.step.old_acceleration.x.array,
        )
        if self._shedding is not None:
            self._shedding.advance()
        new_rate = self._new_rate(length)
        last = 2.0 * mean - speed
        if self._alpha is not None:
            last = _combine(self._alpha.end_velocity(length), (mean, speed, rate))
        before[places] += length * mean[places]
        speed[places] = last[places]
        self._keep_rate(new_rate)
        others = self._force_places
        stretches = self._alpha is None and self.forms.model.axial_rigidity < inf
        before[others] = 2.0 * mean[others] - before[others] if stretches else mean[others]
        if self.forms.model.bends:
            rest = np.setdiff1d(np.arange(len(before)), np.concatenate([places, others]))
            before[rest] = mean[rest]
        self.time += length

    def energies(self) -> NDArray[np.float64]:
        """Kinetic, potential, elastic and bending energy (collective)."""
        return self._sum(self._energies, 4)

    def powers(self) -> NDArray[np.float64]:
        """Mean powers of drag, of the liquid's inertia, of changes of dead forces in the step (collective)."""
        return self._sum(self._powers, 3)

    def _sum(self, form: Any, count: int) -> NDArray[np.float64]:
        vector = assemble_vector(form)
        vector.ghostUpdate(addv=PETSc.InsertMode.ADD, mode=PETSc.ScatterMode.REVERSE)
        local = vector.array.reshape(-1, count).sum(axis=0)
        vector.destroy()
        total: NDArray[np.float64] = self.forms.space.mesh.comm.allreduce(local, op=MPI.SUM)
        return total

    def reactions(self) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Forces on the held ends in the step, shape (2, dimension), and their powers, shape (2,) (collective)."""
        return self._reactions(self._solver.reaction)

    def start_reactions(self) -> NDArray[np.float64]:
        """Forces on the held ends with the last accelerations, shape (2, dimension) (collective)."""
        return self._reactions(self._consistent.reaction)[0]

    def _reactions(self, reaction: NDArray[np.float64]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        forces, powers = np.zeros((2, self._dimension)), np.zeros(2)
        mean = self.step.unknown.x.array
        for index, axis in self._prescribed:
            for place in self._end_places[index][axis]:
                if place < len(reaction):
                    forces[index, axis] = reaction[place]
                    powers[index] += reaction[place] * mean[place]
        comm = self.forms.space.mesh.comm
        return comm.allreduce(forces, op=MPI.SUM), comm.allreduce(powers, op=MPI.SUM)

    def state(self) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Positions and velocities at the nodes, shape (nodes, dimension) each (collective)."""
        values = self._at_nodes(self._sample, 2 * self._dimension)
        return values[:, : self._dimension], values[:, self._dimension :]

    def tensions(self) -> NDArray[np.float64]:
        """T of the unknown at the nodes, the mean of both sides, shape (nodes,) (collective)."""
        return self._at_nodes(self._tension, 1)[:, 0]

    def largest_velocity(self) -> float:
        """The largest component of the velocities (collective)."""
        local = float(np.max(np.abs(self.step.old_velocity.x.array[self._places]), initial=0.0))
        return float(self.forms.space.mesh.comm.allreduce(local, op=MPI.MAX))

    def _at_nodes(self, expression: Any, count: int) -> NDArray[np.float64]:
        mesh = self.forms.space.mesh
        local = expression.eval(mesh, self._cells).reshape(-1, 2, count)
        ends = gather_elements(mesh, local, _ENDS)
        inner = 0.5 * (ends[:-1, 1] + ends[1:, 0])
        values: NDArray[np.float64] = np.concatenate([ends[:1, 0], inner, ends[-1:, 1]])
        return values


def _combine(weights: tuple[float, ...], values: tuple[NDArray[np.float64], ...]) -> NDArray[np.float64]:
    total: NDArray[np.float64] = sum(weight * value for weight, value in zip(weights, values, strict=True))  # type: ignore[assignment]
    return total


def _slope(function: Callable[[float], float], time: float) -> float:
    h = _DIFFERENCE
    values = [function(time + index * h) for index in range(5)]
    return float(np.dot([-25.0, 48.0, -36.0, 16.0, -3.0], values)) / (12.0 * h)


def _curvature(function: Callable[[float], float], time: float) -> float:
    h = 10.0 * _DIFFERENCE
    values = [function(time + index * h) for index in range(4)]
    return float(np.dot([2.0, -5.0, 4.0, -1.0], values)) / h**2


class ConsistentState:
    """Equations of the state of a thread at one time.

    Args:
        step: whose `before` and `speed` are the state; its `unknown` is used.
    """

    def __init__(self, step: ThreadStep) -> None:
        self._step, self._forms = step, step.forms
        self._tests = ufl.TestFunctions(step.forms.space.mixed)
        self._unknown = step.unknown
        self._solvers: dict[str, StepSolver] = {}

    @property
    def reaction(self) -> NDArray[np.float64]:
        """Forces on the thread where it is held, by the last accelerations."""
        return self._solvers["accelerate"].reaction

    def project_positions(self, held: HeldUnknowns) -> bool:
        """Solve for the positions that are nearest to `before`; the result is in the unknown."""
        self._unknown.x.array[:] = self._step.old_state.x.array
        return self._solve("place", held, self._position_equations, 1.0)

    def project_velocities(self, held: HeldUnknowns) -> bool:
        """Solve for the velocities that are nearest to `speed`; the result is in the unknown."""
        self._unknown.x.array[:] = 0.0
        return self._solve("start", held, self._velocity_equations, _SHORT_TIME)

    def solve_accelerations(self, held: HeldUnknowns, *, unstretched: bool = False) -> bool:
        """Solve for accelerations, axial force and curvature; the result is in the unknown."""
        self._unknown.x.array[:] = 0.0
        if unstretched and self._forms.model.axial_rigidity < inf:
            return self._solve("unstretched", held, partial(self._acceleration_equations, inf), _SHORT_TIME**2)
        solved = self._solve("accelerate", held, self._acceleration_equations, _SHORT_TIME**2)
        return solved and not self._solvers["accelerate"].is_singular()

    def _solve(self, name: str, held: HeldUnknowns, equations: Any, step: float) -> bool:
        if name not in self._solvers:
            stream = self._forms.stream
            position = ufl.split(self._step.old_state)[0]

            def update() -> None:
                if stream is not None:
                    stream.update(position)

            self._solvers[name] = StepSolver(equations(), self._unknown, update)
        return self._solvers[name].solve(held, step) is not None

    def _parts(self) -> tuple[Any, Any]:
        return ufl.split(self._unknown)[0], ufl.split(self._unknown)[1]

    def _position_equations(self) -> Any:
        old = ufl.split(self._step.old_state)[0]
        position, force = self._parts()
        form = ufl.inner(position - old, self._tests[0]) + force * ufl.inner(tangent(position), self._tests[0].dx(0))
        form *= self._forms.space.dx
        return (
            form + self._forms.stretch(ThreadState(position, force), ThreadState(None, self._tests[1])) + self._rest()
        )

    def _velocity_equations(self) -> Any:
        forms = self._forms
        position, speed = ufl.split(self._step.old_state)[0], ufl.split(self._step.old_velocity)[0]
        velocity, impulse = self._parts()
        tau = tangent(position)
        form = forms.inertia(position, velocity - speed, self._tests[0])
        form += impulse * ufl.inner(tau, self._tests[0].dx(0)) * forms.space.dx
        if forms.model.axial_rigidity < inf:
            # An extensible thread has no impulsive tension.
            form += impulse * self._tests[1] * forms.space.dx
        else:
            form += self._tests[1] * ufl.inner(tau, velocity.dx(0)) * forms.space.dx
        return form + self._rest()

    def _rest(self) -> Any:
        if not self._forms.model.bends:
            return 0
        return ufl.inner(ufl.split(self._unknown)[2], self._tests[2]) * self._forms.space.dx

    def _acceleration_equations(self, rigidity: float | None = None) -> Any:
        step, forms = self._step, self._forms
        position, speed = ufl.split(step.old_state)[0], ufl.split(step.old_velocity)[0]
        acceleration, force = self._parts()
        curvature = ufl.split(self._unknown)[2] if forms.model.bends else None
        state = ThreadState(position, force, curvature)
        test = ThreadState(*self._tests)
        form = forms.contact_work(state, test) + forms.inertia(position, acceleration, test.position)
        form -= forms.load_work(position, speed, test.position)
        if (rigidity or forms.model.axial_rigidity) < inf:
            form += forms.stretch(state, test)
        else:
            tau, slope = tangent(position), position.dx(0)
            turning = speed.dx(0) - ufl.inner(speed.dx(0), tau) * tau
            rate = ufl.inner(tau, acceleration.dx(0)) + ufl.inner(turning, turning) / ufl.sqrt(ufl.inner(slope, slope))
            form += test.force * rate * forms.space.dx
        reactive = forms.reactive_work(position, speed, test.position)
        if reactive is not None:
            form -= reactive
        return form + forms.bending(state, test) if forms.model.bends else form
