"""How far a motion of a thread may be from the exact one: the same motion with every step, or every element, in two."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from hydroelastic.fem.thread_motion_plan import MotionPlan
from hydroelastic.fem.thread_motion_results import ThreadMotion

Run = Callable[[MotionPlan, int], ThreadMotion]


@dataclass(frozen=True, kw_only=True)
class MotionDifference:
    """The largest differences of two motions at the nodes and the output times.

    Attributes:
        positions: distance, m.
        velocities: m/s.
        tensions: N.
    """

    positions: float
    velocities: float
    tensions: float


@dataclass(frozen=True, kw_only=True)
class MeasuredMotion:
    """A motion and its errors.

    Attributes:
        motion: that of the halved steps on the mesh as given.
        steps: difference from that of the whole steps; the error that is left is a third of it while steps are of
            second order.
        mesh: difference from that of halved elements with the whole steps, if it was asked for.
    """

    motion: ThreadMotion
    steps: MotionDifference
    mesh: MotionDifference | None


def halved(values: NDArray[np.float64]) -> NDArray[np.float64]:
    """Increasing numbers and the middles between them."""
    result = np.empty(2 * len(values) - 1)
    result[::2], result[1::2] = values, 0.5 * (values[1:] + values[:-1])
    return result


def motion_difference(first: ThreadMotion, second: ThreadMotion, every: int = 1) -> MotionDifference:
    """How far two motions are from each other.

    Args:
        first: a motion.
        second: one at the same times, up to where the shorter one ends.
        every: which nodes of the second are those of the first.
    """
    count = min(len(first.times), len(second.times))

    def largest(a: NDArray[np.float64], b: NDArray[np.float64]) -> float:
        change = a[:count] - b[:count, ::every]
        return float(np.max(np.linalg.norm(change, axis=-1) if change.ndim == 3 else np.abs(change)))

    return MotionDifference(
        positions=largest(first.positions, second.positions),
        velocities=largest(first.velocities, second.velocities),
        tensions=largest(first.tensions, second.tensions),
    )


def measure_motion(run: Run, plan: MotionPlan, *, mesh: bool = False) -> MeasuredMotion:
    """Follow a motion twice, with steps as planned and with all of them halved; and on halved elements if asked.

    Args:
        run: follows a plan on a mesh whose elements are cut in so many parts (collective).
        plan: what is asked.
        mesh: whether to look at the mesh too.

    Returns:
        The motion of halved steps, with the differences (collective).
    """
    whole = run(plan, 1)
    grid = whole.history.ends
    finer = run(replace(plan, grid=halved(grid)), 1)
    cut = motion_difference(whole, run(replace(plan, grid=grid), 2), every=2) if mesh else None
    return MeasuredMotion(motion=finer, steps=motion_difference(whole, finer), mesh=cut)
