"""True errors of threads at rest: by marching, by shooting, or on far finer meshes of another degree."""

from __future__ import annotations

from itertools import pairwise

import numpy as np
from mpi4py import MPI
from thread_shooting import shoot

from hydroelastic.fem.thread.equilibrium import solve_on_mesh
from hydroelastic.fem.thread.profile import start_from, thread_profile
from hydroelastic.fem.thread.refinement import ThreadSolution
from hydroelastic.modal.thread.march import march_back, march_tail
from hydroelastic.physics.thread import PointLoad
from hydroelastic.scenes.models.thread import ThreadScene
from hydroelastic.scenes.models.thread_tables import FixedEnd
from hydroelastic.scenes.thread.physics import frame_of, thread_of

PLACES = 40
# Of each step of a march.
MARCH = 1e-12
_FINER = 4


def true_error(scene: ThreadScene, solution: ThreadSolution) -> float:
    """Return the largest error of positions, of the length, or of tensions, of the largest contact force.

    The end A of the scene is fixed.
    """
    profile, frame, length = solution.profile, frame_of(scene), scene.thread.length
    # Away from bodies, at which tensions jump.
    s = (np.arange(PLACES) + 0.5) / PLACES * length
    held = isinstance(scene.ends.b, FixedEnd)
    if scene.thread.flexural_rigidity > 0.0 or (held and scene.load):
        positions, tensions = _finer(solution, s)
        positions = frame.to_space(positions)
    elif held:
        positions, tensions = _shot(scene, solution, s)
    else:
        positions, tensions = _marched(scene, s)
    moved = np.linalg.norm(frame.to_space(profile.position(s)) - positions, axis=1).max() / length
    largest = np.linalg.norm(profile.force, axis=2).max()
    return float(max(moved, np.abs(profile.tension_at(s) - tensions).max() / largest))


def _finer(solution: ThreadSolution, s: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    model, profile = solution.equilibrium.model, solution.profile
    degree, nodes = solution.equilibrium.space.degree, profile.nodes
    parts = [np.linspace(a, b, _FINER, endpoint=False) for a, b in pairwise(nodes)]
    finer = np.concatenate([*parts, nodes[-1:]])
    found = thread_profile(solve_on_mesh(MPI.COMM_WORLD, model, finer, start_from(profile), degree=degree + 1))
    return found.position(s), found.tension_at(s)


def _shot(scene: ThreadScene, solution: ThreadSolution, s: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    thread = thread_of(scene)
    a, b = (end.position for end in thread.ends)
    guess = frame_of(scene).to_space(solution.profile.force[0, 0])
    shot = shoot(thread.distributed_load, thread.length, a, b, thread.axial_rigidity, guess)
    assert shot.miss < 1e-9
    return shot.positions(s), np.linalg.norm(shot.forces(s), axis=1)


def _marched(scene: ThreadScene, s: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    thread = thread_of(scene)
    load, length, rigidity = thread.distributed_load, thread.length, thread.axial_rigidity
    start = thread.ends[0].position

    def force_on(body: PointLoad, place: np.ndarray) -> np.ndarray:
        velocity = np.zeros(3) if load.stream is None else load.stream.velocity_at(np.asarray(place)[None])[0]
        drag = body.drag * np.linalg.norm(velocity) * velocity
        return np.asarray(body.force + np.array([0.0, 0.0, -body.weight]) + drag)

    b = thread.ends[1].load
    if np.any(force_on(b, start)):
        points = [(at, lambda place, body=body: force_on(body, place)) for at, body in thread.loads.items()]
        shape = march_back(
            load,
            length,
            lambda place: force_on(b, place),
            point_forces=points,
            axial_rigidity=rigidity,
            start=start,
            tolerance=MARCH,
        )
    else:
        shape = march_tail(load, length, axial_rigidity=rigidity, start=start, tolerance=MARCH)
    found = shape.at(s)
    return found.positions, found.tensions
