"""Results of a motion of a thread: the thread at the output times, and values of every step."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray


@dataclass(frozen=True, kw_only=True)
class StepHistory:
    """Values of all n steps, SI."""

    ends: NDArray[np.float64]  # times at which steps end, with that of the start before them, s, shape (n + 1,)
    # kinetic, potential (weight and dead forces), elastic and bending at `ends`, J, shape (n + 1, 4); without the
    # liquid
    energies: NDArray[np.float64]
    # of drag, of the liquid's inertia, of changes of the dead forces, of the held ends, J, shape (n, 4)
    work: NDArray[np.float64]
    reactions: NDArray[np.float64]  # forces on the held ends at `ends`, N, shape (n + 1, 2, dimension)
    tensions: NDArray[np.float64]  # at the nodes at `ends`, N, shape (n + 1, nodes); as the reactions just after breaks
    solutions: NDArray[np.int64]  # linear systems of each step, shape (n,)


@dataclass(frozen=True, kw_only=True)
class Slack:
    """An interval with compression, which a thread without bending stiffness cannot carry."""

    start: float  # first end of a step with compression, s
    end: float  # last one, s
    where: float  # s of the node with the lowest tension, m
    tension: float  # the lowest one, N


@dataclass(frozen=True, kw_only=True)
class ThreadMotion:
    """A motion of a thread, SI."""

    times: NDArray[np.float64]  # of the output that was reached, s, shape (times,)
    nodes: NDArray[np.float64]  # s of the nodes, m, shape (nodes,)
    positions: NDArray[np.float64]  # shape (times, nodes, dimension)
    velocities: NDArray[np.float64]  # shape (times, nodes, dimension)
    tensions: NDArray[np.float64]  # at breaks just after them, shape (times, nodes)
    force_scale: float  # the largest force that acted on the thread, N, see `force_scale`
    history: StepHistory  # numbers of all steps
    moved: float  # largest change of given positions to consistent ones, m
    velocity_change: float  # largest change of velocities to consistent ones, at the start and at discontinuities, m/s
    rejected: int  # number of steps that were repeated with a shorter length
    slack: tuple[Slack, ...]  # times in compression
    rest_time: float | None  # time at which the thread came to rest, s, if that was asked for and reached


# Of the characteristic force: compression below it is rounding, or an end without force.
SLACK = 1e-8


def find_slack(
    times: NDArray[np.float64], nodes: NDArray[np.float64], tensions: NDArray[np.float64], force: float
) -> tuple[Slack, ...]:
    """Find the times in which the lowest tension is below zero."""
    lowest = tensions.min(axis=1)
    loose = lowest < -SLACK * force
    changes = np.flatnonzero(np.diff(np.concatenate([[False], loose, [False]]).astype(int)))
    found = []
    for first, beyond in changes.reshape(-1, 2):
        worst = first + int(np.argmin(lowest[first:beyond]))
        where = float(nodes[np.argmin(tensions[worst])])
        found.append(
            Slack(start=float(times[first]), end=float(times[beyond - 1]), where=where, tension=float(lowest[worst]))
        )
    return tuple(found)


def at_step_ends(
    ends: NDArray[np.float64],
    middles: NDArray[np.float64],
    starts: dict[int, NDArray[np.float64] | None],
    part: float = 0.5,
) -> NDArray[np.float64]:
    """Forces at the ends of steps from those at their midpoints; at discontinuities just after them.

    The midpoint rule leaves an error of the first order in forces of constraint whose sign changes from step to step:
    the mean of two neighbours is free of it, and belongs to the end between them.
    """
    count = len(middles)
    result = np.empty((count + 1, *middles.shape[1:]))
    lengths = np.diff(ends)
    bounds = [*sorted(starts), count]
    for first, last in pairwise(bounds):
        for end in range(first + 1, last):
            before, after = (1.0 - part) * lengths[end - 1], part * lengths[end]
            result[end] = (after * middles[end - 1] + before * middles[end]) / (before + after)
        known = starts[first]
        result[first] = middles[first] if known is None else known
        if known is None and last - first > 2:
            result[first] = _beyond(ends, result, first, first + 1, first + 2)
        result[last] = middles[last - 1]
        if last - first > 1:
            result[last] = _beyond(ends, result, last, last - 1, max(last - 2, first))
    return result


def _beyond(ends: NDArray[np.float64], values: NDArray[np.float64], at: int, near: int, far: int) -> Any:
    ratio = (ends[at] - ends[near]) / (ends[near] - ends[far])
    return values[near] + ratio * (values[near] - values[far])
