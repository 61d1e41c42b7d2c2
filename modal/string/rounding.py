"""Rounding errors of sums of a string's modes."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from hydroelastic.modal.string.modes import FreeMotionJumps
from hydroelastic.physics.string import HangingString

EPS = float(np.finfo(float).eps)


class Rounding:
    """Estimates of rounding: each mode has its own error, of 4ε (1 + J/16 + Ωt/3) of its size after J starts.

    The amplitude is rounded at every start, and may be so to the same side; the phase is rounded with Ωt.

    Args:
        starts: times at which the motion of the upper end starts anew, s, shape (starts,).
        ratios: r of the positions, shape (positions,).
        times: s, shape (times,).
    """

    def __init__(
        self,
        *,
        string: HangingString,
        starts: NDArray[np.float64],
        ratios: NDArray[np.float64],
        times: NDArray[np.float64],
    ) -> None:
        self._damping = string.damping
        past = np.searchsorted(starts, times, side="right")
        self._steps = 1 + past / 16
        # Positions are rounded too: they are as far as R.
        self._phase = (times + string.travel_time) / 3
        self._decay = np.exp(-2 * string.damping * (times - starts[past - 1]))
        # Squares of the sizes of aperiodic modes; of oscillating ones; of these times Ω.
        self._sums = np.zeros((3, len(ratios)))

    def add(self, frequencies: NDArray[np.float64], jumps: FreeMotionJumps, shapes: NDArray[np.float64]) -> None:
        """Take in modes: their frequencies (1/s), jumps, and shapes (positions, modes)."""
        excess = (frequencies - self._damping) * (frequencies + self._damping)
        oscillating = excess > 0
        # Near critical damping S is at most 1/(eα).
        inverse = 1 / np.sqrt(np.maximum(np.abs(excess), self._damping**2 / 4))
        # Of S stands v + αu; of aperiodic modes αu is kept by C + αS, which falls slowly from 1.
        kept = self._damping * oscillating
        pushed = np.concatenate([jumps.factors, jumps.factors * kept[:, None]], axis=1) * inverse[:, None]
        sizes = 2 * (
            _squares(jumps.factors, jumps.displacements)
            + _squares(pushed, np.concatenate([jumps.velocities, jumps.displacements]))
        )
        moving = np.where(oscillating, sizes, 0.0)
        self._sums += np.stack([np.where(oscillating, 0.0, sizes), moving, moving * frequencies**2]) @ (shapes**2).T

    def at(self, rows: NDArray[np.int_], columns: NDArray[np.int_]) -> NDArray[np.float64]:
        """Return estimates at points, m, shape (points,), given by indices of positions and times, both of shape
        (points,)."""
        aperiodic, oscillating, turning = self._sums[:, rows]
        moving = oscillating * self._steps[columns] ** 2 + turning * self._phase[columns] ** 2
        squares = aperiodic * self._steps[columns] ** 2 + self._decay[columns] * moving
        return np.asarray(4 * EPS * np.sqrt(squares))


def _squares(factors: NDArray[np.float64], jumps: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return Σ over starts of (factors · jumps)², shape (modes,)."""
    return np.asarray(np.maximum(((factors @ (jumps @ jumps.T)) * factors).sum(axis=1), 0.0))
