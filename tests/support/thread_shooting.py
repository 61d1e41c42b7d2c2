"""Threads between two fixed ends by shooting: SciPy only, no code of the package but the profile of the stream."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike
from scipy.integrate import solve_ivp
from scipy.optimize import root

from hydroelastic.physics.thread_load import ThreadLoad


@dataclass(frozen=True)
class ShotThread:
    """A thread that was found by shooting.

    Attributes:
        states: r and N, shape (6, n), of places s, shape (n,).
        miss: distance of its end from B, of the length.
    """

    states: Any
    miss: float

    def positions(self, s: ArrayLike) -> np.ndarray:
        """Return r, m, shape (n, 3)."""
        return np.asarray(self.states(np.asarray(s, dtype=float)))[:3].T

    def forces(self, s: ArrayLike) -> np.ndarray:
        """Return N, N, shape (n, 3)."""
        return np.asarray(self.states(np.asarray(s, dtype=float)))[3:].T


def shoot(
    load: ThreadLoad,
    length: float,
    a: ArrayLike,
    b: ArrayLike,
    axial_rigidity: float = math.inf,
    guess: ArrayLike = (0.0, 0.0, 1.0),
) -> ShotThread:
    """Return the thread between A and B, from a guess of N(0), by DOP853 with a tolerance of 1e-13."""
    begin, end, first = (np.asarray(vector, dtype=float) for vector in (a, b, guess))
    force = float(np.linalg.norm(first))

    def slope(_: float, y: np.ndarray) -> np.ndarray:
        tension = np.linalg.norm(y[3:])
        tangent = y[3:] / tension
        stream = np.zeros(3) if load.stream is None else load.stream.profile(y[2:3])[0]
        along = stream @ tangent
        across = stream - along * tangent
        drag = load.normal_drag * np.linalg.norm(across) * across + load.viscous_drag * across
        drag += load.tangential_drag * abs(along) * along * tangent
        return np.concatenate([tangent * (1 + tension / axial_rigidity), [0, 0, load.weight] - drag])

    def shot(unknown: np.ndarray, dense: bool = False) -> Any:
        start = np.concatenate([begin, force * unknown])
        allowed = 1e-13 * np.repeat([length, force], 3)
        return solve_ivp(slope, (0, length), start, "DOP853", rtol=1e-13, atol=allowed, dense_output=dense)

    def miss(unknown: np.ndarray) -> np.ndarray:
        return np.asarray((shot(unknown).y[:3, -1] - end) / length)

    # A difference step of 1e-6 stands far above the noise of the integrator.
    found = root(miss, first / force, options={"xtol": 1e-13, "eps": 1e-12})
    return ShotThread(states=shot(found.x, dense=True).sol, miss=float(np.linalg.norm(miss(found.x))))
