"""All estimates of a scene's thread by asymptotic and closed forms."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from mpi4py import MPI

from hydroelastic.fem.thread.equilibrium_search import end_forces_without_bending
from hydroelastic.fem.thread.refinement import NoEquilibriumError
from hydroelastic.modal.thread.asymptotics import NoAsymptoticError
from hydroelastic.modal.thread.estimate import Found, Inapplicable
from hydroelastic.modal.thread.fixed_end_estimates import fixed_end_estimates
from hydroelastic.modal.thread.layer_estimates import clamp_estimates, towed_estimates
from hydroelastic.modal.thread.mode_estimates import mode_estimates, stability_estimates
from hydroelastic.modal.thread.pulled_estimates import pulled_estimates
from hydroelastic.modal.thread.tail_estimates import tail_estimates
from hydroelastic.physics.arrays import FloatArray
from hydroelastic.scenes.models.thread import ThreadScene
from hydroelastic.scenes.models.thread_analyses import ThreadModes, ThreadStability
from hydroelastic.scenes.thread.physics import frame_of, thread_of


def thread_estimates(scene: ThreadScene, comm: MPI.Comm) -> tuple[Found, ...]:
    """Return every estimate of a scene, and those that do not apply to it with the reason (collective).

    Args:
        scene: the scene.
        comm: the processes: for the moments at clamps the thread is solved without bending stiffness.
    """
    return tuple(_all(scene, comm))


def compared_places(scene: ThreadScene) -> FloatArray:
    """Places at which shapes are compared: those of the scene between both ends, m, shape (positions + 2,)."""
    return np.array([0.0, *scene.positions, scene.thread.length])


def _all(scene: ThreadScene, comm: MPI.Comm) -> Iterator[Found]:
    thread, places = thread_of(scene), compared_places(scene)

    def end_forces() -> FloatArray:
        try:
            return end_forces_without_bending(comm, thread, frame_of(scene), scene.accuracy.tolerance)
        except NoEquilibriumError as error:
            raise NoAsymptoticError(f"without bending: {error}") from error

    if all(end.is_fixed for end in thread.ends):
        yield from fixed_end_estimates(thread, places)
    elif any(end.is_free for end in thread.ends):
        yield from pulled_estimates(thread, places)
        yield from tail_estimates(thread, places)
        yield from towed_estimates(thread)
    else:
        yield Inapplicable("shapes", "an end drifts on the surface: its height is given, and not the force on it")
    yield from clamp_estimates(thread, end_forces)
    modes = stability = 0
    for asked in scene.analysis:
        if isinstance(asked, ThreadModes):
            yield from mode_estimates(thread, asked.count, modes)
            modes += 1
        elif isinstance(asked, ThreadStability):
            yield from stability_estimates(thread, asked.factors, stability)
            stability += 1
