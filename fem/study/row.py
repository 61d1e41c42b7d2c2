"""One solution of a study: its errors against the reference, and its cost. No dolfinx."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, TypeAlias

Family: TypeAlias = Literal["uniform", "algebraic", "geometric", "tolerance"]
"""Series of solutions."""


@dataclass(frozen=True, kw_only=True)
class StudyRow:
    """One solution of a study.

    Attributes:
        family: which series it belongs to.
        degree: polynomial degree of ψ.
        element_size: largest element at the top, in tank lengths.
        grading: β of meshes graded towards the tips, 1 for uniform ones; ``None`` in the other families.
        tolerance: requested relative error; ``None`` except in the family ``"tolerance"``.
        unknowns: number of unknowns of ψ and of the surfaces, of both halves of a tank that is solved as two.
        errors: ω/ω_exact − 1 of the requested frequencies.
        floor: error of rounding and of the reference, below which errors are not significant.
        estimate: largest error by the estimate of the solver; ``None`` without an estimate.
        reasons: why the solver did not keep the tolerance; empty if it did.
        seconds: time that it took, s.
        memory: increase of the resident memory during the solution, bytes, over all processes; ``None`` where the
            system does not report it.
    """

    family: Family
    degree: int
    element_size: float
    grading: float | None
    tolerance: float | None
    unknowns: int
    errors: tuple[float, ...]
    floor: float
    estimate: float | None
    reasons: tuple[str, ...]
    seconds: float
    memory: int | None

    @property
    def error(self) -> float:
        """Largest relative error of the requested frequencies."""
        return max(map(abs, self.errors))

    @property
    def lowest_error(self) -> float:
        """Relative error of the lowest frequency."""
        return abs(self.errors[0])
