"""Libraries that are loaded in a thread are those of their modules, which it does not import; they disturb nothing."""

from __future__ import annotations

import os
import subprocess
import sys
from pathlib import Path

import pytest

from hydroelastic.scenes import early_libraries
from hydroelastic.scenes.program import RANK_VARIABLES

PROGRAM = """
import sys, threading
from pathlib import Path
from hydroelastic.scenes.early_libraries import DOLFINX, GMSH, MPI, load_early

load_early("missing.module", MPI, DOLFINX, GMSH)
for thread in threading.enumerate():
    if thread is not threading.current_thread():
        thread.join()

def loaded():
    return {line.split()[-1] for line in Path("/proc/self/maps").read_text().splitlines() if ".so" in line}

early = loaded()
assert not {MPI, "dolfinx", GMSH} & sys.modules.keys()
import dolfinx, gmsh, mpi4py.MPI
libraries = {mpi4py.MPI.__file__, dolfinx.cpp.__file__, *(name for name in loaded() if "libgmsh" in name)}
missing = {name for name in libraries if Path(name).resolve() not in {Path(one).resolve() for one in early}}
sys.exit(f"loaded late: {missing}" if missing else 0)
"""


UNCHANGED = """
import ctypes, sys, threading
from hydroelastic.scenes.early_libraries import MPI, load_early

libc = ctypes.CDLL(None)

def code():
    places = (ctypes.cast(getattr(libc, name), ctypes.c_void_p).value for name in ("sbrk", "mmap", "munmap", "madvise"))
    return [ctypes.string_at(place, 16) for place in places]

before = code()
load_early(MPI)
for thread in threading.enumerate():
    if thread is not threading.current_thread():
        thread.join()
import mpi4py.MPI
sys.exit("functions of libc were rewritten" if code() != before else 0)
"""


@pytest.mark.skipif(not Path("/proc/self/maps").exists(), reason="the system does not tell what is loaded")
def test_libraries_are_there_before_their_modules_are_imported() -> None:
    ended = alone(PROGRAM)
    assert ended.returncode == 0, ended.stderr


@pytest.mark.skipif(not Path("/proc/self/maps").exists(), reason="functions of libc are those of Linux")
def test_memory_that_python_uses_meanwhile_is_left_alone() -> None:
    ended = alone(UNCHANGED)
    assert ended.returncode == 0, ended.stderr


def test_processes_of_mpi_load_nothing_early(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("PMIX_RANK", "0")
    monkeypatch.setattr(early_libraries, "Thread", None)
    early_libraries.load_early("missing.module")


def alone(program: str) -> subprocess.CompletedProcess[str]:
    """Run a program in a process that is not one of several of MPI, whatever this one is."""
    environment = {name: value for name, value in os.environ.items() if name not in RANK_VARIABLES}
    return subprocess.run(
        [sys.executable, "-c", program], capture_output=True, text=True, check=False, timeout=60, env=environment
    )
