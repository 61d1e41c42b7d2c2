"""What is measured, and what a measurement gives: the values that go between the processes."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Literal

Code = Literal[
    "hydroelastic",
    "ngsolve",
    "scikit-fem",
    "lower bound",
    "hydroelastic radiation",
    "capytaine",
    "string field",
    "string series",
    "string sum",
]
Variant = Literal["certified", "whole", "halves", "bare", "one length", "two lengths", "cut sharply"]

CODES: tuple[Code, ...] = ("hydroelastic", "ngsolve", "scikit-fem", "lower bound")
"""Those that solve the tanks."""
CIRCLE_CODES: tuple[Code, ...] = ("hydroelastic radiation", "capytaine")
"""Those that solve the circle in open water."""
STRING_CODES: tuple[Code, ...] = ("string field", "string series", "string sum")
"""Those that move the hanging string."""
ALL_CODES = (*CODES, *CIRCLE_CODES, *STRING_CODES)


@dataclass(frozen=True, kw_only=True)
class Case:
    """One thing to be solved again and again.

    Attributes:
        code: by which code.
        tank: name of the tank, of the frequency of the circle, or of the motion of the string.
        variant: ``certified`` with estimate, count and companion; ``whole`` tank or its two ``halves`` without them;
            ``bare`` factorization and solutions alone; a cylinder of ``one length``, or ``two lengths`` and their
            difference; a series ``cut sharply``.
        degree: polynomial degree, where it is chosen; else 0.
        tolerance: asked relative error, where it is chosen; else 0.
        panels: along a quarter of the circle, where they are chosen; else 0.
        length: of the cylinder over its radius, of the longer one of two, which is twice the other; else 0.
        terms: of a series that is cut sharply; else 0.
    """

    code: Code
    tank: str
    variant: Variant
    degree: int = 0
    tolerance: float = 0.0
    panels: int = 0
    length: float = 0.0
    terms: int = 0

    @property
    def resolution(self) -> str:
        """What was chosen, in words."""
        if self.panels:
            lengths = (
                f"{self.length / 2:g} and {self.length:g}" if self.variant == "two lengths" else f"{self.length:g}"
            )
            return f"length {lengths}, {self.panels} panels"
        if self.terms:
            return f"{self.terms} terms"
        return f"degree {self.degree}" if self.degree else f"tolerance {self.tolerance:.0e}"


@dataclass(frozen=True, kw_only=True)
class Answer:
    """What a solution gives.

    Attributes:
        values: the lowest ω of a tank, rad/s, ascending; a', b' of heave and a', b' of sway of the circle;
            displacements of the string at its points.
        unknowns: of ψ and of the surface, panels, unknowns of a string, or terms.
        stages: seconds by stage, as far as the code tells them.
        note: what else is to be said of it.
    """

    values: tuple[float, ...]
    unknowns: int
    stages: dict[str, float] = field(default_factory=dict)
    note: str = ""
