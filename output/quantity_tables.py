"""Printed tables of declared quantities, and the reference of all keys in Markdown."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Any

from hydroelastic.output.markdown import markdown_table
from hydroelastic.output.quantities import Group, Quantity
from hydroelastic.output.sections import Row


def listed(group: Group, values: Mapping[str, Any]) -> list[Row]:
    """Return one row for each printed quantity of a group: meaning, symbol and unit; value.

    Args:
        group: which declares them.
        values: by key; those that it lacks have no row.
    """
    return [(quantity.label, quantity.cell(values, group)) for quantity in _printed(group) if quantity.key in values]


def headings(group: Group) -> Row:
    """Return the headings of the columns of `columns`."""
    return tuple(quantity.heading for quantity in _printed(group))


def without_zeros(group: Group, key: str, entries: Sequence[Mapping[str, Any]]) -> Group:
    """Return the group, without the quantity of a key where that is zero in all entries: it says nothing there."""
    said = any(values[key] for values in entries)
    return group if said else replace(group, parts=tuple(part for part in group.parts if part.key != key))


def columns(group: Group, entries: Sequence[Mapping[str, Any]]) -> list[Row]:
    """Return one row for each entry of a list, with one cell for each printed quantity.

    Args:
        group: which declares the quantities.
        entries: their values by key.
    """
    return [tuple(quantity.cell(values, group) for quantity in _printed(group)) for values in entries]


def labelled_columns(group: Group, entries: Sequence[Mapping[str, Any]] | Mapping[str, Mapping[str, Any]]) -> list[Row]:
    """Return the rows of `columns`, in front of each the number of the entry, or its label in a dictionary."""
    if isinstance(entries, Mapping):
        labels, entries = list(entries), list(entries.values())
    else:
        labels = [str(number) for number in range(1, len(entries) + 1)]
    return [(label, *row) for label, row in zip(labels, columns(group, entries), strict=True)]


def _printed(group: Group) -> Iterator[Quantity]:
    return (part for part in group.parts if isinstance(part, Quantity) and part.in_summary and part.printed)


def reference_table(kind: Group) -> str:
    """Return a table in Markdown of all keys and variables of a kind of scene, in the order of their declaration."""
    rows: list[Row] = []
    for place, name, dimensions, part in kind.places():
        level = place.count(".")
        key = "· " * level + f"`{part.key}`"
        if isinstance(part, Group):
            what = f"{part.meaning}; along `{part.dimension}`" if part.dimension else part.meaning
            rows.append((key, "", "", _noted(what, part.note), ""))
            continue
        variable = f"`{name}`" + (f" ({', '.join(dimensions)})" if dimensions else "") if name else ""
        rows.append(
            (key if part.in_summary else "", part.symbol, part.unit_text, _noted(part.meaning, part.note), variable)
        )
    headings = ("key of `summary.json`", "symbol", "unit", "meaning", "variable of `dataset.nc`")
    # Attributes of a record in a name are those of its entries.
    return markdown_table(
        headings, [tuple(cell.replace("|", r"\|").replace("{.", "{") for cell in row) for row in rows]
    )


def _noted(meaning: str, note: str) -> str:
    return f"{meaning}; {note}" if note else meaning
