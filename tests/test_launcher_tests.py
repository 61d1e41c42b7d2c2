"""`./hydro test` runs pytest on everything, then the tests marked mpi under two ranks, and fails if either fails."""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

CHECKOUT = Path(__file__).resolve().parent.parent

pytestmark = pytest.mark.skipif(sys.platform != "linux", reason="the launcher is for Linux")


@pytest.fixture
def run(tmp_path):
    """Start `hydro test` of a small checkout; its Python and mpirun tell their arguments and end as told."""
    checkout, venv = tmp_path / "checkout", tmp_path / "venv"
    (checkout / "tests").mkdir(parents=True)
    (venv / "bin").mkdir(parents=True)
    for name in ("hydro", "pyproject.toml"):
        shutil.copy(CHECKOUT / name, checkout)
    for name in ("launcher", "requirements"):
        shutil.copytree(CHECKOUT / name, checkout / name)
    (checkout / "tests" / "test_some.py").touch()
    programs = {
        "python": '#!/bin/sh\necho "pytest: $*"\nexit ${PYTEST_ENDS:-0}\n',
        # -n 2 sh SCRIPT FOLDER, then what goes to pytest.
        "mpirun": '#!/bin/sh\nfolder=$5; shift 5\necho "mpi: $*"\n'
        "echo ${RANK_0_ENDS:-0} >$folder/status-0\necho ${RANK_1_ENDS:-0} >$folder/status-1\n"
        "echo said by rank 1 >$folder/output\n",
    }
    for name, text in programs.items():
        (venv / "bin" / name).write_text(text)
        (venv / "bin" / name).chmod(0o755)

    def start(*arguments: str, folder: Path = tmp_path, **variables: str):
        environment = {name: value for name, value in os.environ.items() if not name.startswith("HYDROELASTIC")}
        environment |= {"HYDROELASTIC_CACHE": str(tmp_path / "cache"), "HYDROELASTIC_INSIDE": str(venv)}
        environment["XDG_CACHE_HOME"] = str(tmp_path / "forms")
        return subprocess.run(
            [checkout / "hydro", "test", *arguments],
            env=environment | variables,
            cwd=folder,
            capture_output=True,
            text=True,
            timeout=30,
        )

    return start


@pytest.mark.parametrize("arguments", [(), ("-q",), ("-x", "-q", "--tb=short")])
def test_both_runs_without_a_selection(run, arguments):
    ended = run(*arguments)
    serial, parallel = ended.stdout.splitlines()
    assert ended.returncode == 0
    assert serial.startswith("pytest: -m pytest ")
    assert parallel.startswith("mpi: ")
    assert parallel.endswith(" -m mpi and (not slow)")
    assert all(flag in serial and flag in parallel for flag in arguments)


def test_markers_hold_for_both_runs(run):
    serial, parallel = run("-m", "slow").stdout.splitlines()
    assert serial.endswith(" -m slow")
    assert parallel.endswith(" -m mpi and (slow)")


def test_all_runs_the_slow_tests_too_on_one_rank_and_on_two(run, tmp_path):
    tests = tmp_path / "checkout" / "tests"
    (tests / "test_ranks.py").write_text("@pytest.mark.mpi\n")
    serial, parallel = run("--all", "-q").stdout.split("\n")[:2]
    assert serial.endswith(" -m  -q")
    assert parallel.endswith(" -q -m mpi tests/test_ranks.py")
    selected = run("--all", "test_some.py", folder=tests)
    assert selected.stdout.rstrip().endswith(f" -m  {tests}/test_some.py")


def test_ranks_collect_only_the_files_with_tests_for_them(run, tmp_path):
    (tmp_path / "checkout" / "tests" / "test_ranks.py").write_text("pytestmark = [pytest.mark.mpi]\n")
    _, parallel = run().stdout.splitlines()
    assert parallel.endswith(" -m mpi and (not slow) tests/test_ranks.py")


def test_report_is_of_the_run_on_one_rank(run):
    serial, parallel = run("--junitxml=report.xml").stdout.splitlines()
    assert serial.endswith(" --junitxml=report.xml")
    assert "report.xml" not in parallel


@pytest.mark.parametrize("arguments", [("tests/test_some.py",), ("-k", "some"), ("--collect-only",)])
def test_selection_runs_once(run, arguments):
    ended = run(*arguments)
    assert [line.split(":")[0] for line in ended.stdout.splitlines()] == ["pytest"]


def test_paths_of_the_current_folder_are_understood(run, tmp_path):
    ended = run("test_some.py::test_one", folder=tmp_path / "checkout" / "tests")
    assert ended.stdout.rstrip().endswith(f"{tmp_path}/checkout/tests/test_some.py::test_one")


@pytest.mark.parametrize(
    ("variables", "code"),
    [
        ({"PYTEST_ENDS": "1"}, 1),
        ({"RANK_0_ENDS": "1"}, 1),
        ({"RANK_1_ENDS": "2"}, 2),
        ({"PYTEST_ENDS": "3", "RANK_0_ENDS": "1"}, 3),
        ({"RANK_0_ENDS": "5", "RANK_1_ENDS": "5"}, 0),
    ],
)
def test_fails_if_either_run_fails(run, variables, code):
    ended = run(**variables)
    assert ended.returncode == code
    assert len(ended.stdout.splitlines()) == 2
    rank_1_shown = "said by rank 1" in ended.stderr
    assert rank_1_shown == any(variables.get(f"RANK_{rank}_ENDS", "0") not in "05" for rank in (0, 1))


def test_no_test_under_ranks_is_told(run):
    ended = run(RANK_0_ENDS="5", RANK_1_ENDS="5")
    assert "no test marked mpi fits -m 'not slow'" in ended.stderr
