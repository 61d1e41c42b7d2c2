"""Nothing that a scene names is executed: gmsh runs what it does not know as a script, and FILE.opt beside FILE."""

import os
import re
import subprocess
import sys
from pathlib import Path

import gmsh
import pytest
from click.testing import CliRunner, Result
from given_meshes import BOX_SCENE, box_mesh

from hydroelastic.scenes.command_line import main

RUN = ("--no-images", "--quiet", "--out", "results")
SHELL = 'SystemCall "touch planted";\nPrintf("planted") > "planted";\n'
HULL = """
kind = "tank"
[tank]
length = 4.0
width = 2.0
[[liquid]]
density = 1000.0
depth = 1.0
[[body]]
kind = "float"
shape = "hull"
file = "{file}"
draught = 0.25
vertical_centre_of_gravity = 0.0
radii_of_gyration = [0.3, 0.3, 0.4]
motions = ["heave"]
[accuracy]
tolerance = 1e-1
modes = 1
"""
SECTION = """
kind = "tank"
[tank]
length = 4.0
[[liquid]]
density = 1000.0
depth = 2.0
[mesh]
file = "{file}"
"""
SHAPE = BOX_SCENE.replace("{depth}", "depth = 2.0")


@pytest.fixture(autouse=True)
def _in_an_empty_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)


def invoke(command: str, scene: str, file: str) -> Result:
    Path("scene.toml").write_text(scene.replace("{file}", file), encoding="utf-8")
    return CliRunner().invoke(main, [command, "scene.toml", *(RUN if command == "run" else ())])


def solid_file(file: Path) -> Path:
    """A box of 1 m, 0.5 m high, as a solid of CAD or its triangles."""
    if not gmsh.isInitialized():
        gmsh.initialize(readConfigFiles=False, interruptible=False)
    gmsh.option.setNumber("General.Verbosity", 0)
    gmsh.model.add("solid")
    gmsh.model.occ.addBox(-0.5, -0.5, -0.25, 1.0, 1.0, 0.5)
    gmsh.model.occ.synchronize()
    gmsh.option.setString("Geometry.OCCTargetUnit", "M")
    if file.suffix == ".stl":
        gmsh.model.mesh.generate(2)
    gmsh.write(str(file))
    gmsh.model.remove()
    return file


@pytest.mark.parametrize("command", ["check", "run"])
@pytest.mark.parametrize(
    ("scene", "file"),
    [
        (SHAPE, "tank.msh"),
        (SHAPE, "tank.step"),
        (SHAPE, "tank.brep"),
        (SECTION, "tank.msh"),
        (SECTION, "tank.vtu"),
        (SECTION, "tank.xdmf"),
        (HULL, "hull.stl"),
        (HULL, "hull.step"),
    ],
)
@pytest.mark.parametrize("beginning", ["", "\n$MeshFormat\n", "// $MeshFormat\n"])
def test_a_script_in_place_of_a_mesh_is_refused_and_not_run(
    command: str, scene: str, file: str, beginning: str
) -> None:
    Path(file).write_text(beginning + SHELL, encoding="utf-8")
    result = invoke(command, scene, file)
    assert not Path("planted").exists()
    assert result.exit_code == 2, result.output
    (line,) = result.stderr.splitlines()
    assert f'{file}": ' in line
    assert "cannot be read" in line


@pytest.mark.parametrize(("scene", "file"), [(SHAPE, "tank.step"), (HULL, "hull.step")])
def test_a_solid_that_ends_its_reader_is_refused(scene: str, file: str) -> None:
    """Without one of its lines OpenCASCADE would end the process, as do a tenth of other changes at random."""
    text = solid_file(Path(file)).read_text(encoding="utf-8")
    Path(file).write_text(re.sub(r"#\d+ = FACE_BOUND\([^;]*;", "", text, count=1), encoding="utf-8")
    result = invoke("check", scene, file)
    assert result.exit_code == 2, result.output
    (line,) = result.stderr.splitlines()
    assert f"{file} cannot be read: it is broken, or not" in line


@pytest.mark.parametrize("command", ["check", "run"])
@pytest.mark.parametrize(
    ("scene", "file"),
    [
        (SHAPE, "tank.msh"),
        (SHAPE.replace("depth = 2.0", "depth = 0.5"), "tank.step"),
        (HULL, "hull.stl"),
        (HULL, "hull.brep"),
    ],
)
def test_options_beside_a_good_file_are_not_read(command: str, scene: str, file: str) -> None:
    if file.endswith(".msh"):
        box_mesh(Path(file))
    else:
        solid_file(Path(file))
    for name in (f"{file}.opt", f"{Path(file).stem}.opt", ".gmshrc", ".gmsh-options", "gmshrc"):
        Path(name).write_text(SHELL, encoding="utf-8")
    result = invoke(command, scene, file)
    assert not Path("planted").exists()
    assert result.exit_code == 0, result.output


def test_preferences_of_gmsh_are_neither_read_nor_written(tmp_path: Path) -> None:
    home = tmp_path / "home"
    home.mkdir()
    for folder in (home, tmp_path):
        for name in (".gmshrc", ".gmsh-options", ".gmshsock"):
            (folder / name).write_text(SHELL, encoding="utf-8")
    before = {path: path.read_bytes() for path in home.iterdir()}
    box_mesh(tmp_path / "tank.msh")
    Path("scene.toml").write_text(SHAPE.replace("{file}", "tank.msh"), encoding="utf-8")
    # gmsh starts once in a process: one of its own sees these files.
    command = [sys.executable, "-m", "hydroelastic.scenes", "run", "scene.toml", *RUN]
    environment = os.environ | {"HOME": str(home)}
    done = subprocess.run(command, capture_output=True, text=True, check=False, env=environment, timeout=120)
    assert done.returncode == 0, done.stderr
    assert not Path("planted").exists()
    assert {path: path.read_bytes() for path in home.iterdir() if path.name.startswith(".gmsh")} == before
    # FLTK's preferences, which gmsh brings.
    assert not (home / ".fltk").exists()
