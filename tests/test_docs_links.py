"""Links and names of files lead somewhere: in the documentation, in the README, in the code.

The site is built with dead links as errors too, but without the README.
"""

import re
from functools import cache
from pathlib import Path
from urllib.parse import unquote

import pytest
from markdown_it import MarkdownIt
from markdown_it.token import Token
from scene_reference import anchor

ROOT = Path(__file__).parent.parent
PAGES = sorted([*ROOT.glob("*.md"), *ROOT.glob("docs/**/*.md"), *ROOT.glob("results/*/*.md")])
CODE = sorted(
    file
    for pattern in ("hydro", "Dockerfile", "*.toml", "*.yml", ".ci/run", "launcher/*.sh", "docs/*.py", "results/*.py")
    for file in ROOT.glob(pattern)
) + sorted(
    file
    for folder in ("api", "physics", "meshes", "fem", "modal", "scenes", "benchmarks")
    for file in ROOT.glob(f"{folder}/**/*.py")
)
FOLDERS = "api|physics|meshes|fem|modal|scenes|benchmarks|tests|results|launcher|docs|requirements"
# A file of the checkout, with asterisks for several; what a run writes to results/ is none.
NAMED = re.compile(rf"(?<![\w./-])((?:{FOLDERS})/[\w/*-]+\.(?:py|sh|md|toml|txt)|test_\w+\.py)\b")


@cache
def tokens(page: Path) -> list[Token]:
    """All tokens of a page, with those inside of lines."""
    blocks = MarkdownIt("commonmark").enable("table").parse(page.read_text(encoding="utf-8"))
    return [token for block in blocks for token in (block, *(block.children or ()))]


@cache
def anchors(page: Path) -> set[str]:
    """The anchors of a page's headings, as GitHub makes them."""
    found: list[str] = []
    lines = tokens(page)
    for place, token in enumerate(lines):
        if token.type != "heading_open":
            continue
        inline = lines[place + 1]
        text = "".join(part.content for part in inline.children or () if part.type in ("text", "code_inline"))
        slug = anchor(text)
        found.append(f"{slug}-{found.count(slug)}" if slug in found else slug)
    return set(found)


@pytest.mark.parametrize("page", PAGES, ids=lambda page: str(page.relative_to(ROOT)))
def test_links_lead_somewhere(page: Path) -> None:
    for token in tokens(page):
        target = str(token.attrGet("href") or token.attrGet("src") or "")
        if not target or re.match(r"[a-z]+:", target):
            continue
        path, _, heading = unquote(target).partition("#")
        file = (page.parent / path).resolve() if path else page
        assert file.exists(), target
        assert file.is_relative_to(ROOT), target
        if heading:
            assert heading in anchors(file), target


@pytest.mark.parametrize("file", [*PAGES, *CODE], ids=lambda file: str(file.relative_to(ROOT)))
def test_files_that_are_named_exist(file: Path) -> None:
    for name in NAMED.findall(file.read_text(encoding="utf-8")):
        places = [ROOT / "tests"] if name.startswith("test_") else [ROOT, file.parent]
        assert any(any(place.glob(name)) for place in places), name


@pytest.mark.parametrize("page", sorted(ROOT.glob("docs/**/*.md")), ids=lambda page: str(page.relative_to(ROOT)))
def test_files_that_are_named_without_a_folder_are_in_one_that_the_line_names(page: Path) -> None:
    for line in page.read_text(encoding="utf-8").splitlines():
        quoted = line.split("`")[1::2]
        patterns = [re.sub(r"<\w+>", "*", name) for name in quoted if name.endswith("/")]
        folders = [ROOT / "tests", *(folder for pattern in patterns for folder in ROOT.glob(pattern))]
        for name in quoted:
            if re.fullmatch(r"[\w*]+\.py", name):
                assert any(any(folder.glob(name)) for folder in folders), name


def test_every_page_is_linked_from_the_first_one() -> None:
    index = ROOT / "docs" / "index.md"
    linked = {(index.parent / str(token.attrGet("href") or "")).resolve() for token in tokens(index)}
    pages = {*ROOT.glob("docs/*.md"), *ROOT.glob("docs/*/index.md"), *ROOT.glob("*.md")} - {index}
    assert pages - linked == set()


def test_pages_are_found() -> None:
    assert {"README.md", "index.md", "tank.md", "speed_against_error.md"} <= {page.name for page in PAGES}
    assert len(CODE) > 300
