"""Pictures: they are there, of the size that was asked for, something is drawn; options are refused or said in vain."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from command import run_command
from PIL import Image

import hydroelastic as he
from hydroelastic.output import plots

FEW = {"accuracy.modes": 2, "accuracy.tolerance": 1e-3}
CHAIN = [{"kind": "motion", "times": [0.0, 0.5, 1.0], "tolerance": 1e-2, "release": [{"end": "b", "time": 0.25}]}]
WAVES = {"analysis": [{"kind": "response", "omega": [2.5, 3.0]}], "accuracy.tolerance": 1e-2}
# Scenes of each kind, and the pictures that a person looks for first.
SCENES: dict[str, tuple[str, dict[str, Any], set[str]]] = {
    "tank": ("aquarium", FEW, {"mode_001", "mode_002", "overview"}),
    "lid": ("aquarium", FEW | {"tank.top": "rigid"}, {"mode_001", "overview"}),
    "two liquids": ("float_in_two_liquids", FEW, {"mode_001", "overview"}),
    "thin layers": ("sloshing", FEW | {"liquid.1.depth": 0.05}, {"mode_001", "overview"}),
    "plan": ("cross_waves", FEW | {"accuracy.tolerance": 1e-2}, {"mode_001", "mode_002"}),
    "open water": ("open_plate", WAVES, {"response_1"}),
    "string": ("string_ramp", {"output.frames": 0}, {"space_time", "shapes", "modes"}),
    "thread": ("catenary", {"analysis": [{"kind": "modes", "count": 2}]}, {"equilibrium", "tension", "modes"}),
    "chain": ("released_chain", {"analysis": CHAIN}, {"motion", "tension_in_time"}),
    "roll": ("swell", {}, {"roll"}),
}


def pixels(file: Path) -> np.ndarray:
    with Image.open(file) as picture:
        return np.asarray(picture.convert("RGB"), dtype=float)


@pytest.mark.slow_but("tank", "string")
@pytest.mark.parametrize("kind", SCENES)
def test_pictures_of_each_kind_are_drawn(kind: str, tmp_path: Path) -> None:
    name, changes, expected = SCENES[kind]
    he.solve(he.read(name, changes)).save(tmp_path / "out", images=he.PictureOptions(width=500, dpi=60))
    files = {file.stem: file for file in (tmp_path / "out" / "images").glob("*.png")}
    assert expected <= files.keys()
    for file in files.values():
        drawn = pixels(file)
        assert min(drawn.shape[:2]) >= 100
        # Neither one colour nor a blank page: lines, letters and fields are darker or coloured.
        assert (drawn != drawn[0, 0]).any(axis=-1).mean() > 0.01, file.name


MOVING = {
    "sloshing": FEW | {"accuracy.modes": 1},
    "string_sine": {"output.times": [2.0], "output.frames": 0},
    "released_chain": {"output.frames": 0},
}


@pytest.mark.slow_but("sloshing")
@pytest.mark.parametrize("name", MOVING)
def test_what_moves_is_animated_when_asked(name: str, tmp_path: Path) -> None:
    pictures = he.PictureOptions(width=500, animate=True, dpi=50)
    he.solve(he.read(name, MOVING[name])).save(tmp_path / "out", images=pictures)
    with Image.open(next((tmp_path / "out" / "images").glob("*.gif"))) as film:
        assert film.n_frames >= 20
        pages = []
        for number in (0, film.n_frames // 2):
            film.seek(number)
            pages.append(np.asarray(film.convert("RGB"), dtype=float))
    assert (pages[0] != pages[1]).any(axis=-1).mean() > 1e-3


def test_the_command_draws_as_it_is_told(tmp_path: Path) -> None:
    options = ("--image-format", "svg", "--image-format", "png", "--dpi", "60", "--image-scale", "0.8")
    result = run_command("run", "swell", "--quiet", "--out", str(tmp_path / "out"), *options)
    assert (result.exit_code, result.output) == (0, "")
    images = tmp_path / "out" / "images"
    assert sorted(path.name for path in images.iterdir()) == ["roll.png", "roll.svg"]
    assert (images / "roll.svg").read_text(encoding="utf-8").count("<path") > 10
    # 11 by 8 inches.
    assert pixels(images / "roll.png").shape[:2] == (round(8 * 0.8 * 60), round(11 * 0.8 * 60))


def test_fields_are_drawn_in_each_format_and_at_their_places(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """The axes of a mode hold the field's extent and the largest drawn displacement, 0.16 of the depth."""
    figures: dict[str, Any] = {}
    save = plots.Sheets.save

    def saved(sheets: plots.Sheets, figure: Any, name: str, *image: Any) -> None:
        axes = figure.axes[0]
        figures[name] = axes.get_ylim(), [line.get_ydata() for line in axes.lines], axes.get_xlim()
        save(sheets, figure, name, *image)

    monkeypatch.setattr(plots.Sheets, "save", saved)
    pictures = he.PictureOptions(width=500, formats=("png", "svg", "pdf"))
    he.solve(he.read("sloshing", {"accuracy.modes": 1})).save(tmp_path / "out", images=pictures)
    images = tmp_path / "out" / "images"
    names = {f"{name}.{kind}" for name in ("mode_001", "overview") for kind in pictures.formats}
    assert {file.name for file in images.iterdir()} == names
    assert pixels(images / "mode_001.png").shape[1] == 500
    assert "Mode 1: ω = " in (images / "mode_001.svg").read_text(encoding="utf-8")
    heights, lines, limits = figures["mode_001"]
    scene = he.read("sloshing").model_dump()["tank"]
    depth = he.read("sloshing").model_dump()["liquid"][0]["depth"]
    assert heights[0] == pytest.approx(-depth)
    assert limits == pytest.approx((0.0, scene["length"]))
    largest = max(np.abs(y).max() for y in lines if len(y) > 5)
    assert largest == pytest.approx(min(0.1 * scene["length"], 0.16 * depth))


def test_without_a_renderer_fields_are_left_out_with_a_warning(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("VTK_DEFAULT_OPENGL_WINDOW", "vtkOSOpenGLRenderWindow")
    monkeypatch.setattr(plots, "_has_mesa", lambda: False)
    result = run_command("run", "sloshing", "--set", "accuracy.modes=1", "--quiet", "--out", str(tmp_path / "out"))
    assert result.exit_code == 0
    assert result.stderr.startswith("Warning: no images of fields: pictures need a library that renders")
    assert len(result.stderr.splitlines()) == 1
    assert not (tmp_path / "out" / "images").exists()


@pytest.mark.slow
def test_the_same_picture_is_the_same_file(tmp_path: Path) -> None:
    found = []
    for name in ("one", "other"):
        he.solve("swell").save(tmp_path / name)
        found.append((tmp_path / name / "images" / "roll.png").read_bytes())
    assert found[0] == found[1]


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("--image-format", "gif"), ("--image-format", "gif", "'png', 'svg', 'pdf'")),
        (("--dpi", "20"), ("--dpi", "20", "50<=x<=1200")),
        (("--image-scale", "5"), ("--image-scale", "5", "0.8<=x<=4.0")),
        (("--image-width", "100"), ("--image-width", "100", "400<=x<=8000")),
        (("--no-images", "--animate"), ("--no-images", "leave out one or the other")),
    ],
)
def test_the_command_refuses_before_it_solves(
    tmp_path: Path, arguments: tuple[str, ...], words: tuple[str, ...]
) -> None:
    result = run_command("run", "swell", "--out", str(tmp_path / "out"), *arguments)
    assert result.exit_code == 2
    assert all(word in result.stderr for word in words), result.stderr
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize(
    ("name", "value", "allowed"),
    [("formats", ("gif",), "png, svg, pdf"), ("dpi", 1201, "50 to 1200"), ("scale", float("nan"), "0.8 to 4")],
)
def test_what_cannot_be_drawn_is_refused_by_name(name: str, value: Any, allowed: str) -> None:
    with pytest.raises(ValueError, match=f"^{name} = .*{allowed}$"):
        he.PictureOptions(**{name: value})


def test_options_without_effect_are_said_and_the_run_goes_on(tmp_path: Path) -> None:
    given = ("--image-width", "800", "--animate")
    result = run_command("run", "swell", "--quiet", "--out", str(tmp_path / "out"), *given)
    assert result.exit_code == 0
    width, animation = result.stderr.splitlines()
    assert width.startswith("Warning: a width")
    assert animation.startswith("Warning: an animation")
    assert (tmp_path / "out" / "images" / "roll.png").is_file()
