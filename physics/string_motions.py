"""Motions f(t) of the upper end of a hanging string that was at rest before t = 0."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, fields
from itertools import pairwise
from typing import Literal, Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.interpolate import CubicSpline

from hydroelastic.physics.string_forcing import DERIVATIVES, Forcing, one_piece

MOST_SAMPLES = 2**16
FEWEST_SAMPLES = 17
SHORTEST_SPAN = 1e-9


class Motion(Protocol):
    """A motion of the upper end."""

    @property
    def forcing(self) -> Forcing:
        """The motion as pieces of polynomials and exponentials."""

    @property
    def end(self) -> float:
        """Last time at which the motion is known, s; or infinity."""


class _Values:
    """Values and derivatives of a motion for t > 0, from its pieces and exponentials."""

    def value(self: Motion, times: ArrayLike) -> NDArray[np.float64]:
        """Return f, m, at times from 0, s; at 0 the limit from the right."""
        return self.forcing.derivative(0, np.asarray(times, dtype=float))

    def slope(self: Motion, times: ArrayLike) -> NDArray[np.float64]:
        """Return f', m/s, at times from 0, s; where it jumps, from the right."""
        return self.forcing.derivative(1, np.asarray(times, dtype=float))

    def curvature(self: Motion, times: ArrayLike) -> NDArray[np.float64]:
        """Return f'', m/s², at times from 0, s; where it jumps, from the right."""
        return self.forcing.derivative(2, np.asarray(times, dtype=float))

    @property
    def breaks(self: Motion) -> NDArray[np.float64]:
        """Times at which a derivative may jump, s; 0 first."""
        return self.forcing.starts


class _Unbounded(_Values):
    def __post_init__(self) -> None:
        for parameter in fields(self):  # type: ignore[arg-type]
            value = getattr(self, parameter.name)
            if not math.isfinite(value):
                raise ValueError(f"{parameter.name} is {value}: it must be finite")

    @property
    def end(self) -> float:
        """Infinity: the motion is known at all times."""
        return math.inf


@dataclass(frozen=True, kw_only=True)
class Ramp(_Unbounded):
    """f = V t."""

    speed: float  # V, m/s

    @property
    def forcing(self) -> Forcing:
        """One piece."""
        starts, derivatives = one_piece(0.0, self.speed)
        return Forcing(starts=starts, derivatives=derivatives)


@dataclass(frozen=True, kw_only=True)
class Step(_Unbounded):
    """f = Δ from t = 0."""

    amplitude: float  # Δ, m

    @property
    def forcing(self) -> Forcing:
        """One piece."""
        starts, derivatives = one_piece(self.amplitude)
        return Forcing(starts=starts, derivatives=derivatives)


@dataclass(frozen=True, kw_only=True)
class Sine(_Unbounded):
    """f = Δ sin ωt."""

    amplitude: float  # Δ, m
    omega: float  # ω, 1/s

    @property
    def forcing(self) -> Forcing:
        """Re(−iΔ e^{iωt})."""
        starts, derivatives = one_piece()
        return Forcing(
            starts=starts,
            derivatives=derivatives,
            rates=np.array([1j * self.omega]),
            weights=np.array([-1j * self.amplitude]),
        )


@dataclass(frozen=True, kw_only=True)
class Smooth(_Unbounded):
    """f = Δ(1 − e^{−βt})²."""

    amplitude: float  # Δ, m
    rate: float  # β, 1/s, positive

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.rate <= 0:
            raise ValueError(f"rate is {self.rate}: it must be positive")

    @property
    def forcing(self) -> Forcing:
        """Δ(1 − 2e^{−βt} + e^{−2βt})."""
        starts, derivatives = one_piece(self.amplitude)
        return Forcing(
            starts=starts,
            derivatives=derivatives,
            rates=np.array([-self.rate, -2 * self.rate], dtype=complex),
            weights=np.array([-2 * self.amplitude, self.amplitude], dtype=complex),
        )


@dataclass(frozen=True, kw_only=True, eq=False)
class TabulatedMotion(_Values):
    """A motion by pieces of polynomials up to the third degree; made by `tabulated` and `sampled`."""

    forcing: Forcing  # the pieces
    end: float  # last time at which the motion is known, s


def tabulated(
    times: ArrayLike, values: ArrayLike, interpolation: Literal["linear", "cubic"] = "linear"
) -> TabulatedMotion:
    """Return the motion that interpolates a table.

    Args:
        times: s, rising from 0, shape (rows,), at least 2.
        values: f, m, shape (rows,). The first one may differ from 0: the upper end jumps to it at t = 0.
        interpolation: ``"linear"`` between rows, or ``"cubic"``: f, f' and f'' go through every row without a jump (the
            third derivative too through the second and the last but one).

    Returns:
        The motion, known until the last time of the table.
    """
    times, values = np.asarray(times, dtype=float), np.asarray(values, dtype=float)
    if times.ndim != 1 or times.shape != values.shape or len(times) < 2:
        raise ValueError(f"times and values have shapes {times.shape} and {values.shape}: (rows,) from 2 is allowed")
    if not (np.isfinite(times).all() and np.isfinite(values).all()):
        raise ValueError("times and values of a table must be finite")
    if times[0] != 0:
        raise ValueError(f"times begins with {times[0]}: a table begins with 0")
    if not (np.diff(times) > 0).all():
        row = int(np.argmin(np.diff(times) > 0)) + 1
        raise ValueError(f"times has {times[row]} after {times[row - 1]}: times must rise")
    if interpolation == "linear":
        return _linear(times, values)
    if interpolation == "cubic":
        return _splines([(times, values)])
    raise ValueError(f"interpolation is {interpolation!r}: 'linear' and 'cubic' are allowed")


def sampled(
    function: Callable[[NDArray[np.float64]], NDArray[np.float64]],
    end: float,
    tolerance: float = 1e-9,
    breaks: ArrayLike = (),
) -> TabulatedMotion:
    """Return a motion that follows a function, by C² cubic splines between its breaks.

    Intervals are halved until the spline meets the function at three points in each of them.

    Args:
        function: f(t), m, of an array of times from 0 to `end`, s.
        end: last time, s.
        tolerance: largest deviation, m.
        breaks: times inside at which f or a derivative may jump, s. f is called at the numbers next to them.

    Returns:
        The motion, known until `end`.
    """
    if not (end > 0 and math.isfinite(end)):
        raise ValueError(f"end is {end}: it must be positive and finite")
    if not tolerance > 0:
        raise ValueError(f"tolerance is {tolerance}: it must be positive")
    inner = np.unique(np.asarray(breaks, dtype=float))
    if not ((inner > 0) & (inner < end)).all():
        raise ValueError(f"breaks has times outside 0 … {end}: {inner}")
    edges = np.concatenate([[0.0], inner, [end]])
    return _splines([_sample(function, *span, tolerance) for span in pairwise(edges)])


def _linear(times: NDArray[np.float64], values: NDArray[np.float64]) -> TabulatedMotion:
    derivatives = np.zeros((DERIVATIVES, len(times) - 1))
    derivatives[0], derivatives[1] = values[:-1], np.diff(values) / np.diff(times)
    return TabulatedMotion(forcing=Forcing(starts=times[:-1], derivatives=derivatives), end=float(times[-1]))


def _splines(tables: list[tuple[NDArray[np.float64], NDArray[np.float64]]]) -> TabulatedMotion:
    """Return the motion that is a C² spline through each of the tables, which follow one another."""
    parts = []
    for times, values in tables:
        spline = CubicSpline(times, values)
        parts.append(np.array([spline(times[:-1], order) for order in range(DERIVATIVES)]))
    starts = np.concatenate([times[:-1] for times, _ in tables])
    forcing = Forcing(starts=starts, derivatives=np.concatenate(parts, axis=1))
    return TabulatedMotion(forcing=forcing, end=float(tables[-1][0][-1]))


def _sample(
    function: Callable[[NDArray[np.float64]], NDArray[np.float64]], start: float, end: float, tolerance: float
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return times and values of a table whose spline follows the function from start to end."""
    first, last = np.nextafter(start, end), np.nextafter(end, start)

    def evaluate(times: NDArray[np.float64]) -> NDArray[np.float64]:
        values = np.broadcast_to(np.asarray(function(np.clip(times, first, last)), float), times.shape)
        if not np.isfinite(values).all():
            raise ValueError(f"function is not finite between {start} and {end} s")
        return values

    times = np.asarray(np.linspace(start, end, FEWEST_SAMPLES), dtype=float)
    values = evaluate(times)
    while True:
        spline, spans = CubicSpline(times, values), np.diff(times)
        # Compared at thirds and halves: a deviation may vanish at one of them by chance.
        checks = np.asarray(times[:-1] + spans * np.array([[1 / 3], [1 / 2], [2 / 3]]), dtype=float)
        found = evaluate(checks)
        coarse = (np.abs(found - spline(checks)) > tolerance).any(axis=0)
        if not coarse.any():
            return times, values
        if len(times) > MOST_SAMPLES or spans[coarse].min() < SHORTEST_SPAN * (end - start):
            raise ValueError(
                f"tolerance is {tolerance}: no spline of {MOST_SAMPLES} intervals from {start} to {end} s meets it; "
                "it may be too small for rounding, or breaks may be missing"
            )
        added = checks[1][coarse]
        order = np.argsort(np.concatenate([times, added]))
        times = np.concatenate([times, added])[order]
        values = np.concatenate([values, found[1][coarse]])[order]
