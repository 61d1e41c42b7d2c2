"""A result is that of the files as they are now: neither a journal nor anything kept in memory outlives a change."""

import re
import shutil
import subprocess
import sys
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest

import hydroelastic as he

SHIPPED = he.shipped_scenes()[0].path.parent
COARSE = {"accuracy.tolerance": 1e-2}
ONE_MODE = {"accuracy.tolerance": 1e-1, "accuracy.modes": 1}


@dataclass(frozen=True)
class Case:
    """A scene in a folder, one file that it names, directly or by another file, and a change of that file."""

    scene: str
    files: dict[str, str | None]
    changed: str
    change: Callable[[bytes], bytes]
    vary: dict[str, list[Any]]
    set: dict[str, Any]


def scaled_column(column: int, factor: float, separator: str = ",") -> Callable[[bytes], bytes]:
    """Multiply a column in all rows of numbers."""

    def changed(content: bytes) -> bytes:
        lines = []
        for line in content.decode().splitlines():
            words = line.split(separator)
            if line[:1] in tuple("-0123456789") and len(words) > column:
                words[column] = str(factor * float(words[column]))
            lines.append(separator.join(words))
        return "\n".join(lines).encode()

    return changed


def replaced(old: str, new: str) -> Callable[[bytes], bytes]:
    return lambda content: content.replace(old.encode(), new.encode())


def longer_hull(content: bytes) -> bytes:
    """Make the hull of a text file ten per cent longer."""
    return re.sub(rb"vertex (\S+)", lambda found: b"vertex %f" % (1.1 * float(found[1])), content)


def square_of_triangles() -> str:
    """A mesh of a liquid of 2 m x 1 m, four triangles around its middle, in gmsh's format 2.2."""
    points = [(0.0, -1.0), (2.0, -1.0), (2.0, 0.0), (0.0, 0.0), (1.0, -0.5)]
    nodes = [f"{number} {x} {y} 0" for number, (x, y) in enumerate(points, 1)]
    sides = [(2, 1, 2), (2, 2, 3), (3, 3, 4), (2, 4, 1)]
    lines = [f"{number} 1 2 {tag} {tag} {a} {b}" for number, (tag, a, b) in enumerate(sides, 1)]
    triangles = [f"{number + 4} 2 2 1 1 {a} {b} 5" for number, (_, a, b) in enumerate(sides, 1)]
    names = ["3", '1 2 "walls"', '1 3 "free_surface"', '2 1 "liquid"']
    sections = {
        "MeshFormat": ["2.2 0 8"],
        "PhysicalNames": names,
        "Nodes": ["5", *nodes],
        "Elements": ["8", *lines, *triangles],
    }
    return "".join(f"${name}\n" + "\n".join(rows) + f"\n$End{name}\n" for name, rows in sections.items())


SECTION = {"ship_section.toml": None, "ship_section.csv": None}
SHIP = """
kind = "roll"
[roll]
section = "ship_section.toml"
damping_ratio = 0.05
[[wave]]
period = 14.8
slope = 0.03
"""
THREAD = """
kind = "thread"
[thread]
length = 500.0
diameter = 0.0173
mass = 1.15
weight = 8.89
normal_drag = 1.5
tangential_drag = 0.01
[stream]
density = 1025.0
file = "stream.csv"
[ends.a]
kind = "fixed"
position = [0.0, 0.0, 0.0]
[ends.b]
kind = "free"
weight = 6686.0
"""
BASIN = """
kind = "tank"
[tank]
length = 4.0
width = 2.0
bed = { file = "bed.csv" }
[[liquid]]
density = 1000.0
depth = 1.0
"""
MESHED = """
kind = "tank"
[tank]
length = 2.0
[[liquid]]
density = 1000.0
depth = 1.0
[mesh]
file = "liquid.msh"
"""
BED = "".join(f"{x},{y},{-1.0 + 0.1 * x}\n" for x in (-2.0, 2.0) for y in (-1.0, 1.0))
DAMPING = {"roll.damping_ratio": [0.03]}

CASES = {
    "outline": Case(
        "ship_section.toml",
        SECTION,
        "ship_section.csv",
        scaled_column(0, 1.1),
        {"tank.length": [60.0]},
        ONE_MODE,
    ),
    "record of waves": Case(
        "swell_record.toml",
        {"swell_record.toml": None, "swell_record.csv": None},
        "swell_record.csv",
        scaled_column(1, 0.5),
        DAMPING,
        COARSE,
    ),
    "section of a ship": Case(
        "ship.toml",
        SECTION | {"ship.toml": SHIP},
        "ship_section.toml",
        replaced("radius_of_gyration = 7.6", "radius_of_gyration = 8.6"),
        DAMPING,
        COARSE,
    ),
    "outline of the section of a ship": Case(
        "ship.toml", SECTION | {"ship.toml": SHIP}, "ship_section.csv", scaled_column(0, 1.1), DAMPING, COARSE
    ),
    "motion of a string": Case(
        "string_table.toml",
        {"string_table.toml": None, "crane_record.csv": None},
        "crane_record.csv",
        scaled_column(1, 2.0),
        {"string.resistance": [0.12]},
        COARSE,
    ),
    "stream": Case(
        "thread.toml",
        {"thread.toml": THREAD, "stream.csv": "-600,1,0\n0,2,0\n"},
        "stream.csv",
        scaled_column(1, 1.5),
        {"thread.length": [500.0]},
        {},
    ),
    "mesh": Case(
        "tank.toml",
        {"tank.toml": MESHED, "liquid.msh": square_of_triangles()},
        "liquid.msh",
        replaced("5 1.0 -0.5 0", "5 1.3 -0.5 0"),
        {"tank.gravity": [9.81]},
        ONE_MODE,
    ),
    "bed": Case(
        "basin.toml",
        {"basin.toml": BASIN, "bed.csv": BED},
        "bed.csv",
        scaled_column(2, 0.8),
        {"tank.gravity": [9.81]},
        ONE_MODE,
    ),
    "hull": Case(
        "scow_in_a_basin.toml",
        {"scow_in_a_basin.toml": None, "scow.stl": None},
        "scow.stl",
        longer_hull,
        {"tank.gravity": [9.81]},
        ONE_MODE,
    ),
}


@pytest.fixture(params=CASES)
def case(request: pytest.FixtureRequest, tmp_path: Path) -> Case:
    case = CASES[request.param]
    write_files(case, tmp_path)
    return case


def write_files(case: Case, folder: Path) -> None:
    for name, text in case.files.items():
        if text is None:
            shutil.copy(SHIPPED / name, folder)
        else:
            (folder / name).write_text(text, encoding="utf-8")


def change(case: Case, folder: Path) -> None:
    file = folder / case.changed
    before = file.read_bytes()
    file.write_bytes(case.change(before))
    assert file.read_bytes() != before


def table(case: Case, folder: Path, out: str) -> Any:
    found = he.sweep(he.read(folder / case.scene, case.set), case.vary, out=folder / out, follow=False).table
    return found[[name for name in found if "memory" not in name]]


@pytest.mark.slow_but("outline", "section*", "motion*", "mesh")
def test_a_sweep_takes_no_point_that_was_solved_with_other_files(case: Case, tmp_path: Path) -> None:
    first = table(case, tmp_path, "sweep")
    assert "failed" not in list(first.status), list(first.reason)
    change(case, tmp_path)
    second = table(case, tmp_path, "sweep")
    assert not second.equals(first)
    # The same points from the same files: to the last digit.
    assert second.equals(table(case, tmp_path, "another sweep"))


@pytest.mark.parametrize("case", ["outline"], indirect=True)
def test_a_scene_that_is_solved_again_takes_its_files_as_they_are_now(case: Case, tmp_path: Path) -> None:
    def frequencies() -> Any:
        return he.solve(he.read(tmp_path / case.scene, case.set)).dataset.omega.values

    first = frequencies()
    change(case, tmp_path)
    # A hull that is a tenth wider; both are solved to 1e-1, and at this size to 1e-4.
    assert abs(frequencies() / first - 1.0).max() > 0.02


def test_a_scene_that_was_read_finds_its_files_beside_its_own(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    scene = he.read("string_table", COARSE)
    assert list(he.sweep(scene, {"string.resistance": [0.12]}).table.status) == ["ok"]


def test_names_beside_a_mesh_belong_to_it(tmp_path: Path) -> None:
    names = '$PhysicalNames\n3\n1 2 "walls"\n1 3 "free_surface"\n2 1 "liquid"\n$EndPhysicalNames\n'
    (tmp_path / "tank.toml").write_text(MESHED, encoding="utf-8")
    (tmp_path / "liquid.msh").write_text(square_of_triangles().replace(names, ""), encoding="utf-8")
    beside = tmp_path / "liquid.msh.names.json"

    def statuses() -> list[str]:
        scene = he.read(tmp_path / "tank.toml", ONE_MODE)
        return list(he.sweep(scene, {"tank.gravity": [9.81]}, out=tmp_path / "sweep").table.status)

    beside.write_text('{"cells": {"liquid": 1}, "facets": {"walls": 2, "free_surface": 3}}', encoding="utf-8")
    assert statuses() == ["ok"]
    beside.write_text("{}", encoding="utf-8")
    assert statuses() == ["failed"]


def test_a_file_that_changes_during_a_sweep_ends_it(tmp_path: Path) -> None:
    case = CASES["motion of a string"]
    write_files(case, tmp_path)
    command = [sys.executable, "-m", "hydroelastic.scenes", "sweep", case.scene]
    command += ["--vary", "string.resistance=0.1:0.3:100", "--out", "sweep", "--no-images"]
    with subprocess.Popen(command, cwd=tmp_path, stderr=subprocess.PIPE, stdout=subprocess.DEVNULL, text=True) as sweep:
        journal, end = tmp_path / "sweep" / "sweep.journal", time.monotonic() + 60.0
        while not (journal.exists() and journal.stat().st_size) and time.monotonic() < end:
            time.sleep(0.01)
        change(case, tmp_path)
        _, message = sweep.communicate(timeout=60.0)
    assert sweep.returncode == 2
    assert "has changed while the sweep was running" in message
