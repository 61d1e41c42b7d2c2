"""Pictures of reports: their captions, their order, and what has no room."""

import base64
import io
from pathlib import Path

import numpy as np
from PIL import Image
from reports import parsed, shown

from hydroelastic.scenes.report import write
from hydroelastic.scenes.report.captions import place_and_caption
from hydroelastic.scenes.report.page import Part
from hydroelastic.scenes.report.pictures import pictures_of

MODES = {
    "scene": {"kind": "tank"},
    "modes": [{"omega": 1.23456, "relative_error": 1e-3, "kind": "sloshing", "symmetry": "symmetric"}] * 12,
}


def test_captions_say_what_a_picture_shows() -> None:
    assert place_and_caption("mode_002", MODES)[1] == "Mode 2: ω = 1.235 rad/s, sloshing, symmetric"
    assert place_and_caption("deflection_1_body_2", {})[1] == "Deflection along the body in waves (analysis 1, body 2)"
    assert place_and_caption("waves_radiation_1_heave", {})[1] == "The waves that a motion makes (analysis 1, heave)"
    assert place_and_caption("oscillation_003_2", {})[1] == "Free motion 3 over a period (analysis 2)"
    assert place_and_caption("waves_resonance_1_003", {})[1] == "The field of a resonance (analysis 1, resonance 3)"
    assert place_and_caption("tension_in_time", {})[1] == "Tensions over time"
    assert place_and_caption("another_picture", {})[1] == "Another picture"
    stems = ["mode_010", "unheard_of", "mode_002", "overview"]
    assert sorted(stems, key=lambda stem: place_and_caption(stem, MODES)[0]) == [
        "overview",
        "mode_002",
        "mode_010",
        "unheard_of",
    ]


def noise(file: Path, width: int, height: int) -> None:
    Image.fromarray(np.random.default_rng(1).integers(0, 255, (height, width, 3), np.uint8)).save(file)


def test_pictures_are_made_small(tmp_path: Path) -> None:
    noise(tmp_path / "equilibrium.png", 2400, 240)
    (picture,), left_out = pictures_of(tmp_path, {})
    image = Image.open(io.BytesIO(base64.b64decode(picture.source.partition(",")[2])))
    assert picture.source.startswith("data:image/webp;base64,")
    assert image.size == (picture.width, picture.height) == (1600, 160)
    assert not left_out


def test_what_a_page_cannot_show_is_named(tmp_path: Path) -> None:
    (tmp_path / "roll.pdf").write_bytes(b"%PDF")
    (tmp_path / "modes.pdf").write_bytes(b"%PDF")
    noise(tmp_path / "modes.png", 40, 20)
    shown, left_out = pictures_of(tmp_path, {})
    assert len(shown) == 1
    assert left_out == ("roll.pdf",)


def test_a_very_high_picture_fits(tmp_path: Path) -> None:
    """WebP ends at 16383 pixels."""
    Image.new("RGB", (160, 17_000), "white").save(tmp_path / "overview.png")
    ((picture,), _) = pictures_of(tmp_path, {})
    assert (picture.width, picture.height) == (75, 8000)


def test_drawings_are_taken_before_pixels(tmp_path: Path) -> None:
    noise(tmp_path / "roll.png", 40, 20)
    (tmp_path / "roll.svg").write_text("<svg/>", encoding="utf-8")
    (tmp_path / "roll.pdf").write_bytes(b"%PDF")
    (picture,), _ = pictures_of(tmp_path, {})
    assert picture.source == "data:image/svg+xml;base64," + base64.b64encode(b"<svg/>").decode()
    # One of very many points is a burden to a browser: its pixels stand in.
    (tmp_path / "roll.svg").write_bytes(b" " * 500_000)
    (picture,), _ = pictures_of(tmp_path, {})
    assert picture.source.startswith("data:image/png")


def test_pictures_that_have_no_room_are_named(tmp_path: Path) -> None:
    for number in range(1, 13):
        (tmp_path / f"mode_{number:03d}.gif").write_bytes(b" " * 300_000)
    pictures, left_out = pictures_of(tmp_path, MODES)
    # 3 MB of them.
    assert len(pictures) == 10
    assert left_out == ("mode_011.gif", "mode_012.gif")


def test_what_moves_comes_last_and_when_asked_for(tmp_path: Path) -> None:
    for name in ("mode_001.gif", "mode_001.png", "mode_002.png"):
        noise(tmp_path / name, 40, 20)
    pictures, _ = pictures_of(tmp_path, MODES)
    assert [picture.moving for picture in pictures] == [False, False, True]
    html = write.rendered("page.html.jinja", page=shown(parts=(Part(anchor="p", title="P", pictures=pictures),)))
    tags = [tag for tag, _ in parsed(html).tags if tag in ("figure", "details", "img")]
    assert tags == ["figure", "img", "figure", "img", "details", "img"]


def test_a_folder_without_images_has_no_pictures(tmp_path: Path) -> None:
    assert pictures_of(tmp_path / "images", {}) == ((), ())
