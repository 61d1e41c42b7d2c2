"""Short solutions of a study are repeated, and the quickest is kept; long ones are not."""

from dataclasses import replace

import pytest

from hydroelastic.fem.study.row import StudyRow
from hydroelastic.fem.study.steady import steadily_timed

ROW = StudyRow(
    family="geometric",
    degree=5,
    element_size=0.1,
    grading=None,
    tolerance=None,
    attempts=1,
    unknowns=100,
    errors=(1e-6,),
    floor=1e-12,
    estimate=None,
    reasons=(),
    seconds={},
    memory=None,
)


@pytest.mark.parametrize(
    ("seconds", "solved", "kept"), [([0.1, 0.09, 0.2], 3, 0.09), ([0.05, 3.0, 3.0], 3, 0.05), ([0.2, 0.01], 1, 0.2)]
)
def test_the_least_time_of_a_short_row_is_kept(seconds: list[float], solved: int, kept: float) -> None:
    taken: list[float] = []

    def solve(degree: int) -> StudyRow:
        taken.append(seconds[len(taken)])
        return replace(ROW, degree=degree, seconds={"mesh": 0.0, "solve": taken[-1]})

    row = steadily_timed(solve)(7)
    assert len(taken) == solved
    assert (row.degree, row.total_seconds) == (7, kept)


def test_a_mesh_that_is_too_coarse_is_solved_once() -> None:
    tried: list[None] = []

    def solve() -> StudyRow | None:
        tried.append(None)
        return None

    assert steadily_timed(solve)() is None
    assert len(tried) == 1
