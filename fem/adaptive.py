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
    """

    discretization: float
    rounding: float = 0.0

    @property
    def total(self) -> float:
        """Both parts together."""
        return self.discretization + self.rounding

    def within(self, tolerance: float) -> bool:
        """Whether the error is below a tolerance, or no refinement reduces it: most of it is rounding."""
        return self.discretization <= max(tolerance - self.rounding, self.rounding)


@dataclass(frozen=True, kw_only=True)
class AdaptiveSolution(Generic[Solution]):
    """The result of an adaptive solution.

    Attributes:
        solution: the last one, or the last one whose error fell.
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
    while_error_falls: bool = False,
    failures: tuple[type[Exception], ...] = (),
) -> AdaptiveSolution[Solution]:
    """Solve on successively refined discretizations until the estimated error is within a tolerance.

    Args:
        start: the first discretization: a mesh, a degree, a step in time.
        solve: solves on a discretization; the solution holds what `estimate` and `refine` need.
        estimate: the error of a solution.
        refine: the next discretization by the last one and its solution, or ``None`` if that would be too large.
        tolerance: in the units of the estimate.
        rounds: largest number of solutions, at least 1.
        while_error_falls: whether to stop with the solution before at the first whose error is not smaller.
        failures: errors of `solve` that end the refinement with the solution before; those of the first round are
            raised.

    Returns:
        The solution (collective, as `solve` is); see whether it converged.
    """
    best: AdaptiveSolution[Solution] | None = None
    discretization = start
    for done in range(rounds):
        try:
            solution = solve(discretization)
        except failures:
            if best is None:
                raise
            return best
        error = estimate(solution)
        if while_error_falls and best is not None and error.total >= best.error.total:
            return best
        best = AdaptiveSolution(solution=solution, error=error, converged=error.within(tolerance))
        finer = None if best.converged or done == rounds - 1 else refine(discretization, solution)
        if finer is None:
            return best
        discretization = finer
    raise ValueError(f"rounds is {rounds}: there must be one at least")
