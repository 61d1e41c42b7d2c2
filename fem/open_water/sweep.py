"""Many frequencies from few factorizations: a reduced basis that grows where its residual is largest.

Solutions at the ends and in the middle of a range begin the basis of `fem.open_water.reduced_pencil`. Wherever the
residual between them is largest the problem is solved in full next, which tells the true error there. For functionals
of second order the error goes like the square of the residual, and the ratio of the two, the largest of those that were
seen last, carries it to all other frequencies.
"""

from __future__ import annotations

from collections import deque
from collections.abc import Callable
from dataclasses import dataclass
from typing import Generic, TypeVar

import numpy as np

Solution = TypeVar("Solution")

FEW = 6
"""So many frequencies are solved in full, each by itself."""

# Until the basis is good at so many frequencies the others are not looked at.
_CANDIDATES = 24
# Part of the tolerance that is left to the reduced basis.
_SHARE = 0.1
# A ratio that was seen at a few frequencies may be larger at others.
_SAFETY = 3.0
# So many ratios count, the last ones: those of a basis that has nothing of the solution yet are a thousand times
# larger, and would ask for solutions without end.
_RECENT = 6


@dataclass(frozen=True, kw_only=True)
class Problem(Generic[Solution]):
    """What a sweep needs of a problem.

    Attributes:
        full: solves at a frequency, and takes the solution into the basis.
        reduced: the solution at a frequency on the basis, and its relative residual.
        difference: relative difference of a solution on the basis and the one in full.
    """

    full: Callable[[complex], Solution]
    reduced: Callable[[complex], tuple[Solution, float]]
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
        omegas: frequencies, real or along a line in the complex plane, in any order, all different.
        tolerance: largest relative error that is accepted of what `Problem.difference` compares.
    """
    if len(omegas) <= FEW:
        return Swept(
            solutions=[problem.full(complex(omega)) for omega in omegas],
            errors=np.zeros(len(omegas)),
            in_full=[True] * len(omegas),
        )
    order = [int(place) for place in np.argsort(np.abs(omegas))]
    full = {place: problem.full(complex(omegas[place])) for place in (order[0], order[len(order) // 2], order[-1])}
    found: dict[int, tuple[Solution, float]] = {}
    ratios: deque[float] = deque(maxlen=_RECENT)

    def error(place: int) -> float:
        return _SAFETY * max(ratios, default=0.0) * found[place][1] ** 2

    def is_good(place: int) -> bool:
        return place in found and 0.0 < error(place) <= _SHARE * tolerance

    for candidates in (order[:: max(len(order) // _CANDIDATES, 1)], order):
        while poor := [place for place in candidates if place not in full and not is_good(place)]:
            found |= {place: problem.reduced(complex(omegas[place])) for place in poor}
            worst = max(poor, key=lambda place: found[place][1])
            if is_good(worst):
                continue
            full[worst] = problem.full(complex(omegas[worst]))
            difference = problem.difference(found[worst][0], full[worst])
            ratios.append(difference / max(found[worst][1], np.finfo(float).eps) ** 2)
    errors = np.zeros(len(omegas))
    solutions: list[Solution] = []
    for place in range(len(omegas)):
        if place in full:
            solutions.append(full[place])
        else:
            solutions.append(found[place][0])
            errors[place] = error(place)
    return Swept(solutions=solutions, errors=errors, in_full=[place in full for place in range(len(omegas))])
