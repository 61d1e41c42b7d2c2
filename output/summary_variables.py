"""A summary as labelled variables: every number, word and truth value under the keys that lead to it.

`size: {cells: 83}` becomes the variable `size_cells`. The entries of a list lie along a dimension, so that a list of
entries with keys of their own becomes a variable for each of the keys. Values missing from an entry are NaN, or the
text "".
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from hydroelastic.output.long_names import long_name_of
from hydroelastic.output.provenance import Summary
from hydroelastic.output.summary_units import unit_of

if TYPE_CHECKING:
    import xarray

_Entries: TypeAlias = NDArray[Any]
_INTEGERS = np.iinfo(np.int32)


@dataclass(frozen=True, kw_only=True)
class SummaryNames:
    """Names of the tables in the summary of a kind of scene. A place is the keys that lead to it, joined by dots.

    Attributes:
        dimensions: of the list at a place, one for each level of lists within lists; of a dictionary whose keys are
            labels, one. Those of other lists are named after their place.
        prefixes: prefix that replaces a place in the names of the variables below it.
        units: of numbers at a place, where the key does not determine it.
        reported_by_arrays: places that are left out because the labelled arrays contain the same.
    """

    dimensions: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    prefixes: Mapping[str, str] = field(default_factory=dict)
    units: Mapping[str, str] = field(default_factory=dict)
    reported_by_arrays: frozenset[str] = frozenset()


# Tables that all summaries have.
_DIMENSIONS = {"timing": ("stage",), "versions": ("package",), "reasons": ("reason",)}


@dataclass(frozen=True, kw_only=True)
class _Column:
    """The values at one place of a summary, one for each entry of the enclosing tables.

    Attributes:
        place: keys that lead to it.
        name: of its variables.
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

    def below(self, key: str, prefix: str) -> _Column:
        """The column of one key of its entries."""
        entries = np.empty(self.entries.shape, dtype=object)
        for index in np.ndindex(entries.shape):
            entries[index] = (self.entries[index] or {}).get(key)
        return replace(
            self, place=f"{self.place}.{key}".lstrip("."), name=f"{prefix}_{key}".lstrip("_"), entries=entries
        )


def summary_variables(summary: Summary, names: SummaryNames) -> xarray.Dataset:
    """Return a summary as variables with units, without the places of `SummaryNames.reported_by_arrays`.

    Args:
        summary: content of ``summary.json``, in types of JSON.
        names: of its tables.
    """
    # The import of xarray is slow.
    import xarray

    whole = np.empty((), dtype=object)
    whole[()] = summary
    parts = [
        xarray.Dataset({column.name: (column.dims, *_typed(column, names))}, column.labels)
        for column in _leaves(_Column(place="", name="", entries=whole, dims=(), labels={}), names)
    ]
    return xarray.merge(parts, join="exact", compat="no_conflicts")


def _leaves(column: _Column, names: SummaryNames) -> Iterator[_Column]:
    """The columns of numbers, texts and truth values."""
    if column.place in names.reported_by_arrays:
        return
    column = _unrolled(column, list(names.dimensions.get(column.place, _DIMENSIONS.get(column.place, ()))))
    if isinstance(column.first, dict):
        for key in column.keys:
            yield from _leaves(column.below(key, names.prefixes.get(column.place, column.name)), names)
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


def _typed(column: _Column, names: SummaryNames) -> tuple[NDArray[Any], dict[str, str]]:
    """The values of a column in a type of NetCDF, with their attributes."""
    unit = names.units.get(column.place, unit_of(column.place))
    said = {"long_name": long_name_of(column.place)}
    known = [entry for entry in column.entries.flat if entry is not None]
    if not all(isinstance(entry, bool | int | float) or entry in ("inf", "-inf") for entry in known) or (
        not known and unit is None
    ):
        return np.where(column.entries == np.array(None), "", column.entries).astype(np.str_), said
    if len(known) == column.entries.size:
        if all(isinstance(entry, bool) for entry in known):
            return column.entries.astype(np.bool_), said
        if all(isinstance(entry, int) and _INTEGERS.min <= entry <= _INTEGERS.max for entry in known):
            return column.entries.astype(np.int32), said | _units(unit)
    return column.entries.astype(np.float64), said | _units(unit)


def _units(unit: str | None) -> dict[str, str]:
    return {} if unit is None else {"units": unit}
