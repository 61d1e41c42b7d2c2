"""Levels at which bodies float, and the motions of rigid bodies."""

from __future__ import annotations

from typing import Literal, TypeAlias

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
