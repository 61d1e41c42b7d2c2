"""The motion of the hanging string in time on one mesh: w = U − f, by collocation.

    M w'' + C w' + K w = −f'' M·1 − f' C·1,    w = 0 at the upper end

Steps end at all output times and at the breaks of the motion. There f and f' may jump while U and U_t of the string
below its upper end do not, so that w and w' jump by as much the other way: a step is nothing but such an initial state.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import inf

import numpy as np
from numpy.typing import NDArray

from hydroelastic.fem.string.collocation import Collocation
from hydroelastic.fem.string.end_motion import EndMotion, after, jumps
from hydroelastic.fem.string.pencil import StringPencil
from hydroelastic.fem.string.probe import StringProbe

STAGES = 4
"""Stages of the collocation: order 8."""


@dataclass(frozen=True, kw_only=True)
class TimeHistory:
    """The string at the output times."""

    values: NDArray[np.float64]  # U at the positions, m, shape (positions, times)
    # of w, ½∫m w_t² + ½M w_t² + ½∫T w_x², in units of ρgl² with w in metres over l, shape (times,)
    energies: NDArray[np.float64]
    steps: int  # number of time steps
    factorizations: int  # number of factorized complex systems


@dataclass(frozen=True, kw_only=True)
class StepControl:
    """Length of the time steps."""

    longest: float  # largest step while waves from a break of the motion travel, s
    decay_time: float = inf  # time after a break when they have decayed, s; infinite without resistance


# Factor on the steps when only the motion itself and slow decays remain.
_STRETCH = 10.0


def schedule(motion: EndMotion, times: NDArray[np.float64], control: StepControl) -> list[tuple[float, float, int]]:
    """Intervals between output times, breaks and beginnings of decay_time: start, end, number of steps."""
    first, last = float(motion.breaks[0]), float(times[-1])
    starts = np.array([float(time) for time in motion.breaks])
    stops = {*map(float, times), *starts, *(starts + control.decay_time)}
    known = np.array(sorted(stop for stop in stops if first <= stop <= last))
    since = known - starts[np.searchsorted(starts, known, side="right") - 1]
    steps = np.where(since >= control.decay_time, _STRETCH * control.longest, control.longest)
    counts = np.maximum(1, np.ceil(np.diff(known) / steps[:-1] - 1e-9)).astype(int)
    return list(zip(known[:-1].tolist(), known[1:].tolist(), counts.tolist(), strict=True))


def integrate_motion(
    pencil: StringPencil,
    probe: StringProbe,
    motion: EndMotion,
    times: NDArray[np.float64],
    control: StepControl,
    *,
    stages: int = STAGES,
) -> TimeHistory:
    """Integrate the motion of the string in time (collective)."""
    unit, size = pencil.string.time_unit, len(pencil.free)
    collocation = Collocation(pencil.mass, pencil.resistance, pencil.stiffness, stages)
    field = pencil.zeros()
    displacement: NDArray[np.float64] = np.zeros(size)
    velocity: NDArray[np.float64] = np.zeros(size)
    values, energies = {}, {}
    breaks, wanted = set(motion.breaks), set(times)
    intervals = schedule(motion, times, control)
    for start, end, count in [*intervals, (float(times[-1]), None, 0)]:
        if start in breaks:
            jump, kick = jumps(motion, start)
            displacement, velocity = displacement - jump, velocity - kick * unit
        if start in wanted:
            field.array[:] = displacement
            values[start] = probe.values(field) + after(motion.value, start)
            energies[start] = collocation.energy(displacement, velocity)
        if end is None:
            break
        # One step for equal intervals between output times, whatever the rounding of their difference.
        step = float(f"{(end - start) / count:.13g}")
        stage_times = start + step * (np.arange(count)[:, None] + collocation.rule.nodes)
        slopes, curvatures = motion.slope(stage_times), motion.curvature(stage_times)
        for slope, curvature in zip(slopes, curvatures, strict=True):
            loads = -unit * np.outer(slope, pencil.resistance_load)
            loads -= unit**2 * np.outer(curvature, pencil.mass_load)
            displacement, velocity = collocation.advance(displacement, velocity, step / unit, loads)
    return TimeHistory(
        values=np.array([values[time] for time in times]).T,
        energies=np.array([energies[time] for time in times]),
        steps=sum(count for _, _, count in intervals),
        factorizations=collocation.factorizations,
    )
