"""A beam whose thickness, or rigidity and mass, vary along it, as frozen values."""

from __future__ import annotations

from collections.abc import Iterator
from functools import cached_property
from itertools import pairwise
from typing import Annotated, Literal, TypeAlias

import numpy as np
from pydantic import Field, Strict, ValidationError, model_validator
from pydantic_core import InitErrorDetails

from hydroelastic.physics import varying_beam
from hydroelastic.physics.arrays import FloatArray
from hydroelastic.physics.dofs import Level
from hydroelastic.scenes.models.bodies import MOST_SECTIONS, BeamJoint, BeamSection, physical_joints, physical_sections
from hydroelastic.scenes.models.problems import problem_at
from hydroelastic.scenes.models.scene_model import Place, PositiveNumber, SparseModel

Table: TypeAlias = Annotated[tuple[tuple[Place, PositiveNumber], ...], Field(min_length=2, max_length=MOST_SECTIONS)]


class VaryingBeam(SparseModel):
    """An Euler–Bernoulli beam without draught with free ends, given by tables of rows [x, value], x in m from its left
    end: by its thickness, or by its rigidity and mass. Values go linearly from row to row; two rows with the same x are
    a step.

    Raises:
        SceneError: if the tables do not belong together, or do not cover the beam.
    """

    kind: Literal["varying_beam"] = Field(default="varying_beam", description="kind of the body")
    at: Level | None = Field(
        default=None,
        description="where it floats: at the interface of two liquids, which is the default with two, or at the top",
    )
    start: Place = Field(description="distance of the left end from the left wall, m")
    thickness: Table | None = Field(default=None, description="rows [x, thickness], m; the last x is the length")
    youngs_modulus: PositiveNumber | None = Field(default=None, description="E, beside a thickness, N/m²")
    poisson_ratio: Annotated[float, Strict(), Field(ge=0, le=0.5)] | None = Field(
        default=None, description="ν, beside a thickness: EI = E t³/(12 (1 − ν²)); by default 0"
    )
    density: PositiveNumber | None = Field(default=None, description="of its material, beside a thickness, kg/m³")
    flexural_rigidity: Table | None = Field(
        default=None, description="rows [x, EI per metre of width], N·m; instead of a thickness"
    )
    mass_per_length: Table | None = Field(
        default=None, description="rows [x, mass per length and metre of width], kg/m²; instead of a thickness"
    )
    hydrostatic: Annotated[bool, Strict()] = Field(
        default=True, description="whether the hydrostatic restoring Δρ g w acts on the beam"
    )
    joints: tuple[BeamJoint, ...] = Field(
        default=(), max_length=MOST_SECTIONS, description=f"up to {MOST_SECTIONS} joints and hinges, from left to right"
    )

    @property
    def ends(self) -> Literal["free"]:
        """Both ends are free."""
        return "free"

    @property
    def length(self) -> float:
        """Length, m."""
        return self._tables[0][-1][0]

    @property
    def end(self) -> float:
        """Distance of the right end from the left wall, m."""
        return self.start + self.length

    @property
    def is_uniform(self) -> bool:
        """False: a varying beam counts as not uniform."""
        return False

    @property
    def hinges(self) -> tuple[float, ...]:
        """Where the joints without stiffness lie, m from the left end."""
        return tuple(joint.at for joint in self.joints if joint.rotational_stiffness == 0.0)

    @cached_property
    def sections(self) -> tuple[BeamSection, ...]:
        """The parts between the rows of all tables, each with its mean values."""
        edges = self._edges
        middles = np.array([0.5 * (left + right) for left, right in pairwise(edges)])
        return tuple(
            BeamSection(length=right - left, flexural_rigidity=float(rigidity), mass_per_length=float(mass))
            for (left, right), rigidity, mass in zip(
                pairwise(edges), self.rigidity_at(middles), self.mass_at(middles), strict=True
            )
        )

    @property
    def parts(self) -> tuple[BeamSection, ...]:
        """Its sections, from left to right."""
        return self.sections

    def physical(self, level: Level) -> varying_beam.VaryingBeam:
        """Return the beam at a level, in SI units."""
        return varying_beam.VaryingBeam(
            sections=physical_sections(self.sections),
            joints=physical_joints(self.joints),
            start=self.start,
            level=level,
            hydrostatic=self.hydrostatic,
            rigidity=self.rigidity_at,
            mass=self.mass_at,
        )

    def location_of(self, _number: int, key: str) -> tuple[str]:
        """Return the key from which a value of a section comes."""
        return (key if self.thickness is None else "thickness",)

    def rigidity_at(self, x: FloatArray) -> FloatArray:
        """EI at distances from the left end, N·m."""
        if self.thickness is None:
            return _linear(self.flexural_rigidity or (), x)
        assert self.youngs_modulus is not None
        ratio = self.poisson_ratio or 0.0
        return self.youngs_modulus / (12.0 * (1.0 - ratio**2)) * _linear(self.thickness, x) ** 3

    def mass_at(self, x: FloatArray) -> FloatArray:
        """Mass per length at distances from the left end, kg/m²."""
        if self.thickness is None:
            return _linear(self.mass_per_length or (), x)
        assert self.density is not None
        return self.density * _linear(self.thickness, x)

    @property
    def _tables(self) -> tuple[Table, ...]:
        return tuple(table for table in (self.thickness, self.flexural_rigidity, self.mass_per_length) if table)

    @property
    def _edges(self) -> list[float]:
        return sorted({x for table in self._tables for x, _ in table})

    @model_validator(mode="after")
    def _tables_fit(self) -> VaryingBeam:
        problems = [*_given_in_one_way(self), *(problem for key in _TABLES for problem in _covers(self, key))]
        if not problems:
            problems = list(_of_one_length(self))
        if problems:
            raise ValidationError.from_exception_data(type(self).__name__, problems)
        return self


_TABLES = ("thickness", "flexural_rigidity", "mass_per_length")


def _given_in_one_way(beam: VaryingBeam) -> Iterator[InitErrorDetails]:
    needed: tuple[str, ...] = ("thickness", "youngs_modulus", "density")
    idle: tuple[str, ...] = ("flexural_rigidity", "mass_per_length")
    if beam.thickness is None:
        needed, idle = idle, ("youngs_modulus", "poisson_ratio", "density")
    for key in needed:
        if getattr(beam, key) is None:
            yield problem_at(
                (key,),
                None,
                "it is missing",
                allowed="thickness with youngs_modulus and density, or flexural_rigidity with mass_per_length",
            )
    for key in idle:
        if getattr(beam, key) is not None:
            given = "a thickness" if beam.thickness is not None else "no thickness"
            yield problem_at((key,), getattr(beam, key), f"it has no effect: there is {given}", remedy="Leave it out")


def _covers(beam: VaryingBeam, key: str) -> Iterator[InitErrorDetails]:
    table = getattr(beam, key) or ()
    places = [x for x, _ in table]
    if places and places[0] != 0.0:
        yield problem_at((key, 0), places[0], "the first row is not at the left end", allowed="x = 0")
    for number, (left, right) in enumerate(pairwise(places), 1):
        if right < left or (number > 1 and right == places[number - 2]):
            yield problem_at(
                (key, number),
                right,
                "rows go from left to right, with at most two at one x, which are a step",
                allowed=f"at least {left:g}",
            )
    if len(places) > 1 and (places[-1] == places[-2] or places[1] == 0.0):
        yield problem_at((key,), places[-1], "a step lies at an end of the beam", remedy="Leave one of both rows out")


def _of_one_length(beam: VaryingBeam) -> Iterator[InitErrorDetails]:
    if beam.thickness is None and beam.flexural_rigidity and beam.mass_per_length:
        one, other = beam.flexural_rigidity[-1][0], beam.mass_per_length[-1][0]
        if one != other:
            yield problem_at(
                ("mass_per_length",),
                other,
                f"it ends at {other:g} m, and flexural_rigidity at {one:g} m",
                remedy="Let both end at the length of the beam",
            )


def _linear(table: tuple[tuple[float, float], ...], x: FloatArray) -> FloatArray:
    """Values of a table between its rows; x does not lie on a step."""
    places, values = np.array(table).T
    found: FloatArray = np.interp(x, places, values)
    return found
