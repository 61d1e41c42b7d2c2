"""How much memory a piece of work takes at most, as the operating system counts it."""

from __future__ import annotations

import ctypes
import gc
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path

from mpi4py import MPI

_STATUS = Path("/proc/self/status")
_RESET = Path("/proc/self/clear_refs")
# What /proc takes as "forget the peak so far".
_FORGET_PEAK = "5"


@dataclass
class MemoryUse:
    """What `peak_memory` measured.

    Attributes:
        peak: bytes, summed over the processes; ``None`` until the work is done, and where the system does not tell.
    """

    peak: int | None = None


@contextmanager
def peak_memory(comm: MPI.Comm) -> Iterator[MemoryUse]:
    """Measure the highest resident memory of a block of code above what the process held before it (collective).

    The peak that a process remembers only grows, so it is reset first, which Linux allows a process for itself; and
    memory that earlier work freed is handed back, for to use it again would not show. Elsewhere the peak is ``None``.
    """
    use = MemoryUse()
    hand_back_memory()
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


def hand_back_memory() -> None:
    """Give freed memory back to the operating system: an allocator keeps it, and what comes next seldom fits."""
    gc.collect()
    # Only glibc has it; other allocators keep less.
    with suppress(OSError, AttributeError):
        ctypes.CDLL(None).malloc_trim(0)


def _kilobytes(name: str) -> int | None:
    """One entry of the process's status; ``None`` where there is none."""
    try:
        lines = _STATUS.read_text(encoding="ascii").splitlines()
    except OSError:
        return None
    return next((int(line.split()[1]) for line in lines if line.startswith(f"{name}:")), None)
