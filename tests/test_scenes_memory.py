"""Memory of a piece of work is its own: neither that of earlier work nor a peak that only grows."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from mpi4py import MPI

from hydroelastic.fem import memory
from hydroelastic.fem.memory import peak_memory
from hydroelastic.fem.volume.memory import memory_needed
from hydroelastic.fem.volume.solve import solve_volume
from hydroelastic.physics.volume_tank import VolumeTank
from hydroelastic.scenes.models.level_tank_physics import physical_level_tank
from hydroelastic.scenes.read import read_scene

pytestmark = pytest.mark.skipif(not Path("/proc/self/clear_refs").exists(), reason="only Linux resets a peak")


def peak_of(megabytes: int) -> float:
    with peak_memory(MPI.COMM_SELF) as use:
        np.ones(megabytes * 125_000)  # written, so that it is resident
    assert use.peak is not None
    return use.peak / 1e6


def test_a_peak_is_that_of_the_work_alone() -> None:
    # Pages, and what Python itself takes: a megabyte.
    assert peak_of(200) == pytest.approx(200.0, abs=2.0)
    assert peak_of(50) == pytest.approx(50.0, abs=2.0)
    kept = np.ones(10_000_000)
    assert peak_of(50) == pytest.approx(50.0, abs=2.0)
    assert kept[0] == 1.0


def test_nothing_is_told_where_the_peak_cannot_be_reset(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setattr(memory, "_RESET", tmp_path / "no folder" / "clear_refs")
    with peak_memory(MPI.COMM_SELF) as use:
        pass
    assert use.peak is None


@pytest.mark.slow
@pytest.mark.parametrize("name", ["sloping_basin", "barge_in_a_dock", "scow_in_a_basin"])
def test_memory_told_in_advance_of_a_volume_is_enough_and_little_more(name: str) -> None:
    """Of two, four problems and one; measured 1.14, 1.13 and 1.21 in programs of their own."""
    scene = read_scene(name)
    tank = physical_level_tank(scene).scaled()
    assert isinstance(tank, VolumeTank)
    with peak_memory(MPI.COMM_SELF) as use:
        found = solve_volume(tank, tolerance=scene.accuracy.tolerance, count=scene.accuracy.modes, comm=MPI.COMM_SELF)
    assert use.peak is not None
    assert found.attempts == 1
    model = found.model
    told = memory_needed(
        model.liquid.size,
        model.resolution.degree,
        scene.accuracy.modes,
        problems=model.images,
        factorized=bool(model.resolution.sizes.layers),
    )
    # Compiled forms, 0.02 GiB, may be there before.
    assert use.peak <= told <= 1.3 * (use.peak + 0.02 * 2**30)
