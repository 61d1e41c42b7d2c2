"""Options of pictures: one clear message for each mistake, and a warning where one has no effect."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner, Result
from PIL import Image

from hydroelastic.output.pictures.options import DEFAULT_PICTURES, OF_CURVES, OF_FIELDS, PictureOptions
from hydroelastic.scenes.command_line import main
from hydroelastic.scenes.read import read_scene
from hydroelastic.scenes.run import run_scene
from hydroelastic.scenes.study import report as study_report
from hydroelastic.scenes.study import run as study_run


def invoke(*arguments: str) -> Result:
    return CliRunner().invoke(main, arguments)


@pytest.mark.parametrize(
    ("name", "value", "allowed"),
    [
        ("formats", (), "png, svg, pdf"),
        ("formats", ("png", "gif"), "png, svg, pdf"),
        ("dpi", 49, "50 to 1200"),
        ("dpi", 1201, "50 to 1200"),
        ("scale", 0.79, "0.8 to 4"),
        ("scale", float("nan"), "0.8 to 4"),
        ("width", 399, "400 to 8000"),
        ("width", 8001, "400 to 8000"),
    ],
)
def test_what_cannot_be_drawn_is_refused_by_name(name: str, value: Any, allowed: str) -> None:
    with pytest.raises(ValueError, match=f"^{name} = .*{allowed}$"):
        PictureOptions(**{name: value})


def test_limits_are_allowed() -> None:
    assert PictureOptions(dpi=50, scale=0.8, width=400).dpi == 50
    assert PictureOptions(dpi=1200, scale=4.0, width=8000).scale == 4.0


def test_only_changes_in_vain_are_told() -> None:
    changed = PictureOptions(formats=("svg",), dpi=200, scale=2.0, width=800, animate=True)
    assert DEFAULT_PICTURES.without_effect(frozenset()) == ()
    assert changed.without_effect(OF_CURVES | OF_FIELDS | {"animate"}) == ()
    (width, animation) = changed.without_effect(OF_CURVES)
    assert width.startswith("a width")
    assert animation.startswith("an animation")
    assert len(changed.without_effect(OF_FIELDS | {"animate"})) == len(OF_CURVES)


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("--image-format", "gif"), ("--image-format", "gif", "'png', 'svg', 'pdf'")),
        (("--dpi", "20"), ("--dpi", "20", "50<=x<=1200")),
        (("--dpi", "many"), ("--dpi", "many", "integer")),
        (("--image-scale", "5"), ("--image-scale", "5", "0.8<=x<=4.0")),
        (("--image-width", "100"), ("--image-width", "100", "400<=x<=8000")),
        (("--no-images", "--dpi", "200"), ("--no-images", "leave out one or the other")),
        (("--no-images", "--animate"), ("--no-images", "leave out one or the other")),
    ],
)
def test_the_command_refuses_before_it_solves(
    tmp_path: Path, arguments: tuple[str, ...], words: tuple[str, ...]
) -> None:
    result = invoke("run", "swell", "--out", str(tmp_path / "out"), *arguments)
    assert result.exit_code == 2
    assert all(word in result.stderr for word in words), result.stderr
    assert not (tmp_path / "out").exists()


def test_the_command_draws_as_it_is_told(tmp_path: Path) -> None:
    options = ("--image-format", "svg", "--image-format", "png", "--dpi", "60", "--image-scale", "0.8")
    result = invoke("run", "swell", "--quiet", "--out", str(tmp_path / "out"), *options)
    assert (result.exit_code, result.output) == (0, "")
    images = tmp_path / "out" / "images"
    assert sorted(path.name for path in images.iterdir()) == ["roll.png", "roll.svg"]
    with Image.open(images / "roll.png") as picture:
        # 11 by 8 inches.
        assert picture.size == (round(11 * 0.8 * 60), round(8 * 0.8 * 60))


def test_options_without_effect_are_said_and_the_run_goes_on(tmp_path: Path) -> None:
    result = invoke("run", "swell", "--quiet", "--out", str(tmp_path / "out"), "--image-width", "800", "--animate")
    assert result.exit_code == 0
    assert result.stderr.splitlines() == [
        "Warning: a width of rendered pictures has no effect: this scene has none, only curves, which dpi and "
        "scale (--dpi, --image-scale) size",
        "Warning: an animation has no effect: nothing of this scene can be animated",
    ]
    assert (tmp_path / "out" / "images" / "roll.png").is_file()


def test_a_tank_has_no_curves_but_heeds_the_width(tmp_path: Path) -> None:
    scene = read_scene("sloshing", ("accuracy.modes=1", "accuracy.tolerance=1e-3"))
    outcome = run_scene(scene, out=tmp_path / "out", images=PictureOptions(width=500, dpi=200))
    if not (tmp_path / "out" / "images").exists():
        pytest.skip("nothing renders here")
    assert outcome.warnings == (
        "a resolution of curves has no effect: this scene has only rendered pictures, which are PNG files as wide as "
        "width (--image-width) says",
    )
    for name in ("mode_001", "overview"):
        with Image.open(tmp_path / "out" / "images" / f"{name}.png") as picture:
            assert picture.width == 500


def test_a_tank_says_which_option_it_has(tmp_path: Path) -> None:
    given = ("--set", "accuracy.modes=1", "--set", "accuracy.tolerance=1e-3", "--image-format", "svg", "--dpi", "60")
    result = invoke("run", "sloshing", "--quiet", "--out", str(tmp_path / "out"), *given)
    assert result.exit_code == 0
    complaints = [line for line in result.stderr.splitlines() if "of curves has no effect" in line]
    assert len(complaints) == 2
    assert all("--image-width" in line for line in complaints)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "change", "words"),
    [
        ("catenary", "analysis=[]", 'kind = "modes" or "motion"'),
        ("string_ramp", "output.times=[0.0]", '[output] key "times" times after 0'),
        (
            "released_chain",
            'analysis=[{kind = "motion", times = [0.0, 0.5], tolerance = 1e-2, release = [{end = "b", time = 0.25}]}]',
            'the animation of motion 1 has 2 pages only, one for each of its times: give the [[analysis]] key "times"',
        ),
    ],
)
def test_what_an_animation_lacks_is_said(tmp_path: Path, name: str, change: str, words: str) -> None:
    scene = read_scene(name, ("output.frames=0", change) if name != "catenary" else (change,))
    outcome = run_scene(scene, out=tmp_path / "out", images=PictureOptions(animate=True))
    assert len(outcome.warnings) == 1
    assert words in outcome.warnings[0]
    assert not run_scene(scene, out=tmp_path / "still", images=DEFAULT_PICTURES).warnings


@pytest.mark.slow
@pytest.mark.parametrize("times", ["[2.0]", "[0.0, 1.0, 2.0]"])
def test_a_string_at_few_times_is_animated_smoothly(tmp_path: Path, times: str) -> None:
    scene = read_scene("string_sine", (f"output.times={times}", "output.frames=0"))
    outcome = run_scene(scene, out=tmp_path / "out", images=PictureOptions(animate=True, dpi=50))
    assert outcome.warnings == ()
    with Image.open(tmp_path / "out" / "images" / "motion.gif") as film:
        assert film.n_frames == 60


def test_a_study_takes_formats_and_resolution(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    asked: list[PictureOptions] = []
    monkeypatch.setattr(study_run, "study_scene", lambda *_things, **_settings: None)
    for made in ("study_table", "study_csv"):
        monkeypatch.setattr(study_report, made, lambda _study: "")
    monkeypatch.setattr(
        study_report, "write_study", lambda _study, _folder, options, **_settings: asked.append(options)
    )
    out = ("--out", str(tmp_path / "out"))
    assert invoke("study", "aquarium", *out, "--image-format", "pdf", "--dpi", "300").exit_code == 0
    assert invoke("study", "aquarium", *out).exit_code == 0
    assert asked == [PictureOptions(formats=("pdf",), dpi=300), DEFAULT_PICTURES]
    refused = invoke("study", "aquarium", *out, "--dpi", "1")
    assert refused.exit_code == 2
    assert "--dpi" in refused.stderr


def test_without_images_or_a_folder_nothing_is_said(tmp_path: Path) -> None:
    scene = read_scene("swell")
    assert run_scene(scene, images=PictureOptions(width=500)).warnings == ()
    assert run_scene(scene, out=tmp_path / "out", images=None).warnings == ()
    assert not (tmp_path / "out" / "images").exists()
