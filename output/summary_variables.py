"""A summary as labelled variables: every number, text and truth value under its declared name.

`size: {cells: 83}` becomes the variable `size_cells`. The entries of a list lie along a dimension, so that a list of
entries with keys of their own becomes a variable for each of the keys. Values missing from an entry are NaN, or the
text "".
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from hydroelastic.output.provenance import Summary
from hydroelastic.output.quantities import Group, Quantity
from hydroelastic.output.variables import Variable, attributes_of

_Entries: TypeAlias = NDArray[Any]
_INTEGERS = np.iinfo(np.int32)


def summary_variables(summary: Summary, *groups: Group) -> Iterator[Variable]:
    """Yield a summary as variables with units, and the labels of their dimensions."""
    whole = np.empty((), dtype=object)
    whole[()] = summary
    found = [one for group in groups for one in _below(group, whole, (), "")]
    # What lies along a dimension may be left out.
    used = {name for one in found for name in one.dimensions if name != one.name}
    yield from (one for one in found if one.dimensions != (one.name,) or one.name in used)


def _below(group: Group, records: _Entries, dimensions: tuple[str, ...], prefix: str) -> Iterator[Variable]:
    """The variables of a group, of whose records there is one at each place along the dimensions."""
    for part in group.parts:
        name = part.name_behind(prefix)
        left_out = isinstance(part, Quantity) and (not part.in_summary or part.joined is not None or not name)
        if left_out or not any(part.key in (record or {}) for record in records.flat):
            continue
        entries, along = np.empty(records.shape, dtype=object), dimensions
        for index in np.ndindex(records.shape):
            entries[index] = (records[index] or {}).get(part.key)
        for dimension in part.dimensions if isinstance(part, Quantity) else filter(None, (part.dimension,)):
            if _first(entries) is not None:
                entries, labels = _unrolled(entries)
                along = (*along, dimension)
                if labels is not None and len(labels):
                    yield Variable(name=dimension, dimensions=(dimension,), values=labels)
        if isinstance(part, Group) and _first(entries) is not None:
            yield from _below(part, entries, along, name)
        elif entries.size:
            attributes = attributes_of(part) if isinstance(part, Quantity) else {"long_name": part.meaning}
            values, attributes = _typed(entries, attributes)
            yield Variable(name=name, dimensions=along, values=values, attributes=attributes)


def _first(entries: _Entries) -> Any:
    return next((entry for entry in entries.flat if entry is not None), None)


def _unrolled(entries: _Entries) -> tuple[_Entries, _Entries | None]:
    """Lists, or dictionaries by labels, along one dimension more; its labels, of lists of records their numbers."""
    if isinstance(_first(entries), dict):
        keys = list({key: None for entry in entries.flat for key in entry or {}})
        parts = [[(entry or {}).get(key) for key in keys] for entry in entries.flat]
    else:
        keys, parts = [], [entry or [] for entry in entries.flat]
    longest = max(map(len, parts))
    found: _Entries = np.empty((len(parts), longest), dtype=object)
    for row, pieces in enumerate(parts):
        for place, piece in enumerate(pieces):
            found[row, place] = piece
    found = found.reshape(*entries.shape, longest)
    numbers = np.arange(1, longest + 1, dtype=np.int32) if isinstance(_first(found), dict) else None
    return found, np.array(keys) if keys else numbers


def _typed(entries: _Entries, attributes: dict[str, Any]) -> tuple[NDArray[Any], dict[str, Any]]:
    without_unit = {name: text for name, text in attributes.items() if name != "units"}
    known = [entry for entry in entries.flat if entry is not None]
    if not all(isinstance(entry, bool | int | float) or entry in ("inf", "-inf") for entry in known) or (
        not known and "units" not in attributes
    ):
        return np.where(entries == np.array(None), "", entries).astype(np.str_), without_unit
    if len(known) == entries.size:
        if all(isinstance(entry, bool) for entry in known):
            return entries.astype(np.bool_), without_unit
        if all(isinstance(entry, int) and _INTEGERS.min <= entry <= _INTEGERS.max for entry in known):
            return entries.astype(np.int32), attributes
    return entries.astype(np.float64), attributes
