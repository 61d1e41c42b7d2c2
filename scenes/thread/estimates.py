"""All that asymptotic and closed forms say of the thread of a scene."""

from __future__ import annotations

from collections.abc import Iterator

from mpi4py import MPI

from hydroelastic.scenes.models.thread import ThreadScene
from hydroelastic.scenes.thread.estimate import Found, Inapplicable
from hydroelastic.scenes.thread.held_estimates import held_estimates
from hydroelastic.scenes.thread.layer_estimates import clamp_estimates, towed_estimates
from hydroelastic.scenes.thread.mode_estimates import mode_estimates
from hydroelastic.scenes.thread.pulled_estimates import pulled_estimates
from hydroelastic.scenes.thread.tail_estimates import tail_estimates


def thread_estimates(scene: ThreadScene, comm: MPI.Comm) -> tuple[Found, ...]:
    """Return every estimate of a scene, and those that do not fit it with the reason (collective).

    Args:
        scene: the scene.
        comm: the processes: for the moments of clamps the thread is solved without bending stiffness.
    """
    return tuple(_all(scene, comm))


def _all(scene: ThreadScene, comm: MPI.Comm) -> Iterator[Found]:
    kinds = {scene.ends.a.kind, scene.ends.b.kind}
    if "surface" in kinds:
        yield Inapplicable("shapes", "an end drifts on the surface: its height is given, and not the force on it")
    elif "free" in kinds:
        yield from pulled_estimates(scene)
        yield from tail_estimates(scene)
        yield from towed_estimates(scene)
    else:
        yield from held_estimates(scene)
    yield from clamp_estimates(scene, comm)
    yield from mode_estimates(scene)
