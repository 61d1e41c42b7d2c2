"""Data of a report: parts with tables, lines, pictures and the scene's text."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass

from hydroelastic.output.provenance import Summary
from hydroelastic.output.sections import Section
from hydroelastic.scenes.report.families import Family, family_of

_NUMBER = re.compile(r"[+\-−–≥≤]?\s*(\d[\d.]*(e[+-]?\d+)?( ?[+\-−]\d[\d.]*(e[+-]?\d+)?i)?|inf)?( %)?")
# Lines such as "UNSTABLE: …" are highlighted.
_LOUD = re.compile(r"[A-Z]{2,}:")


@dataclass(frozen=True, kw_only=True)
class Picture:
    """An image embedded in the page.

    Attributes:
        source: a ``data:`` address.
        caption: what it shows.
        width: pixels; ``None`` for vector graphics.
        height: the same.
        moving: whether it is an animation, which is shown on request only.
    """

    source: str
    caption: str
    width: int | None = None
    height: int | None = None
    moving: bool = False


@dataclass(frozen=True, kw_only=True)
class Part:
    """A part of the page under a heading of its own.

    Attributes:
        anchor: target of the link in the contents.
        title: heading.
        lines: paragraphs at its beginning.
        text: preformatted text; empty if there is none.
        sections: tables with lines below them.
        pictures: images.
    """

    anchor: str
    title: str
    lines: tuple[str, ...] = ()
    text: str = ""
    sections: tuple[Section, ...] = ()
    pictures: tuple[Picture, ...] = ()


@dataclass(frozen=True, kw_only=True)
class ReportPage:
    """A whole report.

    Attributes:
        title: of the scene.
        kind: of the scene, in words.
        tolerance: that was asked.
        reasons: why it is not reached; empty if it is.
        warnings: requests besides the solution that could not be fulfilled.
        version: of this project.
        parts: in their order.
    """

    title: str
    kind: str
    tolerance: float
    reasons: tuple[str, ...]
    warnings: tuple[str, ...]
    version: str
    parts: tuple[Part, ...]


_KINDS: dict[Family, str] = {
    "tank": "closed tank",
    "level tank": "tank in three dimensions",
    "open water": "open water",
    "string": "hanging string",
    "thread": "thread in a stream",
    "roll": "rolling ship",
}


def kind_of(summary: Summary) -> str:
    """Return the kind of a scene in words."""
    return _KINDS[family_of(summary)]


def is_numeric(cells: Iterable[str]) -> bool:
    """Return whether a column holds only numbers, which are aligned to the right."""
    return all(_NUMBER.fullmatch(cell) for cell in cells)


def is_warning(line: str) -> bool:
    """Return whether a line warns of the result."""
    return _LOUD.match(line) is not None
