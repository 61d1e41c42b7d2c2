"""Roll of a ship on a train of waves, in closed form: what is given, and the motion at any time."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from hydroelastic.modal.damped_pair import damped_pair
from hydroelastic.modal.roll.wave import response_from_rest
from hydroelastic.physics.arrays import FloatArray


@dataclass(frozen=True)
class Roll:
    """A ship that rolls freely by φ'' + 2nφ' + k²φ = 0.

    Attributes:
        natural_frequency: k, rad/s, without damping.
        damping: n, 1/s, from 0; critical where n = k.

    Raises:
        ValueError: on construction, if k is not finite and positive, or n not finite and from 0.
    """

    natural_frequency: float
    damping: float = 0.0

    def __post_init__(self) -> None:
        """Refuse what no ship can have."""
        if not (math.isfinite(self.natural_frequency) and self.natural_frequency > 0):
            raise ValueError(f"natural_frequency is {self.natural_frequency}; it must be finite and positive")
        if not (math.isfinite(self.damping) and self.damping >= 0):
            raise ValueError(f"damping is {self.damping}; it must be finite, and 0 or more")

    @property
    def damped_frequency(self) -> float:
        """√(k² − n²) of the free motion, rad/s; 0 from critical damping on."""
        k, n = self.natural_frequency, self.damping
        return math.sqrt(max((k - n) * (k + n), 0.0))

    @property
    def fastest_decay(self) -> float:
        """Rate at which the faster of the free motions decays, n or n + √(n² − k²), 1/s."""
        k, n = self.natural_frequency, self.damping
        return n + math.sqrt(max((n - k) * (n + k), 0.0))


@dataclass(frozen=True, eq=False)
class WaveTrain:
    """Waves that pass the ship one after another, the first from t = 0; each is one whole sine of the wave slope.

    Attributes:
        periods: T_i, s, shape (waves,); there may be none.
        slopes: a_i, largest slope of each wave, rad, shape (waves,), of either sign.

    Raises:
        ValueError: on construction, if the shapes differ, a period is not finite and positive, or a slope not finite.
    """

    periods: FloatArray
    slopes: FloatArray

    def __post_init__(self) -> None:
        """Take any sequences of numbers; refuse what are no waves."""
        for name in ("periods", "slopes"):
            values = np.array(getattr(self, name), dtype=float)
            values.setflags(write=False)
            object.__setattr__(self, name, values)
        if self.periods.ndim != 1 or self.periods.shape != self.slopes.shape:
            raise ValueError(
                f"periods have shape {self.periods.shape} and slopes {self.slopes.shape}; they must be two lists of "
                "one length"
            )
        bad = ~(np.isfinite(self.periods) & (self.periods > 0))
        if bad.any():
            raise ValueError(
                f"periods[{bad.argmax()}] is {self.periods[bad.argmax()]}; periods must be finite and positive"
            )
        bad = ~np.isfinite(self.slopes)
        if bad.any():
            raise ValueError(f"slopes[{bad.argmax()}] is {self.slopes[bad.argmax()]}; slopes must be finite")

    @property
    def starts(self) -> FloatArray:
        """Times t_{i−1} at which the waves begin, and that at which the last one ends, s, shape (waves + 1,)."""
        # In extended precision: ten thousand rounded sums would move the late waves.
        ends = np.cumsum(self.periods, dtype=np.longdouble).astype(float)
        return np.concatenate([[0.0], ends])

    @property
    def frequencies(self) -> FloatArray:
        """ω_i = 2π/T_i, rad/s, shape (waves,)."""
        return 2 * np.pi / self.periods

    def slope(self, times: npt.ArrayLike) -> FloatArray:
        """Return the wave slope a_i sin ω_i(t − t_{i−1}), rad, in the shape of the times; 0 before and after."""
        times = np.asarray(times, float)
        number, local = locate(self.starts, times)
        frequency, slope = np.append(self.frequencies, 0.0)[number], np.append(self.slopes, 0.0)[number]
        return np.where(times >= 0, slope * np.sin(frequency * local), 0.0)


@dataclass(frozen=True, kw_only=True, eq=False)
class RollMotion:
    """Motion at given times, all in the shape of the times.

    Attributes:
        times: t, s.
        angle: φ, rad; 0 before t = 0, and so are rate and acceleration.
        rate: φ', rad/s.
        acceleration: φ'', rad/s².
    """

    times: FloatArray
    angle: FloatArray
    rate: FloatArray
    acceleration: FloatArray


@dataclass(frozen=True, kw_only=True, eq=False)
class LinearRollPath:
    """The whole motion of a ship on a train in closed form: its state at the beginning of each wave.

    Attributes:
        roll: the ship.
        train: the waves.
        states: φ and φ' at ``train.starts``, shape (waves + 1, 2): before each wave, and before the free motion.
    """

    roll: Roll
    train: WaveTrain
    states: FloatArray

    def motion(self, times: npt.ArrayLike) -> RollMotion:
        """Return angle, rate and acceleration; in wave i, with τ = t − t_{i−1} and C, S of `damped_pair`,

            φ  = φ_{i−1}(C + nS) + φ'_{i−1} S + a_i ψ(τ),    φ' = φ'_{i−1}(C − nS) − φ_{i−1} k²S + a_i ψ'(τ).

        Args:
            times: t, s, in any order and of any shape.

        Raises:
            ValueError: if a time is not finite.
        """
        times = np.array(times, dtype=float)
        if not np.isfinite(times).all():
            raise ValueError(f"times contain {times[~np.isfinite(times)][0]}; they must be finite")
        angle, rate = np.zeros(times.shape), np.zeros(times.shape)
        began = times >= 0
        angle[began], rate[began] = self._angle_and_rate(times[began])
        return RollMotion(times=times, angle=angle, rate=rate, acceleration=self._acceleration(times, angle, rate))

    def _angle_and_rate(self, times: FloatArray) -> tuple[FloatArray, FloatArray]:
        number, local = locate(self.train.starts, times)
        first, second = _free_motion(self.roll, local)
        before, before_rate = self.states[number].T
        angle = before * first[0] + before_rate * second[0]
        rate = before * first[1] + before_rate * second[1]
        within = number < len(self.train.periods)
        number, local = number[within], local[within]
        frequency, slope = self.train.frequencies[number], self.train.slopes[number]
        response = response_from_rest(self.roll.natural_frequency, self.roll.damping, frequency, local)
        angle[within] += slope * response.imag
        rate[within] += slope * frequency * response.real
        return angle, rate

    def _acceleration(self, times: FloatArray, angle: FloatArray, rate: FloatArray) -> FloatArray:
        return self.roll.natural_frequency**2 * (self.train.slope(times) - angle) - 2 * self.roll.damping * rate


def roll_path(roll: Roll, train: WaveTrain, angle: float = 0.0, rate: float = 0.0) -> LinearRollPath:
    """Return the motion φ'' + 2nφ' + k²φ = k² a_i sin ω_i(t − t_{i−1}) as a whole, from wave to wave.

    Args:
        roll: the ship, with any damping.
        train: the waves; the motion after them is free.
        angle: φ at t = 0, rad.
        rate: φ' at t = 0, rad/s.

    Raises:
        ValueError: if the angle or the rate is not finite.
    """
    for name, value in (("angle", angle), ("rate", rate)):
        if not math.isfinite(value):
            raise ValueError(f"{name} is {value}; it must be finite")
    free = np.moveaxis(np.array(_free_motion(roll, train.periods)), 0, 2)
    response = response_from_rest(roll.natural_frequency, roll.damping, train.frequencies, train.periods)
    forced = np.stack([response.imag, train.frequencies * response.real]) * train.slopes
    states = np.empty((len(train.periods) + 1, 2))
    states[0] = angle, rate
    for wave in range(len(train.periods)):
        states[wave + 1] = free[:, wave] @ states[wave] + forced[:, wave]
    return LinearRollPath(roll=roll, train=train, states=states)


def roll_response(
    roll: Roll, train: WaveTrain, times: npt.ArrayLike, angle: float = 0.0, rate: float = 0.0
) -> RollMotion:
    """Return the motion of a ship on a train of waves, φ'' + 2nφ' + k²φ = k² a_i sin ω_i(t − t_{i−1}), in closed form.

    Every damping, resonance and wave of any period are one formula, `response_from_rest`. Errors are a few roundings
    of the largest angle so far, and of the phase kt in a long free motion.

    Args:
        roll: the ship.
        train: the waves; the motion after them is free.
        times: t, s, in any order and of any shape.
        angle: φ at t = 0, rad.
        rate: φ' at t = 0, rad/s.

    Raises:
        ValueError: if a time, the angle or the rate is not finite.
    """
    return roll_path(roll, train, angle, rate).motion(times)


def locate(starts: FloatArray, times: FloatArray) -> tuple[npt.NDArray[np.intp], FloatArray]:
    """Return at which wave each time lies, from 0, the free motion being the last one, and the time since it began."""
    number = np.maximum(np.searchsorted(starts, times, side="right") - 1, 0)
    return number, times - starts[number]


def _free_motion(roll: Roll, times: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return angle and rate of the free motions from a unit angle and from a unit rate, each of shape (2, times)."""
    k, n = roll.natural_frequency, roll.damping
    pair = damped_pair(k, n, times)
    cosine, sine = pair[0][0], pair[1][0]
    return np.stack([cosine + n * sine, -(k**2) * sine]), np.stack([sine, cosine - n * sine])
