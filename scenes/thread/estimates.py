"""All estimates of a scene's thread by asymptotic and closed forms."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from hydroelastic.modal.thread.estimate import Found, Inapplicable
from hydroelastic.modal.thread.fixed_end_estimates import fixed_end_estimates
from hydroelastic.modal.thread.mode_estimates import mode_estimates, stability_estimates
from hydroelastic.modal.thread.pulled_estimates import pulled_estimates
from hydroelastic.physics.arrays import FloatArray
from hydroelastic.scenes.models.thread import ThreadScene
from hydroelastic.scenes.models.thread_analyses import ThreadModes, ThreadStability
from hydroelastic.scenes.thread.physics import thread_of


def compared_places(scene: ThreadScene) -> FloatArray:
    """Places at which shapes are compared: those of the scene between both ends, m, shape (positions + 2,)."""
    return np.array([0.0, *scene.positions, scene.thread.length])


def thread_estimates(scene: ThreadScene) -> Iterator[Found]:
    """Every estimate of a scene, and those that do not apply to it with the reason."""
    thread, places = thread_of(scene), compared_places(scene)
    if all(end.is_fixed for end in thread.ends):
        yield from fixed_end_estimates(thread, places)
    elif any(end.is_free for end in thread.ends):
        yield from pulled_estimates(thread, places)
    else:
        yield Inapplicable("shapes", "an end drifts on the surface: its height is given, and not the force on it")
    modes = stability = 0
    for asked in scene.analysis:
        if isinstance(asked, ThreadModes):
            yield from mode_estimates(thread, asked.count, modes)
            modes += 1
        elif isinstance(asked, ThreadStability):
            yield from stability_estimates(thread, asked.factors, stability)
            stability += 1
