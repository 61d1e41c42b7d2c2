"""Rigid things in a tank at rest: baffles, which are thin plates in the liquid, and columns from the bed to the top."""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import inf
from typing import TypeAlias

from hydroelastic.physics.plate import Disc, Point, Rectangle, scaled_point


@dataclass(frozen=True, kw_only=True)
class VerticalBaffle:
    """A vertical rectangle; what lies outside of the liquid is left out."""

    start: Point  # x and y of one of its upright sides, m
    end: Point  # of the other one
    bottom: float = -inf  # z of its lower side, m; −∞ stands on the bed
    top: float = 0.0  # z of its upper side, m; 0 pierces the still surface

    def scaled(self, length: float) -> VerticalBaffle:
        """Return it in units of a length."""
        return VerticalBaffle(
            start=scaled_point(self.start, length),
            end=scaled_point(self.end, length),
            bottom=self.bottom / length,
            top=self.top / length,
        )

    def mirrored(self, axis: int, middle: float) -> VerticalBaffle:
        """Return its image in a plane normal to an axis, with its sides in order."""
        one, other = sorted(_image(point, axis, middle) for point in (self.start, self.end))
        return VerticalBaffle(start=one, end=other, bottom=self.bottom, top=self.top)


@dataclass(frozen=True, kw_only=True)
class LevelBaffle:
    """A horizontal plate under the still surface."""

    outline: Rectangle | Disc  # rectangle, disc or ring
    level: float  # its z, m

    def scaled(self, length: float) -> LevelBaffle:
        """Return it in units of a length."""
        return LevelBaffle(outline=self.outline.scaled(length), level=self.level / length)

    def mirrored(self, axis: int, middle: float) -> LevelBaffle:
        """Return its image in a plane normal to an axis."""
        return LevelBaffle(outline=mirrored_outline(self.outline, axis, middle), level=self.level)


_DIGITS = 9

Baffle: TypeAlias = VerticalBaffle | LevelBaffle
"""A thin rigid plate in the liquid: ψ_n = 0 on both sides, between which ψ jumps."""


def mirrored_outline(outline: Rectangle | Disc, axis: int, middle: float) -> Rectangle | Disc:
    """Return the image of an outline in a plane normal to an axis."""
    return replace(outline, position=_image(outline.position, axis, middle))


def _image(point: Point, axis: int, middle: float) -> Point:
    place = list(point)
    place[axis] = 2.0 * middle - place[axis]
    # Decimal input and its image differ by a few units of the last place.
    return round(place[0], _DIGITS), round(place[1], _DIGITS)
