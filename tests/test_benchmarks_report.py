"""Taking turns, seconds at equal error, and what is written."""

from __future__ import annotations

import csv
import io
import math
import platform
from collections import Counter
from pathlib import Path

import pytest
from PIL import Image

from hydroelastic.benchmarks.cases import CODES, Answer, Case, Code
from hydroelastic.benchmarks.equal_error import front, seconds_at, times_slower
from hydroelastic.benchmarks.measure import Benchmark, Solve, cases_of, measure
from hydroelastic.benchmarks.output import TANKS as OUTPUT
from hydroelastic.benchmarks.output import OutputError, check_folder, write_results
from hydroelastic.benchmarks.rows import Row
from hydroelastic.benchmarks.tank.cases import TANKS, tank_named
from hydroelastic.benchmarks.tank.report import CSV_COLUMNS, speed_csv, speed_markdown
from hydroelastic.benchmarks.turns import take_turns
from hydroelastic.benchmarks.workers import WorkerError

CASES = cases_of(tank_named("base_s0"), quick=True) + cases_of(tank_named("offcentre_s0"), quick=True)


def silent(_message: str) -> None:
    pass


def solver(seconds: float, error: float) -> Solve:
    """A code that answers at once, with a given error, and says how long it took."""

    def solve(case: Case) -> tuple[float, Answer]:
        frequencies = tuple(value * (1.0 + error) for value in tank_named(case.tank).frequencies)
        return seconds, Answer(values=frequencies, unknowns=100, stages={"mesh": seconds}, note="a note")

    return solve


def row(code: Code, seconds: float, error: float) -> Row:
    case = Case(code=code, tank="base_s0", variant="whole", degree=4)
    return Row(case=case, unknowns=1, error=error, seconds=(seconds,), stages={}, note="")


def test_cases_are_measured_equally_often_and_codes_alternate() -> None:
    turns = list(take_turns(CASES, 3))
    assert Counter(turns) == Counter((number, case) for number in range(4) for case in CASES)
    assert [case.tank for _, case in turns] == sorted(case.tank for _, case in turns)
    rounds = [number for number, case in turns if case.tank == "base_s0"]
    assert rounds == sorted(rounds)
    first = [case.code for number, case in turns if number == 0 and case.tank == "base_s0"]
    assert first[: len(CODES)] == list(CODES)
    assert len({next(case for number, case in turns if number == count) for count in range(4)}) == 4


def test_halves_are_measured_of_tanks_that_are_their_own_mirror_image() -> None:
    halved = {case.tank for tank in TANKS for case in cases_of(tank, quick=False) if case.variant == "halves"}
    assert halved == {"base_s0", "base_s1", "narrow_s1"}


def test_the_first_round_does_not_count() -> None:
    spent = iter([100.0, 1.0, 2.0, 4.0])
    case = CASES[0]

    def solve(case: Case) -> tuple[float, Answer]:
        return next(spent), solver(0.0, 1e-6)(case)[1]

    ((only,), failed) = measure([case], {case.code: solve}, repeats=3, report=silent)
    assert failed == {}
    assert (only.seconds, only.median, only.spread) == ((1.0, 2.0, 4.0), 2.0, 1.5)
    assert only.error == pytest.approx(1e-6, rel=1e-9)


def test_a_code_that_fails_is_left_out_and_named() -> None:
    def broken(case: Case) -> tuple[float, Answer]:
        raise WorkerError("it does not want to")

    solvers: dict[Code, Solve] = {"hydroelastic": solver(1.0, 1e-6), "ngsolve": broken}
    rows, failed = measure(CASES, solvers, repeats=1, report=silent)
    assert {row.case.code for row in rows} == {"hydroelastic"}
    assert failed.keys() == {"ngsolve"}
    assert "it does not want to" in failed["ngsolve"]


def test_a_front_holds_what_nothing_beats() -> None:
    points = [(1.0, 1e-2), (2.0, 1e-4), (3.0, 1e-3), (0.5, 1e-1), (2.0, 1e-5)]
    assert front(points) == ((0.5, 1e-1), (1.0, 1e-2), (2.0, 1e-5))


def test_seconds_between_measurements_follow_a_power_of_the_error() -> None:
    points = [(error**-0.25, error) for error in (1e-2, 1e-4, 1e-8)]
    for error in (1e-2, 3e-3, 1e-6, 1e-8):
        assert seconds_at(points, error) == pytest.approx(error**-0.25, rel=1e-12)


def test_seconds_are_not_guessed_beyond_the_measurements() -> None:
    points = [(1.0, 1e-2), (2.0, 1e-4)]
    assert seconds_at(points, 9e-5) is None
    assert seconds_at(points, 0.995e-4) == 2.0
    assert seconds_at([], 1e-5) is None
    # A worse answer would not be had in less.
    assert seconds_at(points, 1e-1) == 1.0


def test_ratios_compare_at_the_error_of_the_row() -> None:
    own = row("hydroelastic", 30.0, 1e-6)
    rows = [own, row("ngsolve", 1.0, 1e-4), row("ngsolve", 9.0, 1e-8), row("scikit-fem", 1.0, 1e-5)]
    assert times_slower(own, rows, "ngsolve") == pytest.approx(10.0)
    assert times_slower(own, rows, "scikit-fem") is None


@pytest.fixture
def benchmark_run() -> Benchmark:
    solvers: dict[Code, Solve] = {
        "hydroelastic": solver(0.4, 1e-6),
        "hydroelastic modes": solver(0.2, 1e-6),
        "ngsolve": solver(0.1, 1e-7),
        "lower bound": solver(0.01, 1e-6),
    }
    rows, _ = measure(CASES, solvers, repeats=2, report=silent)
    return Benchmark(
        rows=rows,
        not_measured={"scikit-fem": "pip ended with code 1"},
        versions={"ngsolve": {"NGSolve": "6.2"}},
        repeats=2,
    )


def test_the_table_has_all_rows_and_the_ratios(benchmark_run: Benchmark) -> None:
    rows = list(csv.DictReader(io.StringIO(speed_csv(benchmark_run))))
    assert tuple(rows[0]) == CSV_COLUMNS
    assert len(rows) == sum(case.code != "scikit-fem" for case in CASES)
    own = next(row for row in rows if row["code"] == "hydroelastic")
    assert float(own["times_ngsolve"]) == pytest.approx(4.0)
    assert float(own["times_lower_bound"]) == pytest.approx(40.0)
    assert own["times_scikit_fem"] == ""
    assert math.isclose(float(own["error"]), 1e-6, rel_tol=1e-9)


def test_the_page_says_what_was_not_measured_and_names_no_machine(benchmark_run: Benchmark) -> None:
    page = speed_markdown(benchmark_run)
    assert "scikit-fem: **not measured**: pip ended with code 1" in page
    assert "NGSolve 6.2" in page
    assert "| base_s0 | 1e-06 | 400.0 | 200.0 | 100.0 | — | 10.0 | 4.0 | — | 40.0 | 2.0 |" in page
    assert platform.node() not in page
    assert str(Path.home()) not in page


def test_results_replace_each_other_and_leave_other_files(benchmark_run: Benchmark, tmp_path: Path) -> None:
    folder = tmp_path / "new" / "results"
    check_folder(folder)
    assert not folder.exists()
    write_results(benchmark_run, folder, OUTPUT)
    (folder / "notes.txt").write_text("mine", encoding="utf-8")
    write_results(benchmark_run, folder, OUTPUT)
    assert {path.name for path in folder.iterdir()} == {
        f"{OUTPUT.name}.csv",
        f"{OUTPUT.name}.md",
        f"{OUTPUT.name}.png",
        "notes.txt",
    }
    with Image.open(folder / f"{OUTPUT.name}.png") as picture:
        assert min(picture.size) > 400


def test_a_folder_that_cannot_be_written_is_told_before_measuring(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("", encoding="utf-8")
    for folder in (tmp_path / "file", tmp_path / "file" / "below"):
        with pytest.raises(OutputError, match=r"cannot be written.*--out"):
            check_folder(folder)
