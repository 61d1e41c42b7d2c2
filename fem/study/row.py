"""One solution of a study: its errors against the reference, and what it cost. No dolfinx."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, TypeAlias

Family: TypeAlias = Literal["uniform", "algebraic", "geometric", "tolerance", "thinness"]
"""Series of solutions; the last one compares two boundaries, the others measure errors."""


@dataclass(frozen=True, kw_only=True)
class StudyRow:
    """One solution of a study.

    Attributes:
        family: which series it belongs to.
        degree: of ψ.
        element_size: largest element asked for at the top, in tank lengths.
        grading: β of meshes drawn towards the tips, 1 for uniform ones; ``None`` in the other families.
        tolerance: asked relative error; ``None`` but in the family ``"tolerance"``.
        attempts: resolutions that were tried.
        unknowns: of ψ and of the surfaces, those of both halves of a tank that is solved as two.
        errors: ω/ω_exact − 1 of the frequencies asked for.
        floor: below this an error is rounding, or that of the reference.
        estimate: largest error that the solver itself estimates; ``None`` where it gives no estimate.
        reasons: why the solver says that it missed the tolerance; empty if it does not.
        seconds: time by stage.
        memory: highest resident memory while it was solved, above what was held before, in bytes over all processes;
            ``None`` where the system does not tell.
    """

    family: Family
    degree: int
    element_size: float
    grading: float | None
    tolerance: float | None
    attempts: int
    unknowns: int
    errors: tuple[float, ...]
    floor: float
    estimate: float | None
    reasons: tuple[str, ...]
    seconds: dict[str, float]
    memory: int | None

    @property
    def error(self) -> float:
        """Largest relative error of the frequencies asked for."""
        return max(map(abs, self.errors))

    @property
    def lowest_error(self) -> float:
        """Relative error of the lowest frequency."""
        return abs(self.errors[0])

    @property
    def total_seconds(self) -> float:
        """Time of all stages."""
        return sum(self.seconds.values())
