"""Trains of waves, and a way to their motion that shares nothing with the closed form."""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import numpy as np
import numpy.typing as npt
from scipy.integrate import solve_ivp
from scipy.linalg import expm

from hydroelastic.physics.ship import Ship
from hydroelastic.physics.wave import WaveTrain

K = math.pi / 6
TRAIN = WaveTrain(periods=[8.2, 7.7, 7.5, 8.5, 7.7], slopes=[0.03, -0.05, 0.045, 0.06, 0.02])
PRINTED = WaveTrain(periods=TRAIN.periods, slopes=np.ones(5))

_REFERENCE = json.loads((Path(__file__).parents[1] / "reference" / "string_and_roll.json").read_text(encoding="utf-8"))
SHIPS: dict[str, Any] = {case["id"]: case for case in _REFERENCE["cases"] if case["paper"] == "004"}


def reference_ship(name: str) -> tuple[Ship, WaveTrain, float]:
    """Return ship, waves and time of a reference case."""
    inputs = SHIPS[name]["inputs"]
    train = WaveTrain(
        periods=[float(period) for period in inputs["T"]], slopes=[float(slope) for slope in inputs["slope"]]
    )
    return Ship(natural_frequency=float(inputs["k"]), damping=float(inputs["n"])), train, float(inputs["t"])


def exponential_motion(
    roll: Ship, train: WaveTrain, times: npt.ArrayLike, angle: float = 0.0, rate: float = 0.0
) -> npt.NDArray[np.float64]:
    """Return φ and φ' at times from 0, shape (2, times), by exponentials of the matrix of (φ, φ', sin ωτ, cos ωτ)."""
    times = np.atleast_1d(np.asarray(times, float))
    result = np.empty((2, len(times)))
    state = np.array([angle, rate, 0.0, 1.0])
    starts = [0.0, *np.cumsum(train.periods)]
    for start, end, omega, slope in zip(
        starts, [*starts[1:], math.inf], [*train.frequencies, 0.0], [*train.slopes, 0.0], strict=True
    ):
        k, n = roll.natural_frequency, roll.damping
        matrix = np.array([[0, 1, 0, 0], [-(k**2), -2 * n, k**2 * slope, 0], [0, 0, 0, omega], [0, 0, -omega, 0]])
        here = (times >= start) & (times < end)
        result[:, here] = (expm((times[here] - start)[:, None, None] * matrix) @ state)[:, :2].T
        if end < math.inf:
            state = expm((end - start) * matrix) @ state
            state[2:] = 0.0, 1.0
    return result


def free_swings(ship: Ship, amplitude: float, count: int) -> np.ndarray:
    """The first swing |φ| and `count` more, half a cycle each, of φ'' + 2nφ' + d|φ'|φ' + k²φ = 0, in the time kt."""
    linear = 2 * ship.damping / ship.natural_frequency

    def turn(_: float, state: np.ndarray) -> float:
        return float(state[1])

    turn.terminal, turn.direction = True, 1.0  # type: ignore[attr-defined]
    swings = [amplitude]
    for _ in range(count):
        result = solve_ivp(
            lambda _t, y: (y[1], -y[0] - linear * y[1] - ship.quadratic_damping * abs(y[1]) * y[1]),
            (0, 1e3),
            (swings[-1], 0.0),
            method="DOP853",
            rtol=1e-12,
            atol=1e-13 * swings[-1],
            events=turn,
        )
        swings.append(-float(result.y_events[0][0][0]))
    return np.array(swings)
