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
"""

from __future__ import annotations

from dataclasses import dataclass
from math import sqrt

import numpy as np
from mpi4py import MPI
from numpy.typing import ArrayLike, NDArray

from hydroelastic.fem.adaptive import ErrorEstimate, adaptive_solve
from hydroelastic.fem.string.end_motion import EndMotion
from hydroelastic.fem.string.runs import DEGREE, Resolution, StringRuns
from hydroelastic.fem.string.time_integration import TimeHistory
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
    seconds: dict[str, float]  # time by stage

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
        seconds=runs.seconds,
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
