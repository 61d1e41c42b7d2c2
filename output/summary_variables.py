"""A summary as labelled variables: every number, word and truth value under the keys that lead to it.

`size: {cells: 83}` becomes the variable `size_cells`. The entries of a list lie along a dimension, so that a list of
entries with keys of their own becomes a variable for each of the keys. Values missing from an entry are NaN, or the
text "".
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any, Protocol, TypeAlias

import numpy as np
from numpy.typing import NDArray

from hydroelastic.output.provenance import Summary
from hydroelastic.output.quantities import Group, Quantity
from hydroelastic.output.variables import Variable, attributes_of

_Entries: TypeAlias = NDArray[Any]
_INTEGERS = np.iinfo(np.int32)


class Naming(Protocol):
    """Names and attributes of the variables of a summary, by place: the keys that lead to it, joined by dots."""

    def dimensions(self, place: str) -> tuple[str, ...]:
        """Return the dimensions of a list, one for each level of lists within lists, or of a dictionary by labels."""

    def name(self, place: str, default: str) -> str | None:
        """Return the name of the variable, or the prefix of those below; ``None`` where they are left out."""

    def attributes(self, place: str) -> dict[str, Any]:
        """Return ``long_name``, and ``units`` if there is one."""


class DeclaredNames:
    """The names that declared quantities have.

    Args:
        parts: the declared groups at the top of the summary, one after the other.
    """

    def __init__(self, *parts: Group) -> None:
        """Collect all places."""
        self._parts: dict[str, tuple[str, Quantity | Group]] = {
            place: (name, part)
            for group in parts
            for place, name, _, part in group.places()
            if isinstance(part, Group) or part.in_summary
        }

    def dimensions(self, place: str) -> tuple[str, ...]:
        """Return those declared."""
        part = self._parts[place][1]
        return (part.dimension,) * bool(part.dimension) if isinstance(part, Group) else part.dimensions

    def name(self, place: str, default: str) -> str | None:
        """Return the one declared; ``None`` of arrays that records have together."""
        name, part = self._parts[place]
        return name if isinstance(part, Group) else None if part.joined is not None else name or None

    def attributes(self, place: str) -> dict[str, Any]:
        """Return meaning and unit."""
        part = self._parts[place][1]
        return {"long_name": part.meaning} if isinstance(part, Group) else attributes_of(part)


@dataclass(frozen=True, kw_only=True)
class _Column:
    """The values at one place of a summary, one for each entry of the enclosing tables.

    Attributes:
        place: keys that lead to it.
        name: of its variable, or prefix of those below.
        entries: values; `None` where there is none.
        dims: of the entries.
        labels: of the dimensions that have some.
    """

    place: str
    name: str
    entries: _Entries
    dims: tuple[str, ...]
    labels: dict[str, Any]

    @property
    def first(self) -> Any:
        """The first value that is not missing."""
        return next((entry for entry in self.entries.flat if entry is not None), None)

    @property
    def keys(self) -> list[str]:
        """Of all entries, which are dictionaries."""
        return list({key: None for entry in self.entries.flat for key in entry or {}})

    def along(self, dimension: str, labels: Any, parts: list[list[Any]]) -> _Column:
        """The column whose entries are cut into parts, which lie along one more dimension."""
        longest = max(map(len, parts))
        entries = np.empty((len(parts), longest), dtype=object)
        for row, pieces in enumerate(parts):
            for place, piece in enumerate(pieces):
                entries[row, place] = piece
        return replace(
            self,
            entries=entries.reshape(*self.entries.shape, longest),
            dims=(*self.dims, dimension),
            labels=self.labels | ({} if labels is None else {dimension: labels}),
        )

    def below(self, key: str, names: Naming) -> Iterator[_Column]:
        """The columns below one key of its entries, none if it is left out."""
        place = f"{self.place}.{key}".lstrip(".")
        name = names.name(place, f"{self.name}_{key}".lstrip("_"))
        if name is None:
            return
        entries = np.empty(self.entries.shape, dtype=object)
        for index in np.ndindex(entries.shape):
            entries[index] = (self.entries[index] or {}).get(key)
        yield from _leaves(replace(self, place=place, name=name, entries=entries), names)


def summary_variables(summary: Summary, names: Naming) -> Iterator[Variable]:
    """Yield a summary as variables with units, and the labels of their dimensions.

    Args:
        summary: content of ``summary.json``, in types of JSON.
        names: of its variables.
    """
    whole = np.empty((), dtype=object)
    whole[()] = summary
    top = _Column(place="", name="", entries=whole, dims=(), labels={})
    for key in summary:
        for column in top.below(key, names):
            for dimension, labels in column.labels.items():
                yield Variable(name=dimension, dimensions=(dimension,), values=np.asarray(labels))
            values, attributes = _typed(column, names.attributes(column.place))
            yield Variable(name=column.name, dimensions=column.dims, values=values, attributes=attributes)


def _leaves(column: _Column, names: Naming) -> Iterator[_Column]:
    """The columns of numbers, texts and truth values."""
    column = _unrolled(column, list(names.dimensions(column.place)))
    if isinstance(column.first, dict):
        for key in column.keys:
            yield from column.below(key, names)
    elif column.entries.size and not isinstance(column.first, list):
        yield column


def _unrolled(column: _Column, dimensions: list[str]) -> _Column:
    """A column whose lists, and dictionaries by labels, lie along dimensions."""
    level = 1
    while isinstance(column.first, list) or (dimensions and isinstance(column.first, dict)):
        dimension = dimensions.pop(0) if dimensions else f"{column.name}_entry" + (f"_{level}" if level > 1 else "")
        level += 1
        if isinstance(column.first, dict):
            parts = [[(entry or {}).get(key) for key in column.keys] for entry in column.entries.flat]
            column = column.along(dimension, column.keys, parts)
            continue
        column = column.along(dimension, None, [entry or [] for entry in column.entries.flat])
        if isinstance(column.first, dict):
            numbers = np.arange(1, column.entries.shape[-1] + 1, dtype=np.int32)
            column = replace(column, labels=column.labels | {dimension: numbers})
    return column


def _typed(column: _Column, attributes: dict[str, Any]) -> tuple[NDArray[Any], dict[str, Any]]:
    """The values of a column in a type of NetCDF, with their attributes."""
    without_unit = {"long_name": attributes["long_name"]}
    known = [entry for entry in column.entries.flat if entry is not None]
    if not all(isinstance(entry, bool | int | float) or entry in ("inf", "-inf") for entry in known) or (
        not known and "units" not in attributes
    ):
        return np.where(column.entries == np.array(None), "", column.entries).astype(np.str_), without_unit
    if len(known) == column.entries.size:
        if all(isinstance(entry, bool) for entry in known):
            return column.entries.astype(np.bool_), without_unit
        if all(isinstance(entry, int) and _INTEGERS.min <= entry <= _INTEGERS.max for entry in known):
            return column.entries.astype(np.int32), attributes
    return column.entries.astype(np.float64), attributes
