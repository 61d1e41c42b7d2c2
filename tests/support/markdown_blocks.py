"""What the pages of the documentation show: code, commands and output, read by the parser that builds them."""

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from markdown_it import MarkdownIt

ROOT = Path(__file__).parents[2]
PAGES = [
    *(ROOT / name for name in ("README.md", "CONTRIBUTING.md", "results/README.md")),
    *sorted((ROOT / "docs").glob("**/*.md")),
]
_PARSER = MarkdownIt("commonmark").enable("table")


@dataclass(frozen=True)
class Block:
    """A block of a page.

    Attributes:
        page: file name of the page, relative to the checkout.
        line: where it begins, from 1.
        info: what stands behind the opening fence, such as ``toml``; ``indented`` of a block without fences.
        text: its lines.
    """

    page: str
    line: int
    info: str
    text: str

    @property
    def place(self) -> str:
        return f"{self.page}:{self.line}"

    @property
    def language(self) -> str:
        return self.info.split()[0] if self.info else ""


def blocks_of(page: Path) -> list[Block]:
    """All blocks of a page in their order, those in lists too."""
    name = page.relative_to(ROOT).as_posix()
    return [
        Block(name, token.map[0] + 1, token.info.strip() if token.type == "fence" else "indented", token.content)
        for token in _PARSER.parse(page.read_text(encoding="utf-8"))
        if token.type in ("fence", "code_block") and token.map
    ]


def inline_code_of(page: Path) -> Iterator[Block]:
    """All code within the running text and the tables of a page."""
    name = page.relative_to(ROOT).as_posix()
    for token in _PARSER.parse(page.read_text(encoding="utf-8")):
        if token.type == "inline" and token.map:
            for part in token.children or ():
                if part.type == "code_inline":
                    yield Block(name, token.map[0] + 1, "inline", part.content)
