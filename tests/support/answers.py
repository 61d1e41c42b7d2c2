"""What the solver answers to a scene, through the front door: each scene is solved once, and only numbers are kept."""

from __future__ import annotations

import functools
import time
from dataclasses import dataclass
from typing import Any

import numpy as np

import hydroelastic as he


@dataclass(frozen=True, kw_only=True)
class Answer:
    """Numbers of a solution; keys of `summary` are explained in docs/conventions.md.

    Attributes:
        omega: frequencies of the modes asked for, rad/s.
        estimates: their estimated relative errors.
        reasons: why the tolerance is not kept; empty if it is.
        summary: the content of ``summary.json``.
        seconds: wall time of the solution, without imports.
    """

    omega: np.ndarray
    estimates: np.ndarray
    reasons: tuple[str, ...]
    summary: dict[str, Any]
    seconds: float

    def errors(self, reference: Any) -> np.ndarray:
        """ω/ω_reference − 1."""
        return self.omega / np.asarray(reference, dtype=float) - 1.0


@functools.cache
def answer(scene: he.TankScene) -> Answer:
    """Solve a scene, once in this process (collective)."""
    start = time.perf_counter()
    summary = he.solve(scene).summary
    return Answer(
        omega=np.array([mode["omega"] for mode in summary["modes"]]),
        estimates=np.array([mode["relative_error"] for mode in summary["modes"]]),
        reasons=tuple(summary["reasons"]),
        summary=summary,
        seconds=time.perf_counter() - start,
    )


def kept(scene: he.TankScene) -> Answer:
    """The answer to a scene whose tolerance is kept."""
    found = answer(scene)
    assert found.reasons == ()
    assert len(found.omega) == scene.accuracy.modes
    return found


def assert_alike(one: Answer, other: Answer, factor: float = 1.0) -> None:
    """Frequencies that differ by a factor, within both estimates."""
    assert np.all(np.abs(factor * one.omega / other.omega - 1.0) <= one.estimates + other.estimates)


def zero_modes(scene: he.TankScene) -> int:
    """Motions with λ = 0: heave and pitch of each beam without restoring, but one that the volume holds back."""
    free = 2 * sum(not beam.hydrostatic for beam in scene.body)
    return free - 1 if free and scene.tank.top != "pressure_release" else free
