"""The scene of a heavy string that hangs in a resisting medium while its upper end is moved. SI units."""

from __future__ import annotations

from functools import cached_property
from pathlib import Path
from typing import Annotated, Any, Literal, TypeAlias

from pydantic import (
    BeforeValidator,
    Discriminator,
    Field,
    Strict,
    Tag,
)

from hydroelastic.physics.string import HangingString as PhysicalString
from hydroelastic.scenes.models.folder import SceneInFolder
from hydroelastic.scenes.models.number_files import read_columns
from hydroelastic.scenes.models.scene_model import AnyNumber, PositiveNumber, SceneModel
from hydroelastic.scenes.models.values import OR_SWEEP, NumberFromZero, OrElse, Sweep, Title, ascending_values, kind_of

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


def _uniform(value: Any) -> Any:
    is_number = isinstance(value, int | float) and not isinstance(value, bool)
    return {"bottom": value, "top": value} if is_number else value


class HangingString(SceneModel):
    """The string and its tip mass."""

    length: PositiveNumber = Field(description="length of the string, m")
    linear_density: PositiveNumber = Field(description="ρ, mass of the string per length, kg/m")
    resistance: Annotated[Resistance, BeforeValidator(_uniform), OrElse({"type": "number"})] = Field(
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
    def physical(self) -> PhysicalString:
        """The string in SI units.

        Raises:
            ValueError: if it is not under tension; the checks of a scene refuse that first.
        """
        # NumPy is not needed to read a scene of another kind.

        return PhysicalString(
            length=self.length,
            linear_density=self.linear_density,
            gravity=self.gravity,
            resistance=(self.resistance.bottom, self.resistance.top),
            tip_mass=self.tip_mass,
            added_mass=self.added_mass,
            displaced_mass=self.displaced_mass,
            tip_displaced_mass=self.tip_displaced_mass,
        )


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
    """f by a table, from a file or in the scene."""

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
    """Positions and times at which the displacement is reported."""

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
    """Requested accuracy."""

    tolerance: Annotated[float, Strict(), Field(ge=1e-12, le=1e-1)] = Field(
        default=1e-6,
        description="asked error of the displacement, relative to the largest one, and of the frequencies",
    )
    modes: Annotated[int, Strict(), Field(ge=1, le=200)] = Field(
        default=10, description="how many modes, from the lowest"
    )
    method: Literal["auto", "series", "field"] = Field(
        default="auto",
        description="series of the closed form, field solution, or the series where it exists",
    )


class StringParts(SceneInFolder):
    """The parts of the scene of a hanging string, each valid by itself; `StringScene` checks their consistency."""

    kind: Literal["string"] = Field(default="string", description="kind of the scene")
    title: Title = Field(default="", description="title of tables and images")
    string: HangingString = Field(description="the string")
    motion: Motion = Field(description="how the upper end moves")
    output: StringOutput = Field(default=StringOutput(), description="where and when the displacement is reported")
    accuracy: StringAccuracy = Field(default=StringAccuracy(), description="what is asked of the answer")

    @property
    def positions(self) -> tuple[float, ...]:
        """Positions at which the displacement is reported, m."""
        if self.output.positions is not None:
            return self.output.positions
        # Evenly spread over the travel time of waves, which slow down towards the free end.
        last = DEFAULT_POSITIONS - 1
        return tuple(self.string.length * (place / last) ** 2 for place in range(DEFAULT_POSITIONS))

    @property
    def times(self) -> tuple[float, ...]:
        """Times at which the displacement is reported, s."""
        if self.output.times is not None:
            return self.output.times
        last = DEFAULT_TRAVEL_TIMES * self.string.physical.travel_time
        last = last if self.table is None else min(last, self.table[-1][0])
        return Sweep(start=0.0, stop=last, number=DEFAULT_TIMES).values

    @cached_property
    def table(self) -> tuple[tuple[float, ...], ...] | None:
        """The rows of a motion by a table, time in s and displacement in m; ``None`` for other motions.

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
        """Method of solution."""
        if self.accuracy.method != "auto":
            return self.accuracy.method
        return "series" if self.string.physical.has_closed_form else "field"
