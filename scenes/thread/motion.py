"""Motion in time of a scene's thread, with errors by halving steps and elements."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from math import inf, sin

import numpy as np
from mpi4py import MPI
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline

from hydroelastic.fem.thread.equilibrium import solve_on_mesh
from hydroelastic.fem.thread.motion import MovingStart, move_from_rest, move_thread
from hydroelastic.fem.thread.motion_errors import MeasuredMotion, halved, measure_motion
from hydroelastic.fem.thread.motion_plan import EndCourse, MotionPlan, ThreadMotionError, VectorOfTime
from hydroelastic.fem.thread.motion_results import ThreadMotion
from hydroelastic.fem.thread.newton import ThreadSolverError
from hydroelastic.fem.thread.nodes import first_nodes
from hydroelastic.fem.thread.profile import start_from
from hydroelastic.fem.thread.refinement import ThreadSolution
from hydroelastic.fem.thread.shedding import Shedding
from hydroelastic.scenes.errors import UnsolvedError
from hydroelastic.scenes.models import thread_analyses as analyses
from hydroelastic.scenes.models.thread import ThreadScene
from hydroelastic.scenes.models.thread_parts import FixedEnd
from hydroelastic.scenes.thread.equilibrium import find_equilibrium
from hydroelastic.scenes.thread.frame import Frame
from hydroelastic.scenes.thread.model import model_of, with_stream_times
from hydroelastic.scenes.thread.results import Extremes, FollowedMotion

Array = NDArray[np.float64]

_DEGREE = 2
# Of the tolerance: what a step may add. Errors of steps add up, and partly die out.
_STEP_PART = 0.1
_MOST_ATTEMPTS = 4
# By which a second attempt aims below the tolerance.
_AIM = 0.5


def motion_of(
    comm: MPI.Comm, scene: ThreadScene, frame: Frame, rest: ThreadSolution, asked: analyses.ThreadMotion
) -> FollowedMotion:
    """Follow the thread; halve steps and elements to tell the errors, and refine until they keep the tolerance.

    Args:
        comm: the processes.
        scene: the scene.
        frame: coordinates of the model.
        rest: the equilibrium.
        asked: what is asked.

    Returns:
        The motion with the halved steps (collective); the best one if none keeps the tolerance.

    Raises:
        UnsolvedError: where the motion cannot be followed.
    """
    model = model_of(scene, frame)
    nodes = first_nodes(model, start_from(rest.profile))
    plan = _plan(scene, frame, asked)
    allowed = asked.tolerance * scene.thread.length
    begin = _beginning(comm, scene, frame, rest, asked)

    def run(plan: MotionPlan, parts: int) -> ThreadMotion:
        return begin(nodes if parts == 1 else halved(nodes), plan)

    best: MeasuredMotion | None = None
    for _ in range(_MOST_ATTEMPTS):
        try:
            found = measure_motion(run, plan, mesh=True)
        except (ThreadMotionError, ThreadSolverError) as error:
            if best is None:
                raise UnsolvedError(str(error)) from error
            break
        if best is not None and found.error >= best.error:
            # Where a thread is free of tension short waves grow by themselves: the faster, the finer the mesh is.
            break
        best = found
        if found.error <= allowed:
            break
        assert found.mesh is not None
        steps, mesh = found.steps.positions, found.mesh.positions
        if mesh > _AIM * allowed:
            nodes = halved(nodes)
        if steps > _AIM * allowed:
            plan = _shorter(plan, _AIM * allowed / steps)
    assert best is not None
    return _followed(frame, rest, best)


def _shorter(plan: MotionPlan, ratio: float) -> MotionPlan:
    """Steps whose error is smaller by a ratio: of second order as a whole, of third each."""
    if plan.tolerance is None:
        return replace(plan, step=plan.step * ratio**0.5)
    return replace(plan, tolerance=plan.tolerance * ratio**1.5)


_Begun = Callable[[Array, MotionPlan], ThreadMotion]


def _beginning(
    comm: MPI.Comm, scene: ThreadScene, frame: Frame, rest: ThreadSolution, asked: analyses.ThreadMotion
) -> _Begun:
    """What follows the thread on given nodes from the start that is asked for."""
    model = model_of(scene, frame)
    if asked.start == "straight":
        straight = MovingStart(position=_straight(scene, frame, asked))
        return lambda nodes, plan: move_thread(comm, model, nodes, straight, plan, degree=_DEGREE)
    begin = rest.profile
    if asked.start == "still_liquid":
        try:
            begin = find_equilibrium(comm, with_stream_times(scene, 0.0), frame).solution.profile
        except UnsolvedError as error:
            raise UnsolvedError(f'start = "still_liquid": without the stream {error}') from error

    def from_rest(nodes: Array, plan: MotionPlan) -> ThreadMotion:
        # At rest on this very mesh: a stiff thread takes up the difference of two meshes with a large tension.
        still = solve_on_mesh(comm, begin.model, nodes, start_from(begin), degree=_DEGREE)
        return move_from_rest(replace(still, model=model), plan)

    return from_rest


def _straight(scene: ThreadScene, frame: Frame, asked: analyses.ThreadMotion) -> Callable[[Array], Array]:
    way = np.array(asked.direction) / np.linalg.norm(asked.direction)
    a, b = scene.ends.a, scene.ends.b
    if isinstance(a, FixedEnd):
        first = np.array(a.position)
    else:
        assert isinstance(b, FixedEnd)
        first = np.array(b.position) - scene.thread.length * way
    return lambda s: frame.inside(first + np.outer(s, way))


def _plan(scene: ThreadScene, frame: Frame, asked: analyses.ThreadMotion) -> MotionPlan:
    times = np.array(asked.times if asked.times[0] == 0.0 else (0.0, *asked.times))
    shedding = None
    if asked.vortices is not None:
        diameter = scene.thread.diameter
        assert diameter is not None
        shedding = Shedding(
            lift=0.5 * scene.density * diameter * asked.vortices.lift, wave_number=asked.vortices.strouhal / diameter
        )
    return MotionPlan(
        times=times,
        step=asked.step or float(times[-1]) / 20.0,
        tolerance=None if asked.step is not None else _STEP_PART * asked.tolerance,
        ends=(_course(scene, frame, asked, "a"), _course(scene, frame, asked, "b")),
        dissipation=asked.spectral_radius if asked.integrator == "generalized_alpha" else None,
        shedding=shedding,
        tension_at_start=asked.start == "straight",
    )


def _course(scene: ThreadScene, frame: Frame, asked: analyses.ThreadMotion, name: analyses.EndName) -> EndCourse:
    end = scene.ends.a if name == "a" else scene.ends.b
    moves = [move for move in asked.move if move.end == name]
    releases = [release.time for release in asked.release if release.end == name]
    position: VectorOfTime | None = None
    if moves:
        assert isinstance(end, FixedEnd)
        begin = np.array(end.position)
        displacements = [displacement(scene, move) for move in moves]

        def position(time: float) -> Array:
            return frame.inside(begin + sum(moved(time) for moved in displacements))

    release = (min(releases, default=inf),) * frame.dimension if releases else None
    return EndCourse(position=position, release=release)


def displacement(scene: ThreadScene, move: analyses.EndMotion) -> Callable[[float], Array]:
    """The displacement (x, y, z) in m of a moved end by the time in s; zero at t = 0.

    Args:
        scene: that tells where a table lies.
        move: what is asked.
    """
    velocity, amplitude = np.array(move.velocity), np.array(move.amplitude)
    rows = np.array(scene.table_of(move))
    table = CubicSpline(rows[:, 0], rows[:, 1:] - rows[0, 1:]) if len(rows) else None

    def moved(time: float) -> Array:
        way = velocity * time + amplitude * (sin(move.omega * time + move.phase) - sin(move.phase))
        if table is not None:
            way = way + table(time)
        return np.asarray(_rise(time, move.rise) * way)

    return moved


def _rise(time: float, duration: float) -> float:
    """From 0 to 1 with two continuous derivatives."""
    if time >= duration:
        return 1.0
    part = max(time, 0.0) / duration
    return part**3 * (10.0 + part * (6.0 * part - 15.0))


def _followed(frame: Frame, rest: ThreadSolution, found: MeasuredMotion) -> FollowedMotion:
    motion, history = found.motion, found.motion.history
    assert found.mesh is not None
    tensions = history.tensions
    final = motion.positions[-1] - rest.profile.position(motion.nodes)
    return FollowedMotion(
        times=motion.times,
        nodes=motion.nodes,
        positions=frame.places(motion.positions),
        tensions=motion.tensions,
        step_error=found.steps.positions,
        mesh_error=found.mesh.positions,
        tension_error=found.steps.tensions + found.mesh.tensions,
        steps=len(history.solutions),
        step_ends=history.ends,
        energies=history.energies,
        drag_work=np.concatenate([[0.0], np.cumsum(history.work[:, 0])]),
        extremes=Extremes(
            end_tensions=tensions[:, [0, -1]],
            lowest=tensions.min(axis=1),
            lowest_at=motion.nodes[tensions.argmin(axis=1)],
            highest=tensions.max(axis=1),
            highest_at=motion.nodes[tensions.argmax(axis=1)],
            force_scale=motion.force_scale,
            error=float(found.tension_changes.max()) + _between_steps(tensions),
        ),
        # Near a free end the tension is as small as its error.
        slack=tuple(slack for slack in motion.slack if slack.tension < -found.tension_change(slack.start, slack.end)),
        distance_to_rest=float(np.max(np.linalg.norm(final, axis=1))),
    )


def _between_steps(tensions: Array) -> float:
    """What extremes at the ends of steps leave out between them, N: less than they change by leaving out every other
    step, which a curve does four times as much."""
    return float(max(tensions.max() - tensions[::2].max(), tensions[::2].min() - tensions.min()))
