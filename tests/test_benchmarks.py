"""The benchmarks run on their smallest cases, keep the tolerances that they ask for, and refuse in words."""

import csv
import re
import runpy
import subprocess
import sys
from math import isnan
from pathlib import Path

import pytest
from command import run_command

from hydroelastic.benchmarks.problems import PROBLEMS, Method, Problem
from hydroelastic.benchmarks.runner import COLUMNS, measure, seconds_at

COMMITTED = Path(__file__).parent.parent / "results" / "benchmarks"
TABLES = {problem.file: COMMITTED / f"{problem.file}.csv" for problem in PROBLEMS.values()}
# In motion the tolerance is one of positions, beside the error of a tension.
OTHERWISE = "jumper moved"


def bench(*arguments: str, folder: Path) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-m", "hydroelastic.benchmarks", *arguments]
    return subprocess.run(command, cwd=folder, capture_output=True, encoding="utf-8", timeout=600, check=False)


def rows_of(file: Path) -> list[dict[str, str]]:
    with file.open(encoding="utf-8", newline="") as opened:
        return list(csv.DictReader(opened))


def kept(rows: list[dict[str, str]]) -> list[bool]:
    """Of each row that asks this solver for a tolerance whether its error is within it."""
    own = {method.name for problem in PROBLEMS.values() for method in problem.methods if method.own}
    asked = [row for row in rows if row["method"] in own and "tolerance" in row["resolution"]]
    return [float(row["error"]) <= float(row["resolution"].split()[-1]) for row in asked if row["case"] != OTHERWISE]


@pytest.mark.slow_but("tanks")
@pytest.mark.parametrize("problem", PROBLEMS)
def test_each_problem_runs_on_its_smallest_case(problem: str, tmp_path: Path) -> None:
    ended = bench("--problem", problem, "--quick", "--repeats", "1", "--no-install", "--out", "out", folder=tmp_path)
    assert ended.returncode == 0, ended.stderr
    (table,) = (tmp_path / "out").glob("*.csv")
    assert table.with_suffix(".md").stat().st_size > 500
    assert table.with_suffix(".png").exists() == (problem != "start")
    rows = rows_of(table)
    assert tuple(rows[0]) == COLUMNS
    assert kept(rows)
    assert all(kept(rows))


def test_a_peer_that_is_not_installed_is_a_row() -> None:
    methods = (
        Method("here", "ours:command", ({"arguments": ["-c", "pass"]},)),
        Method("elsewhere", "nowhere:solve", ({"degree": 2},), peer="ngsolve_of_another_world"),
        Method("broken", "ours:command", ({"arguments": ["-c", "raise SystemExit(3)"]},)),
    )
    problem = Problem("", "", "", {"only": {}}, methods, base="here")
    rows = measure(problem, "", quick=False, repeats=2, install=False, report=str)
    told = {row["method"]: row for row in rows}
    assert told["here"]["rounds"] == 2
    assert 0.0 < told["here"]["seconds"] < told["here"]["clock"] + 0.1
    assert re.search("not measured.*ngsolve_of_another_world", told["elsewhere"]["note"])
    assert "not measured: CalledProcessError" in told["broken"]["note"]


def test_seconds_at_equal_error_are_those_of_the_best_measurements() -> None:
    points = ((1.0, 1e-2), (2.0, 1e-1), (4.0, 1e-6))
    rows = [{"seconds": seconds, "error": error} for seconds, error in points]
    # Half of the way in both logarithms; the second row is surpassed by the first.
    assert seconds_at(rows, 1e-4) == pytest.approx(2.0, rel=1e-12)
    assert seconds_at(rows, 1.0) == pytest.approx(1.0, rel=1e-12)
    assert isnan(seconds_at(rows, 1e-7))


@pytest.mark.parametrize("name", TABLES)
def test_committed_measurements_kept_their_tolerances(name: str) -> None:
    rows = rows_of(TABLES[name])
    assert kept(rows)
    assert all(kept(rows))
    methods = {method.name for problem in PROBLEMS.values() if problem.file == name for method in problem.methods}
    assert {row["method"] for row in rows} == methods
    assert all(float(row["seconds"]) > 0.0 for row in rows)
    assert TABLES[name].with_suffix(".md").stat().st_size > 500


def test_pages_have_the_tables_of_the_committed_measurements() -> None:
    pages = runpy.run_path(str(COMMITTED.parent / "page_tables.py"))["pages"]()
    assert {page.name for page in pages} == {"speed_against_error.md", "performance.md"}
    for page, content in pages.items():
        assert page.read_text(encoding="utf-8") == content


@pytest.mark.parametrize("arguments", [["--repeats", "0"], ["--fast"], ["aquarium"], ["--problem", "sea"]])
def test_bad_arguments_are_refused_at_once(arguments: list[str]) -> None:
    result = run_command("bench", *arguments)
    assert result.exit_code == 2
    assert "Error" in result.stderr


def test_a_folder_that_cannot_be_written_is_one_line(tmp_path: Path) -> None:
    (tmp_path / "file").touch()
    ended = bench("--out", "file", folder=tmp_path)
    assert (ended.returncode, ended.stdout, ended.stderr.count("\n")) == (2, "", 1)
    assert "file" in ended.stderr
    assert "--out" in ended.stderr


def test_no_other_folder_imports_the_benchmark_or_its_peers() -> None:
    program = (
        "import sys, hydroelastic.scenes.command_line, hydroelastic.modal\n"
        "names = ('ngsolve', 'netgen', 'skfem', 'capytaine', 'moorpy', 'moordyn', 'hydroelastic.benchmarks')\n"
        "print(*(name for name in sys.modules if name.startswith(names)))\n"
    )
    ended = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=False)
    assert (ended.returncode, ended.stdout, ended.stderr) == (0, "\n", "")
