"""Interface of the motion of a string's upper end that the field solution uses."""

from __future__ import annotations

from collections.abc import Callable
from typing import Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray


class EndMotion(Protocol):
    """f(t), at rest before its first break."""

    @property
    def breaks(self) -> NDArray[np.float64]:
        """Times at which f or one of its derivatives jumps, s, increasing; it starts at the first."""

    @property
    def end(self) -> float:
        """The last time at which it is known, s, or infinity."""

    def value(self, times: ArrayLike) -> NDArray[np.float64]:
        """f, m."""

    def slope(self, times: ArrayLike) -> NDArray[np.float64]:
        """f', m/s."""

    def curvature(self, times: ArrayLike) -> NDArray[np.float64]:
        """f'', m/s²."""


def after(function: Callable[[ArrayLike], NDArray[np.float64]], time: float) -> float:
    """Return the limit of a function of times, shape (n,) → (n,), from the right at a time, s."""
    return float(np.asarray(function(np.nextafter(time, np.inf))))


def jumps(motion: EndMotion, time: float) -> tuple[float, float]:
    """Return the jumps of f, m, and f', m/s, at a break."""
    value, slope = after(motion.value, time), after(motion.slope, time)
    if time <= motion.breaks[0]:
        return value, slope
    before = np.nextafter(time, -np.inf)
    return value - float(np.asarray(motion.value(before))), slope - float(np.asarray(motion.slope(before)))
