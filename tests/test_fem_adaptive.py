"""Adaptive solution: refines until the tolerance is reached, knows rounding, and keeps the best solution."""

from __future__ import annotations

import numpy as np
import pytest

from hydroelastic.fem.adaptive import AdaptiveSolution, ErrorEstimate, adaptive_solve

Found = tuple[int, float, float]


def trapezoids(count: int) -> Found:
    """∫₀¹ eˣ dx with count and twice as many intervals: the number, the better value, the difference."""
    first, second = (float(np.trapezoid(np.exp(np.linspace(0.0, 1.0, n + 1)), dx=1.0 / n)) for n in (count, 2 * count))
    return count, second, abs(first - second)


def integrated(
    tolerance: float, *, rounding: float = 0.0, rounds: int = 20
) -> AdaptiveSolution[tuple[int, float, float]]:
    return adaptive_solve(
        1,
        trapezoids,
        lambda found: ErrorEstimate(discretization=found[2], rounding=rounding),
        lambda count, _found: 2 * count,
        tolerance,
        rounds=rounds,
    )


@pytest.mark.parametrize("tolerance", [1e-3, 1e-6, 1e-9])
def test_the_first_discretization_within_the_tolerance_is_taken(tolerance: float) -> None:
    found = integrated(tolerance)
    count, value, difference = found.solution
    assert found.converged
    # The halves err by a third of the difference, e - 1 being exact; the mesh before would not have been enough.
    assert abs(value - (np.e - 1.0)) == pytest.approx(difference / 3.0, rel=0.01)
    assert difference <= tolerance < trapezoids(count // 2)[2]


def test_no_refinement_is_asked_for_below_rounding() -> None:
    # Of 1e-9, 1e-6 is rounding: as soon as the rest is not larger, finer meshes gain nothing.
    found = integrated(1e-9, rounding=1e-6)
    assert found.converged
    assert 1e-7 < found.error.discretization <= 1e-6
    assert found.error.total == pytest.approx(found.error.discretization + 1e-6)


def test_the_last_solution_is_returned_if_none_converges() -> None:
    found = integrated(1e-9, rounds=3)
    assert (found.converged, found.solution[0]) == (False, 4)
    stopped = adaptive_solve(
        1, trapezoids, lambda found: ErrorEstimate(discretization=found[2]), lambda *_: None, 1e-9, rounds=3
    )
    assert (stopped.converged, stopped.solution[0]) == (False, 1)


def test_the_best_solution_is_kept_where_errors_grow_or_a_solution_fails() -> None:
    errors = {1: 4.0, 2: 1.0, 4: 3.0}
    options = {"while_error_falls": True, "failures": (ArithmeticError,), "rounds": 9}

    def solve(errors: dict[int, float]) -> AdaptiveSolution[int]:
        def at(count: int) -> int:
            if count not in errors:
                raise ArithmeticError
            return count

        return adaptive_solve(
            1,
            at,
            lambda count: ErrorEstimate(discretization=errors[count]),
            lambda count, _found: 2 * count,
            0.5,
            **options,  # type: ignore[arg-type]
        )

    assert solve(errors).solution == 2
    assert solve({1: 4.0, 2: 1.0}).solution == 2
    with pytest.raises(ArithmeticError):
        solve({})
