"""The dry modes of a plate: their shapes, their strain energy and what they are called."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

STEADY = 1e-9
"""Part of the stiffest dry mode below which a stiffness is that of a rigid motion."""


@dataclass(frozen=True, kw_only=True)
class PlateShapes:
    """Dry modes w_i of a plate of unit flexural rigidity, orthonormal: ∫w_i w_j = δ_ij, a(w_i, w_j) = κ_i δ_ij.

    Attributes:
        stiffness: κ_i = ∫(Δw)² − 2(1 − ν)(w_xx w_yy − w_xy²), ascending; exactly 0 of rigid motions, shape (modes,).
        deflection: the shapes at points (2, n) → (modes, n).
        degree: polynomial degree of the shapes, in x and y together.
        errors: estimated relative error of each κ_i by the polynomials left out, shape (modes,).
    """

    stiffness: NDArray[np.float64]
    deflection: Callable[[NDArray[np.float64]], NDArray[np.float64]]
    degree: int
    errors: NDArray[np.float64]
