"""What the checks of a scene find, in the form that pydantic takes and `errors.py` puts into words."""

from __future__ import annotations

from pydantic_core import InitErrorDetails, PydanticCustomError


def problem(wrong: str, *, allowed: str = "", remedy: str = "") -> PydanticCustomError:
    """Return one problem of a value; see `errors.Problem` for the arguments."""
    said = [wrong, f"allowed: {allowed}" if allowed else "", remedy]
    context = {"wrong": wrong, "allowed": allowed, "remedy": remedy, "message": "; ".join(filter(None, said))}
    return PydanticCustomError("scene", "{message}", context)


def misfit(
    location: tuple[str | int, ...], value: object, wrong: str, *, allowed: str = "", remedy: str = ""
) -> InitErrorDetails:
    """Return a problem of the value at a location of the scene, for example ``("body", 0, "start")``."""
    return InitErrorDetails(type=problem(wrong, allowed=allowed, remedy=remedy), loc=location, input=value)
