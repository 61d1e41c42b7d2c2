"""Memory of a piece of work is its own: neither that of earlier work nor a peak that only grows."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from mpi4py import MPI

from hydroelastic.fem import memory
from hydroelastic.fem.memory import peak_memory

pytestmark = pytest.mark.skipif(not Path("/proc/self/clear_refs").exists(), reason="only Linux resets a peak")


def peak_of(megabytes: int) -> float:
    with peak_memory(MPI.COMM_SELF) as use:
        np.ones(megabytes * 125_000)  # written, so that it is resident
    assert use.peak is not None
    return use.peak / 1e6


def test_a_peak_is_that_of_the_work_alone() -> None:
    # Pages, and what Python itself takes: a megabyte.
    assert peak_of(200) == pytest.approx(200.0, abs=2.0)


def test_nothing_is_told_where_the_peak_cannot_be_reset(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setattr(memory, "_RESET", tmp_path / "no folder" / "clear_refs")
    with peak_memory(MPI.COMM_SELF) as use:
        pass
    assert use.peak is None


# Prints what was found, and what is told.
OF_VOLUME = """
import sys
from mpi4py import MPI
from hydroelastic.fem.memory import peak_memory
from hydroelastic.fem.volume.memory import memory_needed
from hydroelastic.fem.volume.solve import solve_volume
from hydroelastic.scenes.models.level_tank_physics import physical_level_tank
from hydroelastic.scenes.read import read_scene

scene = read_scene(sys.argv[1])
asked, tank = scene.accuracy, physical_level_tank(scene).scaled()
with peak_memory(MPI.COMM_SELF) as use:
    found = solve_volume(tank, tolerance=asked.tolerance, count=asked.modes, comm=MPI.COMM_SELF)
model, layers = found.model, bool(found.model.resolution.sizes.layers)
size, degree = model.liquid.size, model.resolution.degree
print(found.attempts, use.peak, memory_needed(size, degree, asked.modes, problems=model.images, factorized=layers))
"""


@pytest.mark.slow
@pytest.mark.parametrize("name", ["sloping_basin", "barge_in_a_dock", "scow_in_a_basin"])
def test_memory_told_in_advance_of_a_volume_is_enough_and_little_more(name: str) -> None:
    """Of two, four problems and one; measured 1.14, 1.04 and 1.12, of the last one. In a process of its own, for one
    that has solved other tanks has memory to spare."""
    command = [sys.executable, "-c", OF_VOLUME, name]
    attempts, peak, told = map(
        float, subprocess.run(command, capture_output=True, text=True, check=True).stdout.split()
    )
    assert attempts <= 2
    # Compiled forms, 0.02 GiB, may be there before.
    assert peak <= told <= 1.3 * (peak + 0.02 * 2**30)
