"""Roll with quadratic damping on a train of waves, by integration in time."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
import numpy.typing as npt
from scipy.integrate import OdeSolution, solve_ivp

from hydroelastic.modal.roll.knots import roll_knots
from hydroelastic.modal.roll.motion import RollMotion
from hydroelastic.physics.arrays import FloatArray
from hydroelastic.physics.ship import Ship
from hydroelastic.physics.wave import WaveTrain

LEAST_TOLERANCE = 1e-11
"""Of `quadratic_roll_path`: the finer steps then come near to what SciPy allows."""

# Tolerances of a step. SciPy allows none below 100 roundings.
_FIRST_STEPS, _REFINEMENT, _LEAST_STEPS = 0.3, 0.1, 2.3e-14
# Longest steps. A method of order 8 takes steps of about five times the root of its tolerance, over the frequency. For
# a decay it is stable up to 6, but loses digits between its steps.
_LONGEST_STEP, _LONGEST_DECAY = 6.0, 3.0
_COMPARED_PER_PERIOD = 16


class RollIntegrationError(ValueError):
    """The integration in time does not reach its tolerance, or its end."""


@dataclass(frozen=True, kw_only=True, eq=False)
class QuadraticRollPath:
    """The whole motion of a ship with quadratic damping."""

    ship: Ship
    train: WaveTrain  # the waves
    end: float  # last time, s
    solutions: tuple[OdeSolution, ...]  # φ and φ' as functions of the time since each wave began, the free motion last
    # largest absolute error of the angle, rad: estimated as the largest difference from a motion of ten times the
    # tolerance, and therefore too large
    angle_error: float
    rate_error: float  # that of the rate, rad/s

    def motion(self, times: npt.ArrayLike) -> RollMotion:
        """Return angle, rate and acceleration.

        Args:
            times: t, s, in any order and of any shape, up to ``end``.
        """
        times = np.array(times, dtype=float)
        wrong = ~np.isfinite(times) | (times > self.end)
        if wrong.any():
            raise ValueError(f"times contain {times[wrong][0]}; they must be finite and at most {self.end}")
        angle, rate = _evaluate(self.solutions, self.train, times)
        k, n = self.ship.natural_frequency, self.ship.damping
        acceleration = (
            k**2 * (self.train.slope(times) - angle) - 2 * n * rate - self.ship.quadratic_damping * np.abs(rate) * rate
        )
        return RollMotion(times=times, angle=angle, rate=rate, acceleration=acceleration)


def quadratic_roll_path(
    ship: Ship,
    train: WaveTrain,
    end: float,
    angle: float = 0.0,
    rate: float = 0.0,
    tolerance: float = 1e-9,
) -> QuadraticRollPath:
    """Return the motion φ'' + 2nφ' + d|φ'|φ' + k²φ = k² a_i sin ω_i(t − t_{i−1}), by DOP853.

    The integration begins anew with each wave, and wherever φ' changes its sign: it meets smooth functions only. Steps
    are refined until two motions agree.

    Args:
        train: the waves; the motion after them is free.
        end: last time, s.
        angle: φ at t = 0, rad.
        rate: φ' at t = 0, rad/s.
        tolerance: largest error of the angle, relative to the largest angle, from `LEAST_TOLERANCE` to 0.01.
    """
    for name, value in (("angle", angle), ("rate", rate)):
        if not math.isfinite(value):
            raise ValueError(f"{name} is {value}; it must be finite")
    if not 0 < end < math.inf:
        raise ValueError(f"end is {end}; it must be finite and positive")
    if not LEAST_TOLERANCE <= tolerance <= 0.01:
        raise ValueError(f"tolerance is {tolerance}; it must lie between {LEAST_TOLERANCE:g} and 0.01")

    compared = roll_knots(ship, train, 0.0, end, _COMPARED_PER_PERIOD)
    steps = _FIRST_STEPS * tolerance
    coarse = _integrate(ship, train, end, (angle, rate), steps)
    before = _evaluate(coarse, train, compared)
    while True:
        steps *= _REFINEMENT
        solutions = _integrate(ship, train, end, (angle, rate), steps)
        after = _evaluate(solutions, train, compared)
        angle_error, rate_error = np.abs(after - before).max(axis=1)
        largest = np.abs(after[0]).max()
        if angle_error <= tolerance * largest:
            break
        if steps * _REFINEMENT < _LEAST_STEPS:
            raise RollIntegrationError(
                f"tolerance is {tolerance:g}; up to {end:g} s no better than {angle_error / largest:.1g} is reached"
            )
        before = after
    return QuadraticRollPath(
        ship=ship,
        train=train,
        end=end,
        solutions=solutions,
        angle_error=float(angle_error),
        rate_error=float(rate_error),
    )


def _integrate(
    ship: Ship,
    train: WaveTrain,
    end: float,
    state: tuple[float, float],
    tolerance: float,
) -> tuple[OdeSolution, ...]:
    starts = train.starts
    begun = int(np.searchsorted(starts, end))
    durations = np.minimum(np.append(starts[1:], np.inf), end)[:begun] - starts[:begun]
    largest = max(float(np.abs(train.slopes).max(initial=0.0)), abs(state[0]), abs(state[1]) / ship.natural_frequency)
    # A ship that nothing moves has no scale of its own.
    scale = tolerance * (largest or 1.0)
    solutions = []
    for duration, frequency, slope in zip(
        durations, np.append(train.frequencies, 0.0), np.append(train.slopes, 0.0), strict=False
    ):
        stage = _Stage(ship, float(frequency), float(slope), tolerance)
        solution, state = stage.solve(state, float(duration), (scale, scale * ship.natural_frequency))
        solutions.append(solution)
    return tuple(solutions)


class _Stage:
    def __init__(self, ship: Ship, frequency: float, slope: float, tolerance: float) -> None:
        self.stiffness, self.linear = ship.natural_frequency**2, 2 * ship.damping
        self.quadratic, self.frequency, self.slope = ship.quadratic_damping, frequency, slope
        self.tolerance = tolerance
        # The method enlarges its steps tenfold at the start of a piece, where its own estimate of the error vanishes.
        self.longest_step = _LONGEST_STEP * tolerance ** (1 / 8) / max(frequency, ship.natural_frequency)
        if ship.damping:
            self.longest_step = min(self.longest_step, _LONGEST_DECAY / ship.fastest_decay)

    def right_side(self, sign: float) -> Callable[[float, Any], tuple[float, float]]:
        """φ' and φ'', with |φ'|φ' continued smoothly from φ' of this sign; as it is if the sign is 0."""

        def derivatives(time: float, state: Any) -> tuple[float, float]:
            angle, rate = float(state[0]), float(state[1])
            damping = self.linear + self.quadratic * (sign * rate if sign else abs(rate))
            torque = self.slope * math.sin(self.frequency * time)
            return rate, self.stiffness * (torque - angle) - damping * rate

        return derivatives

    def sign(self, time: float, state: tuple[float, float]) -> float:
        """Return the sign of φ' just after a time: its own, or that of φ''; where both are 0 it may be either."""
        _, acceleration = self.right_side(0.0)(time, state)
        return math.copysign(1.0, state[1] or acceleration)

    def solve(
        self, state: tuple[float, float], duration: float, absolute: tuple[float, float]
    ) -> tuple[OdeSolution, tuple[float, float]]:
        """Return φ and φ' as a function of the time, and their last values."""

        def piece(start: float, sign: float) -> Any:
            def turn(_: float, state: Any) -> float:
                return float(state[1])

            turn.terminal = True  # type: ignore[attr-defined]
            turn.direction = -sign  # type: ignore[attr-defined]
            return solve_ivp(
                self.right_side(sign),
                (start, duration),
                state,
                method="DOP853",
                rtol=self.tolerance,
                atol=absolute,
                max_step=self.longest_step,
                dense_output=True,
                events=turn if sign and self.quadratic else None,
            )

        times, interpolants = [0.0], []
        while times[-1] < duration:
            sign = self.sign(times[-1], state)
            # Where the rate begins at 0, or almost only touches it, it may have the other sign; or none, as |φ'|φ' is.
            for tried in (sign, -sign, 0.0):
                result = piece(times[-1], tried)
                if result.t[-1] > times[-1]:
                    break
            if not result.success:
                raise RollIntegrationError(f"the integration stops {result.t[-1]:g} s into a wave: {result.message}")
            turned = result.status == 1
            state = (float(result.y[0, -1]), 0.0 if turned else float(result.y[1, -1]))
            times.extend(result.t[1:].tolist())
            interpolants.extend(result.sol.interpolants)
        return OdeSolution(np.array(times), interpolants), state


def _evaluate(solutions: tuple[OdeSolution, ...], train: WaveTrain, times: FloatArray) -> FloatArray:
    """Return φ and φ', shape (2, *times)."""
    state = np.zeros((2, times.size))
    flat = times.ravel()
    # The end of the motion may be the beginning of a wave that is not integrated.
    number = np.minimum(train.locate(flat)[0], len(solutions) - 1)
    number[flat < 0] = -1
    order = np.argsort(number, kind="stable")
    waves, firsts = np.unique(number[order], return_index=True)
    for wave, places in zip(waves, np.split(order, firsts[1:]), strict=False):
        if wave >= 0:
            state[:, places] = solutions[wave](flat[places] - train.starts[wave])
    return state.reshape(2, *times.shape)
