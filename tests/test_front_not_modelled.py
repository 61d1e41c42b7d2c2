"""What is not modelled in the open sea is said where it is asked for."""

from pathlib import Path

import pytest

import hydroelastic as he

SEA = 'kind = "sea"\n[[liquid]]\ndensity = 1025.0\ndepth = 20.0\n'
OPEN = 'kind = "tank"\n[tank]\nlength = 10.0\nends = "open"\n[[liquid]]\ndensity = 1025.0\ndepth = 20.0\n'
BOX = '[[body]]\nkind = "float"\nshape = "box"\nsize = [4.0, 2.0]\ndraught = 1.0\n'
HULL = '[[body]]\nkind = "float"\nshape = "hull"\nfile = "scow.stl"\n'
BUOY = '[[body]]\nkind = "float"\nshape = "cylinder"\nradius = 1.0\ndraught = 1.0\n'
RESPONSE = '[[analysis]]\nkind = "response"\nomega = [1.0]\n'
NO_HULLS = "hulls of other shapes are not modelled there, only in tanks of three dimensions"
NO_HEADINGS = "other headings are not modelled"
CASES = {
    "box": (SEA + BOX, 'key "shape" = "box"', NO_HULLS),
    "hull": (SEA + HULL, 'key "shape" = "hull"', NO_HULLS),
    "hull in a tank with open ends": (OPEN + HULL, 'key "shape" = "hull"', NO_HULLS),
    "heading of waves": (SEA + BUOY + RESPONSE + "heading = 45.0\n", 'key "heading" = 45.0', NO_HEADINGS),
    "direction of waves": (SEA + BUOY + RESPONSE + "wave_direction = 0.5\n", 'key "wave_direction"', NO_HEADINGS),
    "heading of the sea": (SEA + BUOY + "[sea]\nheading = 45.0\n", 'key "heading" = 45.0', NO_HEADINGS),
    "heading of a body": (SEA + BUOY + "heading = 45.0\n", 'key "heading" = 45.0', NO_HEADINGS),
}


@pytest.mark.parametrize(("text", "key", "words"), CASES.values(), ids=list(CASES))
def test_hulls_and_headings_in_the_open_sea_are_refused_with_the_reason(
    text: str, key: str, words: str, tmp_path: Path
) -> None:
    (tmp_path / "scene.toml").write_text(text, encoding="utf-8")
    with pytest.raises(he.SceneError) as error:
        he.read(tmp_path / "scene.toml")
    assert key in str(error.value)
    assert words in str(error.value)


@pytest.mark.parametrize("page", ["README.md", "docs/howto_buoy_in_waves.md", "docs/howto_section_in_waves.md"])
def test_pages_say_what_is_not_modelled(page: str) -> None:
    text = (Path(__file__).parents[1] / page).read_text(encoding="utf-8")
    sentences = [line for line in text.split(".") if "not modelled" in line.lower()]
    assert any("hull" in line and ("heading" in line or "waves" in line) for line in sentences)
