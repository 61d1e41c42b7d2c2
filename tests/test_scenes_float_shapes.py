"""Sections of floats that can be used, and those that cannot."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from float_scenes import SQUARE, WEDGE, polygon, said, scene

import hydroelastic as he


@pytest.mark.parametrize(
    ("vertices", "words"),
    [
        (((-0.5, -0.5), (0.5, 0.5), (0.5, -0.5), (-0.5, 0.5)), "crosses"),
        ((*SQUARE, SQUARE[0]), "not repeated"),
        (((0.0, 0.0), (0.0, 0.0), (0.0, 0.0)), "too short"),
        (((-0.5, -0.5), (0.5, -0.5), (0.0, -0.5)), "folds back"),
        (((-0.5, -0.5), (0.5, -0.5), (0.5, 0.0), (-0.5, 0.0)), "along the still level"),
        (((-0.5, 0.1), (0.5, 0.1), (0.0, 0.5)), "wholly above the still level"),
        (((-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (0.0, -0.4), (-0.5, 0.5)), "in 4 points instead of two"),
        (((-0.5, -1e-4), (0.5, -1e-4), (0.5, 1e-4), (-0.5, 1e-4)), "too flat"),
    ],
)
def test_sections_that_are_no_hull(vertices: tuple[tuple[float, float], ...], words: str) -> None:
    text = said(polygon(*vertices))
    assert '[[body]] number 1, key "vertices"' in text
    assert words in text


def test_another_cut_is_a_matter_of_the_mass() -> None:
    catamaran = ((-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (0.3, 0.5), (0.3, -0.3), (-0.3, -0.3), (-0.3, 0.5), (-0.5, 0.5))
    area = 1 - 0.6 * 0.8
    for mass, refused in ((0.15 * 1000 + (area - 0.15) * 800, False), (0.3 * 1000 + (area - 0.3) * 800, True)):
        if refused:
            assert '"mass"' in said(polygon(*catamaran, mass=mass))
        else:
            assert scene(polygon(*catamaran, mass=mass))


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"position": 0.5}, 'key "position" = 0.5: the float reaches from 0 to 1 m'),
        ({"position": 0.2}, "touches or leaves a wall"),
        ({"position": 9.5005}, "0.501 to 9.499 m"),
        ({"half_width": 5.0}, "10 m wide, and the tank 10 m long"),
        ({"half_height": 2.0, "half_width": 1.0}, "reaches down to y = -2 m"),
        ({"half_height": 1.0, "half_width": 1.0}, "reaches up to y = 1 m"),
        ({"half_width": 3e-4, "half_height": 3e-4}, "too small beside the tank"),
        (
            {"half_width": 3e-4},
            "too slender for one mesh to resolve both. Allowed: a width of 0.001 to 1000 heights. bound",
        ),
        ({"half_height": 3e-4}, "too flat"),
        ({"at": "surface", "half_height": 1.0}, "reaches down to y = 0 m"),
        ({"centre_of_mass": 1e6}, "-1000 to 1000 m"),
        ({"radius_of_gyration": 1e-20}, "double precision"),
    ],
)
def test_floats_have_room_and_size(change: dict[str, Any], words: str) -> None:
    if change.get("half_height") == 3e-4 and "half_width" not in change:
        change = change | {"half_width": 0.5}
    assert words in said(WEDGE | change)


def test_thin_floats_may_be_as_slender_as_one_likes() -> None:
    assert scene(WEDGE | {"half_width": 1e-8, "boundary": "thin"})
    assert "slender" in said(WEDGE | {"half_width": 1e-10, "boundary": "thin"})


OUTLINE = """kind = "tank"
[tank]
length = 10.0
[[liquid]]
density = 1000.0
depth = 2.0
[[body]]
kind = "float"
shape = "outline"
position = 5.0
file = "points.csv"
"""


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (None, "there is no such file"),
        ("", "holds no points"),
        ("1\n2\n3\n", 'line 1, "1", does not have two columns'),
        ("0,0\n1,nan\n", "not two finite numbers"),
        ("-1,-1\n1,1\n1,-1\n-1,1\n", "crosses"),
        ("-1,-1\n1,-1\n1.3,-0.9\n1.5,-0.6\n1.5,0\n1.5,1\n-1.5,1\n-1.5,0\n-1.5,-0.6\n-1.3,-0.9\n", "times as long as"),
    ],
)
def test_outlines_that_cannot_be_used(tmp_path: Path, text: str | None, words: str) -> None:
    path = tmp_path / "scene.toml"
    path.write_text(OUTLINE, encoding="utf-8")
    if text is not None:
        (tmp_path / "points.csv").write_text(text, encoding="utf-8")
    with pytest.raises(he.SceneError) as caught:
        he.read(path)
    assert '[[body]] number 1, key "file"' in str(caught.value)
    assert words in str(caught.value)


def test_an_outline_lies_beside_its_scene(tmp_path: Path) -> None:
    path = tmp_path / "scene.toml"
    path.write_text(OUTLINE, encoding="utf-8")
    (tmp_path / "points.csv").write_text("-1 -1\n1 -1\n1 1\n-1 1\n", encoding="utf-8")
    given = he.read(path, ["body.1.mass=1000.0"])
    assert given.folder == tmp_path
    # What is stored of the scene holds on any machine.
    assert given.model_dump(mode="json")["body"][0]["file"] == "points.csv"
    assert given.model_copy(update={"title": "Square"}).folder == tmp_path
