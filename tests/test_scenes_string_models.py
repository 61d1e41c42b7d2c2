"""Scenes of hanging strings: what is read, what is refused, and in which words."""

from pathlib import Path

import pytest
from scene_files import read_written, refused

import hydroelastic as he

STRING = """kind = "string"
[string]
length = 2.0
linear_density = 0.5
"""
SINE = STRING + '[motion]\nkind = "sine"\namplitude = 0.1\nomega = 3.0\n'


def read(tmp_path: Path, text: str) -> he.StringScene:
    scene = read_written(tmp_path, text)
    assert isinstance(scene, he.StringScene)
    return scene


def test_defaults(tmp_path: Path) -> None:
    scene = read(tmp_path, SINE)
    assert scene.method == "series"
    assert scene.string.physical.has_closed_form
    assert (scene.positions[0], scene.positions[-1], len(scene.positions)) == (0.0, 2.0, 101)
    assert scene.times[0] == 0.0
    assert scene.times[-1] == pytest.approx(6.4 * scene.string.physical.travel_time)


def test_a_bare_resistance_is_uniform_and_a_table_varies(tmp_path: Path) -> None:
    uniform = read(tmp_path, SINE.replace("0.5\n", "0.5\nresistance = 0.2\n", 1))
    assert (uniform.string.resistance.bottom, uniform.string.resistance.top) == (0.2, 0.2)
    assert uniform.string.physical.damping == 0.4
    varied = read(tmp_path, SINE.replace("0.5\n", "0.5\nresistance = { bottom = 0.1, top = 0.3 }\n", 1))
    assert varied.method == "field"


def test_liquid_changes_gravity_and_damping_alone(tmp_path: Path) -> None:
    text = SINE.replace("0.5\n", "0.5\nresistance = 0.2\nadded_mass = 0.3\ndisplaced_mass = 0.1\n", 1)
    string = read(tmp_path, text).string.physical
    assert string.has_closed_form
    assert string.apparent_gravity == pytest.approx(9.81 * 0.4 / 0.8, rel=1e-15)
    assert string.damping == pytest.approx(0.2 / 0.8, rel=1e-15)


@pytest.mark.parametrize("motion", ['kind = "ramp"\nspeed = 1.0', 'kind = "step"\namplitude = -1.0'])
def test_motions_without_further_keys(tmp_path: Path, motion: str) -> None:
    assert read(tmp_path, f"{STRING}[motion]\n{motion}\n").motion.kind in motion


def test_a_table_from_a_file_lies_beside_the_scene(tmp_path: Path) -> None:
    (tmp_path / "record.csv").write_text("time,place\n0, 0\n1, 0.5\n2, 0.5\n3, 0.2\n", encoding="utf-8")
    scene = read(tmp_path, STRING + '[motion]\nkind = "table"\nfile = "record.csv"\n')
    assert scene.table == ((0.0, 0.0), (1.0, 0.5), (2.0, 0.5), (3.0, 0.2))
    # The table ends before six travel times have passed.
    assert scene.times[-1] == 3.0


@pytest.mark.parametrize(
    ("text", "words"),
    [
        (STRING, ["[motion]", "it is missing"]),
        (SINE.replace("omega", "omgea"), ['"omgea"', "not known here", 'Did you mean "omega"?']),
        (
            SINE.replace('"sine"', '"sinus"'),
            ['"sinus"', '"ramp" or "sine" or "smooth" or "step" or "table"', '"sine"?'],
        ),
        (SINE.replace("omega = 3.0", "speed = 3.0"), ['"speed"', "belongs to kind"]),
        (SINE.replace("3.0", "1e9"), ['[motion], key "omega"', "too fast", "up to"]),
        (SINE.replace("2.0", "-2.0"), ['[string], key "length"', "too small"]),
        (SINE.replace("0.5\n", "0.5\nresistance = true\n", 1), ["resistance", "neither a number nor a table"]),
        (SINE.replace("0.5\n", "0.5\nresistance = 1e9\n", 1), ["resistance", "too large"]),
        (SINE.replace("0.5\n", "0.5\ndisplaced_mass = 0.5\n", 1), ["displaced_mass", "float up", "linear_density"]),
        (SINE.replace("0.5\n", "0.5\ntip_displaced_mass = 0.5\n", 1), ["tip_displaced_mass", "tip_mass = 0 kg"]),
        (
            SINE.replace("0.5\n", "0.5\ntip_mass = 1.0\ntip_displaced_mass = 1.0\n", 1),
            ["float up", "less than tip_mass"],
        ),
        (SINE + "[accuracy]\nmodes = 0\n", ["modes", "too small", "from 1 to 200"]),
        (
            SINE.replace("0.5\n", "0.5\ntip_mass = 1.0\n", 1) + '[accuracy]\nmethod = "series"\n',
            ['[accuracy], key "method"', "no series", '"auto" or "field"'],
        ),
        (SINE + "[output]\npositions = [0.0, 2.5]\n", ["positions", "above the upper end", "length = 2"]),
        (SINE + "[output]\ntimes = [0.0, 2.0, 1.0]\n", ["times", "1 does not lie above 2", "in order"]),
        (SINE + "[output]\ntimes = [-1.0]\n", ["times", "too small"]),
        (SINE + "[output]\ntimes = [1e9]\n", ["times", "travel times of a wave"]),
        (
            SINE + "[output]\npositions = {start = 0, stop = 2, number = 2000}\n"
            "times = {start = 0, stop = 2, number = 2000}\n",
            ["too many points", "1000000"],
        ),
        (
            STRING + '[motion]\nkind = "table"\n',
            ['[motion], key "file"', "missing", "either file, or times and values"],
        ),
        (STRING + '[motion]\nkind = "table"\ntimes = [0.0, 1.0]\nvalues = [1.0]\n', ["2 times, 1 values"]),
        (
            STRING + '[motion]\nkind = "table"\ntimes = [0.0, 1.0]\nvalues = [1.0, 2.0]\n',
            ["it holds 2 rows", "4 to 20000 rows"],
        ),
        (
            STRING + '[motion]\nkind = "table"\ninterpolation = "linear"\ntimes = [1.0, 2.0]\nvalues = [1.0, 2.0]\n',
            ["first time is 1", "begins at t = 0"],
        ),
        (
            STRING + '[motion]\nkind = "table"\ninterpolation = "linear"\ntimes = [0.0, 0.0]\nvalues = [1.0, 2.0]\n',
            ["time of row 2 is not greater"],
        ),
        (STRING + '[motion]\nkind = "table"\nfile = "none.csv"\n', ['"none.csv"', "there is no such file"]),
        (
            STRING + '[motion]\nkind = "table"\ninterpolation = "linear"\ntimes = [0.0, 1.0]\nvalues = [0.0, 2.0]\n'
            "[output]\ntimes = [0.5, 1.5]\n",
            ["times", "1.5", "table of the motion ends before", "up to 1 s"],
        ),
    ],
)
def test_what_is_refused(tmp_path: Path, text: str, words: list[str]) -> None:
    message = refused(tmp_path, text)
    assert all(word in message for word in words), message


def test_an_unknown_kind_names_all(tmp_path: Path) -> None:
    assert '"tank" or "sea" or "string" or "thread" or "roll"' in refused(
        tmp_path, SINE.replace('"string"', '"strnig"', 1)
    )
