"""What was measured: one row for each case."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from statistics import median, quantiles

import numpy as np

from hydroelastic.benchmarks.basin.cases import basin_error
from hydroelastic.benchmarks.buoy.cases import buoy_error
from hydroelastic.benchmarks.cases import (
    BASIN_CODES,
    BUOY_CODES,
    CIRCLE_CODES,
    STRING_CODES,
    SWEEP_CODES,
    THREAD_CODES,
    Answer,
    Case,
)
from hydroelastic.benchmarks.circle.cases import circle_error
from hydroelastic.benchmarks.string.cases import string_error
from hydroelastic.benchmarks.sweep.cases import sweep_error
from hydroelastic.benchmarks.tank.cases import tank_named
from hydroelastic.benchmarks.thread.cases import thread_error


@dataclass(frozen=True, kw_only=True)
class Row:
    """A case, its true error, and its seconds.

    Attributes:
        case: what was solved.
        unknowns: as the answer says.
        error: largest relative error of the ten lowest frequencies, of heave and sway of the circle, of the
            displacements of the string relative to the largest one, of heave of a buoy, or that of a
            thread that `thread_error` tells.
        seconds: of each round.
        stages: seconds by stage, median of the rounds.
        note: what else the code says.
    """

    case: Case
    unknowns: int
    error: float
    seconds: tuple[float, ...]
    stages: dict[str, float]
    note: str

    @property
    def median(self) -> float:
        """Median of the seconds."""
        return median(self.seconds)

    @property
    def spread(self) -> float:
        """Distance of the quartiles of the seconds."""
        if len(self.seconds) < 2:
            return 0.0
        first, _, third = quantiles(self.seconds, n=4, method="inclusive")
        return third - first


def row_of(case: Case, answers: Sequence[Answer], seconds: tuple[float, ...]) -> Row:
    """The row of a case from its answers, one for each round."""
    answer = answers[-1]
    return Row(
        case=case,
        unknowns=answer.unknowns,
        error=_error(case, answer),
        seconds=seconds,
        stages={stage: median(one.stages[stage] for one in answers) for stage in answer.stages},
        note=answer.note,
    )


def _error(case: Case, answer: Answer) -> float:
    if case.code in SWEEP_CODES:
        return sweep_error(case.tank, answer.values)
    if case.code in CIRCLE_CODES:
        return circle_error(case.tank, answer.values)
    if case.code in STRING_CODES:
        return string_error(case.tank, answer.values)
    if case.code in BASIN_CODES:
        return basin_error(case.tank, answer.values)
    if case.code in BUOY_CODES:
        return buoy_error(case.tank, answer.values)
    if case.code in THREAD_CODES:
        return thread_error(case.tank, answer.values)
    return float(np.abs(np.array(answer.values) / np.array(tank_named(case.tank).frequencies) - 1.0).max())
