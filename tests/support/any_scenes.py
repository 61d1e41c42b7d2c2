"""Scenes that nobody would write: documents drawn from the fields and limits of the models, and good ones damaged."""

from __future__ import annotations

import json
import tomllib
from collections.abc import Callable, Iterator
from copy import deepcopy
from math import inf, isnan, nan
from pathlib import Path
from typing import Annotated, Any, Literal, get_args, get_origin

from hypothesis import strategies as st
from pydantic import BaseModel
from pydantic.fields import FieldInfo

from hydroelastic.scenes.models.canal import CanalScene
from hydroelastic.scenes.models.level_tank import LevelTankScene
from hydroelastic.scenes.models.round_tank import RoundTankScene
from hydroelastic.scenes.models.tank_kinds import is_canal, is_level_tank, is_round_tank
from hydroelastic.scenes.models.values import OrElse
from hydroelastic.scenes.read import SCENE_MODELS, SHIPPED_FOLDER

Document = dict[str, Any]

MODELS = dict(SCENE_MODELS) | {"round tank": RoundTankScene, "canal": CanalScene, "level tank": LevelTankScene}
"""The kinds of scenes, and the tanks that keys of [tank] give a model of their own."""

ODD_TEXTS = (
    "",
    " ",
    "ü\u202e 火 \U0001f6a2",
    "a\nb",
    "\x1b[31m",
    "x" * 300,
    "1,5",
    "1e3 m",
    "inf",
    "../..",
    "scene.toml",
    "$x$|*",
)
ODD_NUMBERS = (
    0,
    -1,
    3,
    -0.0,
    0.5,
    1e-300,
    1e300,
    -1e300,
    5e-324,
    inf,
    -inf,
    nan,
    10**400,
    -(10**30),
    2**63,
    True,
    False,
)
ODD_VALUES = st.one_of(
    st.sampled_from(ODD_NUMBERS),
    st.floats(),
    st.integers(),
    st.sampled_from(ODD_TEXTS),
    st.text(max_size=8),
    st.recursive(st.just([]), lambda inner: st.lists(inner, min_size=1, max_size=2), max_leaves=30),
    st.dictionaries(st.sampled_from(["start", "kind", "file", "ü", "a b"]), st.sampled_from(ODD_NUMBERS), max_size=2),
    st.lists(st.sampled_from(ODD_NUMBERS), max_size=4),
)


def documents(model: type[BaseModel]) -> st.SearchStrategy[Document]:
    """What the fields of a model allow one by one: required keys always, others now and then, numbers within limits."""
    required, optional = {}, {}
    for name, field in model.model_fields.items():
        values = _values(field.annotation, list(field.metadata))
        (required if field.is_required() or name == "kind" else optional)[name] = values
    return st.fixed_dictionaries(required, optional=optional)


def _values(annotation: Any, limits: list[Any]) -> st.SearchStrategy[Any]:
    origin, parts = get_origin(annotation), get_args(annotation)
    if origin is Annotated:
        return _values(parts[0], [*limits, *annotation.__metadata__])
    others = [limit.form for limit in limits if isinstance(limit, OrElse) and not isinstance(limit.form, dict)]
    if others:
        return st.one_of(_values(annotation, []), *map(documents, others))
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        return st.deferred(lambda: documents(annotation))
    if origin is Literal:
        return st.sampled_from(parts)
    if origin is tuple:
        several = len(parts) == 2 and parts[1] is Ellipsis
        inner = [_values(part, []) for part in parts if part is not Ellipsis]
        return st.lists(inner[0], max_size=3) if several else st.tuples(*inner).map(list)
    if parts:
        return st.one_of(*(_values(part, limits) for part in parts if part is not type(None)))
    simple: dict[Any, Callable[[], st.SearchStrategy[Any]]] = {
        bool: st.booleans,
        int: lambda: st.integers(*map(int, _range(limits))),
        float: lambda: _numbers(*_range(limits)),
        str: lambda: st.text(max_size=10).filter(str.isprintable),
        Path: lambda: st.sampled_from(["table.csv", "nothing.csv", "aquarium"]),
    }
    return simple[annotation]()


def _range(limits: list[Any]) -> tuple[float, float]:
    all_limits = [part for limit in limits for part in (limit.metadata if isinstance(limit, FieldInfo) else [limit])]
    least = max((limit.ge for limit in all_limits if hasattr(limit, "ge")), default=-1e30)
    most = min((limit.le for limit in all_limits if hasattr(limit, "le")), default=1e30)
    return float(least), float(most)


def _numbers(least: float, most: float) -> st.SearchStrategy[float]:
    """Mostly of a size that occurs, else of any size up to the limits themselves."""
    usual = [value for value in (0.0, 0.1, 0.5, 1.0, 2.5, 10.0, 1000.0, 5e3) if least <= value <= most]
    anything = st.one_of(st.sampled_from([least, most]), st.floats(least, most))
    return (
        st.one_of(st.sampled_from(usual), st.floats(max(least, 1e-3), min(most, 1e4)), anything) if usual else anything
    )


def kind_of(family: str) -> str:
    """What a scene of one of `MODELS` has as its ``kind``."""
    return family if family in SCENE_MODELS else "tank"


def shipped_documents(family: str) -> list[Document]:
    """The shipped scenes of one of `MODELS` as documents."""
    parsed = [tomllib.loads(path.read_text(encoding="utf-8")) for path in sorted(SHIPPED_FOLDER.glob("*.toml"))]
    return [document for document in parsed if _family_of(document) == family]


def _family_of(document: Document) -> str:
    tanks = {"round tank": is_round_tank, "canal": is_canal, "level tank": is_level_tank}
    found = (family for family, fits in tanks.items() if document["kind"] == "tank" and fits(document))
    return next(found, document["kind"])


@st.composite
def damaged(draw: st.DrawFn, family: str) -> Document:
    """A document of one of `MODELS`, drawn from it or shipped, damaged in up to three places."""
    fresh = documents(MODELS[family]).map(lambda document: document | {"kind": kind_of(family)})
    shipped = st.sampled_from(shipped_documents(family))
    document = deepcopy(draw(st.one_of(fresh, shipped, shipped)))
    if draw(st.booleans()):
        # Good but for some numbers: what must fit together is reached only so.
        numbers = [place for place in places(document) if isinstance(place[0][place[1]], float)]
        for place in draw(st.lists(st.sampled_from(numbers), max_size=3)) if numbers else ():
            _damage(draw, "scale", place, place)
        return document
    if draw(st.integers(0, 2)) == 0:
        graft = draw(fresh)
        document |= {key: graft[key] for key in draw(st.lists(st.sampled_from(list(graft)), max_size=2))}
    for _ in range(draw(st.integers(0, 3))):
        found = list(places(document))
        if not found:
            break
        what = draw(st.sampled_from(["leave out", "odd", "unknown", "double", "swap", "scale"]))
        _damage(draw, what, draw(st.sampled_from(found)), draw(st.sampled_from(found)))
    return document


def _damage(draw: st.DrawFn, what: str, place: tuple[Any, Any], other: tuple[Any, Any]) -> None:
    (holder, key), (other_holder, other_key) = place, other
    if what == "leave out":
        del holder[key]
    elif what == "odd":
        holder[key] = draw(ODD_VALUES)
    elif what == "unknown" and isinstance(holder, dict):
        holder[draw(st.sampled_from(["lenght", "ü", "a b", "kind", "body", "x" * 80]))] = draw(ODD_VALUES)
    elif what == "double" and isinstance(holder, list):
        holder += deepcopy([holder[key]] * draw(st.sampled_from([1, 2, 120])))
    elif what == "swap":
        holder[key], other_holder[other_key] = deepcopy(other_holder[other_key]), deepcopy(holder[key])
    elif what == "scale" and isinstance(value := holder[key], float):
        extremes = st.sampled_from([1e-30, 2e-30, 1e30, 5e29, 5e-324])
        holder[key] = draw(st.one_of(extremes, _factors.map(lambda factor: factor * value)))


_factors = st.one_of(
    st.sampled_from([-1.0, 0.0, 0.1, 0.5, 2.0, 10.0]), st.floats(-20.0, 20.0).map(lambda power: 10.0**power)
)


def places(value: Any) -> Iterator[tuple[Any, Any]]:
    """All places of a document: a table or a list, and a key or a number."""
    items = (
        list(value.items()) if isinstance(value, dict) else list(enumerate(value)) if isinstance(value, list) else []
    )
    for key, inner in items:
        yield value, key
        yield from places(inner)


def holds_nan(value: Any) -> bool:
    """Whether there is NaN anywhere in a document, which a message may then show."""
    if isinstance(value, dict | list):
        return any(holds_nan(inner) for inner in (value.values() if isinstance(value, dict) else value))
    return isinstance(value, float) and isnan(value)


def as_toml(document: Document) -> str:
    """A document as TOML, all tables inline."""
    return "".join(f"{_text(key)} = {_written(value)}\n" for key, value in document.items())


def _written(value: Any) -> str:
    if isinstance(value, dict):
        return "{" + ", ".join(f"{_text(key)} = {_written(inner)}" for key, inner in value.items()) + "}"
    if isinstance(value, list):
        return "[" + ", ".join(map(_written, value)) + "]"
    if isinstance(value, bool):
        return "true" if value else "false"
    return _text(value) if isinstance(value, str) else repr(value)


def _text(value: str) -> str:
    return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")
