"""Adaptive motion of the hanging string: smoothing of fronts, mesh and time step chosen by their estimated errors.

Fronts limit the accuracy on a uniform mesh: the error is of order s·2n/(2n + 1) in the mean for degree n, with s = ½
after a step, 1½ after a ramp and 2½ after a motion that starts with a jump of its acceleration. The motion is therefore
smoothed at its breaks (`smoothed_motion.py`), and errors are estimated separately for three causes:

    cause   reduced by                             estimated by
    front   smaller half-width of the smoothing,   the last changes; within a front its height
            a finer mesh, shorter steps
    space   more elements                          a mesh of four fifths of the elements
    time    shorter steps                          Richardson's extrapolation from steps twice and four times as long

Before a front comes within the half-width the string is at rest up to ripples within the tolerance.

Motions of one string at chosen resolutions of its waves.

Errors of a smoothed motion of the string next to its wave fronts.

A break of the motion starts a front that both ends reflect: it passes a point at the travel time s from the lower end
at S − s, S + s, 3S − s … with S the travel time along the whole string. Its height changes like
(T m)^{−1/4}, and decays with the resistance.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import inf, log, log10, sqrt

import numpy as np
from mpi4py import MPI
from numpy.typing import ArrayLike, NDArray

from hydroelastic.fem.adaptive import ErrorEstimate, adaptive_solve
from hydroelastic.fem.string.end_motion import EndMotion, after, jumps
from hydroelastic.fem.string.pencil import StringPencil, build_string_pencil, string_nodes
from hydroelastic.fem.string.probe import StringProbe
from hydroelastic.fem.string.smoothed_motion import SmoothedMotion
from hydroelastic.fem.string.time_integration import StepControl, TimeHistory, integrate_motion, schedule
from hydroelastic.physics.string import HangingString

# Part of the tolerance for each cause.
_SHARE = 1.0 / 3.0
_COARSER = 0.8
_TIGHTER = 0.75
_CLOSER = sqrt(0.5)
# Of the travel time of a wave along the string.
_FIRST_HALF_WIDTH = 0.35
_MOST_TIGHTENINGS = 6
_CAUTION = 4.0

DEGREE = 10
"""Polynomial degree."""
# Errors of a wave grow with the distance travelled in wavelengths, and fall with a power of the phase per element
# (twice the degree) or per step (twice the stages): for the same errors shorter waves need slightly less phase in both.
_ELEMENT_ORDER = 2 * DEGREE
_STEP_ORDER = 8

# Largest error of a smoothed step, and of its first three integrals, in units of 1, 1/ω₀, 1/ω₀², 1/ω₀³: from 5 to 11
# digits 0.50, 0.33, 0.13 to 0.14 and 0.12 to 0.15 within 3/ω₀ of the middle, and farther away all below 0.3/(ω₀t).
_LARGEST = (0.51, 0.35, 0.15, 0.16)
_RINGING = 0.3
# Part of 1/ω₀ over which the third derivative is looked at.
_CLOSE = 1e-4


@dataclass(frozen=True, kw_only=True)
class FieldSizes:
    """Size of the last discretisation."""

    elements: int
    degree: int  # polynomial degree
    unknowns: int  # number of free unknowns
    steps: int  # number of time steps
    half_width: float  # time from a front within which values are smoothed, s
    motions_computed: int  # number of motions computed in all, trials and error estimates included


@dataclass(frozen=True, kw_only=True)
class ErrorsByCause:
    """Largest estimated error of each cause."""

    front: float  # error from the smoothing of fronts, of the values that are judged, m
    space: float  # discretisation error in space, m
    time: float  # discretisation error in time, m
    time_order: float  # order observed with three step lengths; rounding lowers it


@dataclass(frozen=True, kw_only=True)
class FieldResponse:
    """Displacements of the string and their errors."""

    values: NDArray[np.float64]  # U at the positions and times, m, shape (positions, times)
    errors: NDArray[np.float64]  # estimate of their absolute errors, m, shape (positions, times)
    causes: ErrorsByCause  # the largest errors by cause
    tolerance: float  # asked, m
    problem: str  # why the tolerance is not reached everywhere; empty if it is
    sizes: FieldSizes  # size of the last discretisation

    @property
    def converged(self) -> bool:
        """Whether all errors are estimated below the tolerance."""
        return not self.problem


def field_response(
    comm: MPI.Comm,
    string: HangingString,
    motion: EndMotion,
    positions: ArrayLike,
    times: ArrayLike,
    *,
    tolerance: float,
    judged: NDArray[np.bool_] | None = None,
    most_unknowns: int = 4_000,
    most_steps: int = 8_000,
) -> FieldResponse:
    """Return the motion of a string at rest whose upper end is moved."""
    places, moments = np.atleast_1d(np.asarray(positions, float)), np.atleast_1d(np.asarray(times, float))
    _check(string, motion, places, moments, tolerance)
    runs = StringRuns(comm, string, motion, places, moments, tolerance)
    share = _SHARE * tolerance
    if judged is None:
        judged = np.ones((len(places), len(moments)), dtype=bool)
    checked, front = _refined(runs, share, judged, most_unknowns, most_steps)
    space, time = checked.worst
    largest = float(front[judged].max(initial=0.0))
    causes = ErrorsByCause(front=largest, space=space, time=time, time_order=checked.order)
    values, errors = checked.values.copy(), front + space + time
    held = places == string.length
    values[held], errors[held] = np.asarray(motion.value(moments)), 0.0
    pencil = runs.pencil(checked.resolution)
    return FieldResponse(
        values=values,
        errors=errors,
        causes=causes,
        tolerance=tolerance,
        problem=_problem(causes, front[judged], share, checked.resolution.half_width),
        sizes=FieldSizes(
            elements=pencil.cell_count,
            degree=DEGREE,
            unknowns=pencil.size,
            steps=checked.steps,
            half_width=checked.resolution.half_width,
            motions_computed=runs.motions_computed,
        ),
    )


def _check(
    string: HangingString,
    motion: EndMotion,
    positions: NDArray[np.float64],
    times: NDArray[np.float64],
    tolerance: float,
) -> None:
    if not (len(positions) and positions.min() >= 0.0 and positions.max() <= string.length):
        raise ValueError(f"positions must lie from 0 to {string.length:g} m, and be at least one")
    first = motion.breaks[0]
    if not (len(times) and np.all(np.diff(times) > 0.0) and times[0] >= first and times[-1] <= motion.end):
        raise ValueError(f"times must increase from {first:g} s at the least to {motion.end:g} s at the most")
    if not tolerance > 0.0:
        raise ValueError(f"tolerance is {tolerance:g} m: it must be above zero")


@dataclass(frozen=True, kw_only=True)
class _Checked:
    """A solution with one smoothing, and the errors of its mesh and step at each position and time."""

    values: NDArray[np.float64]
    space: NDArray[np.float64]
    time: NDArray[np.float64]
    order: float
    steps: int
    resolution: Resolution

    @property
    def worst(self) -> tuple[float, float]:
        return float(self.space.max()), float(self.time.max())


def _checked(runs: StringRuns, resolution: Resolution, known: TimeHistory | None = None) -> _Checked:
    """Solve, unless the solution is known, and estimate the errors of mesh and step."""
    fine = known or runs.move(resolution)
    double, fourfold = (runs.move(resolution.refined(factor, space=False, time=True)) for factor in (2.0, 4.0))
    coarse = runs.move(resolution, elements=int(_COARSER * runs.elements(resolution)))
    last, before = np.abs(fine.values - double.values), np.abs(double.values - fourfold.values)
    tiny = np.finfo(float).tiny
    order = float(np.log2(max(before.max(), tiny) / max(last.max(), tiny)))
    return _Checked(
        values=fine.values,
        space=np.abs(fine.values - coarse.values),
        # At an observed order below one a smaller step need not reduce the error.
        time=last / (2.0 ** np.clip(order, 1.0, 8.0) - 1.0),
        order=order,
        steps=fine.steps,
        resolution=resolution,
    )


def _settled(runs: StringRuns, first: Resolution, share: float, known: TimeHistory | None = None) -> _Checked:
    """Tighten mesh and step until their errors are below a part of the tolerance, or no longer fall."""
    return adaptive_solve(
        first,
        lambda resolution: _checked(runs, resolution, known if resolution is first else None),
        lambda found: ErrorEstimate(discretization=max(found.worst)),
        lambda resolution, found: resolution.refined(
            _TIGHTER, space=found.worst[0] > share, time=found.worst[1] > share
        ),
        share,
        rounds=_MOST_TIGHTENINGS + 1,
        least_gain=1.5,
    ).solution


def _refined(
    runs: StringRuns, share: float, judged: NDArray[np.bool_], most_unknowns: int, most_steps: int
) -> tuple[_Checked, NDArray[np.float64]]:
    """Reduce the half-width of the smoothing until its errors are below a part of the tolerance, or the limits are
    met."""
    checked = _settled(runs, Resolution(half_width=_FIRST_HALF_WIDTH * runs.string.travel_time), share)
    resolution, values, last = checked.resolution.for_error(*checked.worst, share), checked.values, None
    front = np.full(values.shape, np.inf)
    change, ratio = np.zeros(values.shape), 1.0
    while last is None or front[judged].max(initial=0.0) > share:
        finer = resolution.with_smaller_half_width(_CLOSER)
        large = runs.elements(finer) * DEGREE > most_unknowns or runs.steps(finer) > most_steps
        # The error of the smoothing is estimated from two smoothings.
        if large and last is not None:
            break
        last = runs.move(finer)
        before, change = change, np.abs(last.values - values)
        if before[judged].any():
            ratio = float(change[judged].max() / before[judged].max())
        # Changes fall faster and faster, so that the next one bounds the error; one may pass through zero.
        front = np.maximum(change, ratio * before) * min(1.0, _CAUTION * ratio)
        front = np.maximum(front, runs.front_errors(finer))
        resolution, values = finer, last.values
    if last is not None:
        checked = _settled(runs, resolution, share, last)
    return checked, front


def _problem(causes: ErrorsByCause, front: NDArray[np.float64], share: float, half_width: float) -> str:
    problems = []
    if causes.front > share:
        problems.append(
            f"{np.count_nonzero(front > share)} of {front.size} values lie nearer than about {half_width:.2g} s to a "
            f"front, which is resolved to {causes.front:.2g} m with the unknowns and steps allowed"
        )
    for name, value in (("mesh", causes.space), ("step", causes.time)):
        if value > share:
            problems.append(f"the error of the {name} stays at {value:.2g} m")
    return "; ".join(problems)


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
        pencil, probe = self._on_mesh(elements or self.elements(resolution))
        result = integrate_motion(pencil, probe, self.smoothed(resolution), self._times, self.step_control(resolution))
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


def front_errors(
    string: HangingString,
    motion: EndMotion,
    smoothed: SmoothedMotion,
    positions: NDArray[np.float64],
    times: NDArray[np.float64],
) -> NDArray[np.float64]:
    """Return error bounds of the values next to fronts.

    The difference of two smoothings does not show the error everywhere: in the middle of a step both have the mean of
    its sides, and the ripples beside it pass through zero.
    """
    whole, travel = string.travel_time, string.travel_times(positions)
    bottom, slope = string.tension
    root = np.sqrt(bottom + slope * positions)
    # At the lower end the tension may vanish: the height is that at the width of the front.
    blunt = np.maximum(root, abs(slope) / sqrt(string.inertia) / smoothed.middle)
    height = np.sqrt(max(sqrt(bottom + slope * string.length), float(blunt.max())) / blunt)[:, None]
    errors = np.zeros((len(positions), len(times)))
    for start in motion.breaks:
        jumped = (*jumps(motion, start), *_bends(motion, start, _CLOSE / smoothed.middle))
        since = times - start
        away = _nearest_passage(whole, travel, since)
        decay = np.exp(-string.smallest_damping * np.maximum(since, 0.0) - 0.5 * (away / smoothed.width) ** 2)
        ringing = _RINGING / np.maximum(smoothed.middle * away, 1e-3)
        for order, (jump, largest) in enumerate(zip(jumped, _LARGEST, strict=True)):
            errors += abs(jump) / smoothed.middle**order * np.minimum(largest, ringing) * height * decay
    return errors


def _nearest_passage(whole: float, travel: NDArray[np.float64], since: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the time to the nearest passage of the front that started at zero, s, shape (positions, times)."""
    period = 2.0 * whole
    nearest = np.full((len(travel), len(since)), np.inf)
    for first in (whole - travel, whole + travel):
        rounds = np.maximum(np.round((since - first[:, None]) / period), 0.0)
        nearest = np.minimum(nearest, np.abs(since - first[:, None] - rounds * period))
    return nearest


def _bends(motion: EndMotion, time: float, near: float) -> tuple[float, float]:
    first = after(motion.curvature, time)
    later = (float(np.asarray(motion.curvature(time + near))) - first) / near
    if time <= motion.breaks[0]:
        return first, later
    before = float(np.asarray(motion.curvature(np.nextafter(time, -np.inf))))
    earlier = (before - float(np.asarray(motion.curvature(time - near)))) / near
    return first - before, later - earlier
