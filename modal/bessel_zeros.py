"""Zeros of the Bessel function J₀, as many as wanted."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray
from scipy.special import j0, j1

# Of 1/(8β), 1/(8β)³, … in the expansion of McMahon for order 0.
MCMAHON = (1.0, -124.0 / 3.0, 120928.0 / 15.0, -401743168.0 / 105.0)
SMALLEST_TABLE = 1024


def bessel_zeros(count: int) -> NDArray[np.float64]:
    """Return the first zeros μ_k of J₀, to rounding.

    Args:
        count: how many, from 0.

    Returns:
        Zeros in rising order, shape (count,), read-only.

    Source: DLMF 10.21.19 (McMahon), then Newton's method.
    """
    return _table(1 << max(count - 1, SMALLEST_TABLE - 1).bit_length())[:count]


@lru_cache(maxsize=4)
def _table(count: int) -> NDArray[np.float64]:
    beta = np.pi * (np.arange(1, count + 1) - 0.25)
    small = 1 / (8 * beta)
    zeros = beta + sum(coefficient * small ** (2 * order + 1) for order, coefficient in enumerate(MCMAHON))
    # McMahon is 2e-4 off at the first zero and exact beyond the twentieth; Newton squares the error.
    for _ in range(3):
        zeros = zeros + j0(zeros) / j1(zeros)
    zeros.flags.writeable = False
    return zeros
