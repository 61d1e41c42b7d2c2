"""The one loop: solve, estimate, refine by the largest causes, until a tolerance holds."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Protocol, Self, TypeVar

import numpy as np


class Refinable(Protocol):
    def refined(self, causes: Mapping[str, float]) -> Self | None:
        """A finer one for the causes of an error, each in parts of the tolerance; ``None`` where none is finer."""


class Estimated(Protocol):
    """A result with the largest errors by each cause and in all, and how many of the things asked for it lacks."""

    @property
    def causes(self) -> Mapping[str, float]: ...
    @property
    def error(self) -> float: ...
    @property
    def missing(self) -> int: ...


Result = TypeVar("Result", bound=Estimated)
Discretization = TypeVar("Discretization", bound=Refinable)


def solve_adaptive(
    first: Discretization, analysis: Callable[[Discretization], Result], tolerance: float, *, rounds: int = 6
) -> Result:
    """Return the first result within a tolerance, or the best of a few (collective)."""
    best: Result | None = None
    discretization: Discretization | None = first
    for _ in range(rounds):
        if discretization is None:
            break
        found = analysis(discretization)
        if best is None or (found.missing, found.error) < (best.missing, best.error):
            best = found
        if not found.missing and found.error <= tolerance:
            break
        discretization = discretization.refined({cause: error / tolerance for cause, error in found.causes.items()})
    assert best is not None
    return best


def largest(errors: np.ndarray, causes: tuple[str, ...]) -> dict[str, float]:
    """The largest error by each cause, from errors of shape (causes, values)."""
    return {
        cause: float(np.nan_to_num(own, nan=1.0).max(initial=0.0)) for cause, own in zip(causes, errors, strict=True)
    }
