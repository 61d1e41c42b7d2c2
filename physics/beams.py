"""An Euler–Bernoulli beam of uniform sections with elastic joints and hinges, and where it floats."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property, lru_cache
from itertools import pairwise
from math import fsum, isfinite
from typing import Literal, Self

import numpy as np

from hydroelastic.physics.arrays import FloatArray
from hydroelastic.physics.beam_parts import Joint, Section
from hydroelastic.physics.bodies import Body
from hydroelastic.physics.dofs import Dof, Level
from hydroelastic.physics.scales import Scales

SAME_PLACE = 1e-9
"""Places closer than this part of the beam's length are one: decimal input is not exact."""

_ALIKE = 1e-12
# α where the slope of a beam jumps, and where its curvature does.
_KINK, _STEP = 2.0, 3.0


@dataclass(frozen=True, kw_only=True)
class Beam(Body):
    """A beam without draught; its sections are welded to each other where there is no joint.

    Raises:
        ValueError: if a number is not positive and finite, or a joint lies at an end, outside, or upon another.
    """

    is_elastic = True
    sections: tuple[Section, ...]  # from left to right; one of a uniform beam
    joints: tuple[Joint, ...] = ()  # from left to right
    start: float = 0.0  # x of its left end, m
    level: Level = "surface"  # at which it floats
    hydrostatic: bool = True  # whether the hydrostatic restoring Δρ g w acts on it
    ends: Literal["free", "guided"] = "free"  # free (no moment, no shear force), or guided (no slope, no shear force)

    def __post_init__(self) -> None:
        values = (value for part in self.sections for value in vars(part).values())
        if not self.sections or not all(isfinite(value) and value > 0.0 for value in values):
            raise ValueError("a beam needs sections with positive lengths, flexural rigidities and masses")
        if not all(isfinite(joint.rotational_stiffness) and joint.rotational_stiffness >= 0.0 for joint in self.joints):
            raise ValueError("the rotational stiffness of a joint must not be negative")
        places = [0.0, *(joint.at for joint in self.joints), self.length]
        if any(right - left <= SAME_PLACE * self.length for left, right in pairwise(places)):
            raise ValueError("joints must lie between the ends of the beam, from left to right, each at its own place")

    @cached_property
    def length(self) -> float:
        """Length of the whole beam, m."""
        return fsum(part.length for part in self.sections)

    @property
    def end(self) -> float:
        """x of its right end, m."""
        return self.start + self.length

    @property
    def waterplane(self) -> tuple[float, float]:
        """x of its ends, m."""
        return self.start, self.end

    @property
    def rigid_motions(self) -> tuple[Dof, ...]:
        """Heave, pitch of free ends, and one motion for each hinge."""
        rigid = ("heave",) if self.ends == "guided" else ("heave", "pitch")
        return (*map(Dof, rigid), *(Dof.hinge(number + 1) for number in range(len(self.hinges))))

    def dofs(self, count: int) -> tuple[Dof, ...]:
        """Return its first shapes: the rigid motions, then elastic ones."""
        return _first_dofs(self.rigid_motions, count)

    def zero_stiffness_motions(self) -> Iterator[tuple[Dof, bool]]:
        """A free beam without hydrostatics heaves, pitches and turns about its hinges without energy."""
        if not self.hydrostatic and self.ends == "free":
            yield from ((motion, motion == "heave") for motion in self.rigid_motions)

    @property
    def displaces_volume(self) -> bool:
        """Whether one of its motions displaces a net volume: heave does."""
        return True

    @property
    def nodes(self) -> dict[float, float]:
        """Steps and joints: where the slope jumps ψ has a term r² ln r, and r³ ln r where the curvature does."""
        kinks = {self.node_of(joint) for joint in self.joints}
        inner = range(1, len(self.edges) - 1)
        return {self.edges[number]: _KINK if number in kinks else _STEP for number in inner}

    @property
    def flexural_sections(self) -> tuple[Section, ...]:
        """Its sections."""
        return self.sections

    @property
    def is_restored(self) -> bool:
        """Whether the hydrostatic restoring acts on it."""
        return self.hydrostatic

    @property
    def is_uniform(self) -> bool:
        """Whether it has one section and no joints."""
        return len(self.sections) == 1 and not self.joints

    @property
    def flexural_rigidity(self) -> float:
        """EI of the uniform beam of the same mean flexibility, l/EI = Σ lᵢ/EIᵢ, N·m per metre of width."""
        if len(self.sections) == 1:
            return self.sections[0].flexural_rigidity
        return self.length / fsum(part.length / part.flexural_rigidity for part in self.sections)

    @property
    def mass_per_length(self) -> float:
        """Mean mass per length and metre of width, kg/m²."""
        if len(self.sections) == 1:
            return self.sections[0].mass_per_length
        return fsum(part.length * part.mass_per_length for part in self.sections) / self.length

    @property
    def has_uniform_mass(self) -> bool:
        """Whether its mass per length is uniform."""
        return len({part.mass_per_length for part in self.sections}) == 1

    def moved(self, shift: float) -> Self:
        """Return the same beam further to the right, m."""
        return replace(self, start=self.start + shift)

    def scaled(self, units: Scales, start: float, end: float) -> Self:
        """Return the beam in other units, between given ends in these units."""
        # One section has exactly the whole length.
        stretch = (end - start) / self.length
        only = end - start if len(self.sections) == 1 else None
        return replace(
            self,
            start=start,
            sections=tuple(
                Section(
                    length=only or part.length * stretch,
                    flexural_rigidity=part.flexural_rigidity / units.flexural_rigidity,
                    mass_per_length=part.mass_per_length / units.mass_per_length,
                )
                for part in self.sections
            ),
            joints=tuple(
                Joint(
                    at=joint.at / units.length,
                    rotational_stiffness=joint.rotational_stiffness / units.rotational_stiffness,
                )
                for joint in self.joints
            ),
        )

    def is_mirror_image_of(self, other: object) -> bool:
        """Whether it is the mirror image of another body up to rounding, wherever both float."""
        return (
            isinstance(other, Beam)
            and (self.hydrostatic, self.ends) == (other.hydrostatic, other.ends)
            and same_beam(self, other.reversed)
        )

    def with_uniform_mass(self) -> Self:
        """Return the beam with a mass per length of 1 everywhere, and its left end at the origin."""
        return replace(self, start=0.0, sections=tuple(replace(part, mass_per_length=1.0) for part in self.sections))

    @property
    def hinges(self) -> tuple[float, ...]:
        """Where the joints without stiffness lie."""
        return tuple(joint.at for joint in self.joints if joint.rotational_stiffness == 0.0)

    @cached_property
    def edges(self) -> tuple[float, ...]:
        """Ends, steps and joints from left to right: between them a shape is smooth."""
        steps = [0.0]
        for part in self.sections[:-1]:
            steps.append(steps[-1] + part.length)
        steps.append(self.length)
        between = [j.at for j in self.joints if all(abs(j.at - s) > SAME_PLACE * self.length for s in steps)]
        return tuple(sorted([*steps, *between]))

    @cached_property
    def spans(self) -> tuple[Section, ...]:
        """The uniform parts between the `edges`, from left to right."""
        stops, reached = [], 0.0
        for part in self.sections:
            reached += part.length
            stops.append(reached)
        parts = []
        for left, right in pairwise(self.edges):
            owner = next(
                (part for part, stop in zip(self.sections, stops, strict=True) if 0.5 * (left + right) < stop),
                self.sections[-1],
            )
            parts.append(replace(owner, length=right - left))
        return tuple(parts)

    def rigidity_of(self, span: int, fractions: FloatArray) -> FloatArray:
        """EI, N·m, at fractions of the length of a span; in the shape of `fractions`."""
        return np.full_like(fractions, self.spans[span].flexural_rigidity)

    def mass_of(self, span: int, fractions: FloatArray) -> FloatArray:
        """m, kg/m², at fractions of the length of a span; in the shape of `fractions`."""
        return np.full_like(fractions, self.spans[span].mass_per_length)

    def node_of(self, joint: Joint) -> int:
        """Number of the edge at which a joint lies."""
        return min(range(len(self.edges)), key=lambda number: abs(self.edges[number] - joint.at))

    @cached_property
    def reversed(self) -> Self:
        """The beam seen from the other side, in its place."""
        return replace(
            self,
            sections=self.sections[::-1],
            joints=tuple(replace(joint, at=self.length - joint.at) for joint in reversed(self.joints)),
        )

    @cached_property
    def is_mirror_image(self) -> bool:
        """Whether it is its own mirror image up to rounding."""
        return self.is_mirror_image_of(self)


def same_beam(one: Beam, other: Beam) -> bool:
    """Whether two beams are equal up to rounding, wherever they float."""
    numbers, others = _numbers(one), _numbers(other)
    return len(numbers) == len(others) and all(
        abs(a - b) <= _ALIKE * max(abs(a), abs(b), scale) for (a, scale), (b, _) in zip(numbers, others, strict=True)
    )


def _numbers(beam: Beam) -> list[tuple[float, float]]:
    """The numbers that describe a beam, each with the magnitude that its rounding is relative to."""
    spans = [
        number
        for part in beam.spans
        for number in ((part.length, beam.length), (part.flexural_rigidity, 0.0), (part.mass_per_length, 0.0))
    ]
    joints = [n for j in beam.joints for n in ((j.at, beam.length), (j.rotational_stiffness, 0.0))]
    return [*spans, *joints, (float(len(beam.joints)), 0.0)]


def defines_shape_direction(beam: Beam) -> bool:
    """Whether shapes are computed in the direction of this beam, and not in that of its reverse.

    Twins then have shapes that are mirror images of each other, with their signs.
    """
    for (own, scale), (other, _) in zip(_numbers(beam), _numbers(beam.reversed), strict=True):
        if abs(own - other) > _ALIKE * max(abs(own), abs(other), scale):
            return own < other
    return True


@lru_cache(maxsize=64)
def _first_dofs(rigid: tuple[Dof, ...], count: int) -> tuple[Dof, ...]:
    return (*rigid, *(Dof.elastic(number + 1) for number in range(count - len(rigid))))[:count]
