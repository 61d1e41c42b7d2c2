"""Rough cost of a solution, and the memory that is free. Nothing is solved, and dolfinx is not imported."""

from __future__ import annotations

from contextlib import suppress
from pathlib import Path
from typing import NamedTuple

DIRECT_UNKNOWNS = 120_000
"""Up to so many unknowns Laplace's equation in a volume is factorized; measured: beyond, multigrid takes less time and
memory."""


class _Kind(NamedTuple):
    start: float  # processor seconds, with imports and writing, without pictures
    factor: float  # microseconds for each unknown of each part, for its matrices
    solution: float  # microseconds for each unknown of each part, for each solution
    program: float  # GB
    matrix: float  # bytes for each unknown of each part, and degree
    vector: float  # bytes for each unknown and solution


# Measured on one core, on the shipped scenes of each kind; multigrid on 1e5 to 4e6 unknowns of degree 2 and 4.
_KINDS = {
    "section": _Kind(1.7, 30.0, 1.0, 0.17, 800.0, 8.0),  # aquarium … off_centre; conical_tank, ship_tank by order
    "level bed": _Kind(2.0, 100.0, 1.0, 0.12, 800.0, 8.0),  # cross_waves, floating_roof
    "plan": _Kind(2.5, 20.0, 1.0, 0.2, 1_000.0, 8.0),  # ice_in_a_triangle, rectangular_cover, two_plates
    "volume": _Kind(2.0, 12.0, 0.3, 0.17, 1_300.0, 100.0),  # barge_in_a_dock, scow_in_a_basin, sloping_basin
    "multigrid": _Kind(2.0, 8.0, 4.0, 0.3, 1_000.0, 100.0),
    "sea": _Kind(2.0, 0.0, 15.0, 0.2, 3_000.0, 0.0),  # open_circle … point_absorber
    "string": _Kind(1.8, 0.0, 1.0, 0.17, 1_000.0, 8.0),  # string_ramp … string_with_load
    "thread": _Kind(2.0, 0.0, 10.0, 0.17, 1_000.0, 8.0),  # catenary … jumper
    "roll": _Kind(0.7, 0.0, 1.0, 0.12, 0.0, 0.0),  # swell
}


class Cost(NamedTuple):
    """Processor seconds, and bytes of all processes together."""

    seconds: float
    memory: float

    def __str__(self) -> str:
        seconds, memory = (float(f"{value:.1g}") for value in (self.seconds, self.memory / 1e9))
        return f"Cost, roughly: about {seconds:g} s, {memory:g} GB, without pictures."


def cost(unknowns: float, degree: int, solutions: float, kind: str, parts: float = 1, factorized: bool = False) -> Cost:
    """Return what a run without pictures takes: within a factor of three for the shipped scenes of each kind, seconds
    on a quiet core; where a first attempt falls short, the next ones come on top.

    Args:
        unknowns: of ψ, or of a line, in each part.
        degree: of the polynomials.
        solutions: of the liquid's or the line's equations, in each part.
        kind: "section", "level bed", "plan", "volume", "sea", "string", "thread" or "roll"; large volumes take
            multigrid.
        parts: problems of symmetry or azimuthal order, whose matrices are held together.
    """
    is_large = kind == "volume" and unknowns > DIRECT_UNKNOWNS and not factorized
    start, factor, solution, program, matrix, vector = _KINDS["multigrid" if is_large else kind]
    return Cost(
        seconds=start + 1e-6 * unknowns * parts * (factor + solution * solutions),
        memory=1e9 * program + unknowns * (parts * matrix * degree + vector * solutions),
    )


def free_memory() -> float:
    """Return the bytes that this computer could still give; infinite where it does not tell."""
    with suppress(OSError, ValueError):
        for line in Path("/proc/meminfo").read_text(encoding="ascii").splitlines():
            if line.startswith("MemAvailable:"):
                return 1024.0 * int(line.split()[1])
    return float("inf")
