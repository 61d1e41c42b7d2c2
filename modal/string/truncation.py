"""Truncation error of a smoothly cut sum of modes at a point, by its distance from the wave fronts.

Every break of the upper end's motion sends a front down the string, which both ends reflect: the motion is smooth in
(x, t) but for t/R = t_j/R + odd ∓ r. The sum of modes k is cut by weights

    w_k = ½ erfc(√(D ln 10) (2k/N − 1)),

so that the truncation error is the tail from N/2: at the distance d (in units of R) from such a line, with half a term
a of k = N/2 that decays as k^{−p},

    (N/2) a |E_p(iπNd/2)| e^{−(πNd/4)²/(D ln 10)},

which is below 10^{−D} of the motion for N > 3D/d. The exponential integral is bounded by elementary functions here.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray
from scipy.signal import fftconvolve
from scipy.special import erfc

from hydroelastic.modal.string.modes import free_motion_jumps
from hydroelastic.modal.string.quasistatic import Exponential
from hydroelastic.physics.string import HangingString
from hydroelastic.physics.string_forcing import Forcing

DIGITS = 15.0
EDGE = math.sqrt(DIGITS * math.log(10))
# N above this multiple of αR and of R times the frequency of a sine: their modes have weight 1 to 1e-14.
MODES_PER_ANGLE = 8.0
# e^{−45} is below rounding: what has fallen so far needs no modes.
NOTHING_LEFT = 45.0
FEW_STARTS = 8
CELLS_PER_UNIT = 4
MOST_CELLS = 2**21


def weights(modes: NDArray[np.int_], terms: int) -> NDArray[np.float64]:
    """Return w_k of modes k for the sum of N = terms."""
    return np.asarray(erfc(EDGE * (2 * modes / terms - 1)) / 2)


def fewest_terms(
    string: HangingString, parts: Sequence[Exponential], times: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Return the N at each time (s) below which modes that are not yet like those at the tail would be cut.

    These are the modes up to the frequency of a sine and, until they have decayed, those up to Ω = α; later, slow
    aperiodic ones alone, which fall as e^{−Ω²t/2α}.
    """
    travel, damping = string.travel_time, string.damping
    forced = MODES_PER_ANGLE * max((part.argument.real for part in parts), default=0.0)
    damped = np.full(times.shape, MODES_PER_ANGLE * damping * travel)
    late = damping * times > NOTHING_LEFT
    slow = 4 * travel / math.pi * np.sqrt(2 * NOTHING_LEFT * damping / times[late])
    damped[late] = np.minimum(damped[late], slow)
    return np.maximum(forced, damped)


@dataclass(frozen=True, kw_only=True)
class Truncation:
    """Estimates of the truncation error of sums of modes."""

    string: HangingString
    forcing: Forcing  # the motion of the upper end
    parts: Sequence[Exponential]
    ratios: NDArray[np.float64]  # r of the positions, shape (positions,)
    times: NDArray[np.float64]  # s, rising, shape (times,)

    def errors(self, terms: int, rows: NDArray[np.int_], columns: NDArray[np.int_]) -> NDArray[np.float64]:
        """Return estimates of the error of N = terms, m.

        Args:
            terms: N.
            rows: positions, by index, shape (points,).
            columns: times, by index, shape (points,).

        Returns:
            Absolute estimates, shape (points,).
        """
        sizes, decay = self._sizes_at_starts(terms)
        starts = np.divide(self.forcing.starts, self.string.travel_time)
        known = np.searchsorted(starts, self.times[-1] / self.string.travel_time, side="right")
        tail = _Tail(terms=terms, decay=decay, damping=self.string.damping * self.string.travel_time)
        sums = tail.few if known <= FEW_STARTS else tail.many
        time, ratio = self.times[columns] / self.string.travel_time, self.ratios[rows]
        total = np.zeros(len(rows))
        for sign in (1.0, -1.0):
            # What left the upper end at τ_j is at r at τ_j + 1 − r, and on its way back at τ_j + 1 + r.
            way = np.exp(-tail.damping * (1 - sign * ratio))
            total += way * sums(time - 1 + sign * ratio, starts[:known], sizes[:known])
        return total * self._envelope(terms)[rows]

    def _sizes_at_starts(self, terms: int) -> tuple[NDArray[np.float64], float]:
        """Return the amplitudes that every start gives mode N/2, m, and the power p at which terms decay there."""
        numbers = np.array([terms / 2, terms])
        frequencies = np.multiply(numbers - 0.25, math.pi / self.string.travel_time)
        # Numbered beyond all: no mode is left out.
        jumps = free_motion_jumps(self.string, self.forcing, self.parts, frequencies, first_mode=2**62)
        u, v = jumps.factors @ jumps.displacements, jumps.factors @ jumps.velocities
        root = np.sqrt(np.maximum(frequencies**2 - self.string.damping**2, frequencies**2 / 4))[:, None]
        sizes = np.hypot(u, (v + self.string.damping * u) / root)
        largest = sizes.max(axis=1)
        if not largest.all():
            return sizes[0], 0.5
        # Shapes decay as k^{−1/2} at the lower end, and as 1/k elsewhere.
        return sizes[0], 0.5 + max(0.0, float(np.log2(largest[0] / largest[1])))

    def _envelope(self, terms: int) -> NDArray[np.float64]:
        """Return half the envelope of B_k at the positions, for k = N/2."""
        zero = math.pi * (terms / 2 - 0.25)
        size = 2 / (zero * math.sqrt(2 / (math.pi * zero)))
        with np.errstate(divide="ignore"):
            return np.asarray(size / 2 * np.minimum(1.0, np.sqrt(2 / (math.pi * zero * self.ratios))))


@dataclass(frozen=True, kw_only=True)
class _Tail:
    """The tail from N/2 on, for terms that are 1 there and decay as k^{−p}."""

    terms: int  # N
    decay: float  # p
    damping: float  # αR, dimensionless

    def at(self, distances: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the bound at distances d from a front."""
        half = self.terms / 2
        angle = np.maximum(math.pi * half * distances, 1e-9)
        bound = np.log1p(1 / angle) * np.maximum(1.0, angle ** min(0.0, self.decay - 1))
        if self.decay > 1:
            bound = np.minimum(bound, 1 / np.hypot(angle, self.decay - 1))
        return np.asarray(half * bound * np.exp(-((angle / (2 * EDGE)) ** 2)))

    def few(
        self, arrivals: NDArray[np.float64], starts: NDArray[np.float64], sizes: NDArray[np.float64]
    ) -> NDArray[np.float64]:
        """Return the sum over a few starts at times since they could have arrived (in units of R), and reflections."""
        total = np.zeros(len(arrivals))
        for start, size in zip(starts, sizes, strict=True):
            since = arrivals - start
            returns = 2 * np.maximum(np.round(since / 2), 0.0)
            total += size * np.exp(-self.damping * returns) * self.at(np.abs(since - returns))
        return total

    def many(
        self, arrivals: NDArray[np.float64], starts: NDArray[np.float64], sizes: NDArray[np.float64]
    ) -> NDArray[np.float64]:
        """Return the same for many starts, by a table of cells in time: no less than the largest value in each cell."""
        # A fifth of a second to import, which all that imports hydroelastic.modal would pay.

        low, high = -2.0, max(float(arrivals.max(initial=0.0)), float(starts[-1])) + 2
        per_unit = int(min(CELLS_PER_UNIT * self.terms, max(16, MOST_CELLS / (high - low))))
        cells = 2 * per_unit * math.ceil((high - low) / 2)
        sources = np.zeros(cells)
        np.add.at(sources, ((starts - low) * per_unit).astype(int), sizes)
        # Beyond, the Gaussian is below e^{−NOTHING_LEFT}: at most 0.4 for the fewest terms.
        reach = int(4 * EDGE * math.sqrt(NOTHING_LEFT) / (math.pi * self.terms) * per_unit) + 2
        offsets = np.maximum(np.abs(np.arange(-reach, reach + 1)) - 1, 0) / per_unit
        kernel = self.at(offsets)
        spread = np.abs(fftconvolve(sources, kernel, mode="same"))
        rows = spread.reshape(-1, 2 * per_unit)
        for earlier, later in pairwise(rows):
            later += math.exp(-2 * self.damping) * earlier
        return np.asarray(rows.ravel()[((arrivals - low) * per_unit).astype(int)])
