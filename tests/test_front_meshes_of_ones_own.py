"""Meshes of one's own: what is wrong in one is named, by check and run alike, and a wall that is meant is declared."""

import re
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner, Result
from given_meshes import BOX_SCENE, box_mesh, section_mesh, write_msh

import hydroelastic as he
from hydroelastic.scenes.command_line import main

SECTION_SCENE = """
kind = "tank"
[tank]
length = {length}
[[liquid]]
density = 900.0
depth = 2.0
[mesh]
file = "tank.msh"
[accuracy]
tolerance = 1e-2
modes = 2
"""


@pytest.fixture(autouse=True)
def _in_an_empty_folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("COLUMNS", "200")


def upper_half(place: np.ndarray) -> bool:
    return bool(place[-1] > -1.0)


def everywhere(place: np.ndarray) -> bool:
    return True


def of_box(depth: str = "") -> str:
    return BOX_SCENE.replace("{file}", "tank.msh").replace("{depth}", depth)


def of_section(length: float = 4.0) -> str:
    return SECTION_SCENE.format(length=length)


def invoke(command: str, scene: str) -> Result:
    Path("scene.toml").write_text(scene, encoding="utf-8")
    options = ("--no-images", "--quiet", "--out", "results") if command == "run" else ()
    return CliRunner().invoke(main, [command, "scene.toml", *options])


def refused(scene: str) -> str:
    """What check and run say alike of a scene, in one line, with exit code 2 and nothing written."""
    said = set()
    for command in ("check", "run"):
        result = invoke(command, scene)
        assert result.exit_code == 2, result.output
        (line,) = result.stderr.splitlines()
        said.add(line)
    assert not Path("results").exists()
    (line,) = said
    return line


def frequencies(scene: str) -> list[float]:
    Path("scene.toml").write_text(scene, encoding="utf-8")
    result = he.solve(he.read("scene.toml"))
    assert result.summary["status"] == "ok"
    return [mode["omega"] for mode in result.summary["modes"]]


def test_nodes_doubled_by_mistake_are_named_in_a_volume() -> None:
    box_mesh(Path("tank.msh"), split=upper_half)
    line = refused(of_box())
    assert "walls inside of the liquid" in line
    assert "1 m² at x = 2 m, 0 < y < 1 m, -1 < z < 0 m" in line
    assert 'physical group "baffle"' in line
    assert "fragment" in line


def test_nodes_doubled_by_mistake_are_named_in_a_section() -> None:
    section_mesh(Path("tank.msh"), split=upper_half)
    line = refused(of_section())
    assert "1 m at x = 2 m, -1 < y < 0 m" in line
    assert 'physical group "baffle"' in line


@pytest.mark.parametrize("make", [box_mesh, section_mesh])
def test_a_liquid_in_two_parts_is_named(make: Callable[..., Path]) -> None:
    make(Path("tank.msh"), split=everywhere)
    line = refused(of_box() if make is box_mesh else of_section())
    assert "they divide it into 2 parts" in line


def test_parts_that_do_not_match_are_named() -> None:
    """Two boxes side by side, meshed apart: nodes on both sides of their common face are at different places."""
    points, elements, names = [], [], {}
    for file, counts, start in (("one.msh", (2, 1, 2), 0.0), ("other.msh", (2, 2, 3), 2.0)):
        box_mesh(Path(file), (2.0, 1.0, 2.0), counts)
        nodes, own, names = read_msh(Path(file))
        before = sum(map(len, points))
        points.append(nodes + np.array([start, 0.0, 0.0]))
        elements += [(kind, tag, [before + node for node in places]) for kind, tag, places in own]
    write_msh(Path("tank.msh"), np.concatenate(points), elements, names)
    line = refused(of_box())
    assert "2 m² at x = 2 m, 0 < y < 1 m, -2 < z < 0 m" in line
    # A gap between them is no wall, but they are not connected either.
    write_msh(Path("tank.msh"), np.concatenate([points[0], points[1] + [0.1, 0.0, 0.0]]), elements, names)
    line = refused(of_box())
    assert "2 parts of the liquid that are not connected: 0 < x < 2 m" in line
    assert "2.1 < x < 4.1 m" in line


def read_msh(file: Path) -> tuple[np.ndarray, list[tuple[int, int, list[int]]], dict[str, tuple[int, int]]]:
    """Nodes, elements and names of a file of `write_msh`."""
    parts = {name: body.splitlines()[1:] for name, body in re.findall(r"\$(\w+)\n(.*?)\n\$End", file.read_text(), re.S)}
    nodes = np.array([line.split()[1:] for line in parts["Nodes"]], dtype=float)
    rows = [list(map(int, line.split())) for line in parts["Elements"]]
    names = {line.split('"')[1]: (int(line.split()[0]), int(line.split()[1])) for line in parts["PhysicalNames"]}
    return nodes, [(row[1], row[3], [node - 1 for node in row[5:]]) for row in rows], names


SLIT = (1.1854130, 2.8973937)
"""Frequencies 1 and 3 of a tank of 10 m × 2 m with a wall of 1.2 m on its bed in the middle, rad/s, certain to 1e-7: of
polynomials of degree 10 on triangles graded to its top."""


def below_the_top(place: np.ndarray) -> bool:
    return bool(place[-1] < -0.85)


def with_the_top(place: np.ndarray) -> bool:
    return bool(place[-1] < -0.75)


@pytest.mark.parametrize("kind", ["section", "volume"])
def test_a_declared_baffle_has_the_frequencies_of_its_wall_whether_its_nodes_are_doubled_or_not(kind: str) -> None:
    found = []
    for split in (below_the_top, None):
        if kind == "section":
            section_mesh(Path("tank.msh"), (10.0, 2.0), (20, 10), split=split, at=5.0, baffle=with_the_top)
            found.append(frequencies(of_section(10.0).replace("modes = 2", "modes = 3")))
        else:
            box_mesh(Path("tank.msh"), (10.0, 1.0, 2.0), (20, 1, 10), split=split, at=5.0, baffle=with_the_top)
            found.append(frequencies(of_box().replace("modes = 2", "modes = 3")))
    # One problem, with nodes in another order: rounding.
    assert found[0] == pytest.approx(found[1], rel=1e-9)
    # The asked tolerance is 1e-2, and Ritz values come from above.
    for omega, exact in zip(found[0][::2], SLIT, strict=True):
        assert 0.0 < omega / exact - 1.0 < 1e-2


def test_check_and_run_tell_the_baffles_of_a_mesh() -> None:
    box_mesh(Path("tank.msh"), (10.0, 1.0, 2.0), (20, 1, 10), at=5.0, baffle=with_the_top)
    told = " ".join(invoke("check", of_box()).stdout.replace("│", " ").split())
    assert "10 m × 1 m at the still surface, 2 m deep, with 1.2 m² of baffles" in told
    Path("scene.toml").write_text(of_box(), encoding="utf-8")
    assert "with 1.2 m² of baffles" in he.solve(he.read("scene.toml")).summary["solver"]["model"]
    section_mesh(Path("tank.msh"), (10.0, 2.0), (20, 10), at=5.0, baffle=with_the_top)
    assert "1.2 m of baffles" in " ".join(invoke("check", of_section(10.0)).stdout.split())


def test_basins_that_a_baffle_divides_have_their_own_frequencies() -> None:
    """Two basins of 2 m: each has ω² = g k tanh kh with k = π/2; a section is refused, as one volume is kept there."""
    box_mesh(Path("tank.msh"), counts=(8, 1, 4), split=everywhere, baffle=everywhere)
    exact = (9.81 * 0.5 * np.pi * np.tanh(np.pi)) ** 0.5
    # The asked tolerance is 1e-2, and Ritz values come from above.
    for omega in frequencies(of_box()):
        assert 0.0 <= omega / exact - 1.0 < 1e-2
    section_mesh(Path("tank.msh"), split=everywhere, baffle=everywhere)
    assert 'the walls of group "baffle"' in refused(of_section())


def test_the_depth_is_that_of_the_mesh() -> None:
    box_mesh(Path("tank.msh"))
    found = [frequencies(of_box(depth)) for depth in ("", "depth = 2.0")]
    assert found[0] == found[1]
    line = refused(of_box("depth = 200.0"))
    assert '[[liquid]] number 1, key "depth" = 200.0' in line
    assert "is 2 m deep" in line


def test_a_mesh_in_millimetres_is_refused_or_its_size_is_told() -> None:
    box_mesh(Path("tank.msh"), scale=1e3)
    line = refused(of_box("depth = 2.0"))
    assert "is 2000 m deep, as its lengths are taken in metres" in line
    told = " ".join(invoke("check", of_box()).stdout.replace("│", " ").split())
    assert "4000 m × 1000 m at the still surface, 2000 m deep" in told
    result = invoke("run", of_box().replace("modes = 2", "modes = 1"))
    assert result.exit_code == 0, result.output
    assert "4000 m × 1000 m at the still surface, 2000 m deep" in " ".join(
        Path("results/summary.md").read_text().split()
    )


def test_a_section_in_millimetres_is_refused() -> None:
    section_mesh(Path("tank.msh"), (4000.0, 2000.0))
    line = refused(of_section())
    assert "the mesh fills 0 < x/L < 1000, -500 < y/L < 0" in line
    assert "taken in metres" in line


def test_a_depth_is_needed_where_no_mesh_tells_it() -> None:
    line = refused('kind = "tank"\n[tank]\nlength = 4.0\nwidth = 2.0\n[[liquid]]\ndensity = 1000.0\n')
    assert '[[liquid]] number 1, key "depth": it is missing' in line


def prisms() -> None:
    points = np.array([[x, y, z] for z in (-1.0, 0.0) for x, y in ((0.0, 0.0), (1.0, 0.0), (0.0, 1.0))])
    names = {"free_surface": (2, 1), "liquid": (3, 2)}
    write_msh(Path("tank.msh"), points, [(6, 2, range(6)), (2, 1, (3, 4, 5))], names)


def hexahedra() -> None:
    corners = ((0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0))
    points = np.array([[x, y, z] for z in (-1.0, 0.0) for x, y in corners])
    names = {"free_surface": (2, 1), "liquid": (3, 2)}
    write_msh(Path("tank.msh"), points, [(5, 2, range(8)), (3, 1, (4, 5, 6, 7))], names)


def edited(old: str, new: str, *, times: int = 1) -> Callable[[], None]:
    def write() -> None:
        box_mesh(Path("tank.msh"))
        text = Path("tank.msh").read_text(encoding="ascii")
        assert old in text
        Path("tank.msh").write_text(text.replace(old, new, times), encoding="ascii")

    return write


def flat() -> None:
    box_mesh(Path("tank.msh"))
    points, elements, names = read_msh(Path("tank.msh"))
    points[7] = points[6]
    write_msh(Path("tank.msh"), points, elements, names)


@pytest.mark.parametrize(
    ("write", "words"),
    [
        (prisms, "cells of other kinds (prism); only tetrahedra"),
        (hexahedra, "cells of other kinds (hexahedron); only tetrahedra"),
        (edited("1 0.0 0.0 -2.0", "1 nan 0.0 -2.0"), "coordinates are not finite"),
        (edited("1 0.0 0.0 -2.0", "1 inf 0.0 -2.0"), "coordinates are not finite"),
        (edited("1 0.0 0.0 -2.0", "1 1e300 0.0 -2.0"), "beyond 1e+30 m"),
        (edited("$Elements\n", "$Elements\n9"), "cannot be read"),
        (edited("$Nodes\n30", "$Nodes\n99999999999"), "cannot be read"),
        (edited("free_surface", "surface"), 'no physical surface "free_surface"'),
        (flat, "a tetrahedron without volume"),
    ],
)
def test_a_broken_mesh_is_one_clear_error(write: Callable[[], None], words: str) -> None:
    write()
    line = refused(of_box())
    assert '[tank], key "shape" = "tank.msh"' in line
    assert words in line
    assert "gmsh could not" not in line


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
file = "hull.stl"
draught = 0.25
vertical_centre_of_gravity = 0.0
radii_of_gyration = [0.3, 0.3, 0.4]
motions = ["heave"]
[accuracy]
tolerance = 1e-1
modes = 1
"""


def box_triangles() -> np.ndarray:
    """A box of 1 m, 0.5 m high, about the origin, shape (12, 3, 3)."""
    faces = []
    for axis in range(3):
        for side in (-0.5, 0.5):
            corners = np.array([[a, b] for a, b in ((-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5))])
            face = np.insert(corners, axis, side, axis=1)[:: 1 if (side > 0) != (axis == 1) else -1]
            faces += [face[[0, 1, 2]], face[[0, 2, 3]]]
    return np.array(faces) * [1.0, 1.0, 0.5]


def write_stl(triangles: np.ndarray, *, binary: bool) -> None:
    if not binary:
        lines = [f"vertex {x!r} {y!r} {z!r}" for x, y, z in triangles.reshape(-1, 3).tolist()]
        facets = [
            "\n".join(["facet normal 0 0 0", "outer loop", *lines[i : i + 3], "endloop", "endfacet"])
            for i in range(0, len(lines), 3)
        ]
        Path("hull.stl").write_text("\n".join(["solid facet of a vertex", *facets, "endsolid", ""]), encoding="ascii")
        return
    rows = np.zeros(len(triangles), dtype=[("numbers", "<f4", (4, 3)), ("unused", "<u2")])
    rows["numbers"][:, 1:] = triangles
    # Some programs begin binary files as those of text.
    header = b"solid of bytes".ljust(80)
    Path("hull.stl").write_bytes(header + np.uint32(len(triangles)).tobytes() + rows.tobytes())


@pytest.mark.parametrize("binary", [False, True])
def test_triangles_of_text_and_bytes_are_one_hull(binary: bool) -> None:
    write_stl(box_triangles(), binary=binary)
    told = " ".join(invoke("check", HULL).stdout.split())
    # 1 m × 1 m × 0.25 m; single precision holds these numbers.
    assert re.search(r"250\b", told), told


@pytest.mark.parametrize("binary", [False, True])
@pytest.mark.parametrize("number", [np.nan, np.inf, 1e38])
def test_a_hull_with_a_corner_that_is_no_place_is_refused(number: float, binary: bool) -> None:
    triangles = box_triangles()
    triangles[4, 1, 2] = number
    write_stl(triangles, binary=binary)
    line = refused(HULL)
    assert '[[body]] number 1, key "file" = "hull.stl": triangle 5 in' in line
    assert "not finite" in line
