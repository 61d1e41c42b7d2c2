"""Modes followed along a parameter: two coupled oscillators whose frequencies and shapes are known exactly."""

from collections.abc import Sequence

import numpy as np
import pytest

from hydroelastic.fem.sweep.encounters import Encounter, encounters
from hydroelastic.fem.sweep.follow import FollowedModes, follow
from hydroelastic.fem.sweep.mode_vectors import ModeVectors
from hydroelastic.fem.sweep.two_levels import approach

# λ = mean ± ½√(g² + s²(p − p₀)²), and a third mode above them.
MEAN, SLOPE, WHERE = 4.0, 1.5, 0.37
ERROR = 1e-9


def modes_at(p: float, gap: float, *, apart: bool = False) -> ModeVectors:
    """The modes of [[−s(p − p₀), g], [g, s(p − p₀)]]/2 + 4, and of a third oscillator; `apart` gives two symmetries."""
    shift = SLOPE * (p - WHERE)
    matrix = np.diag([MEAN - 0.5 * shift, MEAN + 0.5 * shift, 9.0])
    matrix[0, 1] = matrix[1, 0] = 0.5 * gap
    values, vectors = np.linalg.eigh(matrix)
    symmetry = np.sign(np.abs(vectors[0]) - 0.5) if apart else np.zeros(3)
    return ModeVectors(
        omega=np.sqrt(values),
        relative_error=np.full(3, ERROR),
        symmetry=symmetry,
        blocks={"body": vectors.T},
        participation=vectors[:1] ** 2,
        pressure_release=np.array([2.0]),
    )


def followed(gap: float, values: Sequence[float], *, apart: bool = False, most: int = 100) -> FollowedModes:
    def solve(points: Sequence[float]) -> list[ModeVectors]:
        return [modes_at(point, gap, apart=apart) for point in points]

    found = follow(values, solve(values), solve, count=2, most=most)
    assert found is not None
    return found


def only(found: FollowedModes) -> Encounter:
    (one,) = encounters(found)
    return one


def test_two_solutions_foresee_the_approach_of_two_frequencies() -> None:
    one, two = modes_at(0.1, 0.2), modes_at(0.9, 0.2)
    gaps = [float(np.diff(modes.omega[:2] ** 2)[0]) for modes in (one, two)]
    found = approach((0.1, 0.9), (gaps[0], gaps[1]), one.overlaps(two)[:2, :2])
    assert found is not None
    # Exact but for rounding.
    assert [found.at, found.gap, found.slope] == pytest.approx([WHERE, 0.2, SLOPE], rel=1e-12)


@pytest.mark.parametrize("gap", [0.3, 1e-2, 1e-4, 1e-6])
def test_a_veering_is_found_however_narrow_it_is(gap: float) -> None:
    found = followed(gap, [0.0, 0.25, 0.5, 0.75, 1.0])
    one = only(found)
    # ω₂ − ω₁ = g/2ω; the smallest gap that was solved is the exact one to second order in the distance from it.
    expected = np.sqrt(MEAN + 0.5 * gap) - np.sqrt(MEAN - 0.5 * gap)
    assert (one.kind, one.branches) == ("veering", (0, 1))
    assert one.at == pytest.approx(WHERE, abs=1e-3)
    assert one.gap == pytest.approx(expected, rel=1e-2)
    assert one.gap > one.gap_error
    # Modes of one symmetry keep their order.
    assert np.array_equal(found.branches, np.tile([0, 1, 2], (len(found.values), 1)))
    assert found.refined.sum() <= 12
    assert not found.exhausted


@pytest.mark.parametrize("apart", [True, False])
def test_a_crossing_is_told_from_a_veering(apart: bool) -> None:
    found = followed(0.0, [0.0, 0.25, 0.5, 0.75, 1.0], apart=apart)
    one = only(found)
    assert (one.kind, one.gap) == ("crossing", 0.0)
    assert one.reason == ("opposite symmetry" if apart else "no coupling within the errors")
    assert one.at == pytest.approx(WHERE, abs=1e-3)
    assert one.omega == pytest.approx(np.sqrt(MEAN), abs=1e-3)
    # Both ends of the step foresee it, and one solution there is enough.
    assert found.refined.sum() == 1
    # Each branch keeps its shape, so its order changes.
    assert found.participation(0)[:, 0] == pytest.approx(found.participation(0)[0, 0])
    assert found.branches[0].tolist() == [0, 1, 2]
    assert found.branches[-1].tolist() == [1, 0, 2]


def test_what_cannot_be_followed_is_said() -> None:
    found = followed(1e-4, [0.0, 0.25, 0.5, 0.75, 1.0], most=0)
    assert found.exhausted
    assert only(found).kind == "unresolved"


def test_points_without_solution_are_passed_over() -> None:
    values = [0.0, 0.25, 0.5, 0.75, 1.0]
    solved: list[ModeVectors | None] = [modes_at(value, 0.3) for value in values]
    solved[2] = None
    found = follow(values, solved, lambda points: [None for _ in points], count=2, most=10)
    assert found is not None
    assert found.values.tolist() == [0.0, 0.25, 0.75, 1.0]
