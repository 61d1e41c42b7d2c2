"""What is measured, and what a measurement gives: the values that go between the processes."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Literal

Code = Literal[
    "hydroelastic",
    "hydroelastic modes",
    "ngsolve",
    "scikit-fem",
    "lower bound",
    "sweep",
    "ngsolve loop",
    "hydroelastic radiation",
    "capytaine",
    "string field",
    "string series",
    "string sum",
    "thread field",
    "thread catenary",
    "moorpy",
    "moordyn",
    "basin field",
    "ngsolve plan",
    "ngsolve volume",
    "hydroelastic buoy",
    "capytaine buoy",
    "open-flash",
]
Variant = Literal[
    "one process",
    "two processes",
    "certified",
    "modes alone",
    "whole",
    "halves",
    "bare",
    "one length",
    "two lengths",
    "cut sharply",
    "one run",
    "closed form",
    "catenaries",
    "lumped",
    "relaxed",
    "relaxed in motion",
    "quarters",
    "triangles",
    "without lid",
    "with lid",
    "matched",
]

CODES: tuple[Code, ...] = ("hydroelastic", "hydroelastic modes", "ngsolve", "scikit-fem", "lower bound")
"""Those that solve the tanks."""
SWEEP_CODES: tuple[Code, ...] = ("sweep", "ngsolve loop")
"""Those that solve many tanks."""
CIRCLE_CODES: tuple[Code, ...] = ("hydroelastic radiation", "capytaine")
"""Those that solve the circle in open water."""
STRING_CODES: tuple[Code, ...] = ("string field", "string series", "string sum")
"""Those that move the hanging string."""
THREAD_CODES: tuple[Code, ...] = ("thread field", "thread catenary", "moorpy", "moordyn")
"""Those that bring flexible threads to rest, or move them."""
BASIN_CODES: tuple[Code, ...] = ("basin field", "ngsolve plan", "ngsolve volume")
"""Those that solve a tank in three dimensions."""
BUOY_CODES: tuple[Code, ...] = ("hydroelastic buoy", "capytaine buoy", "open-flash")
"""Those that solve solids of revolution in the open sea."""
ALL_CODES = (*CODES, *SWEEP_CODES, *CIRCLE_CODES, *STRING_CODES, *THREAD_CODES, *BASIN_CODES, *BUOY_CODES)


@dataclass(frozen=True, kw_only=True)
class Case:
    """One thing to be solved again and again.

    Attributes:
        code: by which code.
        tank: name of the tank, of the sweep, of the frequency of the circle, of the motion of the string, of the
            thread, or of the buoy.
        variant: a sweep on ``one process`` or ``two processes``; ``certified`` with estimate, count and tones;
            ``whole`` tank or its two ``halves`` without them; ``modes alone``, the same for this solver; ``bare``
            factorization and solutions alone; a cylinder of ``one length``, or ``two lengths`` and their difference;
            a series ``cut sharply``; a thread moved in ``one run`` at a chosen resolution, at rest by a
            ``closed form`` or as several ``catenaries`` in a row, or ``lumped`` into point masses, at
            rest ``relaxed`` or ``relaxed in motion``; the ``quarters`` of a tank in three dimensions,
            or ``triangles`` on its plan, where the smallest model would be another; panels ``with lid`` or
            ``without lid``; ``matched`` expansions.
        degree: polynomial degree, where it is chosen; else 0.
        tolerance: asked relative error, where it is chosen; else 0.
        panels: along a quarter of the circle, or from axis to water line, where they are chosen; else 0.
        length: of the cylinder over its radius, of the longer one of two, which is twice the other; else 0.
        terms: of a series that is cut sharply, or of expansions; else 0.
        segments: or elements, or catenaries, of a thread, where they are chosen; else 0.
        step: in time, s, where it is chosen; else 0.
        size: of the cells of a volume at the edge of a plate, m, where it is chosen; else 0.
    """

    code: Code
    tank: str
    variant: Variant
    degree: int = 0
    tolerance: float = 0.0
    panels: int = 0
    length: float = 0.0
    terms: int = 0
    segments: int = 0
    step: float = 0.0
    size: float = 0.0

    @property
    def resolution(self) -> str:
        """What was chosen, in words."""
        if self.panels and not self.length:
            return f"{self.panels} panels, {4 * self.panels} around"
        if self.panels:
            lengths = (
                f"{self.length / 2:g} and {self.length:g}" if self.variant == "two lengths" else f"{self.length:g}"
            )
            return f"length {lengths}, {self.panels} panels"
        if self.terms:
            return f"{self.terms} terms"
        if self.step:
            return f"{self.segments} elements, steps of {self.step:g} s"
        if self.segments:
            if self.variant == "catenaries":
                return "1 catenary" if self.segments == 1 else f"{self.segments} catenaries"
            return f"{self.segments} segments"
        if self.size:
            return f"degree {self.degree}, cells of {self.size:g} m"
        if self.degree:
            return f"degree {self.degree}"
        return f"tolerance {self.tolerance:.0e}" if self.tolerance else "exact"


@dataclass(frozen=True, kw_only=True)
class Answer:
    """What a solution gives.

    Attributes:
        values: the lowest ω of a tank, rad/s, ascending; a', b' of heave and a', b' of sway of the circle;
            displacements of the string at its points; a and b/ω of a buoy; forces on the ends of a
            thread, tensions, or places.
        unknowns: of ψ and of the surface, panels, unknowns of a string or a thread at rest, terms, or nodes of a
            thread that moves.
        stages: seconds by stage, as far as the code tells them.
        note: what else is to be said of it.
    """

    values: tuple[float, ...]
    unknowns: int
    stages: dict[str, float] = field(default_factory=dict)
    note: str = ""
