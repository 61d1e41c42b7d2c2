"""A motion of the upper end smoothed at its breaks, so that field solutions resolve it to many digits.

    f_d = f ∗ φ,    φ(t) = sin(ω₀t)/(πt) e^{−t²/2w²},    w = d/L,  ω₀ = L²/d,  L² = 2D ln 10

A jump of f, or of a derivative, travels along the string as a front that no polynomials resolve. The string is
time-invariant, so that its response to f_d is U ∗ φ. At times farther than d (where φ < 10^{−D}) from the passage of a
front it equals U to about D digits, because U is analytic there, and it contains no frequencies above 2ω₀ beyond the
D-th digit. In the frequency domain this is the window ½ erfc of a series of modes.
"""

from __future__ import annotations

from itertools import pairwise
from math import log, pi, sqrt

import numpy as np
from numpy.polynomial import legendre
from numpy.typing import ArrayLike, NDArray

from hydroelastic.fem.string.end_motion import EndMotion, jumps

# Gauss's rule for panels of so many radians of the kernel.
_POINTS, _WEIGHTS = legendre.leggauss(12)
_PANEL = 6.0


class SmoothedMotion:
    """A motion smoothed at its breaks to a number of digits; it starts before its first break.

    Args:
        motion: f.
        half_width: d, s: f is changed within this time of a break.
        digits: D.

    Attributes:
        half_width: d, s.
        middle: ω₀, 1/s.
        width: w, s.
        highest: 2ω₀, 1/s.
    """

    def __init__(self, motion: EndMotion, half_width: float, digits: float) -> None:
        span = sqrt(2.0 * digits * log(10.0))
        self.half_width = half_width
        self.middle = span**2 / half_width
        self.highest = 2.0 * self.middle
        self.width = half_width / span
        self._motion = motion
        self._centres = np.array([float(time) for time in motion.breaks])
        self._jumps = np.array([jumps(motion, time) for time in self._centres])
        self._starts, self._ends = _merged(self._centres - half_width, self._centres + half_width)
        self._places, self._weights = self._panels()
        # Weighted f, f' and f'' at the nodes, computed when first needed.
        self._samples: dict[int, NDArray[np.float64]] = {}

    def _panels(self) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Return nodes and weights of a quadrature between breaks, within twice the half-width of them."""
        places, weights = [], []
        for low, high in zip(
            *_merged(self._centres - 2.0 * self.half_width, self._centres + 2.0 * self.half_width), strict=True
        ):
            low = max(low, self._centres[0])
            inside = self._centres[(self._centres > low) & (self._centres < high)]
            for start, end in pairwise([low, *inside, high]):
                edges = np.linspace(start, end, 1 + max(1, int(np.ceil(self.middle * (end - start) / _PANEL))))
                half = 0.5 * np.diff(edges)[:, None]
                places.append((edges[:-1, None] + half * (1.0 + _POINTS)).ravel())
                weights.append((half * _WEIGHTS).ravel())
        return np.concatenate(places), np.concatenate(weights)

    @property
    def breaks(self) -> NDArray[np.float64]:
        """Times where the smoothed intervals begin and end, s; jumps there are beyond the D-th digit."""
        return np.sort(np.concatenate([self._starts, self._ends]))

    @property
    def end(self) -> float:
        """The last time at which f is known, s."""
        return self._motion.end

    def value(self, times: ArrayLike) -> NDArray[np.float64]:
        """f_d, m."""
        return self._smoothed(times, 0)

    def slope(self, times: ArrayLike) -> NDArray[np.float64]:
        """f_d', m/s."""
        return self._smoothed(times, 1)

    def curvature(self, times: ArrayLike) -> NDArray[np.float64]:
        """f_d'', m/s²."""
        return self._smoothed(times, 2)

    def _smoothed(self, times: ArrayLike, order: int) -> NDArray[np.float64]:
        shape = np.shape(times)
        flat = np.atleast_1d(np.asarray(times, float)).ravel()
        window = np.searchsorted(self._starts, flat, side="right") - 1
        changed = (window >= 0) & (flat < self._ends[window])
        result = np.zeros(len(flat))
        plain = ~changed & (window >= 0)
        if plain.any():
            result[plain] = self._known(flat[plain], order)
        for place in np.flatnonzero(changed):
            result[place] = self._around(float(flat[place]), order)
        return result.reshape(shape)

    def _around(self, time: float, order: int) -> float:
        """Return the convolution, with the contribution of the jumps to derivatives."""
        if order not in self._samples:
            self._samples[order] = self._weights * self._known(self._places, order)
        # Panels are cut where the kernel is below the D-th digit.
        near = slice(*np.searchsorted(self._places, [time - self.half_width, time + self.half_width]))
        total = float(self._samples[order][near] @ self._kernel(time - self._places[near]))
        if order > 0:
            close = np.abs(time - self._centres) < self.half_width
            distances = time - self._centres[close]
            values, slopes = self._jumps[close].T
            if order == 1:
                total += float(values @ self._kernel(distances))
            else:
                total += float(slopes @ self._kernel(distances) + values @ self._kernel_slope(distances))
        return total

    def _known(self, times: NDArray[np.float64], order: int) -> NDArray[np.float64]:
        """Return f or a derivative; beyond the end of f by its last parabola."""
        motion, end = self._motion, self._motion.end
        known = np.minimum(times, end)
        past = np.maximum(times - end, 0.0)
        if order == 2:
            return np.asarray(motion.curvature(known))
        if order == 1:
            return np.asarray(motion.slope(known) + (past * motion.curvature(known) if past.any() else 0.0))
        value = np.asarray(motion.value(known))
        return value + past * motion.slope(known) + 0.5 * past**2 * motion.curvature(known) if past.any() else value

    def _kernel(self, times: NDArray[np.float64]) -> NDArray[np.float64]:
        decay = np.exp(-0.5 * (times / self.width) ** 2)
        return np.asarray(self.middle / pi * np.sinc(self.middle * times / pi) * decay)

    def _kernel_slope(self, times: NDArray[np.float64]) -> NDArray[np.float64]:
        """φ' = φ (ω₀ cot ω₀t − 1/t − t/w²); the first two are an odd function that starts with −ω₀²t/3."""
        decay = np.exp(-0.5 * (times / self.width) ** 2)
        angle = self.middle * times
        small = np.abs(angle) < 1e-3
        safe = np.where(small, 1.0, angle)
        turn = np.where(small, -angle / 3.0, (np.cos(safe) - np.sin(safe) / safe) / safe)
        return np.asarray(self.middle**2 / pi * turn * decay - times / self.width**2 * self._kernel(times))


def _merged(starts: NDArray[np.float64], ends: NDArray[np.float64]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return intervals of increasing starts and ends, overlapping ones merged."""
    apart = starts[1:] > ends[:-1]
    return starts[np.append(True, apart)], ends[np.append(apart, True)]
