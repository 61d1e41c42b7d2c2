"""Solve at successively finer resolutions: each refines the largest contribution to the error of the previous one."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Generic, TypeVar

from hydroelastic.fem.adaptive import ErrorEstimate, adaptive_solve
from hydroelastic.fem.tank.error_estimates import FrequencyErrors, refined
from hydroelastic.fem.tank.resolution import Resolution, sharpest_exponent, workable_tolerance
from hydroelastic.physics.tank import Tank

Result = TypeVar("Result")


@dataclass(frozen=True, kw_only=True)
class Attempt(Generic[Result]):
    """A result with its estimated errors.

    Attributes:
        result: the result.
        causes: its relative errors by cause.
        resolution: its resolution.
        missing: number of requested quantities that were not found.
    """

    result: Result
    causes: FrequencyErrors
    resolution: Resolution
    missing: int = 0

    @property
    def error(self) -> float:
        """The largest error."""
        return self.causes.largest_total


def best_attempt(
    tank: Tank,
    tolerance: float,
    solve: Callable[[Resolution], Attempt[Result]],
    first: Resolution,
    *,
    rounds: int,
    infinite_frequency: bool = False,
    remesh: bool = True,
) -> Attempt[Result]:
    """Return the first attempt whose error is below a tolerance, or the best of a few (collective)."""
    tolerance = workable_tolerance(tolerance, tank.depth)

    def finer(resolution: Resolution, attempt: Attempt[Result]) -> Resolution | None:
        # A finer model does not find missing quantities if the errors are small already.
        if attempt.error <= tolerance:
            return None
        exponent = sharpest_exponent(tank, infinite_frequency=infinite_frequency)
        return refined(resolution, attempt.causes, tolerance, exponent=exponent, remesh=remesh)

    def estimate(attempt: Attempt[Result]) -> ErrorEstimate:
        return ErrorEstimate(discretization=attempt.error, missing=attempt.missing)

    return adaptive_solve(first, solve, estimate, finer, tolerance, rounds=rounds).solution
