"""Meshes of one's own: what gmsh writes has the frequencies of the built-in mesh, bad files are refused in words."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import gmsh
import meshio
import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

import hydroelastic as he
from hydroelastic.meshes.files import load_mesh, save_mesh
from hydroelastic.meshes.tagged_mesh import MeshError

FORMATS = (".msh", ".vtu", ".xdmf")
BEAM = {"start": 3.0, "length": 4.0, "flexural_rigidity": 5e3, "mass_per_length": 50.0}


def scene(mesh: Path | None, *bodies: dict[str, Any], size: float = 10.0, tolerance: float = 1e-6) -> dict[str, Any]:
    """A tank half as deep as it is long."""
    liquid = [{"density": 1000.0, "depth": 0.5 * size}]
    document = {"kind": "tank", "tank": {"length": size}, "liquid": liquid, "body": list(bodies)}
    own = {"mesh": {"file": str(mesh)}} if mesh else {}
    return document | own | {"accuracy": {"tolerance": tolerance, "modes": 3}}


def refused(mesh: Path, *bodies: dict[str, Any], size: float = 10.0) -> str:
    with pytest.raises(he.SceneError) as caught:
        he.solve(scene(mesh, *bodies, size=size, tolerance=1e-2))
    said = " ".join(str(caught.value).split())
    assert '[mesh], key "file"' in said
    assert str(mesh) in said
    return said


def users_mesh(
    path: Path, *, start: float = 3.0, end: float = 7.0, depth: float = 5.0, name: str = "body_1", hole: bool = False
) -> Path:
    """A tank of 10 m as a user makes it with gmsh: sizes given at points, physical groups, written by gmsh itself."""
    gmsh.initialize(readConfigFiles=False, interruptible=False)
    gmsh.option.setNumber("General.Verbosity", 0)
    gmsh.model.add("by a user")
    middle = 0.5 * (start + end)
    place = [(0, 0, 1), (start, 0, 1e-5), (middle, 0, 0.5), (end, 0, 1e-5), (10, 0, 1), (10, -depth, 2), (0, -depth, 2)]
    points = [gmsh.model.geo.addPoint(x, y, 0, size) for x, y, size in place]
    lines = [gmsh.model.geo.addLine(a, b) for a, b in zip(points, [*points[1:], points[0]], strict=True)]
    surface = gmsh.model.geo.addPlaneSurface([gmsh.model.geo.addCurveLoop(lines)])
    gmsh.model.geo.synchronize()
    # A piece of the water left out of its group would silently be rigid lid.
    gmsh.model.addPhysicalGroup(1, [lines[0]] if hole else [lines[0], lines[3]], 11, "free_surface")
    gmsh.model.addPhysicalGroup(1, lines[1:3], 12, name)
    gmsh.model.addPhysicalGroup(1, [*lines[4:], lines[3]] if hole else lines[4:], 13, "walls and bottom")
    gmsh.model.addPhysicalGroup(2, [surface], 21, "liquid")
    for option, value in (("FromPoints", 1), ("ExtendFromBoundary", 1)):
        gmsh.option.setNumber(f"Mesh.MeshSize{option}", value)
    gmsh.model.mesh.generate(2)
    gmsh.write(str(path))
    gmsh.model.remove()
    return path


def named(path: Path, groups: dict[str, Any]) -> Path:
    """Write the names of groups beside a format that holds none."""
    path.with_name(path.name + ".names.json").write_text(json.dumps(groups), encoding="utf-8")
    return path


def converted(mesh: Path, suffix: str) -> Path:
    """The same mesh in another format, to the last digit."""
    content = meshio.read(mesh)
    path = mesh.with_suffix(suffix)
    meshio.write(path, meshio.Mesh(content.points, content.cells, cell_data=content.cell_data))
    tags = {name: (int(tag), int(dim)) for name, (tag, dim) in content.field_data.items()}
    groups = {"cells": {n: tag for n, (tag, dim) in tags.items() if dim == 2}}
    return named(path, groups | {"facets": {n: tag for n, (tag, dim) in tags.items() if dim == 1}})


def test_a_users_own_mesh_gives_the_built_in_meshs_frequencies(tmp_path: Path) -> None:
    """To the sum of the two estimated errors, the user's own tips being graded by point sizes alone."""
    exact = he.solve(scene(None, BEAM)).modes
    mesh = users_mesh(tmp_path / "tank.msh")
    found = {suffix: he.solve(scene(converted(mesh, suffix) if suffix != ".msh" else mesh, BEAM)) for suffix in FORMATS}
    for result in found.values():
        assert result.summary["status"] == "ok"
        errors = np.abs(result.modes.omega / exact.omega - 1.0)
        assert np.all(errors <= result.modes.relative_error + exact.relative_error)
        # One mesh, whose innermost nodes lie 1e-5 from a tip: rounding to single precision would show.
        assert result.modes.omega == pytest.approx(found[".msh"].modes.omega, rel=1e-10)


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"start": 2.9}, "group body_1 of the mesh spans 0.29 < x/L < 0.7; the scene puts it at 0.3 < x/L < 0.7"),
        ({"end": 7.5}, "group body_1 of the mesh spans 0.3 < x/L < 0.75"),
        ({"depth": 4.0}, "the mesh fills 0 < x/L < 1, -0.4 < y/L < 0; the scene's liquid fills 0 < x/L < 1, -0.5"),
        ({"name": "beam"}, "edges missing: body_1 (there are: beam, free_surface, walls and bottom)"),
        ({"hole": True}, "free_surface"),
    ],
)
def test_a_mesh_of_another_tank_is_refused_in_words(changes: dict[str, Any], message: str, tmp_path: Path) -> None:
    assert message in refused(users_mesh(tmp_path / "tank.msh", **changes), BEAM)


@pytest.mark.parametrize("suffix", FORMATS)
@pytest.mark.parametrize("text", ["", "no mesh\n", "<xml", "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n3\n1 0 0\n"])
def test_a_file_that_is_no_mesh_is_refused(
    text: str, suffix: str, tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    """In our words alone: the library that reads it prints its own, and would exit."""
    path = tmp_path / f"tank{suffix}"
    path.write_text(text, encoding="utf-8")
    said = refused(path, BEAM)
    assert "cannot be read: it is broken" in said or "holds no triangles or no boundary edges" in said
    assert capfd.readouterr() == ("", "")


def test_other_files_are_refused(tmp_path: Path) -> None:
    (tmp_path / "tank.stl").write_text("solid\n", encoding="utf-8")
    with pytest.raises(he.SceneError, match=r"\.msh, .*\.vtu, .*\.xdmf"):
        he.solve(scene(tmp_path / "tank.stl", BEAM))
    with pytest.raises(he.SceneError, match=r"nothing\.msh"):
        he.solve(scene(tmp_path / "nothing.msh", BEAM))


@pytest.fixture
def content() -> meshio.Mesh:
    """Two triangles that fill a square, their edges tagged, as other programs write them."""
    names = {"free_surface": (1, 1), "right_wall": (2, 1), "bottom": (3, 1), "left_wall": (4, 1), "liquid": (5, 2)}
    return meshio.Mesh(
        [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, -0.5, 0.0], [0.0, -0.5, 0.0]],
        [("line", [[0, 1], [1, 2], [2, 3], [3, 0]]), ("triangle", [[0, 1, 2], [0, 2, 3]])],
        cell_data={"gmsh:physical": [np.array([1, 2, 3, 4]), np.array([5, 5])]},
        field_data={name: np.array(group) for name, group in names.items()},
    )


def write(content: meshio.Mesh, path: Path) -> Path:
    if path.suffix == ".msh":
        content.cell_data["gmsh:geometrical"] = content.cell_data["gmsh:physical"]
        meshio.write(path, content, file_format="gmsh22", binary=False)
    else:
        meshio.write(path, content)
    return path


@pytest.mark.parametrize(
    ("number", "place", "said"),
    [
        (2, [np.nan, -1.0, 0.0], "a node whose coordinates are not finite"),
        (2, [1e300, np.inf, 0.0], "a node whose coordinates are not finite"),
        (3, [0.5, -0.25, 0.0], "a triangle without area near"),
    ],
)
def test_a_mesh_that_fills_nothing_is_refused(
    content: meshio.Mesh, number: int, place: list[float], said: str, tmp_path: Path
) -> None:
    """NaN passes each comparison with a limit."""
    content.points[number] = place
    assert said in refused(write(content, tmp_path / "tank.msh"), size=1.0)


def test_what_is_missing_in_a_mesh_is_named(content: meshio.Mesh, tmp_path: Path) -> None:
    """Names of groups, groups, and nodes."""
    names = {"cells": {"liquid": 5}, "facets": {"free_surface": 1}}
    plain = tmp_path / "plain.vtu"
    meshio.write(plain, meshio.Mesh(content.points, content.cells))
    assert "give every boundary edge and every cell a physical group" in refused(named(plain, names), size=1.0)
    nameless = write(content, tmp_path / "nameless.vtu")
    said = refused(nameless, size=1.0)
    assert "has no physical names, and there is no nameless.vtu.names.json beside it" in said
    for broken in ([], {"cells": {}}, {"cells": {"liquid": "one"}, "facets": {}}):
        assert "names" in refused(named(nameless, broken), size=1.0)
    content.cells[1] = meshio.CellBlock("triangle", np.array([[0, 1, 2], [0, 2, 9]]))
    said = refused(write(content, tmp_path / "tank.msh"), size=1.0)
    assert "a triangle with a node that is not there" in said or "cannot be read" in said


@pytest.mark.parametrize(
    ("kind", "nodes"), [("quad", [[0, 1, 2, 3]]), ("triangle6", [[0, 1, 2, 4, 5, 6]]), ("tetra", [[0, 1, 2, 4]])]
)
def test_other_elements_than_straight_triangles_are_refused_by_name(
    kind: str, nodes: list[Any], tmp_path: Path
) -> None:
    points = [[0, 0, 0], [1, 0, 0], [1, -1, 0], [0, -1, 0], [0.5, 0, 0], [1, -0.5, 0], [0.5, -0.5, 0]]
    content = meshio.Mesh(
        np.array(points, dtype=float),
        [("line", [[0, 1]]), (kind, nodes)],
        cell_data={"gmsh:physical": [np.array([1]), np.array([2])]},
        field_data={"free_surface": np.array([1, 1]), "liquid": np.array([2, 2])},
    )
    said = refused(write(content, tmp_path / "tank.msh"), size=1.0)
    assert f"elements of type {kind}; only straight triangles are read" in said


@pytest.mark.slow
@settings(derandomize=True, deadline=None, max_examples=60, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(data=st.data(), suffix=st.sampled_from(FORMATS))
def test_a_damaged_file_is_read_or_refused_in_words(
    content: meshio.Mesh, data: st.DataObject, suffix: str, tmp_path: Path
) -> None:
    """Bytes changed, left out or doubled anywhere: no other exception than ours comes out, and no NaN goes in."""
    names = {"cells": {"liquid": 5}, "facets": {"free_surface": 1, "right_wall": 2, "bottom": 3, "left_wall": 4}}
    path = named(write(content, tmp_path / f"tank{suffix}"), names)
    whole = path.read_bytes()
    start = data.draw(st.integers(0, len(whole)))
    end = min(start + data.draw(st.integers(0, 40)), len(whole))
    instead = data.draw(
        st.one_of(st.binary(max_size=8), st.just(2 * whole[start:end]), st.just(b"nan "), st.just(b" 99999 "))
    )
    path.write_bytes(whole[:start] + instead + whole[end:])
    try:
        result = he.solve(scene(path, size=1.0, tolerance=1e-1))
    except (he.SceneError, he.UnsolvedError):
        return
    assert np.isfinite(result.modes.omega).all()


def test_a_mesh_is_written_and_read_back_in_each_format(tmp_path: Path) -> None:
    mesh = load_mesh(users_mesh(tmp_path / "tank.msh"))
    for suffix in FORMATS:
        save_mesh(mesh, tmp_path / f"again{suffix}")
        again = load_mesh(tmp_path / f"again{suffix}")
        np.testing.assert_allclose(again.points, mesh.points, rtol=0, atol=1e-14)
        for name in ("cells", "cell_tags", "facets", "facet_tags"):
            np.testing.assert_array_equal(getattr(again, name), getattr(mesh, name))
        assert (again.cell_names, again.facet_names) == (mesh.cell_names, mesh.facet_names)
    with pytest.raises(MeshError, match=r"tank\.stl.*\.msh"):
        save_mesh(mesh, tmp_path / "tank.stl")
