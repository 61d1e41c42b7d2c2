"""Lists of numbers in a scene, written out or as a sweep."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from math import inf
from typing import Annotated, Any, Literal, TypeAlias

from pydantic import (
    AfterValidator,
    BaseModel,
    BeforeValidator,
    Field,
    GetJsonSchemaHandler,
    PlainSerializer,
    Strict,
    ValidationError,
    model_validator,
)
from pydantic_core import CoreSchema

from hydroelastic.scenes.models.problems import problem, problem_at
from hydroelastic.scenes.models.scene_model import LARGEST, SMALLEST, SceneModel
from hydroelastic.scenes.validation_errors import scene_error

MOST_VALUES = 10000
"""Frequencies or times of one analysis."""

MOST_SWEPT = 1_000_000
"""Values of any sweep."""


ElasticModes: TypeAlias = Annotated[int, Strict(), Field(ge=0, le=200)]


def _on_one_line(title: str) -> str:
    if not title.isprintable():
        raise problem("it holds a line break or another character that cannot be shown", allowed="one line")
    return title


Title: TypeAlias = Annotated[str, Strict(), AfterValidator(_on_one_line)]


def _from_text(value: Any) -> Any:
    return inf if value == "inf" else value


def _finite_or_inf(value: float) -> float:
    if LARGEST < value < inf:
        raise problem("it is too large", allowed=f"up to {LARGEST:g}, or inf")
    return value


def _written(value: float) -> float | str:
    return "inf" if value == inf else value


_INFINITY = (BeforeValidator(_from_text), AfterValidator(_finite_or_inf), PlainSerializer(_written, when_used="json"))


PositiveOrInfinite: TypeAlias = Annotated[float, Strict(), Field(ge=SMALLEST, le=inf, allow_inf_nan=True), *_INFINITY]


ZeroOrMoreOrInfinite: TypeAlias = Annotated[float, Strict(), Field(ge=0, le=inf, allow_inf_nan=True), *_INFINITY]


@dataclass(frozen=True)
class OrElse:
    """Another form of a value, for the JSON schema of scenes."""

    form: dict[str, Any] | type[BaseModel]  # its schema, or the model of a table

    def __get_pydantic_json_schema__(self, own: CoreSchema, handler: GetJsonSchemaHandler) -> dict[str, Any]:
        other = self.form if isinstance(self.form, dict) else handler(self.form.__pydantic_core_schema__)
        return {"anyOf": [handler(own), other]}


NumberFromZero: TypeAlias = Annotated[float, Strict(), Field(ge=0, le=LARGEST)]


class Sweep(SceneModel):
    """Values from a first to a last one."""

    start: NumberFromZero = Field(description="first value")
    stop: NumberFromZero = Field(description="last value, greater than the first")
    number: Annotated[int, Strict(), Field(ge=2, le=MOST_SWEPT)] = Field(description="how many values, with both ends")
    spacing: Literal["linear", "logarithmic"] = Field(default="linear", description="equal differences or ratios")

    @model_validator(mode="after")
    def _goes_up(self) -> Sweep:
        problems = []
        if self.stop <= self.start:
            problems.append(
                problem_at(("stop",), self.stop, "it is not greater than start", allowed=f"> {self.start:g}")
            )
        elif self.start < SMALLEST and self.spacing == "logarithmic":
            allowed = f'from {SMALLEST:g}, or spacing = "linear"'
            problems.append(
                problem_at(("start",), self.start, "equal ratios cannot start so close to 0", allowed=allowed)
            )
        if problems:
            raise ValidationError.from_exception_data(type(self).__name__, problems)
        return self

    @property
    def values(self) -> tuple[float, ...]:
        """The values; equal steps are rounded to the decimal numbers intended, 0.3 rather than 0.30000000000000004."""
        steps = [place / (self.number - 1) for place in range(self.number)]
        if self.spacing == "linear":
            inner = [_shortest(self.start + step * (self.stop - self.start)) for step in steps]
        else:
            inner = [self.start * (self.stop / self.start) ** step for step in steps]
        return (self.start, *inner[1:-1], self.stop)


def _shortest(value: float) -> float:
    """The number of 15 digits next to a value, all that rounding leaves of a sum."""
    return float(f"{value:.15g}")


def _expanded(value: Any) -> Any:
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
        twice = next(value for value, other in pairwise(sorted(values)) if value == other)
        raise problem(f"{twice:g} is named twice", remedy="Name each once")
    return values


def _going_up(values: tuple[float, ...]) -> tuple[float, ...]:
    for before, after in pairwise(values):
        if after <= before:
            raise problem(
                f"{after:g} does not lie above {before:g}, which comes before it", remedy="Write them in order"
            )
    return values


DISTINCT = (
    BeforeValidator(_expanded),
    OrElse(Sweep),
    AfterValidator(_all_different),
    Field(min_length=1, max_length=MOST_VALUES),
)
"""What a list of frequencies or times of an analysis is made with."""

OR_SWEEP = "or a table {start, stop, number, spacing} of them"


def ascending_values(most: int) -> tuple[Any, ...]:
    """Return the type of an ascending list of at most ``most`` places or times."""
    return BeforeValidator(_expanded), OrElse(Sweep), AfterValidator(_going_up), Field(min_length=1, max_length=most)


def kind_of(entry: Any) -> str:
    """Return the kind of a table of several kinds, by which its model is chosen."""
    kind = entry.get("kind", "") if isinstance(entry, dict) else getattr(entry, "kind", "")
    return str(kind)
