"""Results as tables under headings, for a terminal and in Markdown."""

from __future__ import annotations

import io
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, TypeAlias

from hydroelastic.output.markdown import markdown_table, markdown_text, read_markdown_row, read_markdown_text
from hydroelastic.output.provenance import REASONS, SCENE, STATUS, Summary, read_summary, warnings_of

if TYPE_CHECKING:
    from rich.console import Console
    from rich.table import Table

Row: TypeAlias = tuple[str, ...]


@dataclass(frozen=True, kw_only=True)
class Section:
    """A table with a heading and lines below it.

    Attributes:
        title: heading.
        headings: of the columns.
        rows: cells as text; empty if there are only lines.
        lines: lines below the table.
        notes: explanations of the rows: printed by the command compare only.
        compares: whether it compares the solution with a theory; a report shows these separately.
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
    """A result as text for a terminal."""
    console = text_console(width)
    console.print(title_of(summary), markup=False)
    for number, line in enumerate(status_lines(summary)):
        console.print(f"  - {line}" if number else line, markup=False, style="bold")
    for warning in warnings_of(summary):
        console.print(f"WARNING: {warning}", markup=False, style="bold")
    for section in sections:
        console.print(section.title, markup=False)
        if section.rows:
            console.print(rich_table(section.headings, section.rows))
        for line in (*section.lines, *(section.notes if notes else ())):
            console.print(line, markup=False)
    console.print(cost, markup=False)
    return text_of(console).rstrip()


def text_console(width: int) -> Console:
    """Return a console that keeps what is printed, for `text_of`."""
    # Who prints nothing does without it.
    from rich.console import Console

    # In a notebook it would else show each line by itself, and keep nothing.
    return Console(
        file=io.StringIO(), width=width, force_jupyter=False, color_system=None, highlight=False, emoji=False
    )


def text_of(console: Console) -> str:
    """Return what was printed on a console of `text_console`."""
    text: str = console.file.getvalue()  # type: ignore[attr-defined]
    return text


def markdown_sections(summary: Summary, sections: Iterable[Section], cost: str) -> str:
    """A result as Markdown, with all notes; the arguments are those of `printed_sections`."""
    parts = [f"# {markdown_text(title_of(summary))}", ""]
    complaint, *reasons = status_lines(summary) or [""]
    parts += [f"**{complaint}**", *(f"- {markdown_text(reason)}" for reason in reasons), ""] if complaint else []
    parts += [f"**WARNING: {markdown_text(warning)}**\n" for warning in warnings_of(summary)]
    for section in sections:
        parts += [f"## {markdown_text(section.title)}", ""]
        headings, *rows = (tuple(map(markdown_text, row)) for row in (section.headings, *section.rows))
        parts += [markdown_table(headings, rows), ""] if rows else []
        parts += [markdown_text(line) + "\n" for line in section.lines]
        parts += [*(f"- {markdown_text(note)}" for note in section.notes), ""] if section.notes else []
    parts.append(markdown_text(cost))
    return "\n".join(parts) + "\n"


def read_markdown_sections(text: str) -> tuple[tuple[Section, ...], str]:
    """Return the tables and the line about size and time of a text that `markdown_sections` wrote."""
    body, _, cost = text.rstrip("\n").rpartition("\n")
    sections = []
    for part in body.split("\n## ")[1:]:
        title, *lines = part.split("\n")
        table = [read_markdown_row(line) for line in lines if line.startswith("| ")]
        section = Section(
            title=read_markdown_text(title),
            headings=table[0] if table else (),
            rows=table[2:],
            lines=tuple(read_markdown_text(line) for line in lines if line and not line.startswith(("| ", "- "))),
            notes=tuple(read_markdown_text(line[2:]) for line in lines if line.startswith("- ")),
        )
        sections.append(section)
    return tuple(sections), read_markdown_text(cost)


def title_of(summary: Summary) -> str:
    """Return the title of a scene."""
    return read_summary(summary)[SCENE]["title"] or "Untitled scene"


def status_lines(summary: Summary) -> list[str]:
    """A warning if the requested accuracy is not reached, then the reasons."""
    told = read_summary(summary)
    if told[STATUS] == "ok":
        return []
    tolerance = told[SCENE]["accuracy"]["tolerance"]
    return [f"NOT CONVERGED to the tolerance {tolerance:g}:", *told[REASONS]]


def rich_table(headings: tuple[str, ...], rows: Sequence[tuple[str, ...]]) -> Table:
    """Return a table for a terminal."""
    from rich import box
    from rich.table import Table
    from rich.text import Text

    table = Table(box=box.SIMPLE_HEAD, pad_edge=False)
    for column, heading in enumerate(headings):
        leftwards = column == 0 or heading in ("kind", "symmetry", "bound")
        table.add_column(heading, justify="left" if leftwards else "right", no_wrap=True)
    for row in rows:
        # Text, not str: what a scene is called may hold brackets, which rich would read as markup.
        table.add_row(*map(Text, row))
    return table
