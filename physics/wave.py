"""Trains of waves of different periods and slopes."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import numpy.typing as npt

from hydroelastic.physics.arrays import FloatArray


@dataclass(frozen=True, kw_only=True, eq=False)
class WaveTrain:
    """Waves that pass the ship one after another, the first from t = 0; each is one whole sine of the wave slope.

    Raises:
        ValueError: on construction, if the shapes differ, a period is not finite and positive, or a slope not finite.
    """

    periods: FloatArray  # T_i, s, shape (waves,); there may be none
    slopes: FloatArray  # a_i, largest slope of each wave, rad, shape (waves,), of either sign

    def __post_init__(self) -> None:
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
        # Extended precision: rounding of ten thousand sums would shift the late waves.
        ends = np.cumsum(self.periods, dtype=np.longdouble).astype(float)
        return np.concatenate([[0.0], ends])

    @property
    def frequencies(self) -> FloatArray:
        """ω_i = 2π/T_i, rad/s, shape (waves,)."""
        return 2 * np.pi / self.periods

    def slope(self, times: npt.ArrayLike) -> FloatArray:
        """Return the wave slope a_i sin ω_i(t − t_{i−1}), rad, in the shape of the times; 0 before and after."""
        times = np.asarray(times, float)
        number, local = self.locate(times)
        frequency, slope = np.append(self.frequencies, 0.0)[number], np.append(self.slopes, 0.0)[number]
        return np.where(times >= 0, slope * np.sin(frequency * local), 0.0)

    def locate(self, times: npt.ArrayLike) -> tuple[npt.NDArray[np.intp], FloatArray]:
        """Return in which wave times lie and the time since it began, s, both in the shape of the times.

        Waves are counted from 0; the free motion after the last one counts as one more.
        """
        times, starts = np.asarray(times, float), self.starts
        number = np.maximum(np.searchsorted(starts, times, side="right") - 1, 0)
        return number, times - starts[number]
