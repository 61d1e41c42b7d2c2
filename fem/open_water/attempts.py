"""Adaptive resolution: solve, estimate errors by cause, refine where they arise, keep the best of a few attempts."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Generic, TypeVar

from hydroelastic.fem.memory import release_memory
from hydroelastic.fem.open_water.basin import open_basin
from hydroelastic.fem.open_water.field_model import Band, first_resolution
from hydroelastic.fem.open_water.problem import OpenWaterProblem
from hydroelastic.fem.tank.error_estimates import FrequencyErrors, refined
from hydroelastic.fem.tank.resolution import Resolution, sharpest_exponent, workable_tolerance

Result = TypeVar("Result")

_MOST_ATTEMPTS = 4


@dataclass(frozen=True, kw_only=True)
class Attempt(Generic[Result]):
    """A result with its estimated errors.

    Attributes:
        result: the result.
        causes: its relative errors by cause.
        resolution: with which it was found.
    """

    result: Result
    causes: FrequencyErrors
    resolution: Resolution

    @property
    def error(self) -> float:
        """The largest error."""
        return float(self.causes.total.max(initial=0.0))


def best_attempt(
    solve: Callable[[Resolution], Attempt[Result]], first: Resolution, tolerance: float, exponent: float
) -> Attempt[Result]:
    """Return the first attempt whose error is below a tolerance, or the most accurate of a few (collective).

    Args:
        solve: solves at a resolution.
        first: resolution of the first attempt.
        tolerance: largest relative error that is accepted.
        exponent: α of ψ ~ r^α at the sharpest tips.
    """
    resolution: Resolution | None = first
    best: Attempt[Result] | None = None
    for _ in range(_MOST_ATTEMPTS):
        if resolution is None:
            break
        attempt = solve(resolution)
        release_memory()
        if best is None or attempt.error < best.error:
            best = attempt
        if attempt.error <= tolerance:
            break
        resolution = refined(resolution, attempt.causes, tolerance, exponent=exponent, own_mesh=True)
    assert best is not None
    return best


def best_over_band(
    problem: OpenWaterProblem, band: Band, solve: Callable[[Resolution], Attempt[Result]]
) -> Attempt[Result]:
    """Return the best of a few attempts over a range of frequencies, from the resolution that it needs (collective).

    Args:
        problem: the open water.
        band: the frequencies.
        solve: solves at a resolution.
    """
    tank = open_basin(problem.tank, band.wavenumbers(problem.tank)[1]).tank
    return best_attempt(
        solve,
        first_resolution(problem.tank, problem.tolerance, band),
        workable_tolerance(problem.tolerance, tank.depth),
        sharpest_exponent(tank, released=False),
    )
