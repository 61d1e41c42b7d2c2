"""A motion of a thread in the coordinates of a solution: output times, steps, prescribed ends, releases."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import isfinite

import numpy as np
from numpy.typing import NDArray

from hydroelastic.physics.thread import Thread
from hydroelastic.physics.thread_motion import VortexShedding

VectorOfTime = Callable[[float], NDArray[np.float64]]


class ThreadMotionError(RuntimeError):
    """The motion could not be computed; the message says when, why, and what to do."""


@dataclass(frozen=True, kw_only=True)
class PrescribedEnd:
    """Prescribed position or force of an end by the time, and its release."""

    # of the end in m by the time in s, shape (dimension,), of which the held components are asked; the model's position
    # without it
    position: VectorOfTime | None = None
    # the dead force on the end in N by the time, shape (dimension,), in place of the model's
    force: VectorOfTime | None = None
    # when each held component is released, s, shape (dimension,); infinite for never. A clamp is released with the last
    # component.
    release: tuple[float, ...] | None = None

    def held(self, held: tuple[bool, ...], time: float) -> tuple[bool, ...]:
        """Return which components are still held just after a time, of those held at first."""
        if self.release is None:
            return held
        return tuple(kept and time < let_go for kept, let_go in zip(held, self.release, strict=True))


@dataclass(frozen=True, kw_only=True)
class MotionPlan:
    """A motion to be solved for."""

    times: NDArray[np.float64]  # output times, s, increasing, shape (times,); the first is that of the start
    step: float  # the longest step, s; that of all steps without `tolerance`, up to landing on output times
    # error of positions that a step may add, relative to the length; the steps adapt to it
    tolerance: float | None = None
    ends: tuple[PrescribedEnd, PrescribedEnd] = (PrescribedEnd(), PrescribedEnd())  # of A and B
    # by the time in s, times the model's stream; the pressure gradient of a stream that changes is not in the
    # equations, so it must change slowly
    stream_factor: Callable[[float], float] | None = None
    # times at which velocities or accelerations of the ends, forces, or the stream's rate jump
    breaks: tuple[float, ...] = ()
    # spectral radius at infinite frequency of the generalised-α method, which damps frequencies that the steps do not
    # resolve; without it the midpoint rule, which conserves energy
    dissipation: float | None = None
    shedding: VortexShedding | None = None  # vortices, if any
    # times at which steps end, s, increasing, shape (steps,), in place of `step` and `tolerance`
    grid: NDArray[np.float64] | None = None
    # m/s; the motion ends when no component of a velocity is larger, after at least one step. With long steps this
    # needs `dissipation`: the midpoint rule keeps oscillating.
    rest_speed: float | None = None
    # whether a thread without flexural rigidity is refused that would be in compression at once
    tension_at_start: bool = False

    def __post_init__(self) -> None:
        times = np.asarray(self.times, dtype=np.float64)
        if times.ndim != 1 or len(times) < 2 or not np.all(np.isfinite(times)) or np.any(np.diff(times) <= 0.0):
            raise ValueError(f"times are {self.times}: at least two are needed, finite and increasing")
        if not (isfinite(self.step) and self.step > 0.0):
            raise ValueError(f"step is {self.step}: it must be finite and positive")
        if self.tolerance is not None and not 0.0 < self.tolerance < 1.0:
            raise ValueError(f"tolerance is {self.tolerance}: it must be between 0 and 1")
        if self.dissipation is not None and not 0.0 <= self.dissipation < 1.0:
            raise ValueError(
                f"dissipation is {self.dissipation}: it must be at least 0 and below 1; at 1 stiff stretching grows "
                "without bound, 0.5 to 0.7 is usual"
            )
        if self.rest_speed is not None and not self.rest_speed > 0.0:
            raise ValueError(f"rest_speed is {self.rest_speed}: it must be positive")

    def check(self, model: Thread) -> None:
        """Check that the plan fits a thread."""
        if not model.mass > 0.0:
            raise ValueError(f"mass is {model.mass}: the motion of a thread needs a positive one, however small")
        if self.dissipation is not None and model.reactive == "lighthill":
            raise ValueError('dissipation: reactive "lighthill" needs the midpoint rule, leave dissipation out')
        if self.shedding is not None and (model.dimension == 2 or model.normal_drag == 0.0):
            raise ValueError("shedding: its force is across the plane of the thread, and needs dimension 3 and drag")
        if model.reactive != "none" and any(prescribed.release is not None for prescribed in self.ends):
            raise ValueError(f'release: not with reactive "{model.reactive}", which has no terms for a released end')
        for name, prescribed in zip("AB", self.ends, strict=True):
            if prescribed.release is not None and len(prescribed.release) != model.dimension:
                raise ValueError(
                    f"release of end {name} has {len(prescribed.release)} times: there must be {model.dimension}"
                )

    def stops(self) -> tuple[list[float], list[float]]:
        """Return the times after the start at which steps end, and those among them with discontinuities."""
        first, last = float(self.times[0]), float(self.times[-1])
        releases = [time for prescribed in self.ends for time in prescribed.release or ()]
        breaks = sorted({float(time) for time in (*self.breaks, *releases) if first < time < last})
        return sorted({*map(float, self.times[1:]), *breaks}), breaks
