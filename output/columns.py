"""Columns of numbers, flattened from the declared arrays of a record: of CSV files and of printed tables."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import groupby
from math import prod
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hydroelastic.output.json_values import json_ready
from hydroelastic.output.quantities import Group, Quantity
from hydroelastic.output.sections import Row
from hydroelastic.physics.dofs import Dof


@dataclass(frozen=True, kw_only=True, eq=False)
class Column:
    """The values of a quantity at one place along each of its dimensions that are not rows.

    Attributes:
        quantity: which.
        places: along these dimensions, by name.
        labels: there.
        values: of each row.
    """

    quantity: Quantity
    places: Mapping[str, int]
    labels: tuple[str, ...]
    values: NDArray[Any]

    @property
    def name(self) -> str:
        """In CSV files."""
        first = self.quantity.key if self.quantity.column is None else self.quantity.column
        return "_".join(filter(None, (first, *self.labels))).replace(" ", "_")


def columns_of(
    group: Group, record: Any, rows: tuple[str, ...], labels: Mapping[str, Sequence[str]]
) -> Iterator[Column]:
    """Yield the columns of a record: of all arrays along the rows, and of single values that have a column declared.

    What the record does not have has none.

    Columns of successive quantities with the same one further dimension alternate.
    """
    arrays = {
        part: np.asarray(value)
        for part in group.parts
        if isinstance(part, Quantity)
        and (part.in_summary or part.column is not None)
        and (part.column is not None if not part.dimensions else set(part.dimensions) & set(rows))
        and (value := part.of(record)) is not None
    }
    sizes = {name: size for part in arrays for name, size in zip(part.dimensions, arrays[part].shape, strict=True)}
    shape = [sizes[name] for name in rows]
    for further, parts in groupby(arrays, key=lambda part: tuple(name for name in part.dimensions if name not in rows)):
        beyond = [sizes[name] for name in further]
        flat = {}
        for part in parts:
            own = [sizes[name] if name in part.dimensions else 1 for name in rows]
            whole = np.broadcast_to(arrays[part].reshape(*own, *beyond), (*shape, *beyond))
            # In full, because −1 stands for nothing where there is no place beyond the rows.
            flat[part] = whole.reshape(prod(shape), *beyond)
        places = list(np.ndindex(*beyond))
        order = (
            [(at, part) for at in places for part in flat]
            if len(further) == 1
            else [(at, part) for part in flat for at in places]
        )
        for at, part in order:
            index: Any = (slice(None), *at)
            names = tuple(labels[name][place] for name, place in zip(further, at, strict=True))
            yield Column(
                quantity=part,
                places=dict(zip(further, at, strict=True)),
                labels=names,
                values=flat[part][index],
            )


def headings_of(columns: Sequence[Column], told: str) -> Row:
    """The headings of columns, with the labels along one dimension."""
    found = []
    for column in columns:
        motions = [label for label in column.labels if isinstance(label, Dof)]
        quantity = column.quantity.of_rotations(sum(motion.is_rotation for motion in motions))
        labels = [_words(label) for name, label in zip(column.places, column.labels, strict=True) if name == told]
        found.append(replace(quantity, symbol=" ".join(filter(None, (quantity.symbol, *labels)))).heading)
    return tuple(found)


def rows_of(group: Group, columns: Sequence[Column], places: Sequence[int], errors: Sequence[Column] = ()) -> list[Row]:
    """Some rows of columns, with digits by their errors, which are among them or given; of complex numbers the
    magnitudes."""
    own_errors = [_error_of(column, (*columns, *errors)) for column in columns]
    rows = []
    for place in places:
        row = []
        for column, error in zip(columns, own_errors, strict=True):
            values = {column.quantity.key: json_ready(_size(column.values[place]))}
            if error is not None:
                values[error.quantity.key] = json_ready(error.values[place])
            row.append(column.quantity.cell(values, group))
        rows.append(tuple(row))
    return rows


def _error_of(column: Column, others: Sequence[Column]) -> Column | None:
    named = (other for other in others if other.quantity.key == column.quantity.error)
    return next((other for other in named if other.places.items() <= column.places.items()), None)


def _size(value: Any) -> Any:
    return abs(value) if isinstance(value, complex) else value


def _words(label: str) -> str:
    return label.words if isinstance(label, Dof) else label


def csv_columns(tables: Iterable[tuple[int, Iterable[Column]]]) -> dict[str, list[Any]]:
    """Return the columns of tables one below the other, the first one, ``analysis``, with the number of each.

    A column that a table lacks is empty there; a complex number has two, ``re_`` and ``im_``.
    """
    found: dict[str, list[Any]] = {"analysis": []}
    for number, table in tables:
        columns = {name: values for column in table for name, values in _parts(column)}
        count, total = len(next(iter(columns.values()))), len(found["analysis"])
        columns = {"analysis": [number] * count} | columns
        for name in dict.fromkeys((*found, *columns)):
            found.setdefault(name, [""] * total).extend(columns.get(name, [""] * count))
    return found


def _parts(column: Column) -> Iterator[tuple[str, list[Any]]]:
    if column.values.dtype.kind == "c":
        yield f"re_{column.name}", column.values.real.tolist()
        yield f"im_{column.name}", column.values.imag.tolist()
    else:
        yield column.name, column.values.tolist()
