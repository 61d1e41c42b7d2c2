"""What cannot be meshed is one error, with exit code 2, of check and run alike, in words and not in numbers of gmsh."""

from pathlib import Path

import pytest
from click.testing import CliRunner

from hydroelastic.scenes.command_line import main

BARGE = """
kind = "tank"
[tank]
length = 30.0
width = 12.0
[[liquid]]
density = 1025.0
depth = 6.0
[[body]]
kind = "float"
shape = "box"
size = [12.0, 5.0]
draught = {draught}
vertical_centre_of_gravity = -0.1
[accuracy]
tolerance = 3e-3
modes = 2
"""
# The second corner is far below the others: the faces that meet there leave a wedge of liquid without width.
SPAR = """
kind = "sea"
[[liquid]]
density = 1025.0
depth = inf
[[body]]
kind = "float"
shape = "revolved"
outline = [[0.0, -41.0], [10.0, -2732.0], [10.0, -40.0], [4.0, -40.0], [4.0, 5.0], [0.0, 5.0]]
motions = ["heave"]
vertical_centre_of_gravity = -28.0
[[analysis]]
kind = "{analysis}"
{frequencies}
[accuracy]
tolerance = 1e-3
"""
THIN_LAYER = """
kind = "tank"
[tank]
length = 10.0
width = 6.0
model = "volume"
[[liquid]]
density = 1000.0
depth = 1e-9
[[liquid]]
density = 800.0
depth = 2.0
"""
# Of cells that follow the curve of the column, over all of its length.
WELL = """
kind = "tank"
[tank]
length = 12.0
width = 6.0
[[liquid]]
density = 1000.0
depth = {depth}
[[baffle]]
start = [2.5, 0.0]
end = [2.5, 6.0]
bottom = -1.2
[[column]]
position = [10.0, 3.0]
radius = 0.6
[accuracy]
tolerance = 0.1
modes = 6
"""
SCENES = {
    "a deep well": (WELL.format(depth=2500.0), "tetrahedra are needed, and 3e+06 can be made"),
    "a draught of nothing": (BARGE.format(draught=3e-8), '[[body]] number 1, key "draught" = 3e-08'),
    "a draught of little": (BARGE.format(draught=1e-5), "too little to be meshed"),
    "a layer of nothing": (THIN_LAYER, "scene.toml: [tank], [[liquid]]: the liquid cannot be meshed: one of"),
    "a wedge, in waves": (SPAR.format(analysis="response", frequencies="omega = [0.2, 0.6]"), "a wedge of less than"),
    "a wedge, in resonance": (
        SPAR.format(analysis="resonance", frequencies=""),
        "scene.toml: [sea], [[liquid]], [[body]]: ",
    ),
}


@pytest.mark.parametrize("name", SCENES)
def test_check_and_run_refuse_what_cannot_be_meshed_alike(
    name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    scene, words = SCENES[name]
    Path("scene.toml").write_text(scene, encoding="utf-8")
    said = []
    for command in (["check"], ["run", "--no-images", "--quiet", "--out", "results"]):
        result = CliRunner().invoke(main, [command[0], "scene.toml", *command[1:]])
        assert result.exit_code == 2, result.output
        assert result.stdout == ""
        (line,) = result.stderr.splitlines()
        said.append(line)
    assert said[0] == said[1]
    assert words in said[0]
    for number in ("nan", "gmsh could not", ": ."):
        assert number not in said[0]
    assert not Path("results").exists()


def test_check_does_not_make_a_mesh_that_takes_long(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    Path("scene.toml").write_text(WELL.format(depth=300.0), encoding="utf-8")
    result = CliRunner().invoke(main, ["check", "scene.toml"])
    assert result.exit_code == 0, result.output
    assert "too large to be meshed here, by its sizes about" in " ".join(result.stdout.split())
