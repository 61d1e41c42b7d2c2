"""Peak memory of a block of code, as counted by the operating system."""

from __future__ import annotations

import gc
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from mpi4py import MPI
from petsc4py import PETSc

_STATUS = Path("/proc/self/status")
_RESET = Path("/proc/self/clear_refs")
# The value by which /proc resets the peak.
_FORGET_PEAK = "5"


@dataclass
class MemoryUse:
    """The result of `peak_memory`.

    Attributes:
        peak: bytes, summed over the processes; ``None`` before the end of the block, and where the system does not
            provide it.
    """

    peak: int | None = None


@contextmanager
def peak_memory(comm: MPI.Comm) -> Iterator[MemoryUse]:
    """Measure the highest resident memory of a block of code above what the process held before it (collective).

    The peak that a process remembers only grows, so it is reset first, which Linux allows a process for itself; memory
    that the allocator keeps and uses again is not counted. Elsewhere the peak is ``None``.
    """
    use = MemoryUse()
    gc.collect()
    resettable = True
    try:
        _RESET.write_text(_FORGET_PEAK, encoding="ascii")
    except OSError:
        resettable = False
    before = _kilobytes("VmRSS")
    yield use
    after = _kilobytes("VmHWM")
    known = resettable and before is not None and after is not None
    increases = comm.allgather(1024 * (after - before) if known and before is not None and after is not None else None)
    told = [increase for increase in increases if increase is not None]
    use.peak = sum(told) if len(told) == len(increases) else None


def release_matrices(comm: MPI.Comm) -> None:
    """Free what PETSc keeps of the objects that no process uses (collective).

    On several processes it keeps them until all of these let go, which Python does at other times on each.
    """
    gc.collect()
    PETSc.garbage_cleanup(comm)


def _kilobytes(name: str) -> int | None:
    """One entry of the process's status; ``None`` where there is none."""
    try:
        lines = _STATUS.read_text(encoding="ascii").splitlines()
    except OSError:
        return None
    return next((int(line.split()[1]) for line in lines if line.startswith(f"{name}:")), None)
