"""Errors of a scene, said so that its author can mend them: where, what was found, what is allowed, what to do."""

from __future__ import annotations

import difflib
import json
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Literal, TypeAlias, get_args, get_origin

from pydantic import BaseModel, ValidationError
from pydantic.fields import FieldInfo

Location: TypeAlias = tuple[str | int, ...]
"""The way to a value as the reader of the file sees it: ``("body", 0, "start")``."""

MOST_PROBLEMS_SHOWN = 10
LONGEST_VALUE_SHOWN = 60
LARGEST_DECIMAL_SHOWN = 10**LONGEST_VALUE_SHOWN


@dataclass(frozen=True, kw_only=True)
class Problem:
    """One thing that is wrong.

    Args:
        wrong: what is wrong, a phrase that continues the key.
        key: where, as the author reads it, for example ``[[body]] number 1, key "start"``.
        value: what was found, as TOML writes it; empty where there is nothing short to show.
        allowed: what may stand there.
        remedy: what to do.
    """

    wrong: str
    key: str = ""
    value: str = ""
    allowed: str = ""
    remedy: str = ""

    def line(self) -> str:
        """Return the problem as one line."""
        subject = f"{self.key} = {self.value}" if self.value else self.key
        parts = [f"{subject}: {self.wrong}" if subject else self.wrong]
        if self.allowed:
            parts.append(f"Allowed: {self.allowed}")
        if self.remedy:
            parts.append(self.remedy)
        return " ".join(part if part.endswith(("?", ".")) else f"{part}." for part in parts)


class SceneError(Exception):
    """A scene, an override or an output folder that cannot be used.

    Args:
        problems: what is wrong, at least one.
        file: the scene file, or None where no file is concerned.
    """

    def __init__(self, *problems: Problem, file: str | Path | None = None) -> None:
        """Keep the problems and the file for the message."""
        super().__init__(*problems)
        self.problems = problems
        self.file = file

    def __str__(self) -> str:
        """Return one line for one problem, else a heading and one line each (ten at most)."""
        lines = [problem.line() for problem in self.problems]
        if len(lines) == 1:
            return f"{self.file}: {lines[0]}" if self.file is not None else lines[0]
        shown = lines[:MOST_PROBLEMS_SHOWN]
        if len(lines) > len(shown):
            shown.append(f"… and {len(lines) - len(shown)} more")
        heading = f"{self.file}: {len(lines)} problems" if self.file is not None else f"{len(lines)} problems"
        return "\n  ".join([heading, *shown])


def shown_value(value: object) -> str:
    """Return a value as TOML writes it, shortened; empty for tables and lists, which are too long to show."""
    if isinstance(value, dict | list | tuple | BaseModel) or value is None:
        return ""
    if isinstance(value, str | bool):
        # JSON writes texts and truth values as TOML does, and escapes control characters.
        text = json.dumps(value, ensure_ascii=False)
    else:
        # Python refuses to write whole numbers of thousands of digits in decimal.
        text = hex(value) if isinstance(value, int) and abs(value) > LARGEST_DECIMAL_SHOWN else str(value)
    return text if len(text) <= LONGEST_VALUE_SHOWN else text[:LONGEST_VALUE_SHOWN] + "…"


def nearest(word: str, known: Iterable[str]) -> str | None:
    """Return the known word that is most like ``word``, or None where none is near."""
    by_lower_case = {name.lower(): name for name in known}
    found = difflib.get_close_matches(word.lower(), by_lower_case, n=1, cutoff=0.6)
    return by_lower_case[found[0]] if found else None


def proposal(word: str, known: Iterable[str]) -> str:
    """Return ``Did you mean "length"?`` for the nearest known word, or an empty text."""
    near = nearest(word, known)
    return f'Did you mean "{near}"?' if near is not None else ""


def readable_key(location: Location, *, table: Literal["", "one", "many"] = "") -> str:
    """Return a location as the author writes it, for example ``[[body]] number 1, key "start"``.

    Args:
        location: table, number of the entry from 0, key; as far as it goes.
        table: whether a lone first name is a table ("one"), a list of tables ("many") or a plain key ("").
    """
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
    keys = ".".join(shown_value(str(part))[1:-1] for part in rest)
    return f'{entry}, key "{keys}"' if keys else entry


def scene_error(error: ValidationError, model: type[BaseModel], *, file: str | Path | None = None) -> SceneError:
    """Return what the validation of a scene found, in the words of its author.

    Args:
        error: what pydantic raised.
        model: the model that was validated; its fields give the allowed values and the proposals.
        file: the scene file, named in the message.
    """
    details = error.errors(include_url=False)
    proposed = {location for detail in details if (location := _proposed_location(detail, model)) is not None}
    broken = {detail["loc"][:1] for detail in details if len(detail["loc"]) > 1}
    return SceneError(
        *(_problem(detail, model) for detail in details if not _follows(detail, proposed, broken)),
        file=file,
    )


def _follows(detail: Any, proposed: set[Location], broken: set[Location]) -> bool:
    """Whether a detail only repeats another: a misspelt key is also missing, a broken entry is not counted."""
    if detail["type"] == "missing":
        return detail["loc"] in proposed
    return detail["type"] == "too_short" and detail["loc"] in broken


def _problem(detail: Any, root: type[BaseModel]) -> Problem:
    location: Location = detail["loc"]
    if detail["type"] == "missing":
        return _missing(location, root)
    if detail["type"] == "extra_forbidden":
        return _unknown_key(location, detail["input"], root)
    field, value = _field_at(root, location), detail["input"]
    key = readable_key(location, table=_table(field))
    if detail["type"] == "scene":
        said = {name: detail["ctx"][name] for name in ("wrong", "allowed", "remedy")}
        return Problem(key=key, value=shown_value(value), **said)
    return Problem(
        key=key,
        value=shown_value(value),
        wrong=_wrong(detail, value),
        allowed=_allowed(field),
        remedy=_remedy(detail["type"], location, value, field),
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


def _wrong(detail: Any, value: object) -> str:
    if detail["type"] == "float_type" and type(value) is int:
        return "it is too large"  # a whole number beyond the range of floats
    return _WRONG.get(detail["type"], str(detail["msg"]))


def _missing(location: Location, root: type[BaseModel]) -> Problem:
    field = _field_at(root, location)
    return Problem(
        key=readable_key(location, table=_table(field)),
        wrong="it is missing",
        allowed=_allowed(field),
    )


def _unknown_key(location: Location, value: object, root: type[BaseModel]) -> Problem:
    model = _model_at(root, location[:-1]) or root
    known = list(model.model_fields)
    many = isinstance(value, list) and bool(value) and all(isinstance(entry, dict) for entry in value)
    return Problem(
        key=readable_key(location, table="one" if isinstance(value, dict) else "many" if many else ""),
        value=shown_value(value),
        wrong="it is not known here",
        allowed=", ".join(known),
        remedy=proposal(str(location[-1]), known),
    )


def _proposed_location(detail: Any, root: type[BaseModel]) -> Location | None:
    location: Location = detail["loc"]
    if detail["type"] != "extra_forbidden":
        return None
    near = nearest(str(location[-1]), (_model_at(root, location[:-1]) or root).model_fields)
    return (*location[:-1], near) if near is not None else None


def _remedy(kind: str, location: Location, value: object, field: FieldInfo | None) -> str:
    if kind == "literal_error" and field is not None:
        return proposal(str(value), map(str, get_args(field.annotation)))
    if kind in ("float_type", "int_type", "bool_type") and isinstance(value, str):
        return "Write it without quotes"
    if kind in ("model_type", "tuple_type") and location:
        return f"Write it as {readable_key(location[:1], table=_table(field))}"
    return ""


def _allowed(field: FieldInfo | None) -> str:
    """Say what a field takes: its kind and range, then its description."""
    if field is None:
        return ""
    range_of = next((say for matches, say in _RANGES if matches(field.annotation)), None)
    values = range_of(field) if range_of is not None else ""
    return " – ".join(text for text in (values, (field.description or "").rstrip(".")) if text)


def _bound(field: FieldInfo, name: str) -> float:
    return next(float(getattr(limit, name)) for limit in field.metadata if hasattr(limit, name))


def _number_range(field: FieldInfo) -> str:
    smallest, largest = _bound(field, "ge"), _bound(field, "le")
    kind = "whole number" if field.annotation is int else "positive number" if smallest > 0 else "number"
    return f"a {kind} from {smallest:g} to {largest:g}"


def _choices(field: FieldInfo) -> str:
    return " or ".join(f'"{choice}"' for choice in get_args(field.annotation))


_RANGES: tuple[tuple[Callable[[Any], bool], Callable[[FieldInfo], str]], ...] = (
    (lambda annotation: annotation in (int, float), _number_range),
    (lambda annotation: annotation is bool, lambda field: "true or false"),
    (lambda annotation: annotation is str, lambda field: "a text in quotes"),
    (lambda annotation: get_origin(annotation) is Literal, _choices),
)


def _field_at(root: type[BaseModel], location: Sequence[str | int]) -> FieldInfo | None:
    names = [part for part in location if isinstance(part, str)]
    model: type[BaseModel] | None = root
    field = None
    for name in names:
        field = model.model_fields.get(name) if model is not None else None
        model = _nested_model(field)
    return field


def _model_at(root: type[BaseModel], location: Sequence[str | int]) -> type[BaseModel] | None:
    return _nested_model(_field_at(root, location)) if location else root


def _nested_model(field: FieldInfo | None) -> type[BaseModel] | None:
    if field is None:
        return None
    candidates = (field.annotation, *get_args(field.annotation))
    return next((part for part in candidates if isinstance(part, type) and issubclass(part, BaseModel)), None)


def _table(field: FieldInfo | None) -> Literal["", "one", "many"]:
    if field is None or _nested_model(field) is None:
        return ""
    return "many" if get_origin(field.annotation) is tuple else "one"


class UnsolvedError(Exception):
    """A valid scene that could not be solved; its text says what failed."""
