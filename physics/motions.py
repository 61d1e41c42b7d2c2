"""Levels at which bodies float, and the motions of rigid bodies."""

from __future__ import annotations

from typing import Literal, TypeAlias

Level: TypeAlias = Literal["interface", "surface"]
"""At which a body floats: between two liquids, or at the top of the uppermost."""

Motion: TypeAlias = Literal["heave", "sway", "roll"]

MOTIONS: tuple[Motion, ...] = ("heave", "sway", "roll")
"""Up, to the right, and anticlockwise about the centre of mass."""
