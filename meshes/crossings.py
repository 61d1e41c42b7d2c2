"""Detection of straight lines that cross or touch, on which gmsh fails or does not terminate."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray


def crossing_pair(starts: NDArray[np.float64], ends: NDArray[np.float64]) -> tuple[int, int] | None:
    """Two segments that meet elsewhere than at common ends."""
    # Side of each segment on which each end of each other one lies, shape (segments, others).
    from_start, from_end = (_sides(starts, ends, points) for points in (starts, ends))
    across = from_start * from_end < 0.0
    touching = _within(starts, ends, starts, from_start) | _within(starts, ends, ends, from_end)
    found = np.argwhere((across & across.T) | touching)
    return (int(found[0, 0]), int(found[0, 1])) if len(found) else None


def _sides(starts: NDArray[np.float64], ends: NDArray[np.float64], points: NDArray[np.float64]) -> NDArray[np.float64]:
    edges = (ends - starts)[:, None]
    away = points - starts[:, None]
    sides: NDArray[np.float64] = edges[..., 0] * away[..., 1] - edges[..., 1] * away[..., 0]
    # A shared end lies exactly on both lines, in spite of rounding.
    shared = (points == starts[:, None]).all(axis=2) | (points == ends[:, None]).all(axis=2)
    sides[shared] = 0.0
    return sides


def _within(
    starts: NDArray[np.float64], ends: NDArray[np.float64], points: NDArray[np.float64], sides: NDArray[np.float64]
) -> NDArray[np.bool_]:
    edges = (ends - starts)[:, None]
    along = ((points - starts[:, None]) * edges).sum(axis=2)
    inside: NDArray[np.bool_] = (sides == 0.0) & (along > 0.0) & (along < (edges**2).sum(axis=2))
    inside &= ~(points == ends[:, None]).all(axis=2)
    return inside
