"""Values of a scene that are replaced: by --set, by a sweep, or in Python."""

from __future__ import annotations

import re
import tomllib
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from typing import Any, TypeAlias

from hydroelastic.scenes.errors import Problem, SceneError, shown_value
from hydroelastic.scenes.models.scene_model import plain
from hydroelastic.scenes.number_texts import how_to_write

Document: TypeAlias = dict[str, Any]


@dataclass(frozen=True, kw_only=True)
class Change:
    """A value that replaces one of the document.

    Attributes:
        key: dotted.
        value: the new one.
        text: key and value as messages show them.
        option: what messages call it.
    """

    key: str
    value: Any
    text: str
    option: str = "--set"


MOST_NESTED = 20
"""Tables and lists within each other in a scene: no key of any kind is as deep."""

# Of names that are joined by dots, in a key: the reader of TOML takes memory like the square of their number.
_MOST_NAMES = 100
_NAME = r"""(?:[\w-]+|"[^"\n]*"|'[^'\n]*')"""
_LONG_KEY = re.compile(rf"(?<![\w-]){_NAME}(?:[ \t]*\.[ \t]*{_NAME}){{{_MOST_NAMES},}}")
TOO_DEEP = "its tables and lists are nested too deeply"


def parsed_toml(text: str) -> Document:
    """Return the content of a text of TOML."""
    if _LONG_KEY.search(text):
        raise ValueError(TOO_DEEP)
    try:
        return tomllib.loads(text)
    except RecursionError:
        raise ValueError(TOO_DEEP) from None


def is_too_deep(value: Any) -> bool:
    """Whether tables and lists of a value are nested more deeply than `MOST_NESTED`."""
    level = [value]
    for _ in range(MOST_NESTED):
        entries = [
            one.values() if isinstance(one, dict) else one for one in level if isinstance(one, dict | list | tuple)
        ]
        level = [entry for some in entries for entry in some]
    return any(isinstance(one, dict | list | tuple) for one in level)


def changes_of(overrides: Iterable[str] | Mapping[str, Any]) -> Iterator[Change]:
    """Yield the changes of texts key=value, or of values by their keys."""
    if isinstance(overrides, Mapping):
        for key, value in overrides.items():
            if is_too_deep(value):
                raise SceneError(Problem(key=str(key), wrong=TOO_DEEP))
            new = plain(value)
            yield Change(key=str(key), value=new, text=f"{key} = {shown_value(new) or '…'}", option="change")
        return
    for text in (overrides,) if isinstance(overrides, str) else overrides:
        key, equals, value = text.partition("=")
        change = Change(key=key, value=None, text=text)
        if not equals or not all(name.strip() for name in key.split(".")):
            raise _bad_override(change, "it is not of the form key=value", "For example --set accuracy.tolerance=1e-8")
        if key.count(".") > MOST_NESTED:
            raise _bad_override(change, "the key has too many names", allowed=f"up to {MOST_NESTED}")
        yield replace(change, value=_override_value(change, value.strip()))


def override(document: Document, change: Change) -> None:
    """Replace one value in the document."""
    names = [name.strip() for name in change.key.split(".")]
    holder: Any = document
    for place in range(len(names) - 1):
        index = _index_in(holder, names, place, change)
        holder = holder.setdefault(index, {}) if isinstance(holder, dict) else holder[index]
    holder[_index_in(holder, names, len(names) - 1, change)] = change.value


def _index_in(holder: Any, names: list[str], place: int, change: Change) -> Any:
    """Return the index of a name in a table (the key) or in a list (the number of the entry)."""
    name = names[place]
    if isinstance(holder, dict) and not name.isdigit():
        return name
    if not isinstance(holder, list):
        raise _bad_override(change, f'"{name}" needs a {"list" if name.isdigit() else "table"}, which is not there')
    numbers = {str(number): number - 1 for number in range(1, len(holder) + 1)}
    if name not in numbers:
        entries = ", ".join(numbers) or "none, the list is empty"
        remedy = "Entries are numbered from 1"
        if numbers and (name == "0" or not name.lstrip("+-").isdigit()):
            rest = names[place + 1 :] if name == "0" else names[place:]
            remedy += f": write {'.'.join((*names[:place], '1', *rest))} for the first"
        raise _bad_override(change, f'"{name}" is not an entry of the list', remedy, allowed=entries)
    return numbers[name]


_BARE_TEXT = re.compile(r"[^\W\d][^\"'=\[\]{}\n]*|[./~][^\"'=\[\]{}\n]*")


def _override_value(change: Change, text: str) -> Any:
    try:
        parsed = parsed_toml(f"value = {text}")
        if list(parsed) == ["value"]:  # a line break in the text would start another key
            return parsed["value"]
    except ValueError:
        # A text that is nearly a number is refused later by validation, where the allowed values are known.
        if _BARE_TEXT.fullmatch(text) or how_to_write(text):
            return text
    raise _bad_override(change, "the value is not TOML", "Put a text in quotes")


def _bad_override(change: Change, wrong: str, remedy: str = "", *, allowed: str = "") -> SceneError:
    return SceneError(
        Problem(key=change.option, value=shown_value(change.text), wrong=wrong, allowed=allowed, remedy=remedy)
    )
