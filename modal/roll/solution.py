"""Roll of a ship on a train of waves with its extremes and errors, as plain values."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from hydroelastic.modal.roll.knots import RollPath, roll_knots
from hydroelastic.modal.roll.motion import RollMotion, roll_path
from hydroelastic.modal.roll.quadratic import QuadraticRollPath, quadratic_roll_path
from hydroelastic.modal.roll.statistics import RollStatistics, roll_statistics
from hydroelastic.physics.arrays import FloatArray
from hydroelastic.physics.ship import Ship
from hydroelastic.physics.wave import WaveTrain

# Roundings in the closed form, of the largest angle; and those of the phase kt besides.
_ROUNDINGS = 20.0
_COMPARED_PER_PERIOD = 16


@dataclass(frozen=True, kw_only=True)
class RollSolution:
    """The motion of a ship on a train of waves."""

    ship: Ship
    train: WaveTrain  # the waves
    motion: RollMotion  # angle, rate and acceleration at the times asked
    statistics: RollStatistics  # extremes from t = 0 to the last of these times
    angle_error: float  # estimated largest absolute error of the angle, rad, of the integration or by rounding
    ship_error: float  # what an error of the ship's natural frequency and damping adds to it, rad

    @property
    def relative_error(self) -> float:
        """Estimated error of the angle, over the largest angle; 0 where nothing rolls."""
        largest = abs(self.statistics.largest_angle)
        return (self.angle_error + self.ship_error) / largest if largest else 0.0


def roll_solution(
    ship: Ship,
    train: WaveTrain,
    times: FloatArray,
    *,
    angle: float = 0.0,
    rate: float = 0.0,
    tolerance: float = 1e-8,
    relative_ship_error: float | None = None,
) -> RollSolution:
    """Return the motion of a ship: in closed form, or with quadratic damping by integration in time.

    Args:
        train: the waves; the motion after them is free.
        times: t, s, from 0, ascending, shape (times,).
        angle: φ at t = 0, rad.
        rate: φ' at t = 0, rad/s.
        tolerance: of an integration, relative to the largest angle.
        relative_ship_error: error of k, and of n relative to k; ``None`` if they are exact.
    """
    end = float(times[-1])
    path: RollPath
    if ship.quadratic_damping:
        path = quadratic_roll_path(ship, train, end, angle=angle, rate=rate, tolerance=min(tolerance, 0.01))
    else:
        path = roll_path(ship, train, angle, rate)
    motion = path.motion(times)
    statistics = roll_statistics(path, end)
    ship_error = 0.0
    if relative_ship_error is not None:
        ship_error = _error_of_ship(ship, train, end, (angle, rate), relative_ship_error)
    return RollSolution(
        ship=ship,
        train=train,
        motion=motion,
        statistics=statistics,
        angle_error=_error_of(path, end, abs(statistics.largest_angle)),
        ship_error=ship_error,
    )


def _error_of(path: RollPath, end: float, largest: float) -> float:
    """Return the largest error of the angle, rad: of the integration, or by rounding."""
    if isinstance(path, QuadraticRollPath):
        return path.angle_error
    return (_ROUNDINGS + path.ship.natural_frequency * end) * float(np.finfo(float).eps) * largest


def _error_of_ship(ship: Ship, train: WaveTrain, end: float, state: tuple[float, float], change: float) -> float:
    """Return what relative errors of k, and of n relative to k, do to the angle, to first order, rad.

    Quadratic damping, which would only lessen it, is left out.
    """
    linear = replace(ship, quadratic_damping=0.0)
    changed = (
        replace(linear, natural_frequency=ship.natural_frequency * (1.0 + change)),
        replace(linear, damping=ship.damping + change * ship.natural_frequency),
    )
    times = roll_knots(ship, train, 0.0, end, _COMPARED_PER_PERIOD)
    angle, *angles = (roll_path(each, train, *state).motion(times).angle for each in (linear, *changed))
    return sum(float(np.abs(other - angle).max()) for other in angles)
