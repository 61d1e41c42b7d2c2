"""Errors of pydantic in terms of a scene file: which place, what is wrong there, what is allowed, and what to do."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any, Literal, TypeAlias, get_args, get_origin

from pydantic import BaseModel, BeforeValidator, Tag, ValidationError
from pydantic.fields import FieldInfo

from hydroelastic.scenes.errors import Problem, SceneError, shown_value
from hydroelastic.scenes.number_texts import how_to_write
from hydroelastic.scenes.words import nearest, proposal

# What the open sea does not have yet; of bodies the shapes that tanks in three dimensions have.
_HULLS = ("box", "hull")
_NO_HULLS = (
    "In the open sea bodies are sections per metre of width, or solids of revolution about one vertical axis: hulls of "
    "other shapes are not modelled there, only in tanks of three dimensions ([tank] with a width)"
)
_HEADINGS = ("heading", "headings", "wave_heading", "wave_direction", "direction", "wave_angle", "angle", "beta")
_NO_HEADINGS = 'Waves travel along x, waves_from = "left" or "right": other headings are not modelled'

Location: TypeAlias = tuple[str | int, ...]
"""The way to a value as the reader of the file sees it: ``("body", 0, "start")``."""


def readable_key(location: Location, *, table: Literal["", "one", "many"] = "") -> str:
    """Return a location as the author writes it, for example ``[[body]] number 1, key "start"``."""
    if not location:
        return ""
    name = shown_value(str(location[0]))[1:-1]
    if len(location) == 1:
        return {"": f'key "{name}"', "one": f"[{name}]", "many": f"[[{name}]]"}[table]
    if isinstance(location[1], int):
        entry = f"[[{name}]] number {location[1] + 1}"
        rest = location[2:]
    else:
        entry, rest = f"[{name}]", location[1:]
    names = ".".join(shown_value(part)[1:-1] for part in rest if isinstance(part, str))
    numbers = ".".join(str(part + 1) for part in rest if isinstance(part, int))
    keys = f'{entry}, key "{names}"' if names else entry
    return f"{keys}, entry {numbers}" if numbers else keys


def scene_error(error: ValidationError, model: type[BaseModel], *, file: str | Path | None = None) -> SceneError:
    """Convert a validation error of a scene to a `SceneError` in terms of the scene file."""
    details = error.errors(include_url=False)
    proposed = {location for detail in details if (location := _proposed_location(detail, model)) is not None}
    broken = {detail["loc"][:length] for detail in details for length in range(1, len(detail["loc"]))}
    return SceneError(
        *(_problem(detail, model) for detail in details if not _follows(detail, proposed, broken)),
        file=file,
    )


def _follows(detail: Any, proposed: set[Location], broken: set[Location]) -> bool:
    """Whether an error follows from another: a misspelt key is also missing, an invalid entry is not counted."""
    if detail["type"] == "missing":
        return detail["loc"] in proposed
    return detail["type"] == "too_short" and detail["loc"] in broken


def _problem(detail: Any, root: type[BaseModel]) -> Problem:
    place = _place(root, detail["loc"])
    if detail["type"] == "missing":
        return _missing(place)
    if detail["type"] == "extra_forbidden":
        return _unknown_key(place, detail, root)
    if detail["type"] == "union_tag_invalid":
        return _unknown_kind(place, detail["input"])
    value = detail["input"]
    key = readable_key(place.location, table=_table(place.field))
    if detail["type"] == "scene":
        said = {name: detail["ctx"][name] for name in ("wrong", "allowed", "remedy")}
        return Problem(key=key, value=shown_value(value), **said)
    return Problem(
        key=key,
        value=shown_value(value),
        wrong=_wrong(detail, value, place),
        allowed=_allowed(place, of_list=detail["type"] == "tuple_type"),
        remedy=_remedy(detail["type"], place, value),
    )


_WRONG = {
    "float_type": "it is not a number",
    "int_type": "it is not a whole number",
    "int_from_float": "it is not a whole number",
    "bool_type": "it is not a truth value",
    "string_type": "it is not a text",
    "path_type": "it is not a text",
    "finite_number": "it is not a finite number",
    "greater_than_equal": "it is too small",
    "less_than_equal": "it is too large",
    "literal_error": "it is not one of the choices",
    "model_type": "it is not a table",
    "tuple_type": "it is not a list of tables",
    "too_short": "there are too few",
    "too_long": "there are too many",
}


def _wrong(detail: Any, value: object, place: _Place) -> str:
    if detail["type"] == "less_than_equal" and value != value:
        return _WRONG["float_type"]
    if detail["type"] == "float_type" and type(value) is int:
        return "it is too large"  # a whole number beyond the range of floats
    if detail["type"] == "tuple_type" and not _table(place.field):
        return "it is not a list"
    if detail["type"] == "model_type" and _takes_a_number(place.field):
        return "it is neither a number nor a table"
    return _WRONG.get(detail["type"], str(detail["msg"]))


def _takes_a_number(field: FieldInfo | None) -> bool:
    return field is not None and any(isinstance(part, BeforeValidator) for part in field.metadata)


def _missing(place: _Place) -> Problem:
    return Problem(
        key=readable_key(place.location, table=_table(place.field)),
        wrong="it is missing",
        allowed=_allowed(place),
    )


def _unknown_kind(place: _Place, entry: Any) -> Problem:
    if not isinstance(entry, dict):
        return Problem(key=readable_key(place.location), value=shown_value(entry), wrong=_WRONG["model_type"])
    kind = entry.get("kind")
    kinds = list(dict.fromkeys(map(_kind, _nested_models(place.field).values())))
    return Problem(
        key=readable_key((*place.location, "kind")),
        value=shown_value(kind),
        wrong="it is not one of the choices" if "kind" in entry else "it is missing",
        allowed=" or ".join(f'"{known}"' for known in kinds),
        remedy=proposal(str(kind), kinds) if "kind" in entry else "",
    )


def _unknown_key(place: _Place, detail: Any, root: type[BaseModel]) -> Problem:
    name, value = str(detail["loc"][-1]), detail["input"]
    parent = _place(root, detail["loc"][:-1])
    known = list((parent.model or root).model_fields)
    many = isinstance(value, list) and bool(value) and all(isinstance(entry, dict) for entry in value)
    # A section and a solid share their kind, which then tells nothing.
    own = _kind(parent.model or root)
    owners = [_kind(model) for model in parent.siblings.values() if name in model.model_fields and _kind(model) != own]
    return Problem(
        key=readable_key(place.location, table="one" if isinstance(value, dict) else "many" if many else ""),
        value=shown_value(value),
        wrong="it is not known here",
        allowed=", ".join(known),
        remedy=(
            _NO_HEADINGS
            if name in _HEADINGS and _kind(root) in ("sea", "tank")
            else f'It belongs to kind = "{owners[0]}"'
            if owners
            else proposal(name, known)
        ),
    )


def _proposed_location(detail: Any, root: type[BaseModel]) -> Location | None:
    location: Location = detail["loc"]
    if detail["type"] != "extra_forbidden":
        return None
    near = nearest(str(location[-1]), (_place(root, location[:-1]).model or root).model_fields)
    return (*location[:-1], near) if near is not None else None


def _remedy(kind: str, place: _Place, value: object) -> str:
    if kind == "literal_error" and place.location[-1] == "shape" and value in _HULLS:
        return _NO_HULLS
    if kind == "literal_error" and place.field is not None:
        return proposal(str(value), map(str, get_args(_value_type(place.field)[0])))
    if kind in ("float_type", "int_type", "bool_type") and isinstance(value, str):
        description = place.field.description if place.field is not None else None
        return how_to_write(value, description or "") or "Write it without quotes"
    if kind in ("model_type", "tuple_type") and _table(place.field) and len(place.location) == 1:
        return f"Write it as {readable_key(place.location[:1], table=_table(place.field))}"
    return ""


def _allowed(place: _Place, *, of_list: bool = False) -> str:
    """Describe the values of a field, or of the lists in its list: type and range, then its description."""
    field = place.field
    if field is None:
        return ""
    annotation, limits = _value_type(field)
    range_of = next((say for matches, say in _RANGES if matches(annotation)), None)
    values = range_of(annotation, limits) if range_of is not None else ""
    if values and (of_list or isinstance(place.location[-1], str)) and _is_list(field.annotation):
        values = f"a list of {values}" if get_origin(annotation) is Literal else "a list"
    return " – ".join(text for text in (values, (field.description or "").rstrip(".")) if text)


def _is_list(annotation: Any) -> bool:
    return get_origin(annotation) is tuple or any(map(_is_list, get_args(annotation)))


def _value_type(field: FieldInfo) -> tuple[Any, list[Any]]:
    """Type and limits of a single value of a field: without None, and for an entry of a list."""
    annotation, limits = field.annotation, list(field.metadata)
    while True:
        if get_origin(annotation) is Annotated:
            limits += [
                limit for part in getattr(annotation, "__metadata__", ()) for limit in getattr(part, "metadata", [part])
            ]
            annotation = get_args(annotation)[0]
        elif type(None) in get_args(annotation):
            (annotation,) = (part for part in get_args(annotation) if part is not type(None))
        elif get_origin(annotation) is tuple:
            annotation = get_args(annotation)[0]
        else:
            return annotation, limits


def _number_range(annotation: Any, limits: list[Any]) -> str:
    smallest = max(float(limit.ge) for limit in limits if hasattr(limit, "ge"))
    largest = min(float(limit.le) for limit in limits if hasattr(limit, "le"))
    kind = "whole number" if annotation is int else "positive number" if smallest > 0 else "number"
    return f"a {kind} from {smallest:g} to {largest:g}"


def _choices(annotation: Any, limits: list[Any]) -> str:
    return " or ".join(f'"{choice}"' for choice in get_args(annotation))


_RANGES: tuple[tuple[Callable[[Any], bool], Callable[[Any, list[Any]], str]], ...] = (
    (lambda annotation: annotation in (int, float), _number_range),
    (lambda annotation: annotation is bool, lambda annotation, limits: "true or false"),
    (lambda annotation: annotation in (str, Path), lambda annotation, limits: "a text in quotes"),
    (lambda annotation: get_origin(annotation) is Literal, _choices),
)


@dataclass(frozen=True, kw_only=True)
class _Place:
    """The part of a scene at a location of pydantic.

    Args:
        location: the location without the kinds of entries, which pydantic inserts.
        field: the last known field along the location.
        model: the model at the location, or None.
        siblings: by their tag, all models that the model was chosen from.
    """

    location: Location
    field: FieldInfo | None
    model: type[BaseModel] | None
    siblings: dict[str, type[BaseModel]]


def _place(root: type[BaseModel], location: Location) -> _Place:
    model: type[BaseModel] | None = root
    field = None
    shown: list[str | int] = []
    choices: dict[str, type[BaseModel]] = {}
    siblings = choices
    for part in location:
        if part in choices:
            model, siblings, choices = choices[str(part)], choices, {}
            continue
        shown.append(part)
        if isinstance(part, str):
            field = model.model_fields.get(part) if model is not None else None
            models = _nested_models(field)
            choices = models if len(models) > 1 else {}
            model = next(iter(models.values())) if len(models) == 1 else None
    return _Place(location=tuple(shown), field=field, model=model, siblings=siblings)


def _kind(model: type[BaseModel]) -> str:
    kind = model.model_fields.get("kind")
    return "" if kind is None else str(kind.default)


def _nested_models(field: FieldInfo | None) -> dict[str, type[BaseModel]]:
    """The models of a field, by the tag that pydantic inserts in locations: two may share a ``kind``."""
    return dict(_models_in(field.annotation)) if field is not None else {}


def _models_in(annotation: Any, tag: str = "") -> Iterator[tuple[str, type[BaseModel]]]:
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        yield tag, annotation
    parts = get_args(annotation)
    tag = next((part.tag for part in parts if isinstance(part, Tag)), tag)
    for part in parts:
        yield from _models_in(part, tag)


def _table(field: FieldInfo | None) -> Literal["", "one", "many"]:
    if field is None or not _nested_models(field):
        return ""
    return "many" if get_origin(field.annotation) is tuple else "one"
