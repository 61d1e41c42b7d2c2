"""Meshes survive a round trip through files, bad files are refused in words, a user's own mesh gives the same tones."""

from __future__ import annotations

import json
from dataclasses import fields, replace
from pathlib import Path
from typing import Any

import gmsh
import meshio
import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from scene_files import BEAM_IN_TANK

from hydroelastic.meshes.files import load_mesh, save_mesh
from hydroelastic.meshes.formats import FORMATS
from hydroelastic.meshes.geometry import tank_geometry
from hydroelastic.meshes.grading import Grading
from hydroelastic.meshes.tagged_mesh import MeshError, TaggedMesh
from hydroelastic.meshes.tank import build_tank_mesh
from hydroelastic.scenes.errors import SceneError
from hydroelastic.scenes.kinds import checker_of
from hydroelastic.scenes.models.tank import TankScene
from hydroelastic.scenes.models.tank_parts import MeshFile
from hydroelastic.scenes.read import read_scene
from hydroelastic.scenes.run import run_scene

PIECES = ((0.0, 0.3, "free_surface"), (0.3, 0.7, "body_1"), (0.7, 1.0, "free_surface"))


@pytest.fixture(scope="module")
def mesh() -> TaggedMesh:
    geometry = tank_geometry(length=1.0, depth=0.5, pieces=PIECES)
    return build_tank_mesh(geometry, Grading(surface_sizes=(0.1,) * 3, bulk_size=0.25, tip_size=1e-8))


@pytest.fixture
def content() -> meshio.Mesh:
    """Two triangles that fill a square, their edges tagged, as other programs write them."""
    return meshio.Mesh(
        [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, -1.0, 0.0], [0.0, -1.0, 0.0]],
        [("line", [[0, 1], [1, 2], [2, 3], [3, 0]]), ("triangle", [[0, 1, 2], [0, 2, 3]])],
        cell_data={"gmsh:physical": [np.array([1, 2, 3, 4]), np.array([5, 5])]},
        field_data={
            "free_surface": np.array([1, 1]),
            "right_wall": np.array([2, 1]),
            "bottom": np.array([3, 1]),
            "left_wall": np.array([4, 1]),
            "liquid": np.array([5, 2]),
        },
    )


def write(content: meshio.Mesh, path: Path) -> Path:
    if path.suffix == ".msh":
        content.cell_data["gmsh:geometrical"] = content.cell_data["gmsh:physical"]
        meshio.write(path, content, file_format="gmsh22", binary=False)
    else:
        meshio.write(path, content)
    return path


@pytest.mark.parametrize("suffix", FORMATS)
def test_a_mesh_comes_back_as_it_was_saved(mesh: TaggedMesh, suffix: str, tmp_path: Path) -> None:
    path = tmp_path / f"tank{suffix}"
    save_mesh(mesh, path)
    loaded = load_mesh(path)
    assert loaded.cell_names == mesh.cell_names
    assert loaded.facet_names == mesh.facet_names
    # Text formats keep at least the 16 digits of a double near one.
    assert np.abs(loaded.points - mesh.points).max() <= 1e-15
    for name in ("cells", "cell_tags", "facets", "facet_tags"):
        assert np.array_equal(getattr(loaded, name), getattr(mesh, name)), name


def test_the_first_ring_keeps_its_place_in_every_format(mesh: TaggedMesh, tmp_path: Path) -> None:
    """The innermost nodes lie 1e-9 from a tip: rounding to single precision would fold the rings."""
    distances = []
    for suffix in FORMATS:
        save_mesh(mesh, tmp_path / f"tank{suffix}")
        points = load_mesh(tmp_path / f"tank{suffix}").points
        distances.append(np.sort(np.linalg.norm(points - [0.3, 0.0], axis=1))[1])
    expected = np.sort(np.linalg.norm(mesh.points - [0.3, 0.0], axis=1))[1]
    assert distances == pytest.approx([expected] * len(FORMATS), rel=1e-6)


def test_another_suffix_is_refused_with_those_that_are_known(mesh: TaggedMesh, tmp_path: Path) -> None:
    with pytest.raises(MeshError, match=r"must end in one of \.msh, \.vtu, \.xdmf"):
        save_mesh(mesh, tmp_path / "tank.stl")
    with pytest.raises(MeshError, match=r"must end in one of \.msh, \.vtu, \.xdmf"):
        load_mesh(tmp_path / "tank.stl")


def test_a_missing_file_is_refused(tmp_path: Path) -> None:
    with pytest.raises(MeshError, match=r"nothing\.msh does not exist"):
        load_mesh(tmp_path / "nothing.msh")


@pytest.mark.parametrize("suffix", FORMATS)
@pytest.mark.parametrize("text", ["", "no mesh\n", "<xml", "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n3\n1 0 0\n"])
def test_a_file_that_is_no_mesh_is_refused(
    text: str, suffix: str, tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    """In our words alone: the library that reads it prints its own, and would exit."""
    path = tmp_path / f"tank{suffix}"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(MeshError) as caught:
        load_mesh(path)
    assert str(caught.value) in (
        f"mesh file {path} cannot be read: it is broken, or not {FORMATS[suffix]}",
        f"mesh file {path} holds no triangles or no boundary edges with physical groups (gmsh:physical); "
        "give every boundary edge and every cell a physical group",
    )
    assert capfd.readouterr() == ("", "")


@pytest.mark.parametrize(
    ("number", "place", "said"),
    [
        (2, [np.nan, -1.0, 0.0], "a node whose coordinates are not finite"),
        (2, [1e300, np.inf, 0.0], "a node whose coordinates are not finite"),
        (2, [0.5, -0.5, 0.0], r"a triangle without area near"),
    ],
)
def test_a_mesh_that_fills_nothing_is_refused(
    content: meshio.Mesh, number: int, place: list[float], said: str, tmp_path: Path
) -> None:
    """NaN passes each comparison with a limit."""
    content.points[3 if "area" in said else number] = place
    with pytest.raises(MeshError, match=said):
        load_mesh(write(content, tmp_path / "tank.msh"))


def test_a_triangle_with_a_node_that_is_not_there_is_refused(content: meshio.Mesh, tmp_path: Path) -> None:
    content.cells[1] = meshio.CellBlock("triangle", np.array([[0, 1, 2], [0, 2, 9]]))
    with pytest.raises(MeshError, match=r"a triangle with a node that is not there|cannot be read"):
        load_mesh(write(content, tmp_path / "tank.msh"))


@pytest.mark.slow
@settings(
    derandomize=True, deadline=None, max_examples=150, suppress_health_check=[HealthCheck.function_scoped_fixture]
)
@given(data=st.data(), suffix=st.sampled_from(list(FORMATS)))
def test_a_damaged_file_is_read_or_refused_in_words(
    mesh: TaggedMesh, data: st.DataObject, suffix: str, tmp_path: Path
) -> None:
    """Bytes changed, left out or doubled anywhere: no other exception than ours comes out, and no NaN goes in."""
    path = tmp_path / f"tank{suffix}"
    save_mesh(mesh, path)
    whole = path.read_bytes()
    start = data.draw(st.integers(0, len(whole)))
    end = min(start + data.draw(st.integers(0, 40)), len(whole))
    instead = data.draw(
        st.one_of(st.binary(max_size=8), st.just(2 * whole[start:end]), st.just(b"nan "), st.just(b" 99999 "))
    )
    path.write_bytes(whole[:start] + instead + whole[end:])
    try:
        loaded = load_mesh(path)
    except MeshError:
        return
    assert np.isfinite(loaded.points).all()
    assert loaded.cells.max() < len(loaded.points)


def test_a_mesh_without_names_is_refused(content: meshio.Mesh, tmp_path: Path) -> None:
    content.field_data = {}
    with pytest.raises(MeshError, match=r"has no physical names, and there is no tank\.vtu\.names\.json beside it"):
        load_mesh(write(content, tmp_path / "tank.vtu"))
    with pytest.raises(MeshError, match="has no physical names"):
        load_mesh(write(content, tmp_path / "tank.msh"))


def test_a_mesh_without_groups_is_refused(content: meshio.Mesh, tmp_path: Path) -> None:
    path = tmp_path / "tank.vtu"
    meshio.write(path, meshio.Mesh(content.points, content.cells))
    with pytest.raises(MeshError, match="give every boundary edge and every cell a physical group"):
        load_mesh(path)


@pytest.mark.parametrize("text", ["", "{", "[]", '{"cells": {}}', '{"cells": {"liquid": "one"}, "facets": {}}'])
def test_a_broken_names_file_is_refused(content: meshio.Mesh, text: str, tmp_path: Path) -> None:
    path = write(content, tmp_path / "tank.vtu")
    path.with_name("tank.vtu.names.json").write_text(text, encoding="utf-8")
    with pytest.raises(MeshError, match=r"names"):
        load_mesh(path)


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
    with pytest.raises(MeshError, match=f"elements of type {kind}; only straight triangles are read"):
        load_mesh(write(content, tmp_path / "tank.msh"))


def test_nodes_of_no_triangle_are_left_out(content: meshio.Mesh, tmp_path: Path) -> None:
    content.points = np.vstack([[[9.0, 9.0, 0.0]], content.points])
    content.cells = [meshio.CellBlock(block.type, block.data + 1) for block in content.cells]
    loaded = load_mesh(write(content, tmp_path / "tank.msh"))
    assert len(loaded.points) == 4
    assert sorted(map(tuple, loaded.facet_nodes("free_surface").tolist())) == [(0.0, 0.0), (1.0, 0.0)]


def test_tagged_edges_of_no_triangle_are_refused(content: meshio.Mesh, tmp_path: Path) -> None:
    content.points = np.vstack([content.points, [[9.0, 9.0, 0.0]]])
    content.cells[0] = meshio.CellBlock("line", np.array([[0, 1], [1, 2], [2, 3], [3, 4]]))
    with pytest.raises(MeshError, match="tagged edges that belong to no triangle"):
        load_mesh(write(content, tmp_path / "tank.msh"))


def test_all_missing_groups_are_named_at_once(mesh: TaggedMesh) -> None:
    mesh.require(cells=["liquid"], facets=["body_1", "free_surface"])
    with pytest.raises(MeshError) as caught:
        mesh.require(cells=["liquid", "oil"], facets=["body_1", "body_2", "lid"])
    assert "physical groups of cells missing: oil (there are: liquid)" in str(caught.value)
    assert "edges missing: body_2, lid (there are: body_1, bottom, free_surface, left_wall" in str(caught.value)


def test_a_group_without_elements_is_missing(mesh: TaggedMesh) -> None:
    empty = replace(mesh, facet_names=mesh.facet_names | {"lid": 99})
    with pytest.raises(MeshError, match="edges missing: lid"):
        empty.require(cells=[], facets=["lid"])


def test_scaling_changes_the_coordinates_alone(mesh: TaggedMesh) -> None:
    scaled = mesh.scaled(10.0)
    assert np.array_equal(scaled.points, 10.0 * mesh.points)
    kept = [field.name for field in fields(mesh) if field.name not in ("points", "deviation")]
    assert all(getattr(scaled, name) is getattr(mesh, name) for name in kept)


def users_mesh(path: Path, *, start: float = 3.0, end: float = 7.0, depth: float = 5.0, name: str = "body_1") -> Path:
    """A tank of 10 m as a user makes it with gmsh: sizes given at points, physical groups, written by gmsh itself."""
    if not gmsh.isInitialized():
        gmsh.initialize(readConfigFiles=False, interruptible=False)
    gmsh.option.setNumber("General.Verbosity", 0)
    gmsh.model.add("by a user")
    middle = 0.5 * (start + end)
    place = [(0, 0, 1), (start, 0, 1e-5), (middle, 0, 0.5), (end, 0, 1e-5), (10, 0, 1), (10, -depth, 2), (0, -depth, 2)]
    points = [gmsh.model.geo.addPoint(x, y, 0, size) for x, y, size in place]
    lines = [gmsh.model.geo.addLine(a, b) for a, b in zip(points, [*points[1:], points[0]], strict=True)]
    surface = gmsh.model.geo.addPlaneSurface([gmsh.model.geo.addCurveLoop(lines)])
    gmsh.model.geo.synchronize()
    gmsh.model.addPhysicalGroup(1, [lines[0], lines[3]], 11, "free_surface")
    gmsh.model.addPhysicalGroup(1, lines[1:3], 12, name)
    gmsh.model.addPhysicalGroup(1, lines[4:], 13, "walls and bottom")
    gmsh.model.addPhysicalGroup(2, [surface], 21, "liquid")
    for option, value in (("FromPoints", 1), ("ExtendFromBoundary", 1)):
        gmsh.option.setNumber(f"Mesh.MeshSize{option}", value)
    gmsh.model.mesh.generate(2)
    gmsh.write(str(path))
    gmsh.model.remove()
    return path


def with_mesh(scene: TankScene, path: Path) -> TankScene:
    return scene.model_copy(update={"mesh": MeshFile(file=path)})


def test_a_users_own_mesh_gives_the_built_in_meshs_frequencies(tanks: Any, tmp_path: Path) -> None:
    """To the sum of the two estimated errors, the user's own tips being graded by point sizes alone."""
    scene = tanks.case_scene("base_s0")
    outcome = run_scene(with_mesh(scene, users_mesh(tmp_path / "tank.msh")))
    assert outcome.summary["status"] == "ok"
    expected = tanks.omega(scene)
    found = np.array([mode["omega"] for mode in outcome.summary["modes"]])
    allowed = tanks.solve(scene).relative_errors[:8] + outcome.solution.tank.relative_errors[:8]
    assert np.all(np.abs(found / expected - 1.0) <= allowed)


@pytest.mark.parametrize("suffix", FORMATS)
def test_the_built_in_mesh_brought_as_a_file_changes_nothing(tanks: Any, suffix: str, tmp_path: Path) -> None:
    scene = tanks.scene(tanks.beam(), modes=3)
    _, tagged = tanks.graded_mesh(scene)
    save_mesh(tagged.scaled(10.0), tmp_path / f"tank{suffix}")
    outcome = run_scene(with_mesh(scene, tmp_path / f"tank{suffix}"))
    found = [mode["omega"] for mode in outcome.summary["modes"]]
    # Both solutions keep 1e-6 by their own estimates; the reference has 14 digits.
    assert found == pytest.approx(tanks.cases["base_s0"]["omega"][:3], rel=1e-6)


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"start": 2.9}, "group body_1 of the mesh spans 0.29 < x/L < 0.7; the scene puts it at 0.3 < x/L < 0.7"),
        ({"end": 7.5}, "group body_1 of the mesh spans 0.3 < x/L < 0.75"),
        ({"depth": 4.0}, "the mesh fills 0 < x/L < 1, -0.4 < y/L < 0; the scene's liquid fills 0 < x/L < 1, -0.5"),
        ({"name": "beam"}, "edges missing: body_1 (there are: beam, free_surface, walls and bottom)"),
    ],
)
def test_a_mesh_of_another_tank_is_refused_in_words(
    tanks: Any, changes: dict[str, Any], message: str, tmp_path: Path
) -> None:
    path = users_mesh(tmp_path / "tank.msh", **changes)
    with pytest.raises(SceneError) as caught:
        run_scene(with_mesh(tanks.scene(tanks.beam()), path))
    said = " ".join(str(caught.value).split())
    assert message in said
    assert str(path) in said


def test_what_a_run_would_refuse_of_a_mesh_a_check_refuses_with_the_same_words(
    tmp_path: Path, capfd: pytest.CaptureFixture[str]
) -> None:
    scene = tmp_path / "scene.toml"
    scene.write_text(f'{BEAM_IN_TANK}[mesh]\nfile = "tank.msh"\n', encoding="utf-8")
    (tmp_path / "tank.msh").write_text("garbage\n", encoding="utf-8")
    said = []
    for use in (run_scene, lambda scene: tuple(checker_of(scene)(scene))):
        with pytest.raises(SceneError) as caught:
            use(read_scene(scene))
        said.append(str(caught.value))
    assert said[0] == said[1]
    mesh = tmp_path / "tank.msh"
    assert said[0] == (
        f'{scene}: [mesh], key "file" = "{mesh}": mesh file {mesh} cannot be read: it is broken, or not a mesh of '
        "gmsh, format 2.2 or 4.1, as gmsh writes it. Correct the mesh, or leave [mesh] out to use the built-in one."
    )
    assert capfd.readouterr() == ("", "")
    users_mesh(mesh, end=7.5)
    with pytest.raises(SceneError, match="the scene puts it at"):
        tuple(checker_of(read_scene(scene))(read_scene(scene)))
    users_mesh(mesh)
    sections = checker_of(read_scene(scene))(read_scene(scene))
    assert any("triangles" in line for section in sections for line in section.lines)


def test_water_without_its_group_is_refused(tanks: Any, tmp_path: Path) -> None:
    """An edge of the water left out of its group would silently be a piece of rigid lid."""
    scene = tanks.scene(tanks.beam(), modes=3)
    _, tagged = tanks.graded_mesh(scene)
    on_water = tagged.facet_tags == tagged.facet_names["free_surface"]
    middle = tagged.points[tagged.facets].mean(axis=1)
    left_out = on_water & (middle[:, 0] > 0.1) & (middle[:, 0] < 0.25)
    assert left_out.any()
    holed = replace(tagged, facets=tagged.facets[~left_out], facet_tags=tagged.facet_tags[~left_out])
    save_mesh(holed.scaled(10.0), tmp_path / "tank.msh")
    with pytest.raises(SceneError, match="free_surface"):
        run_scene(with_mesh(scene, tmp_path / "tank.msh"))


def test_names_are_written_beside_formats_that_hold_none(mesh: TaggedMesh, tmp_path: Path) -> None:
    save_mesh(mesh, tmp_path / "tank.vtu")
    names = json.loads((tmp_path / "tank.vtu.names.json").read_text(encoding="utf-8"))
    assert names == {"cells": mesh.cell_names, "facets": mesh.facet_names}
