"""Whoever stops ./hydro stops what it started: signals arrive at the program, or the program ends with the launcher."""

import os
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

CHECKOUT = Path(__file__).resolve().parent.parent
# A program that ends at once when it is told; the limits are for a machine under load, an idle one needs milliseconds.
SECONDS_TO_START, SECONDS_TO_END = 30, 30

pytestmark = [
    pytest.mark.skipif(sys.platform != "linux", reason="the launcher is for Linux"),
    pytest.mark.skipif(shutil.which("setpriv") is None, reason="needs setpriv"),
]


@pytest.fixture
def start(tmp_path):
    """Start the launcher in an environment whose programs write their process number and how they are ended."""
    venv = tmp_path / "venv"
    (venv / "bin").mkdir(parents=True)
    for name in ("python", "mpirun", "ruff", "lint-imports"):
        (venv / "bin" / name).write_text(
            f'#!/bin/bash\ntrap "echo TERM >{tmp_path}/ended; exit" TERM\n'
            f"echo $$ >{tmp_path}/new && mv {tmp_path}/new {tmp_path}/number\nwhile true; do sleep 0.05; done\n"
        )
        (venv / "bin" / name).chmod(0o755)
    environment = {name: value for name, value in os.environ.items() if not name.startswith("HYDROELASTIC")}
    environment |= {"HYDROELASTIC_CACHE": str(tmp_path / "cache"), "HYDROELASTIC_INSIDE": str(venv)}
    environment["XDG_CACHE_HOME"] = str(tmp_path / "forms")
    launchers, programs = [], []

    def run(*command: str | Path, **variables: str) -> tuple[subprocess.Popen, int]:
        process = subprocess.Popen(
            command, env=environment | variables, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL
        )
        launchers.append(process)
        wait_until((tmp_path / "number").exists, SECONDS_TO_START)
        programs.append(int((tmp_path / "number").read_text()))
        return process, programs[-1]

    yield run
    for process in launchers:
        process.kill()
        process.wait()
    for number in filter(runs, programs):
        os.kill(number, signal.SIGKILL)


def wait_until(condition, seconds: float) -> None:
    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end, "waited in vain"
        time.sleep(0.02)


def runs(number: int) -> bool:
    """Whether a process exists and has not ended."""
    try:
        return Path(f"/proc/{number}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except OSError:
        return False


@pytest.mark.parametrize("arguments", [("run", "aquarium"), ("python", "-c", ""), ("exec", "python")])
def test_program_takes_the_place_of_the_launcher(start, arguments):
    process, program = start(CHECKOUT / "hydro", *arguments)
    assert program == process.pid
    process.kill()
    process.wait(SECONDS_TO_END)


@pytest.mark.parametrize("sent", [signal.SIGTERM, signal.SIGKILL])
@pytest.mark.parametrize("arguments", [("mpirun", "-n", "2"), ("test",), ("docs",), ("lint",), ("env",)])
def test_program_ends_with_the_launcher(start, tmp_path, arguments, sent):
    process, program = start(CHECKOUT / "hydro", *arguments)
    process.send_signal(sent)
    process.wait(SECONDS_TO_END)
    wait_until(lambda: not runs(program), SECONDS_TO_END)
    assert (tmp_path / "ended").read_text() == "TERM\n"


# What each of them does with its options.
OPTIONS = {"proot": "while [[ $1 == -? ]]; do shift 2; done", "bwrap": "until [[ $1 == -- ]]; do shift; done; shift"}


@pytest.mark.parametrize("sent", [signal.SIGTERM, signal.SIGKILL])
@pytest.mark.parametrize("entry", OPTIONS)
def test_program_below_another_ends_with_the_launcher(start, tmp_path, entry, sent):
    # Like both: starts the program as its child, does not pass signals on, and leaves it alone when it is killed.
    program = tmp_path / entry
    program.write_text(f'#!/bin/bash\ntrap : TERM\n{OPTIONS[entry]}\n"$@"\n')
    program.chmod(0o755)
    code = """
        checkout=$1 way=root entry=${2##*/} entry_program=$2 root=$3 cache=$3
        for file in messages variables enter; do source "$checkout/launcher/$file.sh"; done
        exec_inside "$3/venv/bin/python"
    """
    process, program = start("bash", "-euc", code, "bash", CHECKOUT, program, tmp_path)
    process.send_signal(sent)
    process.wait(SECONDS_TO_END)
    wait_until(lambda: not runs(program), SECONDS_TO_END)
    assert (tmp_path / "ended").read_text() == "TERM\n"
