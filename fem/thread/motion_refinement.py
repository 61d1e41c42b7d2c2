"""Motion of a thread in time to a tolerance: errors by halving steps and elements, both refined as needed."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from math import isfinite

import numpy as np
from mpi4py import MPI
from numpy.typing import NDArray

from hydroelastic.fem.adaptive import ErrorEstimate, adaptive_solve
from hydroelastic.fem.thread.equilibrium import solve_on_mesh
from hydroelastic.fem.thread.equilibrium_search import find_equilibrium
from hydroelastic.fem.thread.frame import Frame
from hydroelastic.fem.thread.initial_mesh import initial_nodes
from hydroelastic.fem.thread.motion import InitialMotion, move_from_rest, move_thread
from hydroelastic.fem.thread.motion_errors import MotionWithErrors, halved, motion_with_errors
from hydroelastic.fem.thread.motion_in_space import MotionInSpace, motion_in_space
from hydroelastic.fem.thread.motion_plan import MotionPlan, PrescribedEnd, ThreadMotionError
from hydroelastic.fem.thread.motion_request import MotionRequest
from hydroelastic.fem.thread.motion_results import ThreadMotion
from hydroelastic.fem.thread.newton import ThreadSolverError
from hydroelastic.fem.thread.profile import start_from
from hydroelastic.fem.thread.refinement import ThreadSolution
from hydroelastic.physics.thread import Thread, ThreadEnd
from hydroelastic.physics.thread_motion import EndDisplacement

Array = NDArray[np.float64]
_Run = Callable[[Array, MotionPlan], ThreadMotion]

_DEGREE = 2
# Error that a step may add, of the tolerance: errors of steps add up, and partly decay.
_STEP_PART = 0.1
_MOST_ATTEMPTS = 4
# Target error of a further attempt, of the tolerance.
_AIM = 0.5


def motion_to_tolerance(
    comm: MPI.Comm, thread: Thread, frame: Frame, rest: ThreadSolution, request: MotionRequest, *, rest_tolerance: float
) -> MotionInSpace:
    """Solve for a motion; halve steps and elements to estimate the errors, and refine until they are small enough."""
    run = _run_from_start(comm, thread, frame, rest, request, rest_tolerance)
    allowed = request.tolerance * thread.length

    def solve(discretization: tuple[Array, MotionPlan]) -> MotionWithErrors:
        nodes, plan = discretization
        return motion_with_errors(
            lambda plan, parts: run(nodes if parts == 1 else halved(nodes), plan), plan, mesh=True
        )

    def refine(discretization: tuple[Array, MotionPlan], found: MotionWithErrors) -> tuple[Array, MotionPlan]:
        nodes, plan = discretization
        assert found.mesh is not None
        if found.mesh.positions > _AIM * allowed:
            nodes = halved(nodes)
        if found.steps.positions > _AIM * allowed:
            plan = _with_smaller_steps(plan, _AIM * allowed / found.steps.positions)
        return nodes, plan

    found = adaptive_solve(
        (initial_nodes(frame.thread_in_frame(thread), start_from(rest.profile)), _plan(thread, frame, request)),
        solve,
        lambda found: ErrorEstimate(discretization=found.error),
        refine,
        allowed,
        rounds=_MOST_ATTEMPTS,
        # Without tension short waves grow by themselves, the faster the finer the mesh.
        least_gain=1.0,
        failures=(ThreadMotionError, ThreadSolverError),
    )
    return motion_in_space(frame, rest, found.solution)


def _with_smaller_steps(plan: MotionPlan, ratio: float) -> MotionPlan:
    """Steps whose error is smaller by a ratio: of second order in total, of third order in each step."""
    if plan.tolerance is None:
        return replace(plan, step=plan.step * ratio**0.5)
    return replace(plan, tolerance=plan.tolerance * ratio**1.5)


def _run_from_start(
    comm: MPI.Comm, thread: Thread, frame: Frame, rest: ThreadSolution, request: MotionRequest, rest_tolerance: float
) -> _Run:
    """The motion on given nodes, by a given plan, from the start of the request."""
    model = frame.thread_in_frame(thread)
    if request.start == "straight":
        straight = InitialMotion(position=_straight(thread, frame, request))
        return lambda nodes, plan: move_thread(comm, model, nodes, straight, plan, degree=_DEGREE)
    begin = rest.profile
    if request.start == "still_liquid":
        begin = find_equilibrium(comm, thread.with_stream_factor(0.0), frame, rest_tolerance).solution.profile

    def from_rest(nodes: Array, plan: MotionPlan) -> ThreadMotion:
        # Equilibrium on this very mesh: in a stiff thread the difference of two meshes is a large tension.
        still = solve_on_mesh(comm, begin.model, nodes, start_from(begin), degree=_DEGREE)
        return move_from_rest(replace(still, model=model), plan)

    return from_rest


def _straight(thread: Thread, frame: Frame, request: MotionRequest) -> Callable[[Array], Array]:
    way = np.array(request.direction) / np.linalg.norm(request.direction)
    a, b = thread.ends
    first = a.position if a.is_fixed else b.position - thread.length * way
    return lambda s: frame.to_frame(first + np.outer(s, way))


def _plan(thread: Thread, frame: Frame, request: MotionRequest) -> MotionPlan:
    times = np.array(request.times if request.times[0] == 0.0 else (0.0, *request.times))
    (a, b), (moves_a, moves_b), (release_a, release_b) = thread.ends, request.displacements, request.releases
    return MotionPlan(
        times=times,
        step=request.step or float(times[-1]) / 20.0,
        tolerance=None if request.step is not None else _STEP_PART * request.tolerance,
        ends=(_course(a, frame, moves_a, release_a), _course(b, frame, moves_b, release_b)),
        dissipation=request.spectral_radius,
        shedding=request.shedding,
        tension_at_start=request.start == "straight",
    )


def _course(end: ThreadEnd, frame: Frame, moves: tuple[EndDisplacement, ...], release: float) -> PrescribedEnd:
    def position(time: float) -> Array:
        return frame.to_frame(end.position + sum(move(time) for move in moves))

    return PrescribedEnd(
        position=position if moves else None,
        release=(release,) * frame.dimension if isfinite(release) else None,
    )
