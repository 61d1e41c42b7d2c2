"""Progress of a run: seconds by stage, largest memory, and reports of the current step."""

from __future__ import annotations

import gc
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, TypeAlias

if TYPE_CHECKING:
    from mpi4py import MPI

Report: TypeAlias = Callable[[str], None]
"""Is told what is being done."""


@dataclass
class Stopwatch:
    """Seconds by stage, added up."""

    seconds: dict[str, float] = field(default_factory=dict)

    @contextmanager
    def stage(self, name: str) -> Iterator[None]:
        """Time a block of code."""
        start = time.perf_counter()
        try:
            yield
        finally:
            self.seconds[name] = self.seconds.get(name, 0.0) + time.perf_counter() - start


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
