"""summary.md shows what a scene is called as it was typed, whatever Markdown makes of such signs elsewhere."""

import re
from html import unescape
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from markdown_it import MarkdownIt

from hydroelastic.output.markdown import markdown_table, markdown_text
from hydroelastic.output.sections import Section, markdown_sections, printed_sections
from hydroelastic.scenes.models.bodies import Beam
from hydroelastic.scenes.models.tank import TankScene
from hydroelastic.scenes.models.tank_parts import Liquid, Tank
from hydroelastic.scenes.run import run_scene

AS_TYPED = [
    "*a* | <b> # [x](y)",
    "# a heading #",
    "1. first",
    "- a list",
    "> quoted",
    "a\\| b \\\\| c",
    "&amp; &lt; &#65;",
    "`code` ``more``",
    "~~struck~~ __bold__ _thin_ snake_case 2*3*4",
    "![picture](file.png) <https://example.org>",
    "$x^2$ and $y$",
    "---",
    "===",
    "+ plus",
    "2) second",
    "ends with a backslash\\",
    "|",
    "[red]not a colour[/red] :smile:",
]


def shown(html: str) -> str:
    """What a reader sees of HTML; any number of blanks is one."""
    return " ".join(unescape(re.sub("<[^>]*>", "", html)).split())


def parser() -> MarkdownIt:
    return MarkdownIt("commonmark").enable(["table", "strikethrough"])


def summary(title: str, reasons: tuple[str, ...] = ()) -> dict[str, Any]:
    scene = {"title": title, "accuracy": {"tolerance": 1e-6}}
    return {"scene": scene, "status": "unconverged" if reasons else "ok", "reasons": reasons}


def reads_as_typed(text: str) -> bool:
    """As a title, a heading, a heading of a column, a cell, a line, a note, a reason and the line of the cost."""
    section = Section(title=text, headings=(text, text), rows=[(text, "1")], lines=(text,), notes=(text,))
    html = parser().render(markdown_sections(summary(text, (text,)), [section], text))
    tags = ("h1", "h2", "th", "th", "td", "li", "li", "p", "p")
    found = [shown(part) for tag in dict.fromkeys(tags) for part in re.findall(f"(?s)<{tag}>(.*?)</{tag}>", html)]
    plain = " ".join(text.split())
    only = set(re.findall("<([a-z0-9]+)", html)) <= {*tags, "strong", "table", "thead", "tbody", "tr", "ul"}
    return only and found == [plain] * 5 + ["1"] + [plain] * 2 + ["NOT CONVERGED to the tolerance 1e-06:"] + [plain] * 2


@pytest.mark.parametrize("text", AS_TYPED)
def test_what_markdown_would_take_for_its_own_reads_as_typed(text: str) -> None:
    assert reads_as_typed(text)


@settings(derandomize=True, deadline=None, max_examples=100)
@given(
    st.one_of(st.text(alphabet="ab1 *_`~|<>[]()#&;+-.=!$\\\"'/:", min_size=1), st.text(min_size=1)).filter(
        lambda text: text.isprintable() and bool(text.strip())
    )
)
def test_any_text_reads_as_typed(text: str) -> None:
    assert reads_as_typed(text)


def test_names_within_words_stay_readable_in_the_file_itself() -> None:
    assert markdown_text("grammel_1 at 0.75 < Re ω < 3.1, EI/(ρ g l⁴), -1.4 %") == (
        "grammel_1 at 0.75 < Re ω < 3.1, EI/(ρ g l⁴), -1.4 %"
    )


def test_a_table_takes_links_where_they_are_meant() -> None:
    html = parser().render(markdown_table(("scene",), [("[a](b.md)",)]))
    assert '<a href="b.md">a</a>' in html


def test_brackets_and_colons_of_a_title_reach_the_terminal_as_they_are() -> None:
    title = "[red]not a colour[/red] :smile:"
    section = Section(title=title, headings=("name",), rows=[(title,)], lines=(title,))
    assert printed_sections(summary(title), [section], title).count(title) == 5


def test_a_run_writes_and_draws_any_title(tmp_path: Any) -> None:
    """Signs of Markdown, of HTML and of formulas, from the scene to the last file."""
    title = r"*a* | <b> # [x](y) $\\frac{1}$ and $2"
    beam = Beam(start=3.0, length=4.0, flexural_rigidity=5e3, mass_per_length=50.0)
    scene = TankScene(title=title, tank=Tank(length=10.0), liquid=(Liquid(density=1e3, depth=5.0),), body=(beam,))
    scene = scene.model_copy(update={"accuracy": scene.accuracy.model_copy(update={"tolerance": 1e-2, "modes": 1})})
    run_scene(scene, out=tmp_path / "result")
    html = parser().render((tmp_path / "result" / "summary.md").read_text(encoding="utf-8"))
    assert shown(re.findall("<h1>(.*)</h1>", html)[0]) == title
