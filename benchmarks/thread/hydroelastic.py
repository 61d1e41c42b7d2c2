"""The flexible threads on this solver: as a field, and by the closed form of the catenary."""

from __future__ import annotations

import numpy as np
from mpi4py import MPI
from numpy.typing import NDArray

from hydroelastic.benchmarks.cases import Answer, Case
from hydroelastic.benchmarks.tank.hydroelastic import versions as versions
from hydroelastic.benchmarks.thread.cases import (
    AMPLITUDE,
    CHAIN,
    JUMPER,
    LINES_AT_REST,
    PERIOD,
    SWING,
    SWING_TIMES,
    TENSION_TIMES,
    BenchmarkLine,
    tension_difference,
    top_displacement,
)
from hydroelastic.fem.thread.equilibrium import solve_on_mesh
from hydroelastic.fem.thread.equilibrium_search import FoundEquilibrium
from hydroelastic.fem.thread.frame import Frame
from hydroelastic.fem.thread.motion import InitialMotion, move_from_rest, move_thread
from hydroelastic.fem.thread.motion_plan import MotionPlan, PrescribedEnd
from hydroelastic.fem.thread.motion_refinement import motion_to_tolerance
from hydroelastic.fem.thread.motion_request import MotionRequest
from hydroelastic.fem.thread.profile import start_from
from hydroelastic.modal.thread.catenary import elastic_catenary
from hydroelastic.physics.thread import PointLoad, Thread, ThreadEnd
from hydroelastic.physics.thread_motion import EndDisplacement
from hydroelastic.scenes.models.thread import ThreadScene
from hydroelastic.scenes.thread.physics import thread_of
from hydroelastic.scenes.thread.solve import equilibrium_of

Array = NDArray[np.float64]

_PLANE = Frame((1.0, 0.0), 2)
# Of the positions of a thread that is moved.
_DEGREE = 3
# Of the equilibrium from which the jumper is moved.
_REST = 1e-6


def solve(case: Case) -> Answer:
    """Solve a case, from numbers to numbers."""
    if case.tank == SWING:
        return _swing(case)
    line = LINES_AT_REST["jumper at rest" if case.tank == JUMPER else case.tank]
    if case.code == "thread catenary":
        return _catenary(line)
    if case.tank == JUMPER:
        scene = thread_scene(line, _REST if case.variant == "one run" else case.tolerance)
        found = equilibrium_of(MPI.COMM_WORLD, scene)
        return _certified(case, scene, found) if case.variant == "certified" else _moved(case, scene, found)
    found = equilibrium_of(MPI.COMM_WORLD, thread_scene(line, case.tolerance))
    forces = found.solution.profile.force
    return Answer(
        values=tuple(map(float, (*forces[0, 0], *forces[-1, 1]))),
        unknowns=len(found.solution.equilibrium.solution.x.array),
        note=f"estimate {found.solution.errors.relative:.1e}, {found.solution.elements[-1]} elements",
    )


def thread_scene(line: BenchmarkLine, tolerance: float) -> ThreadScene:
    """A line as a scene."""
    stream: dict[str, object] = {"density": line.density}
    if line.stream:
        stream["velocity"] = (line.stream, 0.0)
    if line.shear:
        stream |= {"shear": (line.shear, 0.0), "level": line.a[1]}
    return ThreadScene.model_validate(
        {
            "thread": {
                "length": line.length,
                "diameter": line.diameter,
                "mass": line.mass,
                "gravity": line.gravity,
                "axial_rigidity": line.axial_rigidity,
                "normal_drag": line.normal_drag,
                "tangential_drag": line.tangential_drag,
                "added_mass": 1.0,
            },
            "stream": stream,
            "ends": {
                name: {"kind": "fixed", "position": (place[0], 0.0, place[1])}
                for name, place in (("a", line.a), ("b", line.b))
            },
            "accuracy": {"tolerance": tolerance},
        }
    )


def _catenary(line: BenchmarkLine) -> Answer:
    a, b = ((x, 0.0, z) for x, z in (line.a, line.b))
    shape = elastic_catenary(a, b, line.length, line.weight, line.axial_rigidity, np.array([0.0, line.length]))
    return Answer(values=tuple(map(float, shape.forces[:, [0, 2]].ravel())), unknowns=2)


def _certified(case: Case, scene: ThreadScene, found: FoundEquilibrium) -> Answer:
    """The jumper by the solution to a tolerance, which halves steps and elements to estimate its errors."""
    swayed = EndDisplacement(amplitude=(AMPLITUDE, 0.0, 0.0), omega=2.0 * np.pi / PERIOD, rise=PERIOD)
    request = MotionRequest(
        times=tuple(map(float, TENSION_TIMES)), displacements=((), (swayed,)), tolerance=case.tolerance
    )
    tolerance = scene.accuracy.tolerance
    motion = motion_to_tolerance(
        MPI.COMM_WORLD, thread_of(scene), _PLANE, found.solution, request, rest_tolerance=tolerance
    )
    estimate = (motion.step_error + motion.mesh_error) / scene.thread.length
    tension = motion.tension_error / float(np.abs(motion.tensions).max())
    words = f"estimates: positions {estimate:.1e}, tensions {tension:.1e}"
    return _jumper_answer(motion.tensions[-len(TENSION_TIMES) :, -1], len(motion.nodes), motion.steps, words)


def _moved(case: Case, scene: ThreadScene, found: FoundEquilibrium) -> Answer:
    line = LINES_AT_REST["jumper at rest"]

    def top(time: float) -> Array:
        return np.array([line.b[0] + top_displacement(time), line.b[1]])

    plan = MotionPlan(
        times=np.array([0.0, *TENSION_TIMES]),
        step=case.step,
        ends=(PrescribedEnd(), PrescribedEnd(position=top)),
        breaks=(PERIOD,),
    )
    nodes = np.linspace(0.0, line.length, case.segments + 1, dtype=np.float64)
    start = start_from(found.solution.profile)
    # At rest on its own mesh: a thread that is interpolated begins to ring along itself.
    rest = solve_on_mesh(MPI.COMM_WORLD, _PLANE.thread_in_frame(thread_of(scene)), nodes, start, degree=_DEGREE)
    history = move_from_rest(rest, plan).history
    pulls = np.linalg.norm(history.reactions[:, 1], axis=1)
    values = np.interp(TENSION_TIMES, history.ends, pulls)
    return _jumper_answer(values, _DEGREE * case.segments + 1, len(history.work), "")


def _jumper_answer(values: Array, nodes: int, steps: int, words: str) -> Answer:
    parts = [f"{steps} steps", f"{tension_difference(values, 'MoorDyn'):.1e} from MoorDyn's fine run", words]
    return Answer(values=tuple(map(float, values)), unknowns=nodes, note=", ".join(part for part in parts if part))


def _swing(case: Case) -> Answer:
    none = np.zeros(2)
    top = ThreadEnd(load=PointLoad(force=none), held=(True, True), position=none)
    body = PointLoad(force=np.array([0.0, -CHAIN.tip_weight]), mass=CHAIN.tip_mass)
    model = Thread(
        dimension=2,
        length=CHAIN.length,
        ends=(top, ThreadEnd(load=body, held=(False, False), position=none)),
        weight=CHAIN.weight,
        mass=CHAIN.mass,
        normal_drag=CHAIN.normal_drag,
        tangential_drag=CHAIN.tangential_drag,
        added_mass=CHAIN.added_mass,
    )

    def hanging(s: Array) -> Array:
        return np.asarray(np.outer(s, [0.0, -1.0]), dtype=np.float64)

    def sideways(s: Array) -> Array:
        return np.asarray(np.outer(CHAIN.velocity(s), [1.0, 0.0]), dtype=np.float64)

    start = InitialMotion(position=hanging, velocity=sideways)
    nodes = np.linspace(0.0, CHAIN.length, case.segments + 1, dtype=np.float64)
    plan = MotionPlan(times=np.array([0.0, *SWING_TIMES]), step=case.step)
    motion = move_thread(MPI.COMM_WORLD, model, nodes, start, plan, degree=_DEGREE)
    return Answer(
        values=tuple(map(float, motion.positions[1:, -1].ravel())),
        unknowns=_DEGREE * case.segments + 1,
        note=f"{len(motion.history.work)} steps",
    )
