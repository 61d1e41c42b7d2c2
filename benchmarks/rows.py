"""What was measured: one row for each case."""

from __future__ import annotations

from dataclasses import dataclass
from statistics import median, quantiles

import numpy as np

from hydroelastic.benchmarks.cases import Answer, Case
from hydroelastic.benchmarks.tanks import BenchmarkTank


@dataclass(frozen=True, kw_only=True)
class Row:
    """A case, its true error, and its seconds.

    Attributes:
        case: what was solved.
        unknowns: of ψ and of the surface.
        error: largest relative error of the ten lowest frequencies.
        seconds: of each round.
        stages: seconds by stage in the last round.
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


def row_of(case: Case, tank: BenchmarkTank, answer: Answer, seconds: tuple[float, ...]) -> Row:
    """The row of a case from its last answer."""
    errors = np.abs(np.array(answer.frequencies) / np.array(tank.frequencies) - 1.0)
    return Row(
        case=case,
        unknowns=answer.unknowns,
        error=float(errors.max()),
        seconds=seconds,
        stages=answer.stages,
        note=answer.note,
    )
