"""Where the displacement of a hanging string, or a derivative of it, jumps.

A wave takes the time s(x) = ∫dx/√(T/m) from the free end to the height x. What begins at the upper end, s = R, at t = 0
runs down and is reflected at both ends, so that fronts pass x at t = (2j + 1)R ∓ s(x), j = 0, 1, …
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hydroelastic.scenes.models.string import HangingString

BESIDE = {"series": 0.02, "field": 0.05}
"""Parts of R from a front within which values of a method are told apart from the others: a jump has no value, and a
series or a field solution only a blurred one."""


def travel_times(string: HangingString, positions: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return s(x) = 2(√(T m) − √(T₀ m))/T', in s, of the tension T = T₀ + T'x.

    Args:
        string: the string.
        positions: x, m, shape (positions,).
    """
    rise = string.gravity * (string.linear_density - string.displaced_mass)
    at_tip = string.gravity * (string.tip_mass - string.tip_displaced_mass)
    times: NDArray[np.float64] = (
        2.0 * np.sqrt(string.inertia) * positions / (np.sqrt(at_tip + rise * positions) + np.sqrt(at_tip))
        if at_tip
        else 2.0 * np.sqrt(string.inertia * positions / rise)
    )
    return times


def front_distance(
    string: HangingString, positions: NDArray[np.float64], times: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Return how far points are from the nearest front, in parts of R = s(l), shape (positions, times)."""
    whole = string.travel_time
    height, moment = (travel_times(string, positions) / whole)[:, None], times / whole
    # Fronts at 1 ∓ s, 3 ∓ s, …: at moment ± s an odd number passes.
    away = [np.abs(np.mod(moment + sign * height, 2.0) - 1.0) for sign in (1.0, -1.0)]
    distance: NDArray[np.float64] = np.minimum(*away)
    return distance
