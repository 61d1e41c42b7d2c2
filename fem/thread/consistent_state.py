"""Consistent initial state of a moving thread: positions and velocities that satisfy its constraints, accelerations.

Given positions r* are moved, and given velocities v* changed, as little as possible in the mean: with forces P

    ∫ η·(r − r*) + ∫ P τ·η_s = 0,  ∫ μ (|r_s| − 1) = 0,      ∫ η·M (v − v*) + ∫ P τ·η_s = 0,  ∫ μ τ·v_s = 0,

the second being the impulse where the velocity of an end jumps. Accelerations a and the axial force S follow from the
equations of motion with the second derivative of |r_s| = 1, τ·a_s + |P v_s|²/|r_s| = 0, or with the law of stretch.
"""

from __future__ import annotations

from functools import partial
from math import inf
from typing import Any

import numpy as np
import ufl
from numpy.typing import NDArray

from hydroelastic.fem.thread.forms import ThreadState, tangent
from hydroelastic.fem.thread.step import ThreadStep
from hydroelastic.fem.thread.step_solver import HeldUnknowns, StepSolver

# Of the unit of time: convergence of velocities and accelerations is judged by the displacements in this time.
_SHORT_TIME = 1e-4


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
