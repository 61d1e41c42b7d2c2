"""What is found of a thread in a stream."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from hydroelastic.fem.kept_tolerance import kept_tolerance
from hydroelastic.fem.thread.modes import ThreadModes
from hydroelastic.fem.thread.motion_results import Slack
from hydroelastic.fem.thread.stability import Stability
from hydroelastic.scenes.models.thread import ThreadScene
from hydroelastic.scenes.thread.frame import Frame

Floats = NDArray[np.float64]

# Of the largest: a motion whose tensions are known worse says nothing of slack.
_TENSION_KNOWN = 0.1
# Of the forces that act: smaller tensions, of a thread that falls freely say, are as good as none.
_TENSION_LEAST = 0.01


@dataclass(frozen=True, kw_only=True)
class RestingThread:
    """A thread at rest, at the positions of the scene.

    Attributes:
        positions: r, m, shape (positions, 3).
        tensions: T, N, shape (positions,).
        forces: contact force N, N, shape (positions, 3).
        curvatures: |r_ss|, 1/m, shape (positions,).
        end_positions: of A and B, m, shape (2, 3).
        end_tensions: at A and B, N, shape (2,).
        reactions: forces on the thread by what holds A and B, N, shape (2, 3).
        end_moments: EI κ at A and B, N·m, shape (2,).
        largest_tension: of the whole thread, N.
        smallest_tension: of the whole thread, N.
        smallest_at: where that is, m along the thread.
        position_error: estimated, of all positions, m.
        tension_error: estimated, of all tensions, N.
        reaction_error: estimated, of reactions, N.
        moment_error: estimated, of the end moments, N·m.
        relative_error: the largest of them, of length, largest force and largest moment.
        start: how Newton's method was begun.
        newton_steps: on each of the meshes.
        failed_starts: why starts before it did not lead to a thread under tension.
    """

    positions: Floats
    tensions: Floats
    forces: Floats
    curvatures: Floats
    end_positions: Floats
    end_tensions: Floats
    reactions: Floats
    end_moments: Floats
    largest_tension: float
    smallest_tension: float
    smallest_at: float
    position_error: float
    tension_error: float
    reaction_error: float
    moment_error: float
    relative_error: float
    start: str
    newton_steps: tuple[int, ...]
    failed_starts: tuple[str, ...]


@dataclass(frozen=True, kw_only=True)
class Extremes:
    """Tensions at the ends of all steps of a motion, between the output times too; n ends.

    Attributes:
        end_tensions: at A and B, N, shape (n, 2).
        lowest: along the thread, N, shape (n,).
        lowest_at: where that is, m along the thread, shape (n,).
        highest: along the thread, N, shape (n,).
        highest_at: where that is, m along the thread, shape (n,).
        force_scale: the largest force that acted on the thread, N.
        error: estimated, of all of them and of what lies between the steps, N.
    """

    end_tensions: Floats
    lowest: Floats
    lowest_at: Floats
    highest: Floats
    highest_at: Floats
    force_scale: float
    error: float

    @property
    def size(self) -> float:
        """The tension in whose parts errors of tensions are judged: the largest one, N."""
        return max(float(np.max(self.highest)), _TENSION_LEAST * self.force_scale)


@dataclass(frozen=True, kw_only=True)
class FollowedMotion:
    """A motion in time.

    Attributes:
        times: s, shape (times,).
        nodes: s of the nodes, m, shape (nodes,).
        positions: r, m, shape (times, nodes, 3).
        tensions: T, N, shape (times, nodes).
        step_error: largest change of a position by halving all steps, m.
        mesh_error: the same by halving all elements, m.
        tension_error: largest change of a tension at the output times by both, N.
        steps: in time, of the last run.
        step_ends: times at which energies are told, s, shape (steps + 1,).
        energies: kinetic, of weight and dead forces, of stretch, of bending, J, shape (steps + 1, 4).
        drag_work: of the drag by then, J, shape (steps + 1,).
        extremes: tensions at `step_ends`.
        slack: times in which some of the thread was in compression, by more than the error of its tension then.
        distance_to_rest: largest distance of the last shape from the equilibrium, m.
    """

    times: Floats
    nodes: Floats
    positions: Floats
    tensions: Floats
    step_error: float
    mesh_error: float
    tension_error: float
    steps: int
    step_ends: Floats
    energies: Floats
    drag_work: Floats
    extremes: Extremes
    slack: tuple[Slack, ...]
    distance_to_rest: float

    @property
    def position_error(self) -> float:
        """Estimated, of all positions, m."""
        return self.step_error + self.mesh_error


@dataclass(frozen=True, kw_only=True)
class ThreadSolutionOfScene:
    """All that a scene asks of a thread.

    Attributes:
        scene: the scene.
        frame: coordinates of the model.
        rest: the equilibrium.
        modes: of each analysis of modes.
        stability: of each analysis of stability.
        motions: of each analysis of motion.
        size: cells, degree and unknowns of the equilibrium, steps of motions.
        seconds: time by stage.
    """

    scene: ThreadScene
    frame: Frame
    rest: RestingThread
    modes: tuple[ThreadModes, ...]
    stability: tuple[Stability, ...]
    motions: tuple[FollowedMotion, ...]
    size: dict[str, int]
    seconds: dict[str, float]

    @cached_property
    def s(self) -> Floats:
        """Places along the thread at which the equilibrium is told, m."""
        return np.array(self.scene.positions)

    @property
    def reasons(self) -> tuple[str, ...]:
        """Why the answer does not keep what was asked; empty if it does."""
        tolerance = self.scene.accuracy.tolerance
        judged = [("equilibrium", "of its positions and forces", self.rest.relative_error, tolerance)]
        for modes in self.modes:
            for kind, roots in (("frequency", modes.oscillating), ("root that does not oscillate", modes.aperiodic)):
                worst = float(np.max(roots.relative_errors, initial=0.0))
                judged.append(("modes", f"of a {kind}", worst, tolerance))
        for threshold in (threshold for sweep in self.stability for threshold in sweep.thresholds):
            judged.append(("stability", f"of the {threshold.kind}", threshold.error / threshold.value, tolerance))
        for motion, asked in zip(self.motions, self.scene.motions, strict=True):
            relative = motion.position_error / self.scene.thread.length
            judged.append(("motion", "of positions, of the length,", relative, asked.tolerance))
        slack = [
            f"motion: from {motion.slack[0].start:.6g} s on a part of the thread would be in compression"
            for motion in self.motions
            if motion.slack
        ]
        slack += [
            f"motion: the estimated error of tensions is {motion.extremes.error:.1e} N, of {motion.extremes.size:.1e} N"
            for motion in self.motions
            if motion.extremes.error > _TENSION_KNOWN * motion.extremes.size
        ]
        return *slack, *(
            f"{what}: the estimated error {of} is {error:.1e}; {kept_tolerance(error)}"
            for what, of, error, asked_error in judged
            if error > asked_error
        )
