"""Roots of a tensioned beam in axial flow by Chebyshev collocation, nothing of which the field solution uses.

EI w'''' − (T − M U²) w'' + 2 M U w'_t + (m + M) w_tt + c (w_t + U w') = 0 on 0 ≤ x ≤ 1 with EI = 1, m + M = 1; at x = 1
pinned, or free with w'' = 0, w''' + f M U (w_t + U w') = 0.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.polynomial import chebyshev
from numpy.typing import NDArray
from scipy.linalg import eig


def axial_flow_roots(
    speed: float,
    share: float,
    *,
    cantilever: bool = False,
    tension: Callable[[NDArray[np.float64]], NDArray[np.float64]] = np.zeros_like,
    viscous: float = 0.0,
    taper: float = 0.0,
    terms: int = 36,
) -> NDArray[np.complex128]:
    """λ with Im λ ≥ 0 by ascending magnitude, `speed` U √(M/EI) and `share` M/(m + M)."""
    velocity = speed / np.sqrt(share)
    places = 0.5 * (1.0 - np.cos(np.pi * (np.arange(terms - 4) + 0.5) / (terms - 4)))

    def rows(x: NDArray[np.float64], order: int) -> NDArray[np.float64]:
        columns = [chebyshev.chebval(2.0 * x - 1.0, chebyshev.chebder(unit, order)) for unit in np.eye(terms)]
        return 2.0**order * np.column_stack(columns)

    one = np.ones(1)
    axial = (tension(places) - share * velocity**2)[:, None]
    stiffness = rows(places, 4) - axial * rows(places, 2) + viscous * velocity * rows(places, 1)
    damping = 2.0 * share * velocity * rows(places, 1) + viscous * rows(places, 0)
    ends = [rows(0.0 * one, 0), rows(0.0 * one, 1 if cantilever else 2), rows(one, 2)]
    if cantilever:
        thrust = taper * share * velocity
        ends.append(rows(one, 3) + thrust * velocity * rows(one, 1))
        end_damping = thrust * rows(one, 0)
    else:
        ends.append(rows(one, 0))
        end_damping = np.zeros((1, terms))
    k = np.vstack([stiffness, *ends])
    c = np.vstack([damping, np.zeros((3, terms)), end_damping])
    m = np.vstack([rows(places, 0), np.zeros((4, terms))])
    zero, unit = np.zeros((terms, terms)), np.eye(terms)
    # 1/λ of (K + λC + λ²M) w = 0, for M is singular.
    inverse, _ = eig(np.block([[zero, unit], [-m, -c]]), np.block([[unit, zero], [zero, k]]))
    roots = 1.0 / inverse[np.abs(inverse) > 1e-6]
    roots = roots[roots.imag >= -1e-9 * np.abs(roots)]
    return np.asarray(roots[np.argsort(np.abs(roots))])
