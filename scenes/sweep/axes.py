"""The values over which a scene is swept: ``KEY=start:stop:number``, or lists."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from itertools import product
from math import isfinite, prod
from typing import Any, TypeAlias

import numpy as np

from hydroelastic.scenes.errors import Problem, SceneError, shown_value
from hydroelastic.scenes.models.scene_model import plain
from hydroelastic.scenes.overrides import parsed_toml

MOST_POINTS = 100_000
"""Of one sweep."""

_EXAMPLE = "For example --vary body.1.start=0:6:25 or --vary liquid.1.depth=0.5,1,2"
_EXAMPLE_IN_PYTHON = 'For example {"body.1.start": [0.0, 3.0, 6.0]}'
# Decimal digits of the values of a range, so that the middle between 0 and 6 is 3.
_DIGITS = 13

Vary: TypeAlias = Mapping[str, Iterable[Any]]


@dataclass(frozen=True, kw_only=True)
class Axis:
    """One varied key of a scene.

    Attributes:
        key: dotted, entries numbered from 1.
        values: in the order of the sweep.
    """

    key: str
    values: tuple[Any, ...]

    @property
    def name(self) -> str:
        """The key as a dimension of a dataset."""
        return self.key.replace(".", "_")

    @property
    def is_number(self) -> bool:
        """Whether all values are numbers."""
        return all(isinstance(value, int | float) and not isinstance(value, bool) for value in self.values)


@dataclass(frozen=True, kw_only=True)
class Grid:
    """All combinations of the values of the axes; the last axis runs fastest.

    Attributes:
        axes: the varied keys.

    Raises:
        SceneError: if there is no axis, a key stands twice, or there are too many points.
    """

    axes: tuple[Axis, ...]

    def __post_init__(self) -> None:
        keys = [axis.key for axis in self.axes]
        twice = next((key for key in keys if keys.count(key) > 1), None)
        if not keys:
            raise SceneError(_refused("", "nothing is varied", _EXAMPLE_IN_PYTHON))
        if "kind" in keys:
            raise SceneError(_refused("kind", "kinds of scenes have different results", "Sweep each kind by itself"))
        if twice is not None:
            raise SceneError(_refused(twice, "the key stands twice", "Name all of its values at once"))
        if len(self) > MOST_POINTS:
            raise SceneError(_refused(f"{len(self)} points", "there are too many", f"At most {MOST_POINTS}"))

    def __len__(self) -> int:
        return prod(self.shape)

    @property
    def shape(self) -> tuple[int, ...]:
        """Number of values of each axis."""
        return tuple(len(axis.values) for axis in self.axes)

    @property
    def points(self) -> list[dict[str, Any]]:
        """The values of each point by key."""
        keys = [axis.key for axis in self.axes]
        return [dict(zip(keys, values, strict=True)) for values in product(*(axis.values for axis in self.axes))]


def grid_from_values(vary: Vary) -> Grid:
    """Return the grid of lists of values by key."""
    if not isinstance(vary, Mapping):
        wrong = "it is not a dictionary of values by key"
        problem = Problem(key="vary", value=repr(vary)[:60], wrong=wrong, remedy=_EXAMPLE_IN_PYTHON, argument=True)
        raise SceneError(problem)
    axes = []
    for key, values in vary.items():
        given = plain(values)
        entries = list(given) if isinstance(given, Iterable) and not isinstance(given, str) else [given]
        if not entries:
            raise SceneError(_refused(key, "there is no value", _EXAMPLE_IN_PYTHON))
        axes.append(Axis(key=str(key), values=tuple(map(plain, entries))))
    return Grid(axes=tuple(axes))


def grid_from_texts(texts: Sequence[str]) -> Grid:
    """Return the grid of the option --vary of the command line."""
    return Grid(axes=tuple(_axis(text) for text in texts))


def _axis(text: str) -> Axis:
    key, equals, values = text.partition("=")
    if not equals or not values.strip() or not all(name.strip() for name in key.split(".")):
        raise SceneError(_refused(text, "it is not of the form KEY=start:stop:number or KEY=value,value"))
    parts = values.split(":")
    found = _range(text, parts) if len(parts) > 1 else [_value(text, entry.strip()) for entry in values.split(",")]
    return Axis(key=".".join(name.strip() for name in key.split(".")), values=tuple(found))


def _range(text: str, parts: list[str]) -> list[float]:
    if len(parts) not in (3, 4) or (len(parts) == 4 and parts[3].strip() != "log"):
        raise SceneError(_refused(text, "a range is start:stop:number, or start:stop:number:log in equal ratios"))
    start, stop = (_number(text, part) for part in parts[:2])
    count = parts[2].strip()
    if not (count.isascii() and count.isdigit() and 1 <= int(count) <= MOST_POINTS):
        wrong = f'the number of values, "{count}", is not a whole number from 1 to {MOST_POINTS}'
        raise SceneError(_refused(text, wrong))
    if len(parts) == 4:
        if min(start, stop) <= 0.0:
            raise SceneError(_refused(text, "equal ratios need positive ends"))
        return _rounded(np.geomspace(start, stop, int(count)))
    return _rounded(np.linspace(start, stop, int(count)))


def _rounded(values: np.ndarray) -> list[float]:
    return [float(f"{value:.{_DIGITS}g}") for value in values]


def _number(text: str, part: str) -> float:
    try:
        value = float(part)
    except ValueError:
        value = np.nan
    if not isfinite(value):
        raise SceneError(_refused(text, f'"{part.strip()}" is not a finite number'))
    return value


def _value(text: str, entry: str) -> Any:
    if not entry:
        raise SceneError(_refused(text, "an entry is empty"))
    try:
        return parsed_toml(f"value = {entry}")["value"]
    except ValueError:
        # An unquoted word is a text, as in --set.
        return entry


def _refused(value: str, wrong: str, remedy: str = _EXAMPLE) -> Problem:
    return Problem(key="vary", value=shown_value(value) if value else "", wrong=wrong, remedy=remedy, argument=True)


def point_text(point: Mapping[str, Any]) -> str:
    """Return the values of a point for messages and tables."""
    return ", ".join(f"{key} = {shown_number(value)}" for key, value in point.items())


def shown_number(value: Any) -> str:
    """Return a value for a table."""
    return f"{value:.10g}" if isinstance(value, float) else str(value)
