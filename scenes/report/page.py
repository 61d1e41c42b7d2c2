"""What a report holds, as values: parts with tables, lines, pictures and the scene's text."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass

from hydroelastic.scenes.output.provenance import Summary
from hydroelastic.scenes.output.sections import Section

_NUMBER = re.compile(r"[+\-−–≥≤]?\s*(\d[\d.]*(e[+-]?\d+)?( ?[+\-−]\d[\d.]*(e[+-]?\d+)?i)?|inf)?( %)?")
# A line such as "UNSTABLE: …" is meant to be seen.
_LOUD = re.compile(r"[A-Z]{2,}:")


@dataclass(frozen=True, kw_only=True)
class Picture:
    """An image that stands in the page itself.

    Attributes:
        source: a ``data:`` address.
        caption: what it shows.
        width: pixels; ``None`` of drawings without pixels.
        height: the same.
        moving: whether it moves, and is seen only when asked for: what moves beside a text hinders its reader.
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
        anchor: name that the contents lead to.
        title: heading.
        lines: paragraphs at its beginning.
        text: a text in which every space counts; empty if there is none.
        sections: tables and what is said below them.
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
        kind: of the scene, as a person says it.
        tolerance: that was asked.
        reasons: why it is not kept; empty if it is.
        warnings: what was asked and could not be done, beside the solution.
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


def kind_of(summary: Summary) -> str:
    """Return what a scene is, as a person says it."""
    scene = summary["scene"]
    if scene["kind"] == "tank":
        return "open water" if scene["tank"]["ends"] == "open" else "closed tank"
    return {"string": "hanging string", "thread": "thread in a stream", "roll": "rolling ship"}[scene["kind"]]


def is_numeric(cells: Iterable[str]) -> bool:
    """Return whether a column holds numbers alone, which stand to the right."""
    return all(_NUMBER.fullmatch(cell) for cell in cells)


def is_warning(line: str) -> bool:
    """Return whether a line warns of the result."""
    return _LOUD.match(line) is not None
