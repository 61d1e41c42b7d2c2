"""Scenes of threads in a stream: what is read, what is refused, and in which words."""

import re
from math import nextafter
from pathlib import Path

import pytest
from scene_files import read_written
from scene_files import refused as refused_scene

import hydroelastic as he

HEAD = 'kind = "thread"\n'
THREAD = "[thread]\nlength = 2.0\nweight = 1.0\n"
STREAM = "[stream]\ndensity = 1000.0\n"
FLOW = STREAM + "velocity = [1.0, 0.0]\n"
FIXED = '[ends.b]\nkind = "fixed"\nposition = [1.0, 0.0, 0.0]\n'
FREE = '[ends.b]\nkind = "free"\n'
PULLED = FREE + "force = [0.0, 0.0, 5.0]\n"
MOTION = '[[analysis]]\nkind = "motion"\ntimes = [0.0, 1.0]\n'
LIMP = "axial_rigidity = 1e6"


def read(tmp_path: Path, *parts: str) -> he.ThreadScene:
    scene = read_written(tmp_path, HEAD + "".join(parts))
    assert isinstance(scene, he.ThreadScene)
    return scene


def refused(tmp_path: Path, *parts: str) -> str:
    said = refused_scene(tmp_path, HEAD + "".join(parts))
    # One error, whatever else would follow from it.
    assert not said.splitlines()[0].endswith(" problems"), said
    return said


def thread(*lines: str) -> str:
    return THREAD + "".join(f"{line}\n" for line in lines)


def test_defaults(tmp_path: Path) -> None:
    scene = read(tmp_path, THREAD, FIXED)
    assert (scene.positions[0], scene.positions[-1], len(scene.positions)) == (0.0, 2.0, 101)
    assert (scene.weight, scene.density, scene.normal_drag, scene.streams) == (1.0, 0.0, 0.0, False)
    assert scene.accuracy.tolerance == 1e-6


def test_weight_follows_from_mass_and_diameter(tmp_path: Path) -> None:
    scene = read(tmp_path, "[thread]\nlength = 2.0\nmass = 3.0\ndiameter = 0.1\n", STREAM, FIXED)
    # 1000 π 0.1²/4 = 7.854 kg/m of liquid.
    assert scene.weight == pytest.approx(9.81 * (3.0 - 7.853981633974483), rel=1e-14)


@pytest.mark.parametrize(
    ("parts", "words"),
    [
        ((thread("lenght = 1.0"), FIXED), ['"lenght"', "not known here", 'Did you mean "length"?']),
        ((THREAD, FIXED.replace("fixed", "fixd")), ['"fixd"', '"fixed" or "free" or "surface"']),
        ((THREAD.replace("2.0", "-2.0"), FIXED), ['[thread], key "length"', "too small"]),
        ((thread("reactive = 'all'"), FIXED), ["reactive", '"none" or "moving_load" or "lighthill"']),
        # How the liquid streams.
        (
            (THREAD, FLOW + "veer = {speed = 1.0, rate = 0.1}\n", FIXED),
            ["veer", "given beside velocity", "one of velocity (and shear), veer, profile or file"],
        ),
        ((THREAD, STREAM + "shear = [1.0, 0.0]\n", FIXED), ["shear", "no velocity that it adds to", "[0, 0]"]),
        ((THREAD, STREAM + "profile = [[0.0, 1.0, 0.0]]\n", FIXED), ["profile", "1 rows", "2 to 10000 rows"]),
        (
            (THREAD, STREAM + "profile = [[0.0, 1.0, 0.0], [0.0, 2.0, 0.0]]\n", FIXED),
            ["profile", "row 2 does not lie above", "heights that go up"],
        ),
        ((THREAD, STREAM + 'file = "none.csv"\n', FIXED), ["file", '"none.csv"', "there is no such file"]),
        # Bodies and places.
        ((THREAD, FIXED, "[[load]]\nat = 2.0\n"), ["load", "at", "2", "less than length = 2 m", "belongs to [ends]"]),
        ((THREAD, FIXED, "[[load]]\nat = 1.0\n" * 2), ["load", "1", "another body is there", "Add the two up"]),
        (
            (THREAD, FIXED, *(f"[[load]]\nat = {0.01 * (place + 1)}\n" for place in range(101))),
            ["load", "101", "too many", "up to 100 bodies"],
        ),
        ((THREAD, FIXED, "[output]\npositions = [0.0, 2.5]\n"), ["positions", "2.5", "beyond end B", "length = 2 m"]),
        # What the liquid acts on.
        ((thread("normal_drag = 1.2"), FIXED), ["normal_drag", "1.2", "no liquid", "Give [stream]"]),
        ((thread("added_mass = 1.0"), STREAM, FIXED), ["diameter", "missing", "added_mass needs it"]),
        ((THREAD, FIXED, "[[load]]\nat = 1.0\ndrag_area = 0.5\n"), ["drag_area", "0.5", "no liquid", "Give [stream]"]),
        ((THREAD, FREE + "weight = 1.0\ndrag_area = 0.5\n"), ["b.drag_area", "no liquid"]),
        (
            (thread('reactive = "lighthill"'), FLOW, FIXED),
            ["reactive", "a stream and an added mass", "added_mass > 0"],
        ),
        ((thread('stretch_drag = "volume"'), FLOW, FIXED), ["stretch_drag", "does not stretch", '"none" here']),
        # How it is held.
        (
            (THREAD, FIXED + "clamp = [1.0, 0.0, 0.0]\n"),
            ["clamp", "without flexural rigidity turns freely", "Give flexural_rigidity, or leave the clamp out"],
        ),
        (
            (thread("flexural_rigidity = 1.0"), FIXED + "clamp = [0.0, 0.0, 0.0]\n"),
            ["clamp", "no direction", "a vector other than 0"],
        ),
        ((THREAD, '[ends.a]\nkind = "free"\n', FREE), ["neither end is fixed", "drifts off", 'kind = "fixed"']),
        # What has no determined tension, or no shape.
        ((THREAD.replace("2.0", "0.5"), FIXED), ["length", "0.5", "1 m apart", "axial_rigidity"]),
        (
            (THREAD.replace("2.0", "1.0"), FIXED),
            ["length", "no determined tension", "1.000000002 m or more, or axial_rigidity"],
        ),
        (
            (THREAD.replace("1.0", "0.0"), FIXED),
            ["weight", "nothing loads the thread", "its shape is undetermined", "Give weight, a stream that drags"],
        ),
        ((THREAD.replace("1.0", "0.0"), FREE), ["nothing pulls at this end", "Give a force or a weight"]),
        (
            (thread("diameter = 0.1", "normal_drag = 1.0").replace("weight = 1.0", "weight = 0.0"), FLOW, FIXED),
            ["length", "along the line between the ends", "indeterminate", "a stream at an angle"],
        ),
        (
            (THREAD, FIXED.replace("1.0, 0.0, 0.0", "0.0, 0.0, 1.0")),
            ["length", "one vertical", "folds", "set the ends apart"],
        ),
        (
            (thread("diameter = 0.1", "added_mass = 1.0", 'reactive = "lighthill"'), FLOW, FREE),
            ["reactive", "free end B", "ill-posed", '"none", or flexural_rigidity > 0, or a force on the end'],
        ),
        # Analyses.
        (
            (thread("mass = 1.0"), FIXED, '[[analysis]]\nkind = "stability"\nfactors = [1.0, 2.0]\n'),
            ["kind", '"stability"', "there is no stream", '"modes" or "motion"'],
        ),
        ((THREAD, FIXED, '[[analysis]]\nkind = "modes"\n'), ["mass", "the analysis modes needs it", "> 0"]),
        (
            (thread("mass = 1.0"), PULLED, MOTION, "[[analysis.move]]\nend = 'b'\n"),
            ["move", "end", '"b"', "not fixed", "a fixed end"],
        ),
        (
            (thread("mass = 1.0"), PULLED, MOTION, "[[analysis.release]]\nend = 'b'\n"),
            ["release", "end", "not fixed"],
        ),
        (
            (thread("mass = 1.0"), FIXED, MOTION + 'integrator = "generalized_alpha"\n'),
            ["integrator", "does not stretch", '"midpoint", or axial_rigidity'],
        ),
        (
            (thread("mass = 1.0"), FIXED, MOTION + "vortices = {lift = 1.0}\n"),
            ["vortices", "a liquid and drag across the thread", "Give both"],
        ),
        (
            (thread("mass = 1.0"), PULLED, MOTION + 'start = "straight"\ndirection = [0.0, 0.0, 0.0]\n'),
            ["direction", "no direction"],
        ),
        (
            (thread("mass = 1.0"), FIXED, MOTION + 'start = "straight"\n'),
            ["start", "both ends are fixed", '"equilibrium" or "still_liquid"'],
        ),
        (
            (thread("mass = 1.0"), FLOW, FIXED, '[[analysis]]\nkind = "stability"\nfactors = [1.0]\n'),
            ["factors", "there is one", "two or more factors"],
        ),
        ((thread("viscous_drag = 1.0"), FIXED), ["viscous_drag", "no liquid", "Give [stream]"]),
        ((THREAD, FIXED, "[[load]]\nat = 1.0\nadded_mass = 0.5\n"), ["added_mass", "0.5", "no liquid"]),
        ((THREAD, FIXED, "[[load]]\nat = 1e-7\n"), ["load", "as good as at an end", "belongs to [ends]"]),
        ((THREAD, FIXED, "[[load]]\nat = 1.0\n[[load]]\nat = 1.0000001\n"), ["another body is there"]),
        (
            (thread("mass = 1.0"), FIXED, MOTION.replace("[0.0, 1.0]", "[0.0]")),
            ["times", "nothing moves by then", "a last time > 0"],
        ),
        (
            (thread("mass = 1.0"), FIXED, MOTION, "[[analysis.release]]\nend = 'b'\n" * 2),
            ["release", "let go twice", "each end once"],
        ),
        (
            (thread("mass = 1.0"), FIXED, MOTION, "[[analysis.release]]\nend = 'b'\ntime = 2.0\n"),
            ["release", "the motion ends before", "less than 1 s"],
        ),
        (
            (
                thread("mass = 1.0", "diameter = 0.1", "added_mass = 1.0", 'reactive = "moving_load"'),
                FLOW,
                FIXED,
                MOTION,
                "[[analysis.release]]\nend = 'b'\n",
            ),
            ["release", "reactive model", 'reactive = "none"'],
        ),
        (
            (
                thread("mass = 1.0", "diameter = 0.1", "added_mass = 1.0", 'reactive = "lighthill"', LIMP),
                FLOW,
                FIXED,
                MOTION + 'integrator = "generalized_alpha"\n',
            ),
            ["integrator", "Lighthill", '"midpoint"'],
        ),
        (
            (
                thread("mass = 1.0"),
                "[ends.b]\nkind = 'surface'\nlevel = -1.0\nforce = [1.0, 0.0]\n",
                MOTION + 'start = "straight"\n',
            ),
            ["direction", "z = -2 m", "at its level, -1 m"],
        ),
        (
            (
                thread("mass = 1.0", "flexural_rigidity = 1.0"),
                "[ends.a]\nkind = 'fixed'\nclamp = [1.0, 0.0, 0.0]\n",
                PULLED,
                MOTION + 'start = "straight"\n',
            ),
            ["direction", "clamped in another", "that of the clamp"],
        ),
        (
            (thread("mass = 1.0"), FIXED, MOTION, "[[analysis.move]]\nend = 'a'\nfile = 'none.csv'\n"),
            ["file", '"none.csv"', "there is no such file"],
        ),
    ],
)
def test_what_is_refused(tmp_path: Path, parts: tuple[str, ...], words: list[str]) -> None:
    message = refused(tmp_path, *parts)
    assert all(word in message for word in words), message


@pytest.mark.parametrize(
    ("rows", "words"),
    [
        (["0, 0, 0, 0", "1, 0, 0, 0"], ["it holds 2 rows", "4 to 20000 rows"]),
        (["0, 0, 0, 0", "1, 0, 0, 0", "1, 0, 0, 0", "2, 0, 0, 0"], ["times do not go up"]),
        (["0, 0, 0, 0", "0.1, 0, 0, 0", "0.2, 0, 0, 0", "0.5, 0, 0, 0"], ["from 0 to 0.5 s", "from 0 to 1 s at least"]),
    ],
)
def test_tables_of_an_end_that_are_refused(tmp_path: Path, rows: list[str], words: list[str]) -> None:
    (tmp_path / "move.csv").write_text("\n".join(rows) + "\n", encoding="utf-8")
    move = "[[analysis.move]]\nend = 'a'\nfile = 'move.csv'\n"
    message = refused(tmp_path, thread("mass = 1.0"), FIXED, MOTION, move)
    assert all(word in message for word in ['"move.csv"', *words]), message


@pytest.mark.parametrize("length", [1.0, 1.000000001, nextafter(1.0, 2.0), 0.5])
def test_the_length_that_is_allowed_is_accepted(tmp_path: Path, length: float) -> None:
    for chord in (1.0, 13.7, 1e-3):
        fixed = FIXED.replace("1.0", repr(chord))
        message = refused(tmp_path, THREAD.replace("2.0", repr(length * chord)), fixed)
        (allowed,) = re.findall(r"(\S+) m or more, or axial_rigidity", message)
        assert read(tmp_path, THREAD.replace("2.0", allowed), fixed)
        assert read(tmp_path, thread(LIMP).replace("2.0", repr(length * chord)), fixed)


def test_numbers_that_nearly_agree_are_told_apart(tmp_path: Path) -> None:
    message = refused(tmp_path, THREAD.replace("2.0", "10.000001"), FIXED, "[[load]]\nat = 10.0000015\nweight = 1.0\n")
    assert "less than length = 10.000001 m" in message
