"""Where functions of a parameter change their sign, many at once."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

_MOST_STEPS = 100
_ROUNDING = 4.0 * float(np.finfo(float).eps)


def sign_changes(
    function: Callable[[NDArray[np.float64]], NDArray[np.float64]],
    below: NDArray[np.float64],
    above: NDArray[np.float64],
) -> NDArray[np.float64]:
    """Return zeros by the Illinois method: secants between both signs, of which an end that stays counts half.

    Source: M. Dowell, P. Jarratt, BIT 11 (1971) 168.
    """
    low, high = function(below), function(above)
    nearest, kept = above, np.zeros(np.shape(above))
    for _ in range(_MOST_STEPS):
        last, nearest = nearest, np.asarray(above - high * (above - below) / np.where(high > low, high - low, 1.0))
        if np.all(np.abs(nearest - last) <= _ROUNDING * nearest):
            break
        values = function(nearest)
        beyond = values >= 0.0
        low = np.where(beyond, np.where(kept > 0.0, 0.5, 1.0) * low, values)
        high = np.where(beyond, values, np.where(kept < 0.0, 0.5, 1.0) * high)
        below, above = np.where(beyond, below, nearest), np.where(beyond, nearest, above)
        kept = np.where(beyond, 1.0, -1.0)
    return nearest
