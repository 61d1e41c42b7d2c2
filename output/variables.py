"""Labelled arrays as `dataset.nc` holds them, made of declared quantities."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hydroelastic.output.quantities import Group, Quantity


@dataclass(frozen=True, kw_only=True, eq=False)
class Variable:
    """A labelled array.

    Attributes:
        name: in ``dataset.nc``; that of a dimension if it holds the places along it.
        dimensions: names.
        values: numbers, which may be complex, texts or truth values.
        attributes: ``units``, ``long_name``, ``absolute_error`` and others.
        is_coordinate: whether it belongs to the places of other arrays without being one of their dimensions.
    """

    name: str
    dimensions: tuple[str, ...]
    values: NDArray[Any]
    attributes: Mapping[str, Any] = field(default_factory=dict)
    is_coordinate: bool = False


def attributes_of(quantity: Quantity) -> dict[str, Any]:
    """Return the long name and the unit of the variables of a quantity, and what its phase is relative to."""
    found = {"long_name": quantity.meaning, "units": quantity.unit_with_rolls, "phase": quantity.phase or None}
    return {name: text for name, text in found.items() if text is not None}


def array_variables(group: Group, record: Any) -> list[Variable]:
    """Return the arrays that only ``dataset.nc`` has, of a group and of all groups within.

    Of a list of records each has arrays of its own: from the second on, their names, and those of their dimensions
    which the groups around do not declare, end in the number of the record. Labels of unused dimensions are left out,
    and so are arrays without a value.
    """
    found = list(_arrays(group, record, frozenset(), 0))
    used = {name for one in found for name in one.dimensions if name != one.name}
    return [one for one in found if one.dimensions != (one.name,) or one.name in used]


def _arrays(group: Group, record: Any, shared: frozenset[str], place: int) -> Iterator[Variable]:
    for quantity in group.arrays:
        attributes = attributes_of(quantity)
        if quantity.error:
            attributes["absolute_error"] = float(group[quantity.error].of(record))
        values = quantity.of(record)
        if values is None:
            continue
        yield Variable(
            name=numbered(quantity.variable or quantity.key, place),
            dimensions=tuple(name if name in shared else numbered(name, place) for name in quantity.dimensions),
            values=np.asarray(values),
            attributes=attributes,
            is_coordinate=quantity.is_coordinate,
        )
    # Names along dimensions that all records of the solution share.
    shared |= (
        {quantity.key for quantity in group.arrays if quantity.dimensions == (quantity.key,)} if not place else set()
    )
    for inner in group.groups:
        for number, one in enumerate(inner.records(record)):
            yield from _arrays(inner, one, shared, number)


def numbered(name: str, place: int, suffix: str = "") -> str:
    """Return the name of what belongs to the first (0), second … record of a list: "modes", "modes_2" …"""
    return f"{name}{suffix}" if place == 0 else f"{name}_{place + 1}{suffix}"


def merged(*parts: Iterable[Variable]) -> list[Variable]:
    """Return all variables, of those with the same name the first one."""
    found: dict[str, Variable] = {}
    for variable in (variable for part in parts for variable in part):
        first = found.setdefault(variable.name, variable)
        same = np.array_equal(first.values, variable.values, equal_nan=first.values.dtype.kind in "fc")
        if first is not variable and not (first.dimensions == variable.dimensions and same):
            raise ValueError(f"two variables of the name {variable.name} differ")
    return list(found.values())


def grid_columns(variables: Iterable[Variable], names: Iterable[str], dimensions: tuple[str, ...]) -> dict[str, Any]:
    """Return arrays as columns of a table with one row for each place of a grid, the last dimension fastest."""
    by_name = {variable.name: variable for variable in variables}
    sizes = [len(by_name[name].values) for name in dimensions]
    columns = {}
    for name in names:
        variable = by_name[name]
        order = sorted(range(len(variable.dimensions)), key=lambda axis: dimensions.index(variable.dimensions[axis]))
        shape = [size if one in variable.dimensions else 1 for one, size in zip(dimensions, sizes, strict=True)]
        columns[name] = np.broadcast_to(variable.values.transpose(order).reshape(shape), sizes).ravel()
    return columns


def separate_parts(variable: Variable) -> Variable:
    """Return an array of complex numbers with a leading dimension `complex`, as Capytaine writes them; others as is."""
    if variable.values.dtype.kind != "c":
        return variable
    # Values that were not computed are NaN in both parts.
    parts = np.where(np.isnan(variable.values), np.nan, [variable.values.real, variable.values.imag])
    return replace(variable, dimensions=("complex", *variable.dimensions), values=parts)


PARTS = Variable(name="complex", dimensions=("complex",), values=np.array(["re", "im"]))
