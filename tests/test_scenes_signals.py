"""Signals end a run at once and in order: no traceback, no half result, nothing left behind.

The process sends a signal to itself when it imports a module or opens a file, so that the instant is always the same.
"""

import json
import os
import random
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

# Of a string: all that a run does, and little of it.
RUN = ["run", "string_ramp", "--no-images", "--out", "result"]
PROGRAM = """
import os, runpy, signal, sys
event, name, number = {event!r}, {name!r}, {number}
def send(happened, arguments):
    if happened == event and str(arguments[0]).endswith(name):
        os.kill(os.getpid(), number)
# Those of a terminal, whatever this process has inherited.
signal.signal(signal.SIGINT, signal.default_int_handler)
for other in (signal.SIGTERM, signal.SIGHUP):
    signal.signal(other, signal.SIG_DFL)
sys.argv = ["hydroelastic", *{arguments!r}]
sys.addaudithook(send)
runpy.run_module("hydroelastic.scenes", run_name="__main__")
"""
STARTED = [("import", "click"), ("import", "numpy"), ("import", "mpi4py.MPI"), ("import", "scipy.io._netcdf")]
WRITING = [("open", "response.csv"), ("open", "dataset.nc"), ("open", "summary.json")]
ENDING = [signal.SIGINT, signal.SIGTERM, signal.SIGHUP]


def ended_at(event: str, name: str, number: int, arguments: list[str] = RUN) -> subprocess.CompletedProcess[str]:
    program = PROGRAM.format(event=event, name=name, number=int(number), arguments=arguments)
    return subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=False, timeout=100)


@pytest.fixture(autouse=True)
def _in_an_empty_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)


@pytest.mark.slow_but("import-numpy", "open-dataset.nc")
@pytest.mark.parametrize(("event", "name"), STARTED + WRITING)
def test_ctrl_c_is_one_line_and_leaves_nothing(tmp_path: Path, event: str, name: str) -> None:
    ended = ended_at(event, name, signal.SIGINT)
    assert ended.stderr == "Interrupted: no result folder was written.\n"
    assert (ended.returncode, ended.stdout) == (128 + signal.SIGINT, "")
    assert list(tmp_path.rglob("*.partial")) + list(tmp_path.rglob("*.csv")) == []


def test_ctrl_c_in_a_sweep_says_that_solved_points_are_kept(tmp_path: Path) -> None:
    given = ["sweep", "swell", "--vary", "roll.damping_ratio=0.2,0.4", "--out", "result", "--no-images"]
    ended = ended_at("open", "sweep.csv", signal.SIGINT, given)
    kept = "Interrupted: the points solved so far are kept in result/; the same command goes on from there.\n"
    assert (ended.returncode, ended.stdout, ended.stderr) == (128 + signal.SIGINT, "", kept)
    assert len((tmp_path / "result" / "sweep.journal").read_text(encoding="utf-8").split()) > 2
    assert not (tmp_path / "result" / "sweep.csv").exists()


@pytest.mark.slow
@pytest.mark.parametrize("scene", ["open_circle", "aquarium"])
def test_a_reader_that_stops_is_no_crash(scene: str) -> None:
    """PETSc takes the signal of a broken pipe for one, and says so."""
    command = [sys.executable, "-m", "hydroelastic.scenes", "check", scene]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) as process:
        assert process.stdout is not None
        process.stdout.close()
        assert process.stderr is not None
        assert process.stderr.read() == ""
    assert process.returncode == 1


def test_ctrl_c_before_python_has_started_is_one_line() -> None:
    def pressed() -> None:
        signal.signal(signal.SIGINT, signal.SIG_DFL)
        signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGINT})
        os.kill(os.getpid(), signal.SIGINT)

    command = [sys.executable, "-m", "hydroelastic.scenes", *RUN]
    ended = subprocess.run(command, preexec_fn=pressed, capture_output=True, text=True, check=False, timeout=100)
    assert ended.stderr == "Interrupted: no result folder was written.\n"
    assert (ended.returncode, ended.stdout) == (128 + signal.SIGINT, "")


@pytest.mark.slow
@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGHUP])
@pytest.mark.parametrize(("event", "name"), [STARTED[2], WRITING[1]])
def test_other_signals_are_silent_and_leave_nothing(tmp_path: Path, event: str, name: str, number: int) -> None:
    ended = ended_at(event, name, number)
    # While nothing is written yet the system ends the process, which a parent sees as a negative code.
    assert ended.returncode in (128 + number, -number)
    assert (ended.stdout, ended.stderr) == ("", "")
    assert list(tmp_path.rglob("*.partial")) + list(tmp_path.rglob("*.csv")) == []


@pytest.mark.slow
@pytest.mark.parametrize("number", [*ENDING, signal.SIGKILL])
def test_a_signal_at_any_instant_leaves_the_old_or_the_new_result_whole(tmp_path: Path, number: int) -> None:
    command = [sys.executable, "-m", "hydroelastic.scenes", *RUN]

    def run() -> float:
        began = time.monotonic()
        subprocess.run(command, check=True, timeout=100, stdout=subprocess.DEVNULL)
        return time.monotonic() - began

    whole = max(run(), run())
    instants = random.Random(7)
    for _ in range(30):
        with subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True) as process:
            time.sleep(instants.uniform(0.05, whole))
            process.send_signal(number)
            said = process.communicate(timeout=100)[1]
        assert "Traceback" not in said
        listed = json.loads((tmp_path / "result" / "summary.json").read_text(encoding="utf-8"))
        assert all((tmp_path / "result" / name).is_file() for name in listed["files"])
        assert {path.name for path in tmp_path.iterdir()} == {"result"} or number == signal.SIGKILL
    run()
    assert os.listdir(tmp_path) == ["result"]
