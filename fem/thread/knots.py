"""Nodes where the thread passes heights at which a derivative of its stream jumps.

Between rows of a table the stream is smooth; at them a derivative jumps, the first one of straight lines, the second of
monotone cubics, the third of a spline. An element that contains such a place has an error of low order that depends on
the position within it: comparison with halved elements does not estimate it.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hydroelastic.fem.thread.equilibrium import Along

# Number of samples on each element in search of a passage.
_LOOKS = 16
_BISECTIONS = 50
# Of the smaller element beside it: a node this near is moved to the passage, otherwise there is another one.
_NEAR = 0.4
# Of the same: the remaining error of a kink falls with its square.
_THERE = 1e-3
# With more passages elements are as short as the rows of the table are dense, and nodes are left where they are.
_MOST = 300


def knots_along(heights: tuple[float, ...], position: Along, nodes: NDArray[np.float64]) -> NDArray[np.float64]:
    """Places at which a thread passes heights where a derivative of its stream jumps."""
    breaks = np.array(heights, dtype=np.float64)
    if len(breaks) == 0:
        return breaks
    looks = np.append((nodes[:-1, None] + np.diff(nodes)[:, None] * np.arange(_LOOKS) / _LOOKS).ravel(), nodes[-1])
    # The number of breaks below each place changes where the thread passes some.
    below = np.searchsorted(breaks, position(looks)[:, -1])
    if np.sum(np.abs(np.diff(below))) > _MOST:
        return np.empty(0)
    intervals: list[int] = []
    passed: list[float] = []
    for place in np.flatnonzero(np.diff(below)):
        first, last = sorted((below[place], below[place + 1]))
        passed += list(breaks[first:last])
        intervals += [place] * (last - first)
    low, high, levels = looks[intervals], looks[np.array(intervals, dtype=int) + 1], np.array(passed)
    if len(levels) == 0:
        return levels
    rising = position(high)[:, -1] > position(low)[:, -1]
    for _ in range(_BISECTIONS):
        middle = 0.5 * (low + high)
        beyond = (position(middle)[:, -1] > levels) == rising
        low, high = np.where(beyond, low, middle), np.where(beyond, middle, high)
    found: NDArray[np.float64] = np.unique(0.5 * (low + high))
    return found


def at_knots(nodes: NDArray[np.float64], knots: NDArray[np.float64], kept: list[float]) -> NDArray[np.float64]:
    """Nodes of which one is at each knot: the nearest one is moved, or one is added between two that are far."""
    fixed = [nodes[0], *kept, nodes[-1]]
    for knot in knots:
        index = int(np.argmin(np.abs(nodes - knot)))
        size = _size(nodes, index)
        distance = abs(nodes[index] - knot)
        if distance <= _THERE * size:
            fixed.append(nodes[index])
        elif distance < _NEAR * size and nodes[index] not in fixed:
            nodes = np.concatenate([nodes[:index], [knot], nodes[index + 1 :]])
            fixed.append(knot)
        elif distance > 1e-9 * nodes[-1]:
            nodes = np.sort(np.append(nodes, knot))
            fixed.append(knot)
    return nodes


def _size(nodes: NDArray[np.float64], index: int) -> float:
    return float(np.min(np.diff(nodes[max(index - 1, 0) : index + 2])))
