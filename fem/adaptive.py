"""Adaptive solution: solve, estimate the error, refine, until a tolerance is reached."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Generic, TypeVar

Discretization = TypeVar("Discretization")
Solution = TypeVar("Solution")


@dataclass(frozen=True, kw_only=True)
class ErrorEstimate:
    """An estimated error, in the units of the tolerance.

    Attributes:
        discretization: the part that refinement reduces.
        rounding: the part that it does not.
        missing: how many of the things that were asked for a solution lacks, or cannot vouch for, whatever its error.
    """

    discretization: float
    rounding: float = 0.0
    missing: int = 0

    @property
    def total(self) -> float:
        """Both parts together."""
        return self.discretization + self.rounding

    @property
    def shortfall(self) -> tuple[int, float]:
        """What is missing, then the error: of two solutions that with the smaller one is the better."""
        return self.missing, self.total

    def within(self, tolerance: float) -> bool:
        """Whether nothing is missing, and the error is below a tolerance or, mostly rounding, not to be reduced."""
        return not self.missing and self.discretization <= max(tolerance - self.rounding, self.rounding)


@dataclass(frozen=True, kw_only=True)
class AdaptiveSolution(Generic[Solution]):
    """The result of an adaptive solution.

    Attributes:
        solution: the first one within the tolerance, or the best one.
        error: its estimated error.
        converged: whether that is within the tolerance.
    """

    solution: Solution
    error: ErrorEstimate
    converged: bool


def adaptive_solve(
    start: Discretization,
    solve: Callable[[Discretization], Solution],
    estimate: Callable[[Solution], ErrorEstimate],
    refine: Callable[[Discretization, Solution], Discretization | None],
    tolerance: float,
    *,
    rounds: int,
    least_gain: float = 0.0,
    failures: tuple[type[Exception], ...] = (),
) -> AdaptiveSolution[Solution]:
    """Solve on successively refined discretizations until the error is within a tolerance, or keep the best
    solution."""
    best: AdaptiveSolution[Solution] | None = None
    discretization = start
    for left in reversed(range(rounds)):
        try:
            solution = solve(discretization)
        except failures:
            if best is None:
                raise
            break
        error = estimate(solution)
        found = AdaptiveSolution(solution=solution, error=error, converged=error.within(tolerance))
        if found.converged:
            return found
        stuck = best is not None and least_gain * error.total > best.error.total
        if best is None or error.shortfall < best.error.shortfall:
            best = found
        finer = None if stuck or not left else refine(discretization, solution)
        if finer is None:
            break
        discretization = finer
    if best is None:
        raise ValueError(f"rounds is {rounds}: there must be one at least")
    return best
