"""Scenes from files: overrides, shipped scenes, and messages that say what to do."""

from pathlib import Path

import pytest
from scene_files import BEAM_IN_TANK

from hydroelastic.scenes.errors import SceneError
from hydroelastic.scenes.read import read_scene, scene_path, shipped_scenes


@pytest.fixture
def good(tmp_path: Path) -> Path:
    path = tmp_path / "good.toml"
    path.write_text(BEAM_IN_TANK, encoding="utf-8")
    return path


def message(path: Path | str, *overrides: str) -> str:
    with pytest.raises(SceneError) as caught:
        read_scene(path, overrides)
    return str(caught.value)


def test_overrides_replace_and_add_values(good: Path) -> None:
    changes = [
        "body.1.start=2.5",
        "accuracy.tolerance=1e-8",
        "tank.top=rigid",
        'title="Two words"',
        "accuracy.modes = 3",
    ]
    given = read_scene(good, changes)
    assert (given.body[0].start, given.accuracy.tolerance, given.accuracy.modes) == (2.5, 1e-8, 3)
    assert (given.tank.top, given.title) == ("rigid", "Two words")
    assert read_scene(good, ["title=Two words"]).title == "Two words"
    assert read_scene(good, ["body=[]"]).body == ()


@pytest.mark.parametrize(
    ("override", "said"),
    [
        ("body.2.start=2", "Allowed: 1. Entries are numbered from 1."),
        ("body.0.start=2", "Allowed: 1. Entries are numbered from 1: write body.1.start for the first."),
        ("liquid.density=900", "Entries are numbered from 1: write liquid.1.density for the first."),
        ("tank.length=12mm", "Write a number without a unit; the unit is m."),
        ("tank.length=12,5", "Write a decimal point, not a comma: 12.5."),
        ("accuracy.modes=5,0", "Write a decimal point, not a comma: 5.0."),
        ("body.x.start=2", "not an entry"),
        ("body.-1.start=2", "not an entry"),
        ("body.1.start.deep=2", "table, which is not there"),
        ("float.0.start=2", "list, which is not there"),
        ("tank.length", "key=value"),
        ("=3", "key=value"),
        ("tank..length=3", "key=value"),
        ("tank.length=", "not TOML"),
        ("tank.length=[1", "not TOML"),
        ('title="', "not TOML"),
        ("tank.length=3\nkind=4", "not TOML"),
        ("tank.length=abc", "not a number"),
        ("tank.lenght=3", 'Did you mean "length"?'),
        ("acuracy.modes=3", 'Did you mean "accuracy"?'),
        ("tank.top=fre", 'Did you mean "free"?'),
        ("tank.length=" + "[" * 3000, "not TOML"),
    ],
)
def test_overrides_that_cannot_be_used(good: Path, override: str, said: str) -> None:
    assert said in message(good, override)


def test_a_misspelt_key_is_one_problem_and_names_the_way(tmp_path: Path) -> None:
    path = tmp_path / "scene.toml"
    path.write_text(BEAM_IN_TANK.replace("start =", "strat ="), encoding="utf-8")
    said = message(path)
    assert said.startswith(f'{path}: [[body]] number 1, key "strat" = 3.0: ')
    assert 'Did you mean "start"?' in said
    assert "\n" not in said


def test_all_problems_are_listed_up_to_ten(tmp_path: Path) -> None:
    path = tmp_path / "scene.toml"
    path.write_text(BEAM_IN_TANK + "[[body]]\n" * 4, encoding="utf-8")
    lines = message(path).splitlines()
    assert "16 problems" in lines[0]
    assert len(lines) == 12
    assert lines[-1].strip() == "… and 6 more"


def test_control_characters_of_a_file_do_not_reach_the_terminal(tmp_path: Path) -> None:
    path = tmp_path / "scene.toml"
    path.write_text(BEAM_IN_TANK + 'kind = "\\u001b[31mred"\n"\\u001b[32m" = 1\n', encoding="utf-8")
    assert "\x1b" not in message(path)


def test_a_byte_order_mark_is_ignored(tmp_path: Path) -> None:
    path = tmp_path / "scene.toml"
    path.write_text(BEAM_IN_TANK, encoding="utf-8-sig")
    assert read_scene(path).tank.length == 10


def test_the_kind_comes_first(tmp_path: Path) -> None:
    path = tmp_path / "scene.toml"
    path.write_text('kind = "drum"\n[drum]\nlength = 1.0\n', encoding="utf-8")
    assert 'key "kind" = "drum"' in message(path)
    assert 'Allowed: "tank"' in message(path)
    path.write_text(BEAM_IN_TANK.replace("kind", "knd"), encoding="utf-8")
    kinds = 'kind = "tank" or kind = "sea" or kind = "string" or kind = "thread" or kind = "roll"'
    assert f'key "kind": it is missing. Allowed: {kinds}. Instead there is "knd".' in message(path)


def test_a_mesh_lies_beside_its_scene(good: Path) -> None:
    assert "there is no file" in message(good, "mesh.file=tank.msh")
    assert "known mesh format" in message(good, "mesh.file=tank.stl")
    (good.parent / "tank.msh").touch()
    given = read_scene(good, ["mesh.file=tank.msh"])
    assert given.mesh is not None
    assert given.mesh.file == good.parent / "tank.msh"


def test_whole_numbers_of_thousands_of_digits_are_refused_in_words(tmp_path: Path) -> None:
    path = tmp_path / "scene.toml"
    path.write_text(BEAM_IN_TANK.replace("= 10.0\n", "= " + "9" * 5000 + "\n"), encoding="utf-8")
    assert "it is not TOML" in message(path)
    path.write_text(BEAM_IN_TANK.replace("= 10.0\n", "= 0x" + "f" * 5000 + "\n"), encoding="utf-8")
    assert "too large" in message(path)
    assert len(message(path)) < 400


def test_a_file_comes_before_the_shipped_scene_of_its_name(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "sloshing").mkdir()
    assert scene_path("sloshing").name == "sloshing.toml"
    Path("aquarium").write_text(BEAM_IN_TANK, encoding="utf-8")
    assert scene_path("aquarium") == Path("aquarium")


# Inputs of the reference table that the scenes stand for (reference/aquarium.json): start, length, EI, m, hydrostatic.
SHIPPED = {
    "aquarium": (3.0, 4.0, 5e3, 50.0, False),
    "aquarium_hydrostatic": (3.0, 4.0, 5e3, 50.0, True),
    "beam_at_the_wall": (0.0, 4.0, 5e3, 50.0, False),
    "nearly_covered": (0.5, 9.0, 5e3, 50.0, True),
    "off_centre": (1.0, 4.0, 5e3, 50.0, False),
    "sloshing": None,
    "soft_beam": (3.0, 4.0, 50.0, 50.0, False),
    "stiff_beam": (3.0, 4.0, 1.4e5, 156.0, False),
}


def test_all_shipped_scenes_are_listed_with_a_title() -> None:
    assert {shipped.name for shipped in shipped_scenes()} >= SHIPPED.keys()
    assert all(shipped.title and shipped.path.is_file() for shipped in shipped_scenes())


@pytest.mark.parametrize("name", SHIPPED)
def test_shipped_scenes_hold_the_values_of_the_reference_cases(name: str) -> None:
    given = read_scene(name)
    assert (given.tank.length, given.tank.gravity, given.tank.top) == (10.0, 9.81, "free")
    assert (given.liquid[0].density, given.liquid[0].depth) == (1000.0, 5.0)
    found = [
        (body.start, body.length, body.flexural_rigidity, body.mass_per_length, body.hydrostatic) for body in given.body
    ]
    expected = SHIPPED[name]
    assert found == ([] if expected is None else [expected])


@pytest.mark.parametrize("title", ['"two\\nlines"', '"\\u0001"', '"a\\tb"'])
def test_a_title_is_one_line_that_can_be_shown(good: Path, title: str) -> None:
    assert "one line" in message(good, f"title={title}")
