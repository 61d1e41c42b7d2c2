"""Sharply cut sum of the first modes of a string, for comparison with the smoothly cut one of `string_response`."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from hydroelastic.modal.bessel_zeros import bessel_zeros
from hydroelastic.modal.string.closed_form import natural_frequencies, participations, relative_roots
from hydroelastic.modal.string.modes import free_coordinates, free_motion_jumps
from hydroelastic.modal.string.quasistatic import exponentials, forced_part
from hydroelastic.physics.string import HangingString
from hydroelastic.physics.string_motions import Motion


def partial_sum(
    string: HangingString, motion: Motion, positions: ArrayLike, times: ArrayLike, terms: int
) -> NDArray[np.float64]:
    """Return the forced part plus the sum of the first modes, cut sharply.

    Args:
        motion: that of the upper end.
        positions: x, m, shape (positions,) or one.
        times: t, s, from 0 and rising, shape (times,) or one.
        terms: number of modes. A mode that the motion nearly meets must be among them.

    Returns:
        U_N, m, shape (positions, times). Not 0 before the front.
    """
    times = np.atleast_1d(np.asarray(times, dtype=float))
    ratios = np.atleast_1d(relative_roots(string, positions))
    forcing = motion.forcing
    parts = exponentials(string, forcing)
    least = max((part.mode for part in parts), default=0)
    if terms < max(1, least):
        raise ValueError(f"terms is {terms}: at least {max(1, least)} is allowed, for that mode is met")
    zeros, frequencies = bessel_zeros(terms), natural_frequencies(string, terms)
    forced, _ = forced_part(string, forcing, ratios, times)
    jumps = free_motion_jumps(string, forcing, parts, frequencies, first_mode=1)
    free = free_coordinates(frequencies, string.damping, forcing.starts, jumps, times)
    return np.asarray(forced + participations(zeros, ratios) @ free)
