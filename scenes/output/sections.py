"""What a person reads of a result: tables under headings, for a terminal and in Markdown."""

from __future__ import annotations

import io
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import TypeAlias

from rich import box
from rich.console import Console
from rich.table import Table

from hydroelastic.scenes.output.provenance import Summary

Row: TypeAlias = tuple[str, ...]


@dataclass(frozen=True, kw_only=True)
class Section:
    """A table with a heading and what is said below it.

    Attributes:
        title: heading.
        headings: of the columns.
        rows: cells as text; none where there are only lines.
        lines: what is said below the table.
        notes: what explains the rows, for who asks: printed by the command compare alone.
        compares: whether it sets a theory beside the solution; a report puts those apart.
    """

    title: str
    headings: Row = ()
    rows: Sequence[Row] = ()
    lines: tuple[str, ...] = ()
    notes: tuple[str, ...] = ()
    compares: bool = False


def printed_sections(
    summary: Summary, sections: Iterable[Section], cost: str, *, notes: bool = False, width: int = 120
) -> str:
    """All of a result as text for a terminal.

    Args:
        summary: content of ``summary.json``.
        sections: the tables.
        cost: a line that says what the result took.
        notes: whether to print the notes of the tables.
        width: of the text, in characters.
    """
    console = Console(file=io.StringIO(), width=width, color_system=None, highlight=False)
    console.print(title_of(summary), markup=False)
    for line in status_lines(summary):
        console.print(line, markup=False, style="bold")
    for section in sections:
        console.print(section.title, markup=False)
        if section.rows:
            console.print(rich_table(section.headings, section.rows))
        for line in (*section.lines, *(section.notes if notes else ())):
            console.print(line, markup=False)
    console.print(cost, markup=False)
    return console.file.getvalue().rstrip()  # type: ignore[attr-defined]


def markdown_sections(summary: Summary, sections: Iterable[Section], cost: str) -> str:
    """All of a result as Markdown, with all notes; the arguments are those of `printed_sections`."""
    parts = [f"# {title_of(summary)}", ""]
    complaint = [f"**{line}**" if number == 0 else line for number, line in enumerate(status_lines(summary))]
    parts += [*complaint, ""] if complaint else []
    for section in sections:
        parts += [f"## {section.title}", ""]
        parts += [markdown_table(section.headings, section.rows), ""] if section.rows else []
        parts += [line + "\n" for line in section.lines]
        parts += [*(f"- {note}" for note in section.notes), ""] if section.notes else []
    parts.append(cost)
    return "\n".join(parts) + "\n"


def title_of(summary: Summary) -> str:
    """Return the title of a scene."""
    return summary["scene"]["title"] or "Untitled scene"


def status_lines(summary: Summary) -> list[str]:
    """A loud word if the answer does not keep what was asked."""
    if summary["status"] == "ok":
        return []
    tolerance = summary["scene"]["accuracy"]["tolerance"]
    return [f"NOT CONVERGED to the tolerance {tolerance:g}:", *(f"  - {reason}" for reason in summary["reasons"])]


def rich_table(headings: tuple[str, ...], rows: Sequence[tuple[str, ...]]) -> Table:
    """Return a table for a terminal."""
    table = Table(box=box.SIMPLE_HEAD, pad_edge=False)
    for column, heading in enumerate(headings):
        leftwards = column == 0 or heading in ("kind", "symmetry", "bound")
        table.add_column(heading, justify="left" if leftwards else "right", no_wrap=True)
    for row in rows:
        table.add_row(*row)
    return table


def markdown_table(headings: tuple[str, ...], rows: Sequence[tuple[str, ...]]) -> str:
    """Return a table in Markdown."""
    lines = [headings, tuple("---" for _ in headings), *rows]
    # A bar in a cell would end it.
    cells = [[cell.replace("|", r"\|") for cell in line] for line in lines]
    return "\n".join("| " + " | ".join(line) + " |" for line in cells)
