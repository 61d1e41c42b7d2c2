"""Many frequencies from few factorizations: a reduced basis that grows where its residual is largest.

Solutions at the ends and in the middle of a range begin the basis of `reduced_pencil`. The next full solution, by a
factorization, is made where the residual is largest, and gives the true error there. For functionals of second order
the error is proportional to the square of the residual; the largest of the last ratios of both estimates the error at
all other frequencies.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
from dataclasses import dataclass
from typing import Generic, TypeVar

import numpy as np

Solution = TypeVar("Solution")

FEW = 6
"""Largest number of frequencies that are all solved by factorizations, without a reduced basis."""

SHARE = 0.1
"""Part of the tolerance that is left to the reduced basis."""

# Number of frequencies at which the basis must be accurate before the others are checked.
_CANDIDATES = 24
# Part of that share below which a difference says nothing of the ratio.
_NEGLIGIBLE = 1e-3
# Safety factor of the ratio between frequencies.
_SAFETY = 3.0
# Number of last ratios in use: those of a basis that does not yet contain the solution are a thousand times larger, and
# would require too many solutions.
_RECENT = 6


@dataclass(frozen=True, kw_only=True)
class Problem(Generic[Solution]):
    """Functions that a sweep needs of a problem."""

    full: Callable[[complex], Solution]  # solves at a frequency by a factorization, and adds the solution to the basis
    # returns the solution at a frequency on the basis, and its relative residual
    reduced: Callable[[complex], tuple[Solution, float]]
    difference: Callable[[Solution, Solution], float]  # relative difference of a solution on the basis and the full one


@dataclass(frozen=True, kw_only=True)
class Swept(Generic[Solution]):
    """Solutions at all frequencies of a sweep."""

    solutions: list[Solution]  # in the order of the frequencies
    errors: np.ndarray  # estimated relative errors by the reduced basis, shape (frequencies,); zero for full solutions
    in_full: list[bool]  # whether each solution is a full one
    ratio: float  # relative error over the square of the residual, with its safety factor
    # returns the same at other frequencies, with further solutions in the basis where they are needed
    again: Callable[[np.ndarray], Swept[Solution]]


def sweep(problem: Problem[Solution], omegas: np.ndarray, tolerance: float) -> Swept[Solution]:
    """Solve at all frequencies to a relative tolerance."""

    def again(others: np.ndarray) -> Swept[Solution]:
        return sweep(problem, others, tolerance)

    if len(omegas) <= FEW:
        return Swept(
            solutions=[problem.full(complex(omega)) for omega in omegas],
            errors=np.zeros(len(omegas)),
            in_full=[True] * len(omegas),
            ratio=0.0,
            again=again,
        )
    order = [int(place) for place in np.argsort(np.abs(omegas))]
    full = {place: problem.full(complex(omegas[place])) for place in (order[0], order[len(order) // 2], order[-1])}
    found: dict[int, tuple[Solution, float]] = {}
    ratios: deque[float] = deque(maxlen=_RECENT)
    # The largest residual of a solution that is accurate far beyond the need.
    accurate = 0.0

    def error(place: int) -> float:
        if found[place][1] <= accurate:
            return _SAFETY * _NEGLIGIBLE * SHARE * tolerance
        return _SAFETY * max(ratios, default=0.0) * found[place][1] ** 2

    def is_good(place: int) -> bool:
        return place in found and 0.0 < error(place) <= SHARE * tolerance

    for candidates in (order[:: max(len(order) // _CANDIDATES, 1)], order):
        while poor := [place for place in candidates if place not in full and not is_good(place)]:
            found |= {place: problem.reduced(complex(omegas[place])) for place in poor}
            worst = max(poor, key=lambda place: found[place][1])
            if is_good(worst):
                continue
            full[worst] = problem.full(complex(omegas[worst]))
            difference = problem.difference(found[worst][0], full[worst])
            if difference > _NEGLIGIBLE * SHARE * tolerance:
                ratios.append(difference / max(found[worst][1], np.finfo(float).eps) ** 2)
            else:
                # Its ratio would be that of rounding.
                accurate = max(accurate, found[worst][1])
    errors = np.zeros(len(omegas))
    solutions: list[Solution] = []
    for place in range(len(omegas)):
        if place in full:
            solutions.append(full[place])
        else:
            solutions.append(found[place][0])
            errors[place] = error(place)
    return Swept(
        solutions=solutions,
        errors=errors,
        in_full=[place in full for place in range(len(omegas))],
        ratio=_SAFETY * max(ratios, default=_NEGLIGIBLE * SHARE * tolerance / max(accurate, np.finfo(float).eps) ** 2),
        again=again,
    )
