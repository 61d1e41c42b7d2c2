"""The tank as plain geometry: a rectangle whose top is cut into named surface segments."""

from __future__ import annotations

from dataclasses import dataclass

LIQUID = "liquid"
LOWER_LIQUID = "lower_liquid"
UPPER_LIQUID = "upper_liquid"
FREE_SURFACE = "free_surface"
INTERFACE = "interface"
BAFFLE = "baffle"
LID = "lid"
BOTTOM = "bottom"
LEFT_WALL = "left_wall"
RIGHT_WALL = "right_wall"
SYMMETRY_PLANE = "symmetry_plane"
AXIS = "axis"
FAR_END = "far_end"


@dataclass(frozen=True, kw_only=True)
class SurfaceSegment:
    """A piece ``start < x < end`` of the tank's top, and the physical name that its facets carry."""

    name: str
    start: float
    end: float


@dataclass(frozen=True, kw_only=True)
class TankGeometry:
    """Rectangle ``0 < x < length``, ``-depth < y < 0``; its top is covered by segments from left to right.

    Raises:
        ValueError: if the segments do not cover the top, one after the other, without gap or overlap.
    """

    length: float  # of the rectangle
    depth: float  # of the rectangle
    segments: tuple[SurfaceSegment, ...]  # the top
    mirrored: bool = False  # whether x = length is a plane of symmetry instead of a wall

    def __post_init__(self) -> None:
        ends = [0.0, *(segment.end for segment in self.segments)]
        starts = [*(segment.start for segment in self.segments), self.length]
        if ends != starts or any(segment.start >= segment.end for segment in self.segments):
            raise ValueError("the surface segments must cover the tank's top from 0 to its length, in order")

    @property
    def right_end(self) -> str:
        """Physical name of the boundary x = length."""
        return SYMMETRY_PLANE if self.mirrored else RIGHT_WALL

    @property
    def tips(self) -> tuple[float, ...]:
        """Abscissae of the ends of bodies, where ψ is singular: every joint of two segments, and bodies at a wall."""
        joints = [segment.end for segment in self.segments[:-1]]
        if self.segments[0].name not in (FREE_SURFACE, LID):
            joints.insert(0, 0.0)
        # A body continues beyond a plane of symmetry: it has no end there.
        if not self.mirrored and self.segments[-1].name not in (FREE_SURFACE, LID):
            joints.append(self.length)
        return tuple(joints)


def tank_geometry(
    *, length: float, depth: float, pieces: tuple[tuple[float, float, str], ...], mirrored: bool = False
) -> TankGeometry:
    """Return the geometry of a tank from ``(start, end, name)`` of the pieces of its top, from left to right; all
    lengths in one unit, m or dimensionless."""
    segments = tuple(SurfaceSegment(name=name, start=start, end=end) for start, end, name in pieces)
    return TankGeometry(length=length, depth=depth, segments=segments, mirrored=mirrored)
