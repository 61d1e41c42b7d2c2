"""Analyses of open water as frozen values: radiation, response to waves, resonances, decay after release. SI units."""

from __future__ import annotations

from typing import Annotated, Any, Literal, TypeAlias

from pydantic import (
    AfterValidator,
    BeforeValidator,
    Discriminator,
    Field,
    Strict,
    Tag,
    ValidationError,
    model_validator,
)

from hydroelastic.scenes.errors import scene_error
from hydroelastic.scenes.model_bodies import LARGEST, AnyNumber, PositiveNumber, SceneModel
from hydroelastic.scenes.model_infinity import ZeroOrMoreOrInfinite
from hydroelastic.scenes.model_problems import misfit, problem

MOST_VALUES = 10000
"""Frequencies or times of one analysis."""


NumberFromZero: TypeAlias = Annotated[float, Strict(), Field(ge=0, le=LARGEST)]


class Sweep(SceneModel):
    """Values from a first to a last one."""

    start: NumberFromZero = Field(description="first value")
    stop: NumberFromZero = Field(description="last value, greater than the first")
    number: Annotated[int, Strict(), Field(ge=2, le=MOST_VALUES)] = Field(description="how many values, with both ends")
    spacing: Literal["linear", "logarithmic"] = Field(default="linear", description="equal differences or ratios")

    @model_validator(mode="after")
    def _goes_up(self) -> Sweep:
        problems = []
        if self.stop <= self.start:
            problems.append(misfit(("stop",), self.stop, "it is not greater than start", allowed=f"> {self.start:g}"))
        elif self.start == 0.0 and self.spacing == "logarithmic":
            problems.append(
                misfit(("start",), self.start, "equal ratios cannot begin with 0", allowed='> 0, or spacing = "linear"')
            )
        if problems:
            raise ValidationError.from_exception_data(type(self).__name__, problems)
        return self

    @property
    def values(self) -> tuple[float, ...]:
        """The values themselves."""
        steps = [place / (self.number - 1) for place in range(self.number)]
        if self.spacing == "linear":
            inner = [self.start + step * (self.stop - self.start) for step in steps]
        else:
            inner = [self.start * (self.stop / self.start) ** step for step in steps]
        return (*inner[:-1], self.stop)


def _expanded(value: Any) -> Any:
    """Write the table of a sweep out as a list."""
    if not isinstance(value, dict):
        return value
    try:
        return Sweep.model_validate(value).values
    except ValidationError as error:
        first = scene_error(error, Sweep).problems[0]
        subject = f"{first.key} = {first.value}" if first.value else first.key
        raise problem(f"in its table, {subject}: {first.wrong}", allowed=first.allowed, remedy=first.remedy) from error


def _all_different(values: tuple[float, ...]) -> tuple[float, ...]:
    if len(set(values)) < len(values):
        twice = next(value for value in values if values.count(value) > 1)
        raise problem(f"{twice:g} is named twice", remedy="Name each once")
    return values


_LIST = (
    BeforeValidator(_expanded),
    AfterValidator(_all_different),
    Field(min_length=1, max_length=MOST_VALUES),
)
_OR_SWEEP = "or a table {start, stop, number, spacing} of them"


class Radiation(SceneModel):
    """Added mass, radiation damping and excitation forces."""

    kind: Literal["radiation"] = Field(default="radiation", description="kind of the analysis")
    omega: Annotated[tuple[ZeroOrMoreOrInfinite, ...], *_LIST] = Field(
        description=f"frequencies, rad/s, {_OR_SWEEP}; 0 for very long waves, inf for the limit far above the waves"
    )
    elastic_modes: Annotated[int, Strict(), Field(ge=0, le=200)] = Field(
        default=4, description="how many elastic shapes of each beam are reported"
    )


class Response(SceneModel):
    """Motions, reflection and transmission in incident waves."""

    kind: Literal["response"] = Field(default="response", description="kind of the analysis")
    omega: Annotated[tuple[PositiveNumber, ...], *_LIST] = Field(description=f"frequencies, rad/s, {_OR_SWEEP}")
    waves_from: Literal["left", "right"] = Field(default="left", description="the side from which waves come")
    positions: Annotated[int, Strict(), Field(ge=2, le=MOST_VALUES)] = Field(
        default=101, description="points along each beam at which its deflection is reported"
    )


class Resonance(SceneModel):
    """Complex frequencies of motions that die out by themselves."""

    kind: Literal["resonance"] = Field(default="resonance", description="kind of the analysis")
    count: Annotated[int, Strict(), Field(ge=1, le=200)] = Field(
        default=4, description="how many, from the smallest |ω|; of those below a frequency, if one is given, at most"
    )
    below: PositiveNumber | None = Field(default=None, description="rad/s; all whose Re ω is below it are asked for")
    largest_damping: Annotated[float, Strict(), Field(ge=1e-6, le=1)] = Field(
        default=0.5, description="largest −Im ω/Re ω that is looked for"
    )


class Release(SceneModel):
    """Where a float is let go, at rest."""

    heave: AnyNumber = Field(default=0.0, description="m upwards")
    roll: AnyNumber = Field(default=0.0, description="rad anticlockwise")

    @model_validator(mode="after")
    def _is_somewhere(self) -> Release:
        if self.heave == self.roll == 0.0:
            raise problem("the float is let go where it rests", allowed="a heave or a roll other than 0")
        return self


def _as_heave(value: Any) -> Any:
    """A bare number is a heave."""
    return {"heave": value} if not isinstance(value, dict | Release) else value


class Decay(SceneModel):
    """The motion of a float that is let go."""

    kind: Literal["decay"] = Field(default="decay", description="kind of the analysis")
    displacement: Annotated[Release, BeforeValidator(_as_heave)] = Field(
        description="where the float is let go: heave in m, or a table {heave, roll} in m and rad"
    )
    body: Annotated[int, Strict(), Field(ge=1, le=1000)] = Field(
        default=1, description="number of the float among the bodies, from 1"
    )
    times: Annotated[tuple[NumberFromZero, ...], *_LIST] = Field(description=f"times, s, {_OR_SWEEP}")


def _kind_of(analysis: Any) -> str:
    """Which model an analysis is read with."""
    kind = analysis.get("kind", "") if isinstance(analysis, dict) else getattr(analysis, "kind", "")
    return str(kind)


Analysis: TypeAlias = Annotated[
    Annotated[Radiation, Tag("radiation")]
    | Annotated[Response, Tag("response")]
    | Annotated[Resonance, Tag("resonance")]
    | Annotated[Decay, Tag("decay")],
    Discriminator(_kind_of),
]
"""Any analysis: the key ``kind`` tells which."""
