"""The scene of a heavy string that hangs in a resisting medium while its upper end is moved. SI units."""

from __future__ import annotations

from functools import cached_property
from math import sqrt
from pathlib import Path
from typing import Annotated, Any, Literal, TypeAlias

from pydantic import (
    BeforeValidator,
    Discriminator,
    Field,
    Strict,
    Tag,
    model_validator,
)

from hydroelastic.scenes.models.bodies import AnyNumber, PositiveNumber, SceneModel
from hydroelastic.scenes.models.folder import SceneInFolder
from hydroelastic.scenes.models.number_files import read_columns
from hydroelastic.scenes.models.problems import require_fit
from hydroelastic.scenes.models.string_checks import STAGES
from hydroelastic.scenes.models.title import Title
from hydroelastic.scenes.models.values import OR_SWEEP, NumberFromZero, Sweep, ascending_values, kind_of

MOST_POSITIONS, MOST_TIMES = 100_000, 1_000_000
DEFAULT_POSITIONS = 101
DEFAULT_TIMES = 241
DEFAULT_TRAVEL_TIMES = 6.4
"""How long the response is followed if no times are given, in travel times R of a wave along the string. In 240 steps
no time lies at R, 3R and 5R, when waves focus at the free end."""


class Resistance(SceneModel):
    """Resistance of the medium that varies linearly along the string."""

    bottom: NumberFromZero = Field(description="λ at the free end, kg/(m·s)")
    top: NumberFromZero = Field(description="λ at the upper end, kg/(m·s)")

    @property
    def is_uniform(self) -> bool:
        """Whether it is the same everywhere."""
        return self.bottom == self.top


def _uniform(value: Any) -> Any:
    """A bare number is a uniform resistance."""
    is_number = isinstance(value, int | float) and not isinstance(value, bool)
    return {"bottom": value, "top": value} if is_number else value


class HangingString(SceneModel):
    """The string, and what hangs on it."""

    length: PositiveNumber = Field(description="length of the string, m")
    linear_density: PositiveNumber = Field(description="ρ, mass of the string per length, kg/m")
    resistance: Annotated[Resistance, BeforeValidator(_uniform)] = Field(
        default=Resistance(bottom=0.0, top=0.0),
        description="λ, half of the drag per length and velocity (the drag is 2λ ∂U/∂t), kg/(m·s), or a table "
        "{bottom, top} between which it varies linearly",
    )
    gravity: PositiveNumber = Field(default=9.81, description="acceleration of gravity, m/s²")
    tip_mass: NumberFromZero = Field(default=0.0, description="mass that hangs on the free end, kg")
    tip_displaced_mass: NumberFromZero = Field(
        default=0.0, description="mass of the liquid that the body on the free end displaces, kg"
    )
    added_mass: NumberFromZero = Field(
        default=0.0, description="mass of liquid that moves with the string, per length, kg/m"
    )
    displaced_mass: NumberFromZero = Field(
        default=0.0, description="mass of the liquid that the string displaces, per length, kg/m; it carries part of it"
    )

    @property
    def inertia(self) -> float:
        """Mass that moves, per length, kg/m."""
        return self.linear_density + self.added_mass

    @property
    def apparent_gravity(self) -> float:
        """What g becomes where liquid carries and burdens the string, g(ρ − ρ_d)/(ρ + m_a), m/s²."""
        return self.gravity * (self.linear_density - self.displaced_mass) / self.inertia

    @property
    def damping(self) -> float:
        """Mean α = λ/(ρ + m_a), 1/s."""
        return 0.5 * (self.resistance.bottom + self.resistance.top) / self.inertia

    @property
    def travel_time(self) -> float:
        """R, the time in which a wave runs along the string, s; 2√(l/g') without a body on its end."""
        # √x falls by as much as the body's weight lifts it: 2√(l/g') (√(1 + b) − √b), b its weight over the string's.
        weight = (self.tip_mass - self.tip_displaced_mass) / (self.length * (self.linear_density - self.displaced_mass))
        return 2.0 * sqrt(self.length / self.apparent_gravity) / (sqrt(1.0 + weight) + sqrt(weight))

    @property
    def has_closed_form(self) -> bool:
        """Whether Bessel functions and exponentials solve it: nothing on its end, and a uniform resistance."""
        return self.tip_mass == 0.0 and self.resistance.is_uniform


class RampMotion(SceneModel):
    """f = Vt."""

    kind: Literal["ramp"] = Field(default="ramp", description="kind of the motion")
    speed: AnyNumber = Field(description="speed V, m/s")


class SineMotion(SceneModel):
    """f = Δ sin ωt."""

    kind: Literal["sine"] = Field(default="sine", description="kind of the motion")
    amplitude: AnyNumber = Field(description="amplitude Δ, m")
    omega: PositiveNumber = Field(description="angular frequency ω, rad/s")


class SmoothMotion(SceneModel):
    """f = Δ(1 − e^{−βt})²."""

    kind: Literal["smooth"] = Field(default="smooth", description="kind of the motion")
    amplitude: AnyNumber = Field(description="amplitude Δ, m")
    rate: PositiveNumber = Field(description="rate β, 1/s")


class StepMotion(SceneModel):
    """f = Δ from t = 0 on."""

    kind: Literal["step"] = Field(default="step", description="kind of the motion")
    amplitude: AnyNumber = Field(description="amplitude Δ, m")


class TableMotion(SceneModel):
    """f by a table, from a file or written out."""

    kind: Literal["table"] = Field(default="table", description="kind of the motion")
    file: Path | None = Field(
        default=None,
        description="text file with two columns, time in s and displacement in m; relative to the folder of the scene",
    )
    times: tuple[NumberFromZero, ...] | None = Field(default=None, description="times, s, from 0 up")
    values: tuple[AnyNumber, ...] | None = Field(default=None, description="displacements at these times, m")
    interpolation: Literal["cubic", "linear"] = Field(
        default="cubic", description="between the rows: a spline whose curvature is continuous, or straight lines"
    )


Motion: TypeAlias = Annotated[
    Annotated[RampMotion, Tag("ramp")]
    | Annotated[SineMotion, Tag("sine")]
    | Annotated[SmoothMotion, Tag("smooth")]
    | Annotated[StepMotion, Tag("step")]
    | Annotated[TableMotion, Tag("table")],
    Discriminator(kind_of),
]
"""How the upper end moves: the key ``kind`` tells."""


class StringOutput(SceneModel):
    """Where and when the displacement is reported."""

    positions: Annotated[tuple[NumberFromZero, ...], *ascending_values(MOST_POSITIONS)] | None = Field(
        default=None,
        description=f"heights above the free end at rest, m, {OR_SWEEP}; by default {DEFAULT_POSITIONS}, closer below",
    )
    times: Annotated[tuple[NumberFromZero, ...], *ascending_values(MOST_TIMES)] | None = Field(
        default=None,
        description=f"times, s, {OR_SWEEP}; by default {DEFAULT_TIMES}, for {DEFAULT_TRAVEL_TIMES:g} travel times",
    )
    frames: Annotated[int, Strict(), Field(ge=0, le=1000)] = Field(
        default=60, description="pictures of the string in motion, evenly spread over the times; 0 for none"
    )


class StringAccuracy(SceneModel):
    """What is asked of the answer."""

    tolerance: Annotated[float, Strict(), Field(ge=1e-12, le=1e-1)] = Field(
        default=1e-6,
        description="asked error of the displacement, relative to the largest one, and of the frequencies",
    )
    modes: Annotated[int, Strict(), Field(ge=1, le=200)] = Field(
        default=10, description="how many modes, from the lowest"
    )
    method: Literal["auto", "series", "field"] = Field(
        default="auto",
        description="series of the closed form, field solution, or the series wherever there is one",
    )


class StringScene(SceneInFolder):
    """A heavy string that hangs in a resisting medium while its upper end is moved.

    Raises:
        ValidationError: (a ValueError) if a value is not allowed or the parts do not fit together.
    """

    kind: Literal["string"] = Field(default="string", description="kind of the scene")
    title: Title = Field(default="", description="title of tables and images")
    string: HangingString = Field(description="the string")
    motion: Motion = Field(description="how the upper end moves")
    output: StringOutput = Field(default=StringOutput(), description="where and when the displacement is reported")
    accuracy: StringAccuracy = Field(default=StringAccuracy(), description="what is asked of the answer")

    @property
    def positions(self) -> tuple[float, ...]:
        """Where the displacement is reported, m."""
        if self.output.positions is not None:
            return self.output.positions
        # Evenly spread over the travel time of waves, which slow down towards the free end.
        last = DEFAULT_POSITIONS - 1
        return tuple(self.string.length * (place / last) ** 2 for place in range(DEFAULT_POSITIONS))

    @property
    def times(self) -> tuple[float, ...]:
        """When the displacement is reported, s."""
        if self.output.times is not None:
            return self.output.times
        last = DEFAULT_TRAVEL_TIMES * self.string.travel_time
        last = last if self.table is None else min(last, self.table[-1][0])
        return Sweep(start=0.0, stop=last, number=DEFAULT_TIMES).values

    @cached_property
    def table(self) -> tuple[tuple[float, ...], ...] | None:
        """The rows of a motion by a table, time in s and displacement in m; of other motions ``None``.

        Raises:
            ValueError: if its file cannot be read.
        """
        if not isinstance(self.motion, TableMotion):
            return None
        if self.motion.file is not None:
            return tuple(read_columns(self._folder / self.motion.file, 2))
        return tuple(zip(self.motion.times or (), self.motion.values or (), strict=True))

    @property
    def method(self) -> Literal["series", "field"]:
        """How the response is found."""
        if self.accuracy.method != "auto":
            return self.accuracy.method
        return "series" if self.string.has_closed_form else "field"

    @model_validator(mode="after")
    def _parts_fit(self) -> StringScene:
        require_fit(self, STAGES)
        return self
