"""What is measured, and what a measurement gives: the values that go between the processes."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Literal

Code = Literal["hydroelastic", "ngsolve", "scikit-fem", "lower bound"]
Variant = Literal["certified", "whole", "halves", "bare"]

CODES: tuple[Code, ...] = ("hydroelastic", "ngsolve", "scikit-fem", "lower bound")


@dataclass(frozen=True, kw_only=True)
class Case:
    """One thing to be solved again and again.

    Attributes:
        code: by which code.
        tank: name of the tank.
        variant: ``certified`` with estimate, count and companion; ``whole`` tank or its two ``halves`` without them;
            ``bare`` factorization and solutions alone.
        degree: polynomial degree, where it is chosen; else 0.
        tolerance: asked relative error, where it is chosen; else 0.
    """

    code: Code
    tank: str
    variant: Variant
    degree: int = 0
    tolerance: float = 0.0

    @property
    def resolution(self) -> str:
        """What was chosen, in words."""
        return f"degree {self.degree}" if self.degree else f"tolerance {self.tolerance:.0e}"


@dataclass(frozen=True, kw_only=True)
class Answer:
    """What a solution gives.

    Attributes:
        frequencies: the lowest ω, rad/s, ascending.
        unknowns: of ψ and of the surface.
        stages: seconds by stage, as far as the code tells them.
        note: what else is to be said of it.
    """

    frequencies: tuple[float, ...]
    unknowns: int
    stages: dict[str, float] = field(default_factory=dict)
    note: str = ""
