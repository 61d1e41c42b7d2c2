"""Arrays that several records have together, joined by the labels of their dimensions, as xarray's `combine_first`.

Two analyses of radiation, say, have one array of added mass over the frequencies of both.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hydroelastic.output.quantities import Group
from hydroelastic.output.variables import Variable, attributes_of


def record_variables(group: Group, record: Any, *, with_rolls: bool) -> Iterator[Variable]:
    """Yield the arrays of one record that are to be joined with those of others; none where there is no value.

    Args:
        group: of declared quantities, with the groups within.
        record: of the group.
        with_rolls: whether units tell which entries belong to rotations.
    """
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


def joined(parts: Sequence[Sequence[Variable]], labels: Mapping[str, Sequence[Any]]) -> list[Variable]:
    """Return the arrays of all parts over the labels of all, numbers that no part has NaN and texts "".

    Args:
        parts: the arrays of each, the labels of their dimensions among them. Of values that several have, the first is
            taken.
        labels: of some dimensions, all that are kept, in order. Other labels that differ between parts are sorted.
    """
    known: dict[str, NDArray[Any]] = {}
    for one in (variable for part in parts for variable in part if variable.dimensions == (variable.name,)):
        first = known.setdefault(one.name, one.values)
        if not np.array_equal(first, one.values):
            known[one.name] = np.union1d(first, one.values)
    known |= {name: np.asarray(labels[name]) for name in labels if name in known}
    found: dict[str, Variable] = {}
    for part in parts:
        own = {variable.name: variable.values for variable in part}
        for one in part:
            is_text = one.values.dtype.kind == "U"
            if one.name not in found:
                shape = [len(known[name]) for name in one.dimensions]
                kind = object if is_text else np.result_type(one.values, float)
                values = known[one.name] if one.name in known else np.full(shape, "" if is_text else np.nan, kind)
                found[one.name] = Variable(**{**vars(one), "values": values})
            if one.name in known:
                continue
            places = [_places(own[name], known[name]) for name in one.dimensions]
            source, target = (np.ix_(*(pair[side] for pair in places)) for side in (0, 1))
            there = found[one.name].values[target]
            missing = there == "" if is_text else np.isnan(there)
            found[one.name].values[target] = np.where(missing, one.values[source], there)
    return list(found.values())


def _places(own: NDArray[Any], labels: NDArray[Any]) -> tuple[list[int], list[int]]:
    """Places of a part's own labels that are among all labels: among its own, and among all."""
    places = {label: place for place, label in enumerate(labels.tolist())}
    kept = [(place, places[label]) for place, label in enumerate(own.tolist()) if label in places]
    return [one for one, _ in kept], [other for _, other in kept]
