"""Runs of volumes: what a killed process leaves, an error of one process, and the parts that each process writes."""

from __future__ import annotations

import signal
import subprocess
import sys
from pathlib import Path

import pytest
import pyvista

from hydroelastic.scenes.read import read_scene
from hydroelastic.scenes.run import run_scene

# Starts the command with a function of the project in place of its own.
_START = """
import os, signal, sys
from functools import partial
from pathlib import Path
from mpi4py import MPI
from hydroelastic.fem import checkpoint
from hydroelastic.fem.volume import resolution, solve
from hydroelastic.scenes.__main__ import start

folder, how = Path(sys.argv.pop(1)), sys.argv.pop(1)
checkpoint.cache_folder = lambda: folder
resolution.DIRECT_UNKNOWNS = solve.DIRECT_UNKNOWNS = 0
solve.direct_or_multigrid = partial(solve.direct_or_multigrid, largest=0)
product, meshed = checkpoint.Checkpoint.product, solve.distributed_volume

def ended(self, *arguments):
    product(self, *arguments)
    if how == "killed" and self._number == 10:
        os.kill(os.getpid(), signal.SIGKILL)
    print(f"{self.read} of {self._number} read", file=sys.__stderr__, flush=True)

def failing(*arguments):
    if how == "failing" and MPI.COMM_WORLD.rank == 1:
        raise OSError("the disk is gone")
    return meshed(*arguments)

checkpoint.Checkpoint.product, solve.distributed_volume = ended, failing
start()
"""
_ASKED = ("run", "sloping_basin", "--no-images", "--set", "accuracy.tolerance=1e-2", "--set", "accuracy.modes=2")


def started(folder: Path, how: str, *before: str) -> subprocess.CompletedProcess[str]:
    """Run a scene into a folder, under another command if one is given."""
    script = folder / "start.py"
    script.write_text(_START)
    command = [*before, sys.executable, str(script), str(folder), how, *_ASKED, "--out", str(folder / "out")]
    return subprocess.run(command, capture_output=True, text=True, timeout=240, check=False)


@pytest.mark.slow
def test_a_run_that_is_killed_goes_on_from_its_last_product(tmp_path: Path) -> None:
    assert started(tmp_path, "killed").returncode == -signal.SIGKILL
    assert not (tmp_path / "out").exists()
    whole = started(tmp_path, "whole")
    assert whole.returncode == 0, whole.stderr
    # The first ten products are read, all others made.
    last = [line for line in whole.stderr.splitlines() if line.endswith("read")][-1]
    assert last.startswith("10 of "), last


@pytest.mark.slow
def test_an_error_of_one_process_ends_all_with_a_message(tmp_path: Path) -> None:
    """The other one waits for the mesh, without end."""
    ended = started(tmp_path, "failing", "mpirun", "-n", "2")
    assert ended.returncode != 0
    assert "the disk is gone" in ended.stderr
    assert "process 1 of 2 has failed, see above; all processes end" in ended.stderr


@pytest.mark.mpi
@pytest.mark.only_on_ranks
def test_each_process_writes_its_part_of_the_volume(tmp_path: Path) -> None:
    """Of a box of 30 m × 12 m × 6 m without the barge, 12 m × 5 m × 1.5 m; a quarter of it is solved."""
    from mpi4py import MPI

    folder = MPI.COMM_WORLD.bcast(tmp_path) / "result"
    scene = read_scene("barge_in_a_dock", ("accuracy.tolerance=5e-2", "accuracy.modes=1"))
    summary = run_scene(scene, out=folder, images=None).summary
    assert summary["size"]["memory_of_a_process"] < summary["memory_peak"]
    MPI.COMM_WORLD.Barrier()
    parts = [pyvista.read(file) for file in sorted(folder.glob("fields/volume/*.vtu"))]
    assert len(parts) == MPI.COMM_WORLD.size
    whole = pyvista.read(folder / "fields" / "volume.pvtu")
    assert whole.n_cells == sum(part.n_cells for part in parts)
    # Straight cells fill it to rounding.
    assert whole.compute_cell_sizes()["Volume"].sum() == pytest.approx(30.0 * 12.0 * 6.0 - 12.0 * 5.0 * 1.5, rel=1e-9)
    assert all(part["potential_001"].any() for part in parts)
