"""Columns and baffles of a tank in three dimensions, as they are written in scenes. SI units."""

from __future__ import annotations

from collections.abc import Iterator
from math import inf
from typing import TypeAlias

from pydantic import Field, ValidationError, model_validator
from pydantic_core import InitErrorDetails

from hydroelastic.physics.obstacles import Baffle, LevelBaffle, VerticalBaffle
from hydroelastic.physics.plate import Disc, Point, Rectangle
from hydroelastic.scenes.models.problems import problem_at
from hydroelastic.scenes.models.scene_model import AnyNumber, PositiveNumber, SparseModel

PlanPoint: TypeAlias = tuple[AnyNumber, AnyNumber]


class GivenColumn(SparseModel):
    """A rigid column from the bed to above the still surface: a cylinder or a box.

    Raises:
        SceneError: if it has neither radius nor size, or both.
    """

    position: PlanPoint | None = Field(
        default=None, description="[x, y] of its axis, m; by default the middle of the tank"
    )
    radius: PositiveNumber | None = Field(default=None, description="radius of a cylinder, m")
    size: tuple[PositiveNumber, PositiveNumber] | None = Field(
        default=None, description="[along x, along y] of a box, m"
    )

    @model_validator(mode="after")
    def _keys_fit(self) -> GivenColumn:
        if (self.radius is None) == (self.size is None):
            wrong = "the section of the column is missing" if self.radius is None else "the column has two sections"
            problem = problem_at(("radius",), self.radius, wrong, allowed="radius of a cylinder, or size of a box")
            raise ValidationError.from_exception_data(type(self).__name__, [problem])
        return self

    def outline(self, middle: Point) -> Rectangle | Disc:
        """Return its section in a tank with this middle."""
        return _outline(self.position or middle, self.radius, self.size)


class GivenBaffle(SparseModel):
    """A thin rigid plate that does not move: vertical from start to end, or horizontal at a level.

    Raises:
        SceneError: if keys of both are given, or one is missing.
    """

    start: PlanPoint | None = Field(default=None, description="[x, y] of one upright side of a vertical baffle, m")
    end: PlanPoint | None = Field(default=None, description="[x, y] of the other one, m")
    bottom: AnyNumber | None = Field(
        default=None, description="z of its lower side, m, less than 0; by default it stands on the bed"
    )
    top: AnyNumber | None = Field(
        default=None, description="z of its upper side, m; by default 0, it reaches to the still surface"
    )
    level: AnyNumber | None = Field(default=None, description="z of a horizontal baffle, m, less than 0")
    position: PlanPoint | None = Field(
        default=None, description="[x, y] of its middle, m; by default the middle of the tank"
    )
    size: tuple[PositiveNumber, PositiveNumber] | None = Field(
        default=None, description="[along x, along y] of a horizontal rectangle, m"
    )
    radius: PositiveNumber | None = Field(default=None, description="radius of a horizontal disc or ring, m")
    inner_radius: PositiveNumber | None = Field(default=None, description="inner radius of a horizontal ring, m")

    @model_validator(mode="after")
    def _keys_fit(self) -> GivenBaffle:
        problems = list(_keys_of_the_baffle(self))
        if problems:
            raise ValidationError.from_exception_data(type(self).__name__, problems)
        return self

    def physical(self, middle: Point) -> Baffle:
        """Return the baffle in a tank with this middle."""
        if self.level is not None:
            outline = _outline(self.position or middle, self.radius, self.size, self.inner_radius)
            return LevelBaffle(outline=outline, level=self.level)
        assert self.start is not None
        assert self.end is not None
        return VerticalBaffle(
            start=self.start, end=self.end, bottom=-inf if self.bottom is None else self.bottom, top=self.top or 0.0
        )


def _outline(
    position: Point, radius: float | None, size: Point | None, inner_radius: float | None = None
) -> Rectangle | Disc:
    if size is not None:
        return Rectangle(position=position, size=size)
    assert radius is not None
    return Disc(position=position, radius=radius, inner_radius=inner_radius or 0.0)


_VERTICAL, _LEVEL = ("start", "end", "bottom", "top"), ("level", "position", "size", "radius", "inner_radius")


def _keys_of_the_baffle(baffle: GivenBaffle) -> Iterator[InitErrorDetails]:
    vertical = baffle.level is None
    allowed = "start and end of a vertical baffle, or level with size or radius of a horizontal one"
    for key in _LEVEL if vertical else _VERTICAL:
        if getattr(baffle, key) is not None:
            said = "vertical" if vertical else "horizontal"
            wrong = f"it does not belong to a {said} baffle, which has {'no level' if vertical else 'a level'}"
            yield problem_at((key,), getattr(baffle, key), wrong, allowed=allowed)
            return
    if vertical:
        for key in ("start", "end"):
            if getattr(baffle, key) is None:
                yield problem_at((key,), None, "it is missing", allowed=allowed)
                return
        if baffle.start == baffle.end:
            yield problem_at(("end",), list(baffle.end or ()), "it is the same place as start")
        low, high = -inf if baffle.bottom is None else baffle.bottom, baffle.top or 0.0
        if low >= min(high, 0.0):
            key = "top" if baffle.bottom is None else "bottom"
            yield problem_at(
                (key,),
                getattr(baffle, key),
                "the baffle does not reach into the liquid",
                allowed="bottom below top and below 0",
            )
        return
    if (baffle.level or 0.0) >= 0.0:
        yield problem_at(("level",), baffle.level, "it is not below the still surface", allowed="less than 0")
    if (baffle.size is None) == (baffle.radius is None):
        wrong = "the outline of the baffle is missing" if baffle.size is None else "the baffle has two outlines"
        yield problem_at(("size",), None, wrong, allowed=allowed)
    elif baffle.inner_radius is not None and (baffle.radius is None or baffle.inner_radius >= baffle.radius):
        yield problem_at(("inner_radius",), baffle.inner_radius, "it is not inside of a radius", allowed="< radius")
