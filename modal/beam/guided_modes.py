"""Dry modes of a beam whose ends are guided by the walls: cosines, the slope and the shear force zero at both ends."""

from __future__ import annotations

import math

import numpy as np
import numpy.typing as npt

from hydroelastic.physics.arrays import FloatArray


def guided_wavenumber(index: int) -> float:
    """Return κ l = index·π; index 0 is heave."""
    return index * math.pi


def guided_shape(index: int, s: npt.ArrayLike) -> FloatArray:
    """Return cos(index π s), scaled to ∫₀¹ W² ds = 1.

    Args:
        index: 0 heave, 1, 2, … elastic.
        s: z/l along the beam, 0 to 1.

    Returns:
        Values in the shape of ``s``.
    """
    scale = 1.0 if index == 0 else math.sqrt(2.0)
    return scale * np.cos(index * math.pi * np.asarray(s, dtype=np.float64))
