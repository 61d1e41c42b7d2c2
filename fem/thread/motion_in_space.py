"""A motion of a thread in space, with its estimated errors."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hydroelastic.fem.thread.frame import Frame
from hydroelastic.fem.thread.motion_errors import MotionWithErrors
from hydroelastic.fem.thread.motion_results import Slack
from hydroelastic.fem.thread.refinement import ThreadSolution

Array = NDArray[np.float64]

# Of the acting forces: smaller tensions, as of a thread in free fall, are negligible.
_TENSION_LEAST = 0.01


@dataclass(frozen=True, kw_only=True)
class Extremes:
    """Tensions at the ends of all steps of a motion, between the output times too; n ends."""

    end_tensions: Array  # at A and B, N, shape (n, 2)
    lowest: Array  # along the thread, N, shape (n,)
    lowest_at: Array  # where that is, m along the thread, shape (n,)
    highest: Array  # along the thread, N, shape (n,)
    highest_at: Array  # where that is, m along the thread, shape (n,)
    force_scale: float  # the largest force that acted on the thread, N
    error: float  # estimated, of all of them and of what lies between the steps, N

    @property
    def size(self) -> float:
        """The largest tension, N, to which errors of tensions are relative."""
        return max(float(np.max(self.highest)), _TENSION_LEAST * self.force_scale)


@dataclass(frozen=True, kw_only=True)
class MotionInSpace:
    """A motion in time."""

    times: Array  # s, shape (times,)
    nodes: Array  # arc length s of the nodes, m, shape (nodes,)
    positions: Array  # r, m, shape (times, nodes, 3)
    tensions: Array  # T, N, shape (times, nodes)
    step_error: float  # largest change of a position by halving all steps, m
    mesh_error: float  # the same by halving all elements, m
    tension_error: float  # largest change of a tension at the output times by both, N
    steps: int  # in time, of the last run
    step_ends: Array  # times of the energies, s, shape (steps + 1,)
    energies: Array  # kinetic, of weight and dead forces, of stretch, of bending, J, shape (steps + 1, 4)
    drag_work: Array  # of the drag up to these times, J, shape (steps + 1,)
    extremes: Extremes  # tensions at `step_ends`
    # times in which some of the thread was in compression, by more than the error of its tension then
    slack: tuple[Slack, ...]
    distance_to_rest: float  # largest distance of the last shape from the equilibrium, m

    @property
    def position_error(self) -> float:
        """Estimated, of all positions, m."""
        return self.step_error + self.mesh_error


def motion_in_space(frame: Frame, rest: ThreadSolution, found: MotionWithErrors) -> MotionInSpace:
    """Return a measured motion in space, with its estimated errors."""
    motion, history = found.motion, found.motion.history
    assert found.mesh is not None
    tensions = history.tensions
    final = motion.positions[-1] - rest.profile.position(motion.nodes)
    return MotionInSpace(
        times=motion.times,
        nodes=motion.nodes,
        positions=frame.positions_in_space(motion.positions),
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
    """Error of extremes that are taken at the ends of steps only, N: at most their change when every other step is left
    out, which for a smooth curve is four times as large."""
    return float(max(tensions.max() - tensions[::2].max(), tensions[::2].min() - tensions.min()))
