"""The benchmarks run on their smallest cases, keep the tolerances that they ask for, and refuse in words."""

import csv
import runpy
import subprocess
import sys
from pathlib import Path

import pytest
from command import run_command

COMMITTED = Path(__file__).parent.parent / "results" / "benchmarks"
TABLES = {file.stem: file for file in COMMITTED.glob("*.csv")}
# Rows whose tolerance is not one of their error: in motion that of positions, beside the error of a tension.
OTHERWISE = {("thread field", "jumper moved")}


def bench(*arguments: str, folder: Path) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-m", "hydroelastic.benchmarks", *arguments]
    return subprocess.run(command, cwd=folder, capture_output=True, encoding="utf-8", timeout=600, check=False)


def rows_of(file: Path) -> list[dict[str, str]]:
    with file.open(encoding="utf-8", newline="") as opened:
        return list(csv.DictReader(opened))


def kept(rows: list[dict[str, str]]) -> list[bool]:
    """Of each row that asks for a tolerance whether its error is within it."""
    asked = [row for row in rows if row["tolerance"] and not OTHERWISE & {(row["code"], row.get("thread", ""))}]
    return [float(row["error"]) <= float(row["tolerance"]) for row in asked]


@pytest.mark.slow_but("tanks")
@pytest.mark.parametrize("problem", ["tanks", "sweeps", "circle", "string", "thread", "basin", "buoys"])
def test_each_problem_runs_on_its_smallest_case(problem: str, tmp_path: Path) -> None:
    ended = bench("--problem", problem, "--quick", "--repeats", "1", "--no-install", "--out", "out", folder=tmp_path)
    assert ended.returncode == 0, ended.stderr
    (table,) = (tmp_path / "out").glob("*.csv")
    assert (tmp_path / "out" / f"{table.stem}.md").stat().st_size > 500
    assert rows_of(table)
    assert kept(rows_of(table))
    assert all(kept(rows_of(table)))
    assert list(rows_of(table)[0]) == list(rows_of(TABLES[table.stem])[0])


@pytest.mark.parametrize("name", TABLES)
def test_committed_measurements_kept_their_tolerances(name: str) -> None:
    tolerances = kept(rows_of(TABLES[name]))
    assert tolerances
    assert all(tolerances)
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
