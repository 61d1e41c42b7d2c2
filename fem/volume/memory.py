"""Memory that a problem in a volume needs, told in advance, and memory that is free."""

from __future__ import annotations

from contextlib import suppress
from pathlib import Path

DIRECT_UNKNOWNS = 120_000
"""Up to so many unknowns Laplace's equation is factorized; measured: beyond, multigrid takes less time and memory."""

# Bytes above those of the program, measured on one, two and four problems of 17,000 to 480,000 unknowns N, and rounded
# up: of compiled forms, of each cell that gmsh makes, and over N of a mesh with its matrix.
_FIXED, _OF_CELL, _OF_MATRIX = 5e7, 3_300.0, 1_000.0
# Of each problem: of a factorization over N and N^(4/3), of multigrid over N of degree 2 and of higher ones.
_OF_FACTORS = (2_600.0, 40.0)
_OF_MULTIGRID = {2: 500.0, 4: 1_400.0}
# Over N, of what the third degree adds to the second one.
_OF_CUBIC = 1_100.0
# Potentials for each mode: those of its products, as many as were counted, and its own, with their values in cells.
_POTENTIALS = 12.0
# Most cells of a mesh that is made on one process.
_OF_GMSH = 100_000.0
_MEMORY = Path("/proc/meminfo")


def memory_needed(unknowns: int, degree: int, modes: int, *, problems: int = 1, factorized: bool = False) -> float:
    """Return about the bytes that a tank needs above the program on all processes together, rather too many.

    It holds the solvers of all problems. Multigrid is joined by factorizations of the coarser space in which modes are
    sought first, and then of a matrix in which they are counted; those take no more than what a factorization of all
    unknowns has given back.
    """
    alone = problems * _of_solver(unknowns, degree, factorized)
    later = 0.0
    if not factorized and unknowns > DIRECT_UNKNOWNS:
        counted = unknowns * (2.0 / degree) ** 3
        later = max(
            problems * _of_solver(unknowns * (degree // 2 / degree) ** 3, degree // 2),
            _of_solver(counted, 2) if counted <= DIRECT_UNKNOWNS else 0.0,
        )
    return (
        _FIXED
        + _OF_CELL * min(6.0 * unknowns / degree**3, _OF_GMSH)
        + (_OF_MATRIX + (_OF_CUBIC if degree == 2 else 0.0) + _POTENTIALS * 8.0 * modes) * unknowns
        + alone
        + later
    )


def _of_solver(unknowns: float, degree: int, factorized: bool = False) -> float:
    if factorized or unknowns <= DIRECT_UNKNOWNS:
        return _OF_FACTORS[0] * unknowns + _OF_FACTORS[1] * unknowns ** (4.0 / 3.0)
    return _OF_MULTIGRID[2 if degree <= 2 else 4] * unknowns


def free_memory() -> float | None:
    """Return the bytes that this computer could still give; ``None`` where it does not tell."""
    with suppress(OSError, ValueError):
        for line in _MEMORY.read_text(encoding="ascii").splitlines():
            if line.startswith("MemAvailable:"):
                return 1024.0 * int(line.split()[1])
    return None
