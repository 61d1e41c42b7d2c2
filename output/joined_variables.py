"""Arrays that several records have together, joined by the labels of their dimensions, as xarray's `combine_first`.

Two analyses of radiation, say, have one array of added mass over the frequencies of both.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hydroelastic.output.quantities import Group
from hydroelastic.output.variables import Variable, attributes_of


def record_variables(group: Group, record: Any, *, with_rolls: bool) -> Iterator[Variable]:
    """Yield the arrays of one record that are to be joined with those of others; none where there is no value."""
    for part in group.parts:
        if isinstance(part, Group):
            for one in part.records(record):
                yield from record_variables(part, one, with_rolls=with_rolls)
        elif part.joined is not None and (value := part.of(record)) is not None:
            values = np.asarray(value)
            values = values.transpose([part.dimensions.index(name) for name in part.joined if name in part.dimensions])
            single = tuple(axis for axis, name in enumerate(part.joined) if name not in part.dimensions)
            attributes = attributes_of(part if with_rolls else part.of_rotations(0))
            yield Variable(
                name=(part.variable or part.key).format(record),
                dimensions=tuple(name.format(record) for name in part.joined),
                values=np.expand_dims(values, single),
                attributes={key: text.format(record) for key, text in attributes.items()},
                is_coordinate=part.is_coordinate,
            )


def numbered_along(dimension: str, part: Iterable[Variable], number: int) -> Iterator[Variable]:
    """Yield the arrays of one of several parts, but for the labels of dimensions, along one more dimension."""
    yield Variable(name=dimension, dimensions=(dimension,), values=np.array([number]))
    for one in part:
        is_label = one.dimensions == (one.name,)
        yield one if is_label else replace(one, dimensions=(dimension, *one.dimensions), values=one.values[None])


def joined(parts: Sequence[Sequence[Variable]], labels: Mapping[str, Sequence[Any]]) -> list[Variable]:
    """Return the arrays of all parts over the labels of all, numbers that no part has NaN and texts ""."""
    own = [{one.name: one.values for one in part if one.dimensions == (one.name,)} for part in parts]
    known: dict[str, NDArray[Any]] = {}
    for part, told in zip(parts, own, strict=True):
        for one in part:
            for name, size in zip(one.dimensions, one.values.shape, strict=True):
                there = told.setdefault(name, np.arange(size))
                if not np.array_equal(known.setdefault(name, there), there):
                    known[name] = _all_of(known[name], there)
    known |= {name: np.asarray(labels[name]) for name in labels if name in known}
    found: dict[str, Variable] = {}
    for part, told in zip(parts, own, strict=True):
        for one in part:
            if one.dimensions == (one.name,):
                found.setdefault(one.name, replace(one, values=known[one.name]))
                continue
            is_text = one.values.dtype.kind in "UO"
            if one.name not in found:
                empty = np.full([len(known[name]) for name in one.dimensions], "" if is_text else np.nan, object)
                kind = object if is_text else np.result_type(one.values, float)
                found[one.name] = replace(one, values=empty.astype(kind))
            places = [_places(told[name], known[name]) for name in one.dimensions]
            source, target = (np.ix_(*(pair[side] for pair in places)) for side in (0, 1))
            before = found[one.name].values[target]
            missing = before == "" if is_text else np.isnan(before)
            found[one.name].values[target] = np.where(missing, one.values[source], before)
    return list(found.values())


def _all_of(some: NDArray[Any], others: NDArray[Any]) -> NDArray[Any]:
    if some.dtype.kind in "if":
        return np.union1d(some, others)
    return np.array(list(dict.fromkeys((*some.tolist(), *others.tolist()))))


def _places(own: NDArray[Any], labels: NDArray[Any]) -> tuple[list[int], list[int]]:
    """Places of a part's own labels that are among all labels: among its own, and among all."""
    places = {label: place for place, label in enumerate(labels.tolist())}
    kept = [(place, places[label]) for place, label in enumerate(own.tolist()) if label in places]
    return [one for one, _ in kept], [other for _, other in kept]
