"""Many frequencies from few factorizations: a reduced basis that grows where it is worst, until it need not grow.

Solutions at the ends and in the middle of a range begin the basis of `fem.reduced_pencil`. Wherever the residual between
them is largest the problem is solved in full next, which tells the true error there; for what is a functional of second
order the error goes like the square of the residual, and the ratio of the two, the largest that was seen, carries it to
all other frequencies.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Generic, TypeVar

import numpy as np

Solution = TypeVar("Solution")

FEW = 6
"""So many frequencies are solved in full, each by itself."""

# Part of the tolerance that is left to the reduced basis.
_SHARE = 0.1
# A ratio that was seen at a few frequencies may be larger at others.
_SAFETY = 3.0


@dataclass(frozen=True, kw_only=True)
class Problem(Generic[Solution]):
    """What a sweep needs of a problem.

    Attributes:
        full: solves at a frequency, and takes the solution into the basis.
        reduced: the solution at a frequency on the basis, and its relative residual.
        difference: relative difference of a solution on the basis and the one in full.
    """

    full: Callable[[float], Solution]
    reduced: Callable[[float], tuple[Solution, float]]
    difference: Callable[[Solution, Solution], float]


@dataclass(frozen=True, kw_only=True)
class Swept(Generic[Solution]):
    """Solutions at all frequencies of a sweep.

    Attributes:
        solutions: in the order of the frequencies.
        errors: estimated relative errors by the reduced basis; zero where it was solved in full.
        in_full: whether each was.
    """

    solutions: list[Solution]
    errors: np.ndarray
    in_full: list[bool]


def sweep(problem: Problem[Solution], omegas: np.ndarray, tolerance: float) -> Swept[Solution]:
    """Solve at all frequencies to a relative tolerance.

    Args:
        problem: what to solve.
        omegas: frequencies, in any order, all different.
        tolerance: asked relative error of what `Problem.difference` compares.
    """
    if len(omegas) <= FEW:
        return Swept(
            solutions=[problem.full(float(omega)) for omega in omegas],
            errors=np.zeros(len(omegas)),
            in_full=[True] * len(omegas),
        )
    order = np.argsort(omegas)
    known = {int(order[place]): None for place in (0, len(order) // 2, len(order) - 1)}
    full = {place: problem.full(float(omegas[place])) for place in known}
    ratio = 0.0
    while True:
        found = {place: problem.reduced(float(omega)) for place, omega in enumerate(omegas) if place not in full}
        residuals = {place: residual for place, (_, residual) in found.items()}
        if not residuals:
            break
        worst = max(residuals, key=lambda place: residuals[place])
        if ratio and _SAFETY * ratio * residuals[worst] ** 2 <= _SHARE * tolerance:
            break
        full[worst] = problem.full(float(omegas[worst]))
        difference = problem.difference(found[worst][0], full[worst])
        ratio = max(ratio, difference / max(residuals[worst], np.finfo(float).eps) ** 2)
    # The basis has grown since: its solutions are better than when they were judged.
    errors = np.zeros(len(omegas))
    solutions: list[Solution] = []
    for place in range(len(omegas)):
        if place in full:
            solutions.append(full[place])
        else:
            solutions.append(found[place][0])
            errors[place] = _SAFETY * ratio * residuals[place] ** 2
    return Swept(solutions=solutions, errors=errors, in_full=[place in full for place in range(len(omegas))])
