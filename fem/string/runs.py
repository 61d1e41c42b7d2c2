"""Motions of one string at chosen resolutions of its waves."""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import inf, log, log10
from time import perf_counter

import numpy as np
from mpi4py import MPI
from numpy.typing import NDArray

from hydroelastic.fem.string.end_motion import EndMotion
from hydroelastic.fem.string.fronts import front_errors
from hydroelastic.fem.string.pencil import StringPencil, build_string_pencil, string_nodes
from hydroelastic.fem.string.probe import StringProbe
from hydroelastic.fem.string.smoothed_motion import SmoothedMotion
from hydroelastic.fem.string.time_integration import StepControl, TimeHistory, integrate_motion, schedule
from hydroelastic.physics.string import HangingString

DEGREE = 10
"""Polynomial degree."""
# Errors of a wave grow with the distance travelled in wavelengths, and fall with a power of the phase per element
# (twice the degree) or per step (twice the stages): for the same errors shorter waves need slightly less phase in both.
_ELEMENT_ORDER = 2 * DEGREE
_STEP_ORDER = 8


@dataclass(frozen=True, kw_only=True)
class Resolution:
    """Resolution of the fastest waves that the smoothed motion excites."""

    half_width: float  # of the smoothing, s
    element: float = 8.0  # phase of the fastest waves over an element, rad
    step: float = 1.2  # their phase over a time step, rad

    def with_smaller_half_width(self, ratio: float) -> Resolution:
        """Return the resolution that keeps the errors for a half-width, and waves, shorter by a ratio."""
        return replace(
            self,
            half_width=ratio * self.half_width,
            element=ratio ** (1.0 / _ELEMENT_ORDER) * self.element,
            step=ratio ** (1.0 / _STEP_ORDER) * self.step,
        )

    def for_error(self, space: float, time: float, share: float) -> Resolution:
        """Return elements and steps whose errors are expected to be a thirtieth of the share allowed, from known
        errors."""
        target = share / 30.0
        element = (target / max(space, 1e-3 * target)) ** (1.0 / _ELEMENT_ORDER)
        step = (target / max(time, 1e-3 * target)) ** (1.0 / _STEP_ORDER)
        return replace(self, element=self.element * element, step=self.step * step)

    def refined(self, ratio: float, *, space: bool, time: bool) -> Resolution:
        """Return the resolution with shorter elements or steps, or both."""
        return replace(
            self, element=self.element * (ratio if space else 1.0), step=self.step * (ratio if time else 1.0)
        )


class StringRuns:
    """One motion of one string at chosen resolutions.

    Args:
        positions: x, m, shape (positions,).
        times: s, increasing, shape (times,).
        tolerance: absolute, m, which sets the digits of the smoothing.
    """

    def __init__(
        self,
        comm: MPI.Comm,
        string: HangingString,
        motion: EndMotion,
        positions: NDArray[np.float64],
        times: NDArray[np.float64],
        tolerance: float,
    ) -> None:
        self._comm, self._motion, self._times = comm, motion, times
        self.string, self._positions = string, positions
        sample = np.concatenate([times, np.linspace(times[0], times[-1], 64)])
        largest = max(tolerance, float(np.max(np.abs(np.asarray(motion.value(sample))))))
        self._digits = float(np.clip(log10(largest / tolerance) + 2.5, 3.0, 13.0))
        self._cut = largest * 10.0**-self._digits
        self._smoothed: dict[float, SmoothedMotion] = {}
        self._meshes: dict[int, tuple[StringPencil, StringProbe]] = {}
        self.seconds = {"mesh": 0.0, "motion": 0.0}
        self.motions_computed = 0

    def smoothed(self, resolution: Resolution) -> SmoothedMotion:
        """Return the motion with the smoothing of a resolution."""
        if resolution.half_width not in self._smoothed:
            self._smoothed[resolution.half_width] = SmoothedMotion(self._motion, resolution.half_width, self._digits)
        return self._smoothed[resolution.half_width]

    def elements(self, resolution: Resolution) -> int:
        """Return the number of elements of equal travel time."""
        return int(np.ceil(self.smoothed(resolution).highest * self.string.travel_time / resolution.element))

    def step_control(self, resolution: Resolution) -> StepControl:
        """Return the step lengths: waves decay at least like e^{−αt}, α the smallest damping along the string."""
        damping = self.string.smallest_damping
        decay_time = self._digits * log(10.0) / damping if damping > 0.0 else inf
        return StepControl(longest=resolution.step / self.smoothed(resolution).highest, decay_time=decay_time)

    def steps(self, resolution: Resolution) -> int:
        """Return the number of time steps."""
        return sum(
            count for _, _, count in schedule(self.smoothed(resolution), self._times, self.step_control(resolution))
        )

    def move(self, resolution: Resolution, elements: int | None = None) -> TimeHistory:
        """Compute the motion (collective)."""
        started = perf_counter()
        pencil, probe = self._on_mesh(elements or self.elements(resolution))
        meshed = perf_counter()
        result = integrate_motion(pencil, probe, self.smoothed(resolution), self._times, self.step_control(resolution))
        self.seconds["mesh"] += meshed - started
        self.seconds["motion"] += perf_counter() - meshed
        self.motions_computed += 1
        return result

    def _on_mesh(self, elements: int) -> tuple[StringPencil, StringProbe]:
        if elements not in self._meshes:
            pencil = build_string_pencil(self._comm, self.string, DEGREE, string_nodes(self.string, elements))
            self._meshes[elements] = pencil, StringProbe(pencil, np.divide(self._positions, self.string.length))
        return self._meshes[elements]

    def front_errors(self, resolution: Resolution) -> NDArray[np.float64]:
        """Return the errors of the values next to fronts, m, shape (positions, times)."""
        fronts = front_errors(self.string, self._motion, self.smoothed(resolution), self._positions, self._times)
        # The error of the kernel's truncation does not depend on the half-width.
        return fronts + self._cut

    def pencil(self, resolution: Resolution) -> StringPencil:
        """Return the matrices on the mesh of a resolution (collective)."""
        return self._on_mesh(self.elements(resolution))[0]
