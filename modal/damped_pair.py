"""The two free motions of a damped oscillator q'' + 2αq' + Ω²q = 0, in forms that hold in every regime.

    C = e^{−αt} cos νt,   S = e^{−αt} sin νt / ν,   ν² = Ω² − α²

are entire functions of ν². C + αS starts from a unit displacement at rest, S from rest with a unit velocity, and

    C' = −αC − ν²S,   S' = C − αS.

Beyond critical damping, with σ² = −ν², C and S follow from the real roots −Ω²/(α + σ) and −(α + σ): cosh and sinh would
overflow before e^{−αt} brings them down, and −α + σ loses the slow root to cancellation.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray


def damped_pair(
    frequencies: ArrayLike, damping: float, times: ArrayLike
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return C and S of oscillators with one damping.

    Args:
        frequencies: undamped frequencies Ω, 1/s, shape (oscillators,), or a single one.
        damping: α, 1/s, from 0.
        times: t, s, from 0, shape (times,), or a single one.

    Returns:
        C and S (s), each of shape (oscillators, times).
    """
    frequencies, times = np.atleast_1d(np.asarray(frequencies, float)), np.atleast_1d(np.asarray(times, float))
    excess = (frequencies - damping) * (frequencies + damping)
    first = np.empty((len(frequencies), len(times)))
    second = np.empty_like(first)
    # One row after another of a regime: no branch evaluates what overflows in another.
    under, over = excess > 0.0, excess < 0.0
    critical = ~(under | over)
    if under.any():
        first[under], second[under] = _underdamped(excess[under], damping, times)
    if critical.any():
        decay = np.exp(-damping * times)
        first[critical], second[critical] = decay, times * decay
    if over.any():
        first[over], second[over] = _overdamped(frequencies[over], excess[over], damping, times)
    return first, second


def _underdamped(
    excess: NDArray[np.float64], damping: float, times: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    root = np.sqrt(excess)[:, None]
    angle = root * times
    decay = np.exp(-damping * times)
    return np.cos(angle) * decay, np.sin(angle) * (decay / root)


def _overdamped(
    frequencies: NDArray[np.float64], excess: NDArray[np.float64], damping: float, times: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    root = np.sqrt(-excess)[:, None]
    slow = np.exp(-((frequencies**2)[:, None] / (damping + root)) * times)
    ratio = np.expm1(-2.0 * root * times)
    return slow * (1.0 + 0.5 * ratio), slow * ratio / (-2.0 * root)
