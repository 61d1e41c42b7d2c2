"""Numbers of a scene that may be infinite. TOML writes them inf; JSON, which has no infinity, as a text."""

from __future__ import annotations

from math import inf
from typing import Annotated, Any, TypeAlias

from pydantic import AfterValidator, BeforeValidator, Field, PlainSerializer, Strict

from hydroelastic.scenes.models.problems import problem
from hydroelastic.scenes.models.scene_model import LARGEST, SMALLEST


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
