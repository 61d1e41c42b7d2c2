"""The output of the command check."""

from __future__ import annotations

from collections.abc import Iterable

from rich.console import Console
from rich.table import Table
from rich.text import Text

from hydroelastic.output.sections import Section


def print_check(title: str, sections: Iterable[Section], console: Console) -> None:
    """Print the model of a scene; sections without a table have no heading."""
    # Text, not str: a title may hold brackets, which rich would read as markup.
    console.print(Text(title or "Untitled scene", style="bold"))
    for section in sections:
        if section.rows:
            console.print(_table(section))
        for line in (*section.lines, *(f"• {note}" for note in section.notes)):
            console.print(Text(line))


def _table(section: Section) -> Table:
    table = Table(*section.headings, title=section.title, title_justify="left")
    for row in section.rows:
        table.add_row(*(Text(cell) for cell in row))
    return table
