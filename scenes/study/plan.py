"""The plan of a study: series of meshes, degrees and tolerances, and the largest meshes. No dolfinx."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, get_args

from hydroelastic.fem.study.row import Family
from hydroelastic.fem.tank.resolution import HIGHEST_DEGREE
from hydroelastic.scenes.errors import Problem, SceneError, shown_value
from hydroelastic.scenes.words import proposal

FAMILIES: tuple[Family, ...] = get_args(Family)


@dataclass(frozen=True, kw_only=True)
class Limits:
    """Allowed numbers of an entry of a plan.

    Attributes:
        low: smallest.
        high: largest.
        whole: whether they are whole numbers.
    """

    low: float
    high: float
    whole: bool

    @property
    def words(self) -> str:
        """Description of the allowed numbers."""
        return f"{'whole ' if self.whole else ''}numbers from {self.low:.10g} to {self.high:.10g}"

    def objection(self, value: object) -> str:
        """Return what is wrong with a value; empty if it is allowed."""
        if not isinstance(value, int if self.whole else int | float) or isinstance(value, bool):
            return f"it is not a {'whole ' if self.whole else ''}number"
        # The comparison fails for NaN as well.
        return "" if self.low <= value <= self.high else "it is out of range"


LIMITS = {
    "degrees": Limits(low=1, high=HIGHEST_DEGREE, whole=True),
    "geometric_degrees": Limits(low=1, high=HIGHEST_DEGREE, whole=True),
    "tolerances": Limits(low=1e-12, high=1e-1, whole=False),
    # A rate needs three meshes.
    "halvings": Limits(low=2, high=8, whole=True),
    "most_unknowns": Limits(low=1_000, high=10_000_000, whole=True),
}


@dataclass(frozen=True, kw_only=True)
class StudyPlan:
    """The plan of a study. Lists are sorted, without duplicates.

    Attributes:
        families: ``"uniform"``: meshes of one element size, halved again and again. ``"algebraic"``: the same meshes
            drawn towards the tips, r_i = R (i/n)^β, where ψ is singular. ``"geometric"``: one mesh with geometric
            rings around the tips, degree by degree. ``"tolerance"``: what the solver makes of an asked tolerance.
        degrees: of ψ on uniform and algebraic meshes.
        geometric_degrees: of ψ on the mesh with geometric rings.
        tolerances: asked relative errors.
        halvings: how often elements are halved, at most.
        most_unknowns: a series of meshes ends before a mesh with more unknowns of ψ than this.

    Raises:
        SceneError: naming each attribute that cannot be used, its value and what is allowed.
    """

    families: tuple[Family, ...] = FAMILIES
    degrees: tuple[int, ...] = (1, 2, 3, 4)
    geometric_degrees: tuple[int, ...] = tuple(range(2, HIGHEST_DEGREE + 1))
    tolerances: tuple[float, ...] = (1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10)
    halvings: int = 4
    most_unknowns: int = 250_000

    def __post_init__(self) -> None:
        problems = _family_problems(self.families)
        for name, limits in LIMITS.items():
            problems += _number_problems(name, getattr(self, name), limits)
        if problems:
            raise SceneError(*problems)
        ordered = {
            "families": tuple(family for family in FAMILIES if family in self.families),
            "degrees": tuple(sorted(set(self.degrees))),
            "geometric_degrees": tuple(sorted(set(self.geometric_degrees))),
            "tolerances": tuple(sorted({float(value) for value in self.tolerances}, reverse=True)),
        }
        for name, value in ordered.items():
            object.__setattr__(self, name, value)


def _number_problems(name: str, given: Any, limits: Limits) -> list[Problem]:
    many = name in ("degrees", "geometric_degrees", "tolerances")
    if many and not isinstance(given, list | tuple | range):
        return [Problem(key=name, value=shown_value(given), wrong="it is not a list", allowed=limits.words)]
    if many and not given:
        return [Problem(key=name, wrong="it is empty", allowed=limits.words)]
    for value in given if many else (given,):
        if objection := limits.objection(value):
            return [Problem(key=name, value=shown_value(value), wrong=objection, allowed=limits.words)]
    return []


def _family_problems(given: Any) -> list[Problem]:
    allowed = f"one or more of {', '.join(FAMILIES)}"
    if not isinstance(given, list | tuple):
        return [Problem(key="families", value=shown_value(given), wrong="it is not a list", allowed=allowed)]
    if not given:
        return [Problem(key="families", wrong="it is empty", allowed=allowed)]
    return [
        Problem(
            key="families",
            value=shown_value(family),
            wrong="it is not known",
            allowed=allowed,
            remedy=proposal(str(family), FAMILIES),
        )
        for family in given
        if family not in FAMILIES
    ][:1]
