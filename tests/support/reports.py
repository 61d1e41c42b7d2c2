"""Scenes of every kind that are solved in a moment, and what an HTML page holds."""

from __future__ import annotations

from dataclasses import dataclass, field
from html.parser import HTMLParser

SCENES: dict[str, tuple[str, tuple[str, ...]]] = {
    "tank": ("aquarium", ("accuracy.modes=3", "accuracy.tolerance=1e-4")),
    "float": ("float_wedge", ("accuracy.modes=3", "accuracy.tolerance=1e-3")),
    "open": ("open_plate", ("analysis.1.omega=[3.0, 4.0]", "accuracy.tolerance=1e-2")),
    "sea": ("hemisphere", ('analysis=[{kind="radiation", omega=[1.0]}]', "accuracy.tolerance=1e-2")),
    "plates": ("cross_waves", ("accuracy.modes=2", "accuracy.tolerance=1e-2")),
    "round tank": ("spherical_tank", ("accuracy.modes=2", "accuracy.tolerance=1e-2")),
    "canal": ("ship_tank", ("accuracy.modes=2", "accuracy.tolerance=1e-2")),
    "string": ("string_ramp", ("output.frames=0",)),
    "thread": ("catenary", ()),
    "roll": ("swell", ()),
}
"""By kind: the shipped scene, and what is changed in it."""

_WITHOUT_END = {"meta", "link", "img", "br"}


@dataclass
class Page(HTMLParser):
    """A parsed page; an element that is not closed in order fails.

    Attributes:
        tags: every start tag with its attributes.
        text: all that a person reads, titles of the head included.
        headings: level and text of each heading.
        open: elements that are open.
    """

    tags: list[tuple[str, dict[str, str | None]]] = field(default_factory=list)
    text: str = ""
    headings: list[tuple[int, str]] = field(default_factory=list)
    open: list[str] = field(default_factory=list)

    def __post_init__(self) -> None:
        super().__init__()

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.append((tag, dict(attrs)))
        if tag not in _WITHOUT_END:
            self.open.append(tag)
        if tag in ("h1", "h2", "h3"):
            self.headings.append((int(tag[1]), ""))

    def handle_endtag(self, tag: str) -> None:
        assert self.open, tag
        assert self.open.pop() == tag

    def handle_data(self, data: str) -> None:
        if self.open and self.open[-1] == "style":
            return
        self.text += data
        if self.open and self.open[-1] in ("h1", "h2", "h3"):
            level, before = self.headings[-1]
            self.headings[-1] = level, before + data


def parsed(html: str) -> Page:
    """Return a page whose elements are all closed in order."""
    page = Page()
    page.feed(html)
    page.close()
    assert not page.open
    return page
