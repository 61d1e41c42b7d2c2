"""What a summary says of how its numbers came about: versions and memory."""

from __future__ import annotations

import platform
import resource
from importlib.metadata import PackageNotFoundError, version
from typing import TYPE_CHECKING, Any, TypeAlias

if TYPE_CHECKING:
    from mpi4py import MPI

Summary: TypeAlias = dict[str, Any]
"""Content of ``summary.json``."""

PACKAGES = ("hydroelastic", "fenics-dolfinx", "petsc4py", "slepc4py", "gmsh", "numpy", "scipy", "xarray")


def versions() -> dict[str, str]:
    """Return the versions of what a solution rests on."""
    found = {"python": platform.python_version()}
    for package in PACKAGES:
        try:
            found[package] = version(package)
        except PackageNotFoundError:
            found[package] = "unknown"
    return found


def memory_of_processes(comm: MPI.Comm) -> int:
    """Return the sum of the peak resident memory of all processes, bytes (collective)."""
    return int(comm.allreduce(memory_of_process()))


def memory_of_process() -> int:
    """Return the peak resident memory of this process, bytes."""
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024
