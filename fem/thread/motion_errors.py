"""Errors of a motion of a thread, estimated by halving all steps and all elements."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from hydroelastic.fem.thread.motion_plan import MotionPlan
from hydroelastic.fem.thread.motion_results import ThreadMotion

Run = Callable[[MotionPlan, int], ThreadMotion]


@dataclass(frozen=True, kw_only=True)
class MotionDifference:
    """The largest differences of two motions at the nodes and the output times."""

    positions: float  # distance, m
    velocities: float  # m/s
    tensions: float  # N


@dataclass(frozen=True, kw_only=True)
class MotionWithErrors:
    """A motion and its errors."""

    motion: ThreadMotion  # that of the halved steps on the mesh as given
    # difference from that of the whole steps; a third of it estimates the remaining error of second-order steps
    steps: MotionDifference
    mesh: MotionDifference | None  # difference from that of halved elements with the whole steps, if it was asked for
    ends: NDArray[np.float64]  # times at which the whole steps end, s, shape (n,)
    # largest difference of a tension at each of them, by halving steps and, if that was asked for, elements, N, shape
    # (n,)
    tension_changes: NDArray[np.float64]

    @property
    def error(self) -> float:
        """Error of positions by steps and, if estimated, by elements, m."""
        return self.steps.positions + (0.0 if self.mesh is None else self.mesh.positions)

    def tension_change(self, start: float, end: float) -> float:
        """The largest of `tension_changes` between two times and at the whole steps' ends around them, N."""
        first = max(int(np.searchsorted(self.ends, start, side="right")) - 1, 0)
        last = int(np.searchsorted(self.ends, end))
        return float(self.tension_changes[first : last + 1].max())


def halved(values: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return increasing numbers with the middles between them."""
    result = np.empty(2 * len(values) - 1)
    result[::2], result[1::2] = values, 0.5 * (values[1:] + values[:-1])
    return result


def motion_difference(first: ThreadMotion, second: ThreadMotion, every: int = 1) -> MotionDifference:
    """Largest differences of two motions."""
    count = min(len(first.times), len(second.times))

    def largest(a: NDArray[np.float64], b: NDArray[np.float64]) -> float:
        change = a[:count] - b[:count, ::every]
        return float(np.max(np.linalg.norm(change, axis=-1) if change.ndim == 3 else np.abs(change)))

    return MotionDifference(
        positions=largest(first.positions, second.positions),
        velocities=largest(first.velocities, second.velocities),
        tensions=largest(first.tensions, second.tensions),
    )


def motion_with_errors(run: Run, plan: MotionPlan, *, mesh: bool = False) -> MotionWithErrors:
    """Solve for a motion with steps as planned, with all of them halved and, if asked, on halved elements."""
    whole = run(plan, 1)
    grid = whole.history.ends
    finer = run(replace(plan, grid=halved(grid)), 1)
    changes = _tension_changes(whole, finer)
    cut = None
    if mesh:
        parted = run(replace(plan, grid=grid), 2)
        cut = motion_difference(whole, parted, every=2)
        changes = changes + _tension_changes(whole, parted, every=2)
    return MotionWithErrors(
        motion=finer, steps=motion_difference(whole, finer), mesh=cut, ends=grid, tension_changes=changes
    )


def _tension_changes(first: ThreadMotion, second: ThreadMotion, every: int = 1) -> NDArray[np.float64]:
    """Largest difference of a tension at each end of the first motion's steps, where the second one has steps that end
    too, but for rounding."""
    ends = second.history.ends
    places = np.searchsorted(0.5 * (ends[1:] + ends[:-1]), first.history.ends)
    changes: NDArray[np.float64] = np.abs(first.history.tensions - second.history.tensions[places, ::every]).max(axis=1)
    return changes
