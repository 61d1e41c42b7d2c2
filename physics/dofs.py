"""Degrees of freedom of bodies: names, units and kinds."""

from __future__ import annotations

from collections.abc import Iterable
from functools import cache
from typing import Literal, TypeAlias

_BODY, _JOINT = "body_", "__"

Level: TypeAlias = Literal["interface", "surface"]
"""At which a body floats: between two liquids, or at the top of the uppermost."""

Motion: TypeAlias = Literal["heave", "sway", "roll", "surge", "pitch"]

SectionMotion: TypeAlias = Literal["heave", "sway", "roll"]
SolidMotion: TypeAlias = Literal["heave", "surge", "pitch"]

MOTIONS: tuple[SectionMotion, ...] = ("heave", "sway", "roll")
"""Of a section: up, to the right, and anticlockwise about the centre of mass."""

SOLID_MOTIONS: tuple[SolidMotion, ...] = ("heave", "surge", "pitch")
"""Of a solid: up, along x, and from z towards −x about its centre of mass, as the roll of its section."""

PLACES: dict[Motion, int] = {
    motion: place for motions in (MOTIONS, SOLID_MOTIONS) for place, motion in enumerate(motions)
}
"""Index of a motion in the inertia and stiffness of a float."""


@cache
def _kind(name: str) -> str:
    return name.rpartition(_JOINT)[2].split()[0]


class Dof(str):
    """A degree of freedom by its name, as Capytaine's but for the capital.

    "heave", "sway", "roll" and "pitch" are rigid motions, "hinge 1" … turn a beam about its hinges, "elastic 1" … are
    its dry modes, "elastic 2-1" … those of a round plate with two nodal diameters. Where several bodies
    move, the number of the body is in front: "body_2__elastic 1".
    """

    __slots__ = ()

    @classmethod
    def elastic(cls, number: int, order: int | None = None) -> Dof:
        """An elastic dry mode, counted from 1; of a round plate among those with `order` nodal diameters."""
        return cls(f"elastic {number}" if order is None else f"elastic {order}-{number}")

    @classmethod
    def hinge(cls, number: int) -> Dof:
        """The rigid motion of a beam about one of its hinges, counted from 1."""
        return cls(f"hinge {number}")

    def of_body(self, number: int) -> Dof:
        """The same degree of freedom of one of several bodies, counted from 1."""
        return type(self)(f"{body_name(number)}{_JOINT}{self}")

    @property
    def body(self) -> int | None:
        """Number of the body, from 1; ``None`` where there is one body only."""
        return body_number(self.partition(_JOINT)[0]) if _JOINT in self else None

    @property
    def motion(self) -> Dof:
        """The name without the body."""
        return type(self)(self.rpartition(_JOINT)[2])

    @property
    def kind(self) -> str:
        """The name without a number: "heave", "elastic" …"""
        return _kind(self)

    @property
    def is_elastic(self) -> bool:
        """Whether it is a bending mode."""
        return self.kind == "elastic"

    @property
    def is_first_elastic(self) -> bool:
        """Whether it is the lowest bending mode, of a round plate the lowest of some number of nodal diameters."""
        return self.is_elastic and self.replace("-", " ").endswith(" 1")

    @property
    def is_rotation(self) -> bool:
        """Whether it is an angle, rad, and not a length, m: the pitch of a beam is the deflection of its ends."""
        return self.kind == "roll"

    @property
    def capitalised(self) -> str:
        """The name as in Capytaine's datasets: "body_2__Heave"."""
        motion = self.motion
        return self.removesuffix(motion) + motion[:1].upper() + motion[1:]

    @property
    def words(self) -> str:
        """The name in words: "body 2 heave"."""
        return self.replace(_JOINT, " ").replace("_", " ")


class Turn(Dof):
    """The pitch of a solid, which is an angle."""

    __slots__ = ()

    @property
    def is_rotation(self) -> bool:
        """See `Dof.is_rotation`."""
        return True


FIRST_ELASTIC = Dof.elastic(1)
"""The lowest elastic dry mode."""


def dof_names(motions: Iterable[Iterable[str]]) -> tuple[Dof, ...]:
    """The degrees of freedom of some bodies, with the number of the body in front where there are several.

    Args:
        motions: those of each body, in the scene's order; empty for a body that does not move.
    """
    bodies = [tuple(name if isinstance(name, Dof) else Dof(name) for name in own) for own in motions]
    return tuple(dof.of_body(number) if len(bodies) > 1 else dof for number, own in enumerate(bodies, 1) for dof in own)


def body_name(number: int) -> str:
    """Name of a body, counted from 1 in the scene's order, and of its wetted surface in meshes."""
    return f"{_BODY}{number}"


def body_number(name: str) -> int | None:
    """Number of the body with a name, from 1; ``None`` if it is no body's."""
    return int(name.removeprefix(_BODY)) if name.startswith(_BODY) else None
