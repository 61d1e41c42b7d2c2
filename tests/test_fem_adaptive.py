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


def test_a_solution_is_returned_if_none_converges() -> None:
    found = integrated(1e-9, rounds=3)
    assert (found.converged, found.solution[0]) == (False, 4)
    stopped = adaptive_solve(
        1, trapezoids, lambda found: ErrorEstimate(discretization=found[2]), lambda *_: None, 1e-9, rounds=3
    )
    assert (stopped.converged, stopped.solution[0]) == (False, 1)


def refined_by_two(
    errors: dict[int, ErrorEstimate], *, rounds: int = 4, least_gain: float = 0.0
) -> tuple[AdaptiveSolution[int], list[int]]:
    """What is found on 1, 2, 4 … elements with given errors and a tolerance of ½, and on how many it was tried."""
    tried = []

    def solve(count: int) -> int:
        tried.append(count)
        if count not in errors:
            raise ArithmeticError
        return count

    found = adaptive_solve(
        1,
        solve,
        errors.__getitem__,
        lambda count, _found: 2 * count,
        0.5,
        rounds=rounds,
        least_gain=least_gain,
        failures=(ArithmeticError,),
    )
    return found, tried


def of(*errors: float, missing: tuple[int, ...] = (0, 0, 0, 0)) -> dict[int, ErrorEstimate]:
    return {
        2**place: ErrorEstimate(discretization=error, missing=lacked)
        for place, (error, lacked) in enumerate(zip(errors, missing, strict=False))
    }


@pytest.mark.parametrize(
    ("errors", "best"), [((4.0, 1.0, 3.0, 2.0), 2), ((1.0, 4.0, 3.0, 2.0), 1), ((4.0, 3.0, 2.0, 1.0), 8)]
)
def test_the_best_of_all_solutions_is_kept_if_none_converges(errors: tuple[float, ...], best: int) -> None:
    found, tried = refined_by_two(of(*errors))
    assert (found.solution, found.error.total, found.converged) == (best, 1.0, False)
    assert tried == [1, 2, 4, 8]


def test_a_solution_that_lacks_less_is_better_whatever_its_error() -> None:
    found, tried = refined_by_two(of(0.1, 4.0, 3.0, 0.2, missing=(1, 0, 0, 1)))
    # The first and the last are accurate enough, but not all that was asked for.
    assert (found.solution, found.converged, tried) == (4, False, [1, 2, 4, 8])
    found, tried = refined_by_two(of(0.1, 0.4, missing=(1, 0)))
    assert (found.solution, found.converged, tried) == (2, True, [1, 2])


def test_refinement_ends_where_errors_fall_too_little_or_a_solution_fails() -> None:
    grown, tried = refined_by_two(of(4.0, 1.0, 3.0, 0.4), least_gain=1.0)
    assert (grown.solution, tried) == (2, [1, 2, 4])
    # A third less is not enough, but better; what converges is enough, however little it gained.
    slow, tried = refined_by_two(of(4.0, 1.0, 0.7, 0.4), least_gain=1.5)
    assert (slow.solution, slow.converged, tried) == (4, False, [1, 2, 4])
    enough, _ = refined_by_two(of(0.6, 0.5), least_gain=1.5)
    assert (enough.solution, enough.converged) == (2, True)
    failed, tried = refined_by_two(of(4.0, 1.0))
    assert (failed.solution, tried) == (2, [1, 2, 4])
    with pytest.raises(ArithmeticError):
        refined_by_two({})


def test_nothing_is_refined_after_the_last_round() -> None:
    refinements = []
    adaptive_solve(
        1,
        trapezoids,
        lambda found: ErrorEstimate(discretization=found[2]),
        lambda count, _found: refinements.append(count) or 2 * count,  # type: ignore[func-returns-value]
        1e-9,
        rounds=3,
    )
    assert refinements == [1, 2]
