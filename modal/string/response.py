"""The motion of a hanging string under any motion of its upper end.

    U(x, t) = forced part + Σ_k w_k B_k(x) q_k(t)

The forced part (`modal/string/quasistatic.py`) is closed in x, so that the sum converges up to the upper end; the free
motions q_k (`modal/string/modes.py`) are cut smoothly by w_k, which converges exponentially away from the fronts
(`modal/string/truncation.py`).
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from hydroelastic.modal.bessel_zeros import bessel_zeros
from hydroelastic.modal.string.closed_form import participations, relative_roots
from hydroelastic.modal.string.modes import FreeMotionJumps, free_coordinates, free_motion_jumps
from hydroelastic.modal.string.quasistatic import Exponential, exponentials, forced_part
from hydroelastic.modal.string.truncation import Truncation, fewest_terms, weights
from hydroelastic.physics.string import HangingString
from hydroelastic.physics.string_forcing import Forcing
from hydroelastic.physics.string_motions import Motion

EPS = float(np.finfo(float).eps)
FEWEST_TERMS = 128
# Positions and times of a tile: all that is held at once are its modes.
TILE = 1024
# Positions whose times are summed in one product of matrices.
STRIP = 16
# Bessel functions and free motions of one tile (6e-8 s each) if left to choose: 4096 modes for the largest one …
WORK = 2**22
# … and no fewer for long tables, nor more than 65536 for single points, enough at 7e-4 R from a front: powers of 2.
LEAST_OF_MOST_TERMS, LARGEST_OF_MOST_TERMS = 12, 16


@dataclass(frozen=True, kw_only=True, eq=False)
class StringResponse:
    """Displacements of a string."""

    values: NDArray[np.float64]  # U(x, t), m, shape (positions, times)
    # estimates of their absolute errors, m, from truncation, which is large next to a front, and rounding
    errors: NDArray[np.float64]
    terms: int  # the largest number of modes that was used


def string_response(
    string: HangingString,
    motion: Motion,
    positions: ArrayLike,
    times: ArrayLike,
    *,
    tolerance: float = 1e-13,
    most_terms: int | None = None,
) -> StringResponse:
    """Return the displacement U(x, t) of a string that is at rest before its upper end moves.

    Args:
        motion: f(t) of its upper end, from `physics/string_motions.py`.
        positions: x above the free lower end, m, shape (positions,) or one.
        times: t, s, not negative, shape (times,) or one, in any order.
        tolerance: of the truncation error, relative to the largest |f| until then. Next to fronts it may not be
            reached, as the errors returned show.
        most_terms: largest number of modes; by default 65536 for a few points, and fewer, from 4096, for large grids
            and long tables.

    Returns:
        Values, their errors and the number of modes. Exactly 0 before the front, f(t) at the upper end.
    """
    positions, times = np.atleast_1d(np.asarray(positions, float)), np.atleast_1d(np.asarray(times, float))
    _check(motion, times, tolerance, most_terms)
    ratios = relative_roots(string, positions)
    across, along = np.argsort(ratios, kind="stable"), np.argsort(times, kind="stable")
    values = np.zeros((len(positions), len(times)))
    errors = np.zeros_like(values)
    forcing, terms = motion.forcing, 0
    scale = _size(forcing, times)
    for rows in _portions(across):
        for columns in _portions(along):
            parts = exponentials(string, forcing)
            needed = fewest_terms(string, parts, times[columns])
            problem = _Tile(
                string=string,
                forcing=forcing,
                parts=parts,
                ratios=ratios[rows],
                times=times[columns],
                tolerance=tolerance * scale,
                needed=needed,
                most_terms=most_terms or _affordable(len(rows) + len(columns) + len(forcing.starts), needed.max()),
            )
            part = problem.response()
            values[np.ix_(rows, columns)], errors[np.ix_(rows, columns)] = part.values, part.errors
            terms = max(terms, part.terms)
    return StringResponse(values=values, errors=errors, terms=terms)


def _check(motion: Motion, times: NDArray[np.float64], tolerance: float, most_terms: int | None) -> None:
    if not (np.isfinite(times) & (times >= 0)).all():
        raise ValueError(f"times has {times[~(np.isfinite(times) & (times >= 0))][0]}: finite times from 0 are allowed")
    if times.size and times.max() > motion.end:
        raise ValueError(f"times goes to {times.max()} s: the motion of the upper end is known up to {motion.end} s")
    if not tolerance > 0:
        raise ValueError(f"tolerance is {tolerance}: it must be positive")
    if most_terms is not None and most_terms < FEWEST_TERMS:
        raise ValueError(f"most_terms is {most_terms}: at least {FEWEST_TERMS} is allowed")


def _size(forcing: Forcing, times: NDArray[np.float64]) -> float:
    """Return a size of f until the last time, m: that of its exponentials, and of its polynomials at rows and times."""
    starts = forcing.starts[forcing.starts <= times.max(initial=0.0)]
    values = forcing.polynomial(0, np.concatenate([starts, times]))
    return float(np.abs(values).max() + np.abs(forcing.weights).sum())


def _portions(order: NDArray[np.int_]) -> Iterator[NDArray[np.int_]]:
    for start in range(0, len(order), TILE):
        yield order[start : start + TILE]


def _affordable(series: int, needed: float) -> int:
    """Return the largest number of modes for a tile of so many positions, times and pieces."""
    power = max((WORK // series).bit_length(), LEAST_OF_MOST_TERMS)
    extra = max(0, min(2, math.ceil(math.log2(max(needed, 1))) - power))
    return 1 << min(power + extra, LARGEST_OF_MOST_TERMS)


@dataclass(frozen=True, kw_only=True)
class _Octave:
    """Modes from one number to twice that: shapes at all positions, motions at the times that need them."""

    numbers: NDArray[np.int_]  # k, shape (modes,)
    shapes: NDArray[np.float64]  # B_k, shape (positions, modes)
    coordinates: NDArray[np.float64]  # q_k, shape (modes, times)


@dataclass(frozen=True, kw_only=True)
class _Tile:
    """A grid of rising positions and times that is small enough to be computed at once."""

    string: HangingString
    forcing: Forcing  # the motion of its upper end
    parts: Sequence[Exponential]
    ratios: NDArray[np.float64]  # r, rising, shape (positions,)
    times: NDArray[np.float64]  # s, rising, shape (times,)
    tolerance: float  # of the truncation error, m
    needed: NDArray[np.float64]  # the fewest modes at each time, shape (times,)
    most_terms: int  # largest number of modes

    def response(self) -> StringResponse:
        """Return values and errors on the grid."""
        moved = self.times > self.string.travel_time * (1 - self.ratios)[:, None]
        values, errors, terms = self._sum(moved)
        ends = self.ratios == 1
        values[ends] = self.forcing.derivative(0, self.times)
        errors[ends] = 4 * EPS * np.abs(values[ends])
        at_rest = ~(moved | ends[:, None])
        values[at_rest], errors[at_rest] = 0.0, 0.0
        return StringResponse(values=values, errors=errors, terms=terms)

    def _sum(self, pending: NDArray[np.bool_]) -> tuple[NDArray[np.float64], NDArray[np.float64], int]:
        """Return forced part and sum of modes where something has arrived, by levels of twice as many modes each."""
        truncation = Truncation(
            string=self.string, forcing=self.forcing, parts=self.parts, ratios=self.ratios, times=self.times
        )
        values, errors = forced_part(self.string, self.forcing, self.ratios, self.times)
        octaves: list[_Octave] = []
        rounding = Rounding(string=self.string, starts=self.forcing.starts, ratios=self.ratios, times=self.times)
        terms = 0
        while pending.any():
            octaves.append(self._octave(terms, max(FEWEST_TERMS, 2 * terms), pending, rounding))
            terms = max(FEWEST_TERMS, 2 * terms)
            last = 2 * terms > self.most_terms
            rows, columns = np.nonzero(pending & ((self.needed <= terms) | last))
            lost = truncation.errors(terms, rows, columns)
            done = (lost <= self.tolerance) | last
            rows, columns, lost = rows[done], columns[done], lost[done]
            ready = np.zeros_like(pending)
            ready[rows, columns] = True
            cut = [octave.shapes * weights(octave.numbers, terms) for octave in octaves]
            values += _sum_where(ready, cut, octaves)
            errors[rows, columns] += lost + rounding.at(rows, columns)
            if last:
                # Not even the highest octave is of the tail there: it may be what the next ones are.
                short = ready & (self.needed > terms)
                errors += np.abs(_sum_where(short, [octaves[-1].shapes], octaves[-1:]))
            pending = pending & ~ready
        return values, errors, terms

    def _octave(self, start: int, stop: int, pending: NDArray[np.bool_], rounding: Rounding) -> _Octave:
        """Return modes start + 1 … stop at all positions, and at the times that are pending (zero at the others)."""
        zeros = bessel_zeros(stop)[start:]
        frequencies = np.divide(zeros, self.string.travel_time)
        jumps = free_motion_jumps(self.string, self.forcing, self.parts, frequencies, start + 1)
        shapes = participations(zeros, self.ratios)
        wanted = pending.any(axis=0)
        coordinates = np.zeros((len(zeros), len(self.times)))
        coordinates[:, wanted] = free_coordinates(
            frequencies, self.string.damping, self.forcing.starts, jumps, self.times[wanted]
        )
        rounding.add(frequencies, jumps, shapes)
        return _Octave(numbers=np.arange(start + 1, stop + 1), shapes=shapes, coordinates=coordinates)


def _sum_where(
    ready: NDArray[np.bool_], shapes: Sequence[NDArray[np.float64]], octaves: Sequence[_Octave]
) -> NDArray[np.float64]:
    """Return the sum over octaves of shapes times coordinates at the points that are ready, 0 at the others."""
    values = np.zeros(ready.shape)
    for start in range(0, len(ready), STRIP):
        strip = slice(start, start + STRIP)
        columns = np.nonzero(ready[strip].any(axis=0))[0]
        if columns.size:
            total = sum(
                shape[strip] @ octave.coordinates[:, columns] for shape, octave in zip(shapes, octaves, strict=True)
            )
            values[strip, columns] = np.where(ready[strip, columns], total, 0.0)
    return values


class Rounding:
    """Estimates of rounding: each mode has its own error, of 4ε (1 + J/16 + Ωt/3) of its size after J starts.

    The amplitude is rounded at every start, and may be so to the same side; the phase is rounded with Ωt.

    Args:
        starts: times at which the motion of the upper end starts anew, s, shape (starts,).
        ratios: r of the positions, shape (positions,).
        times: s, shape (times,).
    """

    def __init__(
        self,
        *,
        string: HangingString,
        starts: NDArray[np.float64],
        ratios: NDArray[np.float64],
        times: NDArray[np.float64],
    ) -> None:
        self._damping = string.damping
        past = np.searchsorted(starts, times, side="right")
        self._steps = 1 + past / 16
        # Positions are rounded too: they are as far as R.
        self._phase = (times + string.travel_time) / 3
        self._decay = np.exp(-2 * string.damping * (times - starts[past - 1]))
        # Squares of the sizes of aperiodic modes; of oscillating ones; of these times Ω.
        self._sums = np.zeros((3, len(ratios)))

    def add(self, frequencies: NDArray[np.float64], jumps: FreeMotionJumps, shapes: NDArray[np.float64]) -> None:
        """Take in modes: their frequencies (1/s), jumps, and shapes (positions, modes)."""
        excess = (frequencies - self._damping) * (frequencies + self._damping)
        oscillating = excess > 0
        # Near critical damping S is at most 1/(eα).
        inverse = 1 / np.sqrt(np.maximum(np.abs(excess), self._damping**2 / 4))
        # Of S stands v + αu; of aperiodic modes αu is kept by C + αS, which falls slowly from 1.
        kept = self._damping * oscillating
        pushed = np.concatenate([jumps.factors, jumps.factors * kept[:, None]], axis=1) * inverse[:, None]
        sizes = 2 * (
            _squares(jumps.factors, jumps.displacements)
            + _squares(pushed, np.concatenate([jumps.velocities, jumps.displacements]))
        )
        moving = np.where(oscillating, sizes, 0.0)
        self._sums += np.stack([np.where(oscillating, 0.0, sizes), moving, moving * frequencies**2]) @ (shapes**2).T

    def at(self, rows: NDArray[np.int_], columns: NDArray[np.int_]) -> NDArray[np.float64]:
        """Return estimates at points, m, shape (points,), given by indices of positions and times, both of shape
        (points,)."""
        aperiodic, oscillating, turning = self._sums[:, rows]
        moving = oscillating * self._steps[columns] ** 2 + turning * self._phase[columns] ** 2
        squares = aperiodic * self._steps[columns] ** 2 + self._decay[columns] * moving
        return np.asarray(4 * EPS * np.sqrt(squares))


def _squares(factors: NDArray[np.float64], jumps: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return Σ over starts of (factors · jumps)², shape (modes,)."""
    return np.asarray(np.maximum(((factors @ (jumps @ jumps.T)) * factors).sum(axis=1), 0.0))
