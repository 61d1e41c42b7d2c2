"""What the solver answers to a scene, without its matrices: each scene is solved once, and only numbers are kept."""

from __future__ import annotations

import functools
import time
from dataclasses import dataclass
from typing import Any

import numpy as np

from hydroelastic.scenes.models.tank import TankScene
from hydroelastic.scenes.tank.run import run_tank
from hydroelastic.scenes.tank.solve import EstimatedTank, solve_scene


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

    def errors(self, reference: list[float]) -> np.ndarray:
        """ω/ω_reference − 1."""
        return self.omega / np.array(reference) - 1.0


@functools.cache
def answer(scene: TankScene) -> Answer:
    """Solve a scene, once in this process."""
    start = time.perf_counter()
    solution = solve_scene(scene)
    seconds = time.perf_counter() - start
    summary = run_tank.summarized(scene, EstimatedTank(scene=scene, tank=solution))
    return Answer(
        omega=np.array([mode["omega"] for mode in summary["modes"]]),
        estimates=np.array([mode["relative_error"] for mode in summary["modes"]]),
        reasons=solution.reasons,
        summary=summary,
        seconds=seconds,
    )


def zero_modes(scene: TankScene) -> int:
    """Motions with λ = 0: heave and pitch of each beam without restoring, but one that the volume holds back."""
    free = 2 * sum(not beam.hydrostatic for beam in scene.body)
    return free - 1 if free and scene.tank.top != "pressure_release" else free
