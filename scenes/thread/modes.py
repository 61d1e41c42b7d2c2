"""Modes of a scene's thread, and the thresholds of its stability."""

from __future__ import annotations

import numpy as np
from mpi4py import MPI

from hydroelastic.fem.modes import EigenSolverError
from hydroelastic.fem.thread.equilibrium import Equilibrium, Start
from hydroelastic.fem.thread.hyperbolicity import IllPosedError
from hydroelastic.fem.thread.modes import ThreadModes, thread_modes
from hydroelastic.fem.thread.motion_errors import halved
from hydroelastic.fem.thread.newton import ThreadSolverError
from hydroelastic.fem.thread.profile import start_from, thread_profile
from hydroelastic.fem.thread.refinement import ThreadSolution
from hydroelastic.fem.thread.stability import Stability, stability
from hydroelastic.scenes.errors import UnsolvedError
from hydroelastic.scenes.models import thread_analyses as analyses
from hydroelastic.scenes.models.thread import ThreadScene
from hydroelastic.scenes.thread.frame import Frame
from hydroelastic.scenes.thread.model import with_stream_times
from hydroelastic.scenes.thread.on_mesh import equilibrium_on

# How often elements are halved for modes, whose errors may be larger than those of the equilibrium.
_MOST_HALVINGS = 4


def modes_of(
    comm: MPI.Comm, scene: ThreadScene, frame: Frame, rest: ThreadSolution, asked: analyses.ThreadModes
) -> ThreadModes:
    """The slowest motions about an equilibrium, on meshes that are refined until they keep the tolerance.

    Args:
        comm: the processes.
        scene: the scene; if no mesh keeps its tolerance, what the finest one gives is returned.
        frame: coordinates of the model.
        rest: the equilibrium.
        asked: what is asked.

    Raises:
        UnsolvedError: where they have no limit on finer meshes, or the eigen-solver fails (collective).
    """
    start, nodes, degree = start_from(rest.profile), rest.profile.nodes, rest.equilibrium.space.degree
    coarse = equilibrium_on(comm, scene, frame, nodes[::2], start, degree)
    fine = rest.equilibrium
    try:
        for halving in range(_MOST_HALVINGS + 1):
            found = thread_modes(fine, coarse, asked.count, velocity_damping=asked.velocity_damping)
            if found.relative_error <= scene.accuracy.tolerance or halving == _MOST_HALVINGS:
                break
            nodes = halved(nodes)
            coarse, fine = fine, equilibrium_on(comm, scene, frame, nodes, start, degree)
    except IllPosedError as error:
        raise UnsolvedError(f"the modes are ill-posed: {error}") from error
    except (EigenSolverError, ThreadSolverError) as error:
        raise UnsolvedError(f"the modes could not be found: {error}") from error
    return found


def stability_of(
    comm: MPI.Comm, scene: ThreadScene, frame: Frame, rest: ThreadSolution, asked: analyses.ThreadStability
) -> Stability:
    """Thresholds of divergence and flutter as the stream grows.

    Args:
        comm: the processes.
        scene: the scene.
        frame: coordinates of the model.
        rest: the equilibrium in the scene's stream.
        asked: what is asked.

    Raises:
        UnsolvedError: where equilibria or roots cannot be found, or have no limit on finer meshes (collective).
    """
    # Each equilibrium begins at the last one: the stream changes little.
    last: dict[str, Start] = {"start": start_from(rest.profile)}

    def equilibrium_at(factor: float, step: int = 1) -> Equilibrium:
        nodes, degree = rest.profile.nodes[::step], rest.equilibrium.space.degree
        found = equilibrium_on(comm, with_stream_times(scene, factor), frame, nodes, last["start"], degree)
        last["start"] = start_from(thread_profile(found))
        return found

    try:
        return stability(equilibrium_at, lambda factor: equilibrium_at(factor, 2), np.array(asked.factors))
    except IllPosedError as error:
        raise UnsolvedError(f"the stability is ill-posed: {error}") from error
    except (EigenSolverError, ThreadSolverError) as error:
        raise UnsolvedError(f"the stability could not be followed: {error}") from error
