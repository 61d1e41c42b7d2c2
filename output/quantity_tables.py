"""Printed tables of declared quantities, and the reference of all keys in Markdown."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace

from hydroelastic.output.markdown import markdown_table
from hydroelastic.output.quantities import Group, Quantity
from hydroelastic.output.reading import Reading
from hydroelastic.output.sections import Row


def listed(reading: Reading) -> list[Row]:
    """Return one row for each printed quantity that a reading has: meaning, symbol and unit; value."""
    return [(quantity.label, reading.cell(quantity)) for quantity in _printed(reading.group) if quantity in reading]


def headings(group: Group) -> Row:
    """Return the headings of the columns of `columns`."""
    return tuple(quantity.heading for quantity in _printed(group))


def without_zeros(quantity: Quantity, entries: Sequence[Reading], group: Group) -> tuple[Group, list[Reading]]:
    """Return the group and the entries, without a quantity that is zero in all of these: it says nothing there."""
    if any(one[quantity] for one in entries):
        return group, list(entries)
    told = replace(group, parts=tuple(part for part in group.parts if part is not quantity))
    return told, [replace(one, group=told) for one in entries]


def columns(entries: Sequence[Reading]) -> list[Row]:
    """Return one row for each entry of a list, with one cell for each printed quantity."""
    return [tuple(map(entry.cell, _printed(entry.group))) for entry in entries]


def labelled_columns(entries: Sequence[Reading] | Mapping[str, Reading]) -> list[Row]:
    """Return the rows of `columns`, in front of each the number of the entry, or its label in a dictionary."""
    if isinstance(entries, Mapping):
        labels, entries = list(entries), list(entries.values())
    else:
        labels = [str(number) for number in range(1, len(entries) + 1)]
    return [(label, *row) for label, row in zip(labels, columns(entries), strict=True)]


def _printed(group: Group) -> Iterator[Quantity]:
    return (quantity for quantity in group.quantities if quantity.in_summary and quantity.printed)


def reference_table(kind: Group) -> str:
    """Return a table in Markdown of all keys and variables of a kind of scene, in the order of their declaration."""
    rows: list[Row] = []
    for place, name, dimensions, part in kind.places():
        level = place.count(".")
        key = "· " * level + f"`{part.key}`" + ("" if part.contract else " †")
        if isinstance(part, Group):
            what = f"{part.meaning}; along `{part.dimension}`" if part.dimension else part.meaning
            rows.append((key, "", "", _noted(what, part.note), ""))
            continue
        variable = f"`{name}`" + (f" ({', '.join(dimensions)})" if dimensions else "") if name else ""
        variable += " †" if name and not (part.contract or part.in_summary) else ""
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
