"""Errors found by the checks of a scene, which pydantic collects and `scenes/validation_errors.py` words."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from typing import TypeAlias

from pydantic import BaseModel, ValidationError
from pydantic_core import InitErrorDetails, PydanticCustomError

Check: TypeAlias = Callable[..., Iterator[InitErrorDetails]]
"""Yields the problems of a model."""


def problem(wrong: str, *, allowed: str = "", remedy: str = "") -> PydanticCustomError:
    """Return one problem of a value; see `errors.Problem` for the arguments."""
    said = [wrong, f"allowed: {allowed}" if allowed else "", remedy]
    context = {"wrong": wrong, "allowed": allowed, "remedy": remedy, "message": "; ".join(filter(None, said))}
    return PydanticCustomError("scene", "{message}", context)


def problem_at(
    location: tuple[str | int, ...], value: object, wrong: str, *, allowed: str = "", remedy: str = ""
) -> InitErrorDetails:
    """Return a problem of the value at a location of the scene, for example ``("body", 0, "start")``."""
    return InitErrorDetails(type=problem(wrong, allowed=allowed, remedy=remedy), loc=location, input=value)


def require_fit(model: BaseModel, stages: Iterable[Iterable[Check]]) -> None:
    """Run the checks of a model in stages: later ones assume that the earlier ones have passed.

    Args:
        model: the model to check.

    Raises:
        ValidationError: with all problems of the first stage that finds any.
    """
    for checks in stages:
        problems = [found for check in checks for found in check(model)]
        if problems:
            raise ValidationError.from_exception_data(type(model).__name__, problems)
