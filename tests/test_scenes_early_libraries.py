"""Libraries that are loaded in a thread are those of their modules, which are not imported by it."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

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


@pytest.mark.skipif(not Path("/proc/self/maps").exists(), reason="the system does not tell what is loaded")
def test_libraries_are_there_before_their_modules_are_imported() -> None:
    ended = subprocess.run([sys.executable, "-c", PROGRAM], capture_output=True, text=True, check=False, timeout=60)
    assert ended.returncode == 0, ended.stderr
