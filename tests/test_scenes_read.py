"""Scenes from files: overrides, shipped scenes, and messages that say what to do."""

import json
import re
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mutated_scenes import as_toml
from scene_files import BEAM_IN_TANK, CIRCLE_IN_OPEN_WATER, refused

import hydroelastic as he


@pytest.fixture
def good(tmp_path: Path) -> Path:
    path = tmp_path / "good.toml"
    path.write_text(BEAM_IN_TANK, encoding="utf-8")
    return path


def message(path: Path | str, *overrides: str) -> str:
    with pytest.raises(he.SceneError) as caught:
        he.read(path, overrides)
    return str(caught.value)


def test_overrides_replace_and_add_values(good: Path) -> None:
    changes = [
        "body.1.start=2.5",
        "accuracy.tolerance=1e-8",
        "tank.top=rigid",
        'title="Two words"',
        "accuracy.modes = 3",
    ]
    given = he.read(good, changes)
    assert (given.body[0].start, given.accuracy.tolerance, given.accuracy.modes) == (2.5, 1e-8, 3)
    assert (given.tank.top, given.title) == ("rigid", "Two words")
    assert he.read(good, ["title=Two words"]).title == "Two words"
    assert he.read(good, ["body=[]"]).body == ()


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
    assert he.read(path).tank.length == 10


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
    given = he.read(good, ["mesh.file=tank.msh"])
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
    assert he.read("sloshing").body == ()
    Path("aquarium").write_text(BEAM_IN_TANK.replace("length = 10.0", "length = 11.0"), encoding="utf-8")
    assert he.read("aquarium").tank.length == 11.0


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
    assert {shipped.name for shipped in he.shipped_scenes()} >= SHIPPED.keys()
    assert all(shipped.title and shipped.path.is_file() for shipped in he.shipped_scenes())


@pytest.mark.parametrize("name", SHIPPED)
def test_shipped_scenes_hold_the_values_of_the_reference_cases(name: str) -> None:
    given = he.read(name)
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


# --- what is accepted


def test_defaults_are_those_of_the_contract() -> None:
    scene = he.read({"kind": "tank", "tank": {"length": 10}, "liquid": [WATER], "body": [BEAM]})
    assert (scene.tank.gravity, scene.tank.ends, scene.tank.top, scene.mesh) == (9.81, "walls", "free", None)
    assert (scene.body[0].kind, scene.body[0].hydrostatic, scene.body[0].ends) == ("beam", True, "free")
    assert (scene.accuracy.tolerance, scene.accuracy.modes) == (1e-6, 10)
    # Whole numbers become floats.
    assert isinstance(scene.tank.length, float)
    # Scenes can be keys, and come back from JSON.
    assert hash(scene) == hash(he.read(scene.model_dump()))
    assert he.read(json.loads(scene.model_dump_json())) == scene


WATER = {"density": 1000.0, "depth": 5.0}
BEAM: dict[str, Any] = {"start": 3.0, "length": 4.0, "flexural_rigidity": 5e3, "mass_per_length": 50.0}
# Changes of the scene of a beam, the key that is named, or nothing where it is accepted.
CHANGES: list[tuple[dict[str, Any], str]] = [
    *(({"tank.length": value}, '[tank], key "length"') for value in (True, "10", 0, -1, 1e-40, 1e40, [1], 10**400)),
    *(({"accuracy.modes": value}, '[accuracy], key "modes"') for value in (0, 201, 10.0, True, "10")),
    *(({"accuracy.tolerance": value}, '[accuracy], key "tolerance"') for value in (0, 0.9e-12, 0.11, -1e-6)),
    *(({"body.1.hydrostatic": value}, '[[body]] number 1, key "hydrostatic"') for value in (1, "true")),
    ({"body.1.start": 7}, '[[body]] number 1, key "start"'),
    ({"body.1.start": 0, "body.1.length": 11}, '[[body]] number 1, key "length"'),
    ({"body": [BEAM, BEAM | {"start": 7.0, "length": 1.5}]}, "overlaps or touches"),
    ({"body": [BEAM, BEAM | {"start": 4.0, "length": 1.5}]}, "overlaps or touches"),
    ({"body": [], "tank.top": "rigid"}, '[tank], key "top"'),
    ({"body.1.ends": "guided"}, '[[body]] number 1, key "ends"'),
    ({"liquid.1.depth": 0.9e-3}, '[[liquid]] number 1, key "depth"'),
    ({"liquid.1.depth": 1.1e4}, '[[liquid]] number 1, key "depth"'),
    ({"body.1.flexural_rigidity": 1e29}, '[[body]] number 1, key "flexural_rigidity"'),
    ({"body.1.mass_per_length": 1e-29}, '[[body]] number 1, key "mass_per_length"'),
    ({"liquid": [WATER, WATER]}, "[[liquid]] number 2"),
    ({"accuracy.modes": 200, "accuracy.tolerance": 1e-12}, ""),
    ({"accuracy.modes": 1, "accuracy.tolerance": 0.1}, ""),
    ({"body.1.start": 0, "body.1.length": 10, "body.1.ends": "guided"}, ""),
    # One rounding beyond the wall.
    ({"tank.length": 0.3, "liquid.1.depth": 1.0, "body.1.start": 0.1, "body.1.length": 0.2}, ""),
    ({"liquid.1.depth": 1e-3}, ""),
    ({"liquid.1.depth": 1e4}, ""),
    ({"body.1.flexural_rigidity": 1e15, "body.1.mass_per_length": 2000.0}, ""),
]


@pytest.mark.parametrize(("changes", "said"), CHANGES)
def test_values_are_accepted_within_their_limits_and_refused_by_key_beyond(changes: dict[str, Any], said: str) -> None:
    if said:
        with pytest.raises(he.SceneError, match=re.escape(said)):
            he.read("aquarium", changes)
    else:
        assert he.read("aquarium", changes).kind == "tank"


# --- words of newcomers, and numbers with units

ANALYSIS = "[[analysis]]\nkind = {kind}\n{key} = [1.0]\n"


@pytest.mark.parametrize(
    ("kind", "key", "said"),
    [
        ("response", "period", 'Did you mean "omega"? omega = 2π/T in rad/s.'),
        ("response", "wave_period", 'Did you mean "omega"? omega = 2π/T in rad/s.'),
        ("radiation", "frequency", "omega = 2πf in rad/s"),
        ("rao", "omega", 'Did you mean "response"?'),
    ],
)
def test_words_of_newcomers_lead_to_those_of_scenes(kind: str, key: str, said: str, tmp_path: Path) -> None:
    assert said in refused(tmp_path, CIRCLE_IN_OPEN_WATER + ANALYSIS.format(kind=f'"{kind}"', key=key))


@pytest.mark.parametrize(
    ("change", "unit"),
    [("body.1.start=1 in", "m"), ("body.1.mass_per_length=1 lb", "kg/m²"), ('tank.length="1.5e3 kg/m"', "m")],
)
def test_units_are_those_of_the_key(change: str, unit: str) -> None:
    assert f"Write a number without a unit; the unit is {unit}." in message("aquarium", change)


# --- tables and files that are too large

STRING = 'kind = "string"\n[string]\nlength = 1.0\nlinear_density = 1.0\n[motion]\nkind = "table"\n'
READERS = {
    "outline": (2, BEAM_IN_TANK + '[[body]]\nkind = "float"\nshape = "outline"\nposition = 1.0\nfile = "table.csv"\n'),
    "string": (2, STRING + 'file = "table.csv"\n'),
    "waves": (2, 'kind = "roll"\n[roll]\nnatural_period = 8.0\n[train]\nfile = "table.csv"\n'),
    "stream": (
        3,
        'kind = "thread"\n[thread]\nlength = 10.0\nweight = 1.0\n[stream]\ndensity = 1000.0\nfile = "table.csv"\n'
        '[ends.b]\nkind = "free"\n',
    ),
}


@pytest.mark.slow_but("waves")
@pytest.mark.parametrize("reader", READERS)
def test_a_table_is_not_read_beyond_the_most_rows(reader: str, tmp_path: Path) -> None:
    columns, text = READERS[reader]
    rows = "".join(f"{','.join([str(row)] * columns)}\n" for row in range(100_001))
    # What stands after too many rows is no number, and that is not found.
    (tmp_path / "table.csv").write_text(rows + "no number\n", encoding="utf-8")
    said = refused(tmp_path, text)
    assert 'key "file"' in said
    assert "it holds more than 100000 rows" in said
    with (tmp_path / "table.csv").open("wb") as table:
        table.truncate(30_000_000)
    assert "it is 30 MB large" in refused(tmp_path, text)
    (tmp_path / "table.csv").write_text("0,0\n\x1b[31mred\n", encoding="utf-8")
    assert "\x1b" not in refused(tmp_path, text)


def test_a_scene_that_is_too_large_is_not_opened(tmp_path: Path) -> None:
    with (tmp_path / "scene.toml").open("wb") as file:
        file.truncate(30_000_000)
    assert "it is 30 MB large, and a scene takes 20 MB at most" in message(tmp_path / "scene.toml")


# --- anything at all

REPRODUCIBLE = settings(derandomize=True, deadline=None, database=None, max_examples=100)
FOREIGN = re.compile(
    r"array\(|<class|object at 0x|validation error|pydantic|Traceback|float64|\bNone\b|PosixPath|Errno"
)


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("any")


@REPRODUCIBLE
@given(st.one_of(st.binary(max_size=60), st.text(max_size=60).map(lambda text: text.encode("utf-8", "surrogatepass"))))
def test_any_bytes_are_refused_in_words(folder: Path, content: bytes) -> None:
    (folder / "bytes.toml").write_bytes(content)
    assert len(message(folder / "bytes.toml").splitlines()) == 1


@REPRODUCIBLE
@given(st.one_of(st.text(max_size=30), st.from_regex(r"[a-z.0-9]{1,12}=[^\x00]{0,12}", fullmatch=True)))
def test_any_override_is_taken_or_refused_in_words(change: str) -> None:
    said = ""
    try:
        he.read("aquarium", [change])
    except he.SceneError as error:
        said = str(error).replace(change, "")
    assert not FOREIGN.search(said)


TANK = {"kind": "tank", "tank": {"length": 10.0}, "liquid": [WATER]}
HANGING = {
    "kind": "string",
    "string": {"length": 1.0, "linear_density": 1.0},
    "motion": {"kind": "step", "amplitude": 1.0},
}
NEAR_ZERO = {"start": 5e-324, "stop": 1e30, "number": 5, "spacing": "logarithmic"}


@pytest.mark.parametrize(
    ("document", "said"),
    [
        (TANK | {"mesh": {"file": "a\0b.msh"}}, "there is no file"),
        (TANK | {"mesh": {"file": "a\nb.msh"}}, "there is no file"),
        ({"kind": "roll", "roll": {"natural_frequency": 1e-30, "angle": 0.1}}, '[output], key "times" = '),
        (HANGING | {"output": {"times": NEAR_ZERO}}, "equal ratios cannot start so close to 0"),
    ],
)
def test_extremes_are_refused_in_one_line(document: dict[str, Any], said: str, tmp_path: Path) -> None:
    found = refused(tmp_path, as_toml(document))
    assert said in found
    assert len(found.splitlines()) == 1
    assert not FOREIGN.search(found)
