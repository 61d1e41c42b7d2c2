"""A scene as TOML: given values, and defaults, which are marked."""

from __future__ import annotations

import json
from collections.abc import Iterator
from math import inf
from textwrap import fill
from typing import Any

from hydroelastic.scenes.models.values import Sweep
from hydroelastic.scenes.read import Scene

_DEFAULT = "  # default"
_WIDTH = 100
# Longer lists of numbers are written as a sweep, if they are one.
_FEW = 12


def scene_text(scene: Scene) -> str:
    """Return a scene as TOML that reads back as the same scene from the folder of its file."""
    given = scene.model_dump(exclude_unset=True)
    return "\n".join(_table((), scene.model_dump(), given)).strip() + "\n"


def _table(name: tuple[str, ...], values: dict[str, Any], given: dict[str, Any]) -> Iterator[str]:
    inner = {key: value for key, value in values.items() if _is_table(value)}
    for key, value in values.items():
        if value is not None and key not in inner:
            yield f"{key} = {_value(value)}" + ("" if key in given else _DEFAULT)
    for key, value in inner.items():
        path = (*name, key)
        if isinstance(value, dict):
            if not all(_is_table(entry) for entry in value.values()):
                yield from ("", f"[{'.'.join(path)}]" + ("" if key in given else _DEFAULT))
            yield from _table(path, value, given.get(key, {}))
            continue
        entries = given.get(key, ({},) * len(value))
        for entry, of_entry in zip(value, entries, strict=True):
            yield from ("", f"[[{'.'.join(path)}]]")
            yield from _table(path, entry, of_entry)


def _is_table(value: Any) -> bool:
    return isinstance(value, dict) or (isinstance(value, list | tuple) and bool(value) and isinstance(value[0], dict))


def _value(value: Any) -> str:
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, float):
        return repr(value) if abs(value) < inf else "inf" if value > 0 else "-inf"
    if isinstance(value, int):
        return str(value)
    if isinstance(value, list | tuple):
        return _sweep(value) or _list(value)
    # A basic string of TOML has the escapes of JSON.
    return json.dumps(str(value), ensure_ascii=False).replace("\x7f", "\\u007f")


def _list(values: list[Any] | tuple[Any, ...]) -> str:
    line = f"[{', '.join(_value(value) for value in values)}]"
    if len(line) <= _WIDTH:
        return line
    if isinstance(values[0], str):
        return "[\n" + "".join(f"  {_value(value)},\n" for value in values) + "]"
    return f"[\n{fill(line[1:-1], _WIDTH, initial_indent='  ', subsequent_indent='  ')}\n]"


def _sweep(values: list[Any] | tuple[Any, ...]) -> str:
    """A sweep of equal steps or ratios, if it reproduces the numbers exactly."""
    if len(values) <= _FEW or not all(isinstance(value, float) and 0.0 <= value < inf for value in values):
        return ""
    first, last, number = values[0], values[-1], len(values)
    if last <= first:
        return ""
    for spacing in ("linear", "logarithmic"):
        if spacing == "logarithmic" and first == 0.0:
            continue
        sweep = Sweep.model_validate({"start": first, "stop": last, "number": number, "spacing": spacing})
        if sweep.values == tuple(values):
            named = f', spacing = "{spacing}"' if spacing == "logarithmic" else ""
            return f"{{ start = {first!r}, stop = {last!r}, number = {number}{named} }}"
    return ""
