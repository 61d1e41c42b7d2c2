"""Roll of a ship with linear damping on a train of waves, in closed form."""

from __future__ import annotations

import cmath
import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt
from numpy.typing import ArrayLike, NDArray

from hydroelastic.modal.damped_pair import damped_pair
from hydroelastic.physics.arrays import FloatArray
from hydroelastic.physics.ship import Ship
from hydroelastic.physics.wave import WaveTrain


@dataclass(frozen=True, kw_only=True, eq=False)
class RollMotion:
    """Motion at given times, all in the shape of the times."""

    times: FloatArray  # t, s
    angle: FloatArray  # φ, rad; 0 before t = 0, and so are rate and acceleration
    rate: FloatArray  # φ', rad/s
    acceleration: FloatArray  # φ'', rad/s²


@dataclass(frozen=True, kw_only=True, eq=False)
class LinearRollPath:
    """The whole motion of a ship on a train in closed form: its state at the beginning of each wave."""

    ship: Ship
    train: WaveTrain  # the waves
    # φ and φ' at ``train.starts``, shape (waves + 1, 2): before each wave, and before the free motion
    states: FloatArray

    def motion(self, times: npt.ArrayLike) -> RollMotion:
        """Return angle, rate and acceleration; in wave i, with τ = t − t_{i−1} and C, S of `damped_pair`,

            φ  = φ_{i−1}(C + nS) + φ'_{i−1} S + a_i ψ(τ),    φ' = φ'_{i−1}(C − nS) − φ_{i−1} k²S + a_i ψ'(τ).

        Args:
            times: t, s, in any order and of any shape.
        """
        times = np.array(times, dtype=float)
        if not np.isfinite(times).all():
            raise ValueError(f"times contain {times[~np.isfinite(times)][0]}; they must be finite")
        angle, rate = np.zeros(times.shape), np.zeros(times.shape)
        began = times >= 0
        angle[began], rate[began] = self._angle_and_rate(times[began])
        return RollMotion(times=times, angle=angle, rate=rate, acceleration=self._acceleration(times, angle, rate))

    def _angle_and_rate(self, times: FloatArray) -> tuple[FloatArray, FloatArray]:
        number, local = self.train.locate(times)
        first, second = _free_motion(self.ship, local)
        before, before_rate = self.states[number].T
        angle = before * first[0] + before_rate * second[0]
        rate = before * first[1] + before_rate * second[1]
        within = number < len(self.train.periods)
        number, local = number[within], local[within]
        frequency, slope = self.train.frequencies[number], self.train.slopes[number]
        response = response_from_rest(self.ship.natural_frequency, self.ship.damping, frequency, local)
        angle[within] += slope * response.imag
        rate[within] += slope * frequency * response.real
        return angle, rate

    def _acceleration(self, times: FloatArray, angle: FloatArray, rate: FloatArray) -> FloatArray:
        return self.ship.natural_frequency**2 * (self.train.slope(times) - angle) - 2 * self.ship.damping * rate


def roll_path(ship: Ship, train: WaveTrain, angle: float = 0.0, rate: float = 0.0) -> LinearRollPath:
    """Return the motion φ'' + 2nφ' + k²φ = k² a_i sin ω_i(t − t_{i−1}) as a whole, from wave to wave.

    Args:
        ship: the ship, with any linear damping.
        train: the waves; the motion after them is free.
        angle: φ at t = 0, rad.
        rate: φ' at t = 0, rad/s.
    """
    for name, value in (("angle", angle), ("rate", rate)):
        if not math.isfinite(value):
            raise ValueError(f"{name} is {value}; it must be finite")
    if ship.quadratic_damping:
        raise ValueError(f"quadratic_damping is {ship.quadratic_damping}; the closed form is that of linear damping")
    free = np.moveaxis(np.array(_free_motion(ship, train.periods)), 0, 2)
    response = response_from_rest(ship.natural_frequency, ship.damping, train.frequencies, train.periods)
    forced = np.stack([response.imag, train.frequencies * response.real]) * train.slopes
    states = np.empty((len(train.periods) + 1, 2))
    states[0] = angle, rate
    for wave in range(len(train.periods)):
        states[wave + 1] = free[:, wave] @ states[wave] + forced[:, wave]
    return LinearRollPath(ship=ship, train=train, states=states)


def roll_response(
    ship: Ship, train: WaveTrain, times: npt.ArrayLike, angle: float = 0.0, rate: float = 0.0
) -> RollMotion:
    """Return the motion of a ship on a train of waves, φ'' + 2nφ' + k²φ = k² a_i sin ω_i(t − t_{i−1}), in closed form.

    Every damping, resonance and wave of any period are one formula, `response_from_rest`. Errors are a few roundings
    of the largest angle so far, and of the phase kt in a long free motion.

    Args:
        train: the waves; the motion after them is free.
        times: t, s, in any order and of any shape.
        angle: φ at t = 0, rad.
        rate: φ' at t = 0, rad/s.
    """
    return roll_path(ship, train, angle, rate).motion(times)


def _free_motion(ship: Ship, times: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return angle and rate of the free motions from a unit angle and from a unit rate, each of shape (2, times)."""
    k, n = ship.natural_frequency, ship.damping
    pair = damped_pair(k, n, times)
    cosine, sine = pair[0][0], pair[1][0]
    return np.stack([cosine + n * sine, -(k**2) * sine]), np.stack([sine, cosine - n * sine])


def response_from_rest(
    natural_frequency: float, damping: float, frequencies: ArrayLike, times: ArrayLike
) -> NDArray[np.complex128]:
    """Return y(t) of y'' + 2ny' + k²y = k² e^{iωt} from rest: Im y answers k² sin ωt, and its rate is ω Re y.

    y is k² times the divided difference of e^{zt} at iω and at the roots z₁, z₂ of z² + 2nz + k²,

        y = k² (E − S)/(iω − z₂),    E = (e^{z₁t} − e^{iωt})/(z₁ − iω),    S = (e^{z₁t} − e^{z₂t})/(z₁ − z₂).

    The amplitude k²/(k² − ω² + 2inω) of the steady motion does not occur, which is infinite in resonance without
    damping and takes all digits near it. z₁ is the root next to iω, so that iω − z₂ is not small; beyond critical
    damping it may be either. E goes by expm1, and S is regular at critical damping.

    Args:
        natural_frequency: k, rad/s.
        damping: n, 1/s, from 0.
        frequencies: ω, rad/s, shape (times,).
        times: t, s, from 0, shape (times,). Beyond a few periods of the wave the phase ωt loses digits.

    Returns:
        y, shape (times,).
    """
    frequencies, times = np.asarray(frequencies, float), np.asarray(times, float)
    k, n = natural_frequency, damping
    root = cmath.sqrt((k - n) * (k + n))
    if n < k:
        near, far = -n + 1j * root.real, -n - 1j * root.real
    else:
        near, far = complex(-(k**2) / (n + root.imag)), complex(-(n + root.imag))
    apart = near - 1j * frequencies
    # Where both coincide E is t e^{iωt}.
    exponent = apart * times
    small = np.abs(exponent) < np.finfo(float).tiny
    ratio = np.where(small, 1.0, np.expm1(exponent) / np.where(small, 1.0, exponent))
    forced = times * np.exp(1j * frequencies * times) * ratio
    second = damped_pair(k, n, times)[1][0]
    return k**2 * (forced - second) / (1j * frequencies - far)
