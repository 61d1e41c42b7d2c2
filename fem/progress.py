"""Progress of a run: reports of the current step, and the largest memory of a block of code."""

from __future__ import annotations

import gc
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, TypeAlias

if TYPE_CHECKING:
    from mpi4py import MPI

Report: TypeAlias = Callable[[str], None]
"""Is told what is being done."""


@dataclass
class MemoryUse:
    """Result of `peak_memory`, bytes over all processes; ``None`` before the end and where it is unknown."""

    peak: int | None = None


@contextmanager
def peak_memory(comm: MPI.Comm) -> Iterator[MemoryUse]:
    """Measure the highest resident memory of a block of code above what was held before (collective).

    The peak that a process remembers only grows, so it is reset first, which Linux allows a process for itself.
    """
    use, before = MemoryUse(), None
    gc.collect()
    with suppress(OSError):
        Path("/proc/self/clear_refs").write_text("5", encoding="ascii")
        before = _kilobytes("VmRSS")
    yield use
    increases = comm.allgather(None if before is None else 1024 * (_kilobytes("VmHWM") - before))
    use.peak = None if None in increases else sum(increases)


def _kilobytes(name: str) -> int:
    lines = Path("/proc/self/status").read_text(encoding="ascii").splitlines()
    return next(int(line.split()[1]) for line in lines if line.startswith(f"{name}:"))
