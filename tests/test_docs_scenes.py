"""The scenes that the documentation shows can be read, and shipped scenes of strings and ships are all in its list."""

import re
from pathlib import Path

import pytest

import hydroelastic as he

DOCS = Path(__file__).parent.parent / "docs"
PAGE = (DOCS / "scenes_strings_and_ships.md").read_text(encoding="utf-8")
# What is said of a section in place of a period has tests of its own; its field solution takes a while.
SCENES = [
    block
    for block in re.findall(r"```toml\n(.*?)```", PAGE, re.DOTALL)
    if block.startswith("kind") and "section =" not in block
]


@pytest.mark.slow_but("roll")
@pytest.mark.parametrize("text", SCENES, ids=lambda text: text.split('"')[1])
def test_examples_run(text: str, tmp_path: Path) -> None:
    file = tmp_path / "example.toml"
    file.write_text(text, encoding="utf-8")
    # Coarser than the page asks, to be quick.
    assert he.solve(he.read(file, ["accuracy.tolerance=1e-3"])).summary["status"] == "ok"


def test_there_is_an_example_of_each_kind() -> None:
    assert [text.split('"')[1] for text in SCENES] == ["string", "roll"]


def test_all_shipped_scenes_of_these_kinds_are_listed() -> None:
    names = [scene.name for scene in he.shipped_scenes() if he.read(scene.name).kind in ("string", "roll")]
    assert all(f"`{name}`" in PAGE for name in names)
