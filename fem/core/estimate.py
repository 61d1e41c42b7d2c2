"""Errors by cause, each from what neighbouring discretizations say; only their sum is an estimate.

Of three values v₂, v₁, v₀ on ever finer discretizations the last difference d = |v₀ − v₁| and the one before it,
e = |v₁ − v₂|, tell the rate q = d/e of a geometric series, and what is left of it is d q/(1 − q).
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

# The remainder of the series is taken three times: rates grow a little from one degree to the next.
_SAFETY = 3.0


def remainder(finest: Array, finer: Array, coarse: Array, *, rates: tuple[float, float] = (0.04, 0.5)) -> Array:
    """Relative errors of the finest values.

    Args:
        finest: on the finest discretization, shape (values,).
        finer: on the one before.
        coarse: on the one before that.
        rates: smallest and largest rate that is believed.
    """
    scale = np.where(finest == 0.0, 1.0, np.abs(finest))
    last, before = np.abs(finest - finer) / scale, np.abs(finer - coarse) / scale
    rate = np.clip(last / np.where(before > 0.0, before, 1.0), *rates)
    return np.asarray(_SAFETY * last * rate / (1.0 - rate))
