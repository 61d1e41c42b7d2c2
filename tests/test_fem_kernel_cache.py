"""Compiled kernels: a cache that a killed process has damaged is mended, in words and without waiting."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

# Compiles one form, and tells the volume that it integrates.
PROGRAM = """
import ufl
from dolfinx.fem import assemble_scalar
from dolfinx.mesh import create_unit_interval
from mpi4py import MPI
from hydroelastic.fem.kernels import compiled_form
mesh = create_unit_interval(MPI.COMM_SELF, 4)
print(assemble_scalar(compiled_form(ufl.SpatialCoordinate(mesh)[0] ** 2 * ufl.dx)))
"""
COMMAND = [sys.executable, "-c", PROGRAM]
THIRD = pytest.approx(1 / 3, rel=1e-14)


def variables(cache: Path) -> dict[str, str]:
    return os.environ | {"XDG_CACHE_HOME": str(cache), "HYDROELASTIC_INSIDE": "a cache of its own"}


def integrated(cache: Path) -> tuple[float, str]:
    """The integral, and what was said."""
    # Without the mending a process waits for 300 s for one that is gone.
    ended = subprocess.run(COMMAND, env=variables(cache), capture_output=True, text=True, check=True, timeout=100)
    return float(ended.stdout), ended.stderr


def damage_unfinished(kernel: Path) -> None:
    for file in kernel.parent.glob(f"{kernel.stem}.*"):
        if file != kernel:
            file.unlink()
    # By a program that does not know of the lock; after a minute it is given up.
    os.utime(kernel, (time.time() - 100.0, time.time() - 100.0))


def damage_truncated(kernel: Path) -> None:
    library = next(kernel.parent.glob(f"{kernel.stem}*.so"))
    os.truncate(library, library.stat().st_size // 2)


def damage_emptied(kernel: Path) -> None:
    os.truncate(next(kernel.parent.glob(f"{kernel.stem}*.so")), 0)


def damage_lost(kernel: Path) -> None:
    next(kernel.parent.glob(f"{kernel.stem}*.so")).unlink()


@pytest.fixture(scope="module")
def compiled(tmp_path_factory: pytest.TempPathFactory) -> Path:
    cache = tmp_path_factory.mktemp("cache")
    assert integrated(cache) == (THIRD, "")
    assert integrated(cache) == (THIRD, "")
    return cache


@pytest.mark.slow
@pytest.mark.parametrize("damage", [damage_unfinished, damage_truncated, damage_emptied, damage_lost])
def test_a_damaged_kernel_is_compiled_anew_with_one_line_of_notice(compiled: Path, damage) -> None:
    damage(next(compiled.glob("fenics/*.c")))
    value, said = integrated(compiled)
    assert value == THIRD
    assert said.count("\n") == 1
    assert "1 unfinished or damaged kernels" in said
    assert integrated(compiled) == (THIRD, "")


@pytest.mark.slow
def test_a_kernel_that_another_process_compiles_is_waited_for(compiled: Path, tmp_path: Path) -> None:
    with subprocess.Popen(COMMAND, env=variables(tmp_path), stdout=subprocess.PIPE, text=True) as first:
        while not list(tmp_path.glob("fenics/*.c")):
            time.sleep(0.005)
        assert integrated(tmp_path) == (THIRD, "")
        assert float(first.communicate(timeout=100)[0]) == THIRD


def test_a_process_killed_while_it_compiles_delays_nobody(tmp_path: Path) -> None:
    with subprocess.Popen(COMMAND, env=variables(tmp_path), start_new_session=True) as killed:
        while not list(tmp_path.glob("fenics/*.c")):
            time.sleep(0.005)
        os.killpg(killed.pid, signal.SIGKILL)
    assert not list(tmp_path.glob("fenics/*.cached"))
    value, said = integrated(tmp_path)
    assert value == THIRD
    assert "unfinished" in said


@pytest.mark.slow
def test_a_kernel_that_another_program_is_compiling_is_left_alone(compiled: Path) -> None:
    foreign = compiled / "fenics" / "libffcx_forms_0.c"
    foreign.touch()
    assert integrated(compiled) == (THIRD, "")
    assert foreign.exists()
    foreign.unlink()


@pytest.mark.slow
def test_kernels_of_other_programs_are_left_alone(tmp_path: Path) -> None:
    foreign = tmp_path / "fenics" / "libffcx_forms_0.c"
    foreign.parent.mkdir()
    foreign.touch()
    environment = variables(tmp_path)
    del environment["HYDROELASTIC_INSIDE"]
    subprocess.run(COMMAND, env=environment, check=True, timeout=100, stdout=subprocess.DEVNULL)
    assert foreign.exists()
    assert list((foreign.parent / "hydroelastic").glob("libffcx_forms_*.c.cached"))
