"""Memory that a problem in a volume needs, told in advance, and memory that is free."""

from __future__ import annotations

from contextlib import suppress
from pathlib import Path

DIRECT_UNKNOWNS = 120_000
"""Up to so many unknowns Laplace's equation is factorized; measured: beyond, multigrid takes less time and memory."""

# Bytes, measured: of a factorization of N unknowns over N^(4/3), of multigrid over N of degree 2 and of higher ones.
_OF_FACTORS = 200.0
_OF_MULTIGRID = {2: 2_000.0, 4: 3_000.0}
# Potentials for each mode: those of its products, kept until all modes are found, as many as were counted, and its own.
_POTENTIALS = 4.5
_MEMORY = Path("/proc/meminfo")


def memory_needed(unknowns: int, degree: int, modes: int, *, factorized: bool = False) -> float:
    """Return about the bytes that a problem needs on all processes together, where it is factorized at any size say."""
    potentials = _POTENTIALS * 8.0 * modes * unknowns
    if factorized or unknowns <= DIRECT_UNKNOWNS:
        return _OF_FACTORS * float(unknowns) ** (4.0 / 3.0) + potentials
    return _OF_MULTIGRID[2 if degree <= 2 else 4] * unknowns + potentials


def free_memory() -> float | None:
    """Return the bytes that this computer could still give; ``None`` where it does not tell."""
    with suppress(OSError, ValueError):
        for line in _MEMORY.read_text(encoding="ascii").splitlines():
            if line.startswith("MemAvailable:"):
                return 1024.0 * int(line.split()[1])
    return None
