"""A beam of uniform sections with elastic joints and hinges: what it is made of, and where it may bend or kink."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from itertools import pairwise
from math import isfinite

SAME_PLACE = 1e-9
"""Places closer than this part of the beam's length are one: decimal input is not exact."""

_ALIKE = 1e-12


@dataclass(frozen=True, kw_only=True)
class Section:
    """A uniform part of a beam, per metre of width.

    Attributes:
        length: its length, m.
        flexural_rigidity: EI, N·m.
        mass_per_length: m, kg/m².
    """

    length: float
    flexural_rigidity: float
    mass_per_length: float


@dataclass(frozen=True, kw_only=True)
class Joint:
    """A place at which the slope may jump: k (w′(x+) − w′(x−)) = EI w″(x).

    Attributes:
        at: distance from the beam's left end, m.
        rotational_stiffness: k per metre of width, N·m/rad; 0 is a hinge.
    """

    at: float
    rotational_stiffness: float


@dataclass(frozen=True, kw_only=True)
class JointedBeam:
    """A beam with free ends; sections are welded to each other where there is no joint.

    Attributes:
        sections: from left to right.
        joints: from left to right.

    Raises:
        ValueError: if a number is not positive and finite, or a joint lies at an end, outside, or upon another.
    """

    sections: tuple[Section, ...]
    joints: tuple[Joint, ...] = ()

    def __post_init__(self) -> None:
        """Refuse what is no beam."""
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
        return sum(part.length for part in self.sections)

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

    def node_of(self, joint: Joint) -> int:
        """Number of the edge at which a joint lies."""
        return min(range(len(self.edges)), key=lambda number: abs(self.edges[number] - joint.at))

    @cached_property
    def reversed(self) -> JointedBeam:
        """The beam seen from the other side."""
        return JointedBeam(
            sections=self.sections[::-1],
            joints=tuple(replace(joint, at=self.length - joint.at) for joint in reversed(self.joints)),
        )

    @cached_property
    def is_mirror_image(self) -> bool:
        """Whether it is its own mirror image, but for rounding."""
        return alike(self, self.reversed)


def alike(one: JointedBeam, other: JointedBeam) -> bool:
    """Whether two beams are equal but for rounding."""
    numbers, others = _numbers(one), _numbers(other)
    return len(numbers) == len(others) and all(
        abs(a - b) <= _ALIKE * max(abs(a), abs(b), scale) for (a, scale), (b, _) in zip(numbers, others, strict=True)
    )


def _numbers(beam: JointedBeam) -> list[tuple[float, float]]:
    """All that describes a beam, each number with the size beside which it may be rounding."""
    spans = [
        number
        for part in beam.spans
        for number in ((part.length, beam.length), (part.flexural_rigidity, 0.0), (part.mass_per_length, 0.0))
    ]
    joints = [n for j in beam.joints for n in ((j.at, beam.length), (j.rotational_stiffness, 0.0))]
    return [*spans, *joints, (float(len(beam.joints)), 0.0)]


def comes_first(beam: JointedBeam) -> bool:
    """Whether of a beam and its reverse this is the one in whose direction shapes are computed.

    Twins then have shapes that are mirror images of each other, with their signs.
    """
    for (own, scale), (other, _) in zip(_numbers(beam), _numbers(beam.reversed), strict=True):
        if abs(own - other) > _ALIKE * max(abs(own), abs(other), scale):
            return own < other
    return True
