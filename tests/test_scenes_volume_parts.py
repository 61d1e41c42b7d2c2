"""Scenes with hulls, columns, baffles and two liquids in three dimensions: what follows, and what is refused."""

from __future__ import annotations

from itertools import islice
from pathlib import Path
from typing import Any

import gmsh
import numpy as np
import pytest
from mpi4py import MPI

from hydroelastic.meshes.filling import gmsh_model
from hydroelastic.output.level_tank.floats import FLOATS, floats_at_rest
from hydroelastic.physics.obstacles import LevelBaffle, VerticalBaffle
from hydroelastic.physics.plate import Disc
from hydroelastic.physics.volume_tank import VolumeTank
from hydroelastic.scenes.errors import SceneError
from hydroelastic.scenes.level_tank.check import check_level_tank
from hydroelastic.scenes.level_tank.solve import solve_level_scene
from hydroelastic.scenes.models.level_tank import LevelTankScene
from hydroelastic.scenes.models.level_tank_physics import physical_level_tank
from hydroelastic.scenes.read import read_scene

SCOW = "scow_in_a_basin"
WATER = {"density": 1000.0, "depth": 2.0}
CYLINDER = {"kind": "float", "shape": "cylinder", "radius": 1.0, "vertical_centre_of_gravity": -0.3}
OUTLINE = {"kind": "float", "shape": "revolved", "outline": [[0.0, -0.5], [0.6, -0.5], [0.9, 0.4], [0.0, 0.4]]}


def tank(**changes: Any) -> VolumeTank:
    given: dict[str, Any] = {"tank": {"length": 10.0, "width": 6.0}, "liquid": [WATER]}
    physical = physical_level_tank(LevelTankScene(**(given | changes)))
    assert isinstance(physical, VolumeTank)
    return physical


def test_a_mass_immerses_a_float_and_inertia_is_that_of_its_radii() -> None:
    (by_draught,) = tank(body=[CYLINDER | {"draught": 0.5}]).floats
    mass = 1000.0 * np.pi * 0.5
    (by_mass,) = tank(body=[CYLINDER | {"mass": mass}]).floats
    assert by_mass == by_draught
    moments = [mass * radius**2 for radius in (0.4, 0.5, 0.6)]
    (turning,) = tank(body=[CYLINDER | {"mass": mass, "draught": 0.5, "inertia": moments}]).floats
    assert turning.gyration == pytest.approx((0.4, 0.5, 0.6))
    # A sphere of the mass of half of it is half immersed; on a lighter upper liquid more.
    sphere = {"kind": "float", "shape": "sphere", "radius": 0.6, "mass": 2.0 / 3.0 * np.pi * 216.0}
    assert tank(body=[sphere]).floats[0].draught == pytest.approx(0.6)
    two = [{"density": 1025.0, "depth": 1.0}, {"density": 800.0, "depth": 1.5}]
    assert tank(body=[sphere], liquid=two).floats[0].hydrostatics.volume * 800.0 == pytest.approx(sphere["mass"])


def test_an_outline_floats_as_deep_as_its_mass_or_draught() -> None:
    (at_zero,), (drawn,) = (tank(body=[OUTLINE | changes]).floats for changes in ({}, {"draught": 0.5}))
    assert at_zero.draught == drawn.draught == 0.5
    mass = 1000.0 * at_zero.hydrostatics.volume
    (immersed,) = tank(body=[OUTLINE | {"mass": mass}]).floats
    assert immersed.draught == pytest.approx(0.5, rel=1e-9)
    # Homogeneous: the centre of the frustum, by h (R² + 2Rr + 3r²)/(4 (R² + Rr + r²)) from its larger end.
    top, bottom = 0.9, 0.6
    height = 0.9 * (top**2 + 2.0 * top * bottom + 3.0 * bottom**2) / (4.0 * (top**2 + top * bottom + bottom**2))
    assert at_zero.centre_of_gravity == pytest.approx(0.4 - height)


def test_the_shipped_hull_is_at_rest_in_its_place() -> None:
    """A prism: its section immersed to T has the area 2.8 T + (0.2 + 1.2) T²/2 but for the width of 1.6 m."""
    scene = read_scene(SCOW)
    assert isinstance(scene, LevelTankScene)
    physical = physical_level_tank(scene)
    assert isinstance(physical, VolumeTank)
    (at_rest,) = floats_at_rest(physical)
    draught = at_rest.draught
    assert 1.6 * (2.8 * draught + 0.7 * draught**2) == pytest.approx(2.5, rel=1e-6)
    length = 2.8 + 1.4 * draught
    assert at_rest.waterplane_area == pytest.approx(1.6 * length, rel=1e-6)
    values = FLOATS.evaluated(at_rest)
    assert values["mass"] == pytest.approx(2500.0, rel=1e-6)
    assert values["displaced_volume"] == pytest.approx(2.5, rel=1e-6)
    # BM of roll is b³l/12 over V.
    below = at_rest.centre_of_buoyancy[2] + 0.05
    assert values["metacentric_heights"][0] == pytest.approx(1.6**3 * length / 12.0 / 2.5 + below, rel=1e-6)
    assert at_rest.centre_of_gravity[:2] == at_rest.centre_of_buoyancy[:2]
    # The longer rake moves it: the waterplane's middle is before the centre of buoyancy.
    assert physical.floats[0].hydrostatics.first[0] > 0.01
    assert physical.baffles == (VerticalBaffle(start=(2.5, 0.0), end=(2.5, 6.0), bottom=-1.2),)
    assert physical.columns == (Disc(position=(10.0, 3.0), radius=0.6),)
    # Before a mesh is made for the size.
    titles = [section.title for section in islice(check_level_tank(scene), 3)]
    assert titles.index("Bodies at rest") < titles.index("Boundaries")


def test_horizontal_baffles_and_two_liquids_are_read() -> None:
    found = tank(
        liquid=[{"density": 1025.0, "depth": 0.5}, WATER], baffle=[{"level": -0.3, "radius": 1.0, "inner_radius": 0.5}]
    )
    assert found.baffles == (LevelBaffle(outline=Disc(position=(5.0, 3.0), radius=1.0, inner_radius=0.5), level=-0.3),)
    assert (found.depth, found.density, found.interface) == (2.5, 1000.0, -2.0)
    assert found.scaled().lower is not None
    assert found.scaled().lower.density == pytest.approx(1.025)  # type: ignore[union-attr]


BAD: dict[str, tuple[dict[str, Any], str]] = {
    "no draught and no mass": ({"body": [CYLINDER]}, "draught"),
    "mass beside draught": ({"body": [CYLINDER | {"draught": 0.5, "mass": 1000.0}]}, "displaces 1570.8 kg"),
    "inertia beside radii": (
        {"body": [CYLINDER | {"draught": 0.5, "inertia": [1.0] * 3, "radii_of_gyration": [1.0] * 3}]},
        "beside radii_of_gyration",
    ),
    "sinking": ({"body": [OUTLINE | {"mass": 1e5}]}, "it sinks"),
    "outline beside the axis": ({"body": [OUTLINE | {"outline": [[0.1, -0.5], [0.6, 0.0], [0.0, 0.4]]}]}, "r > 0"),
    "hull without file": ({"body": [{"kind": "float", "shape": "hull"}]}, "file"),
    "hull that is not there": (
        {
            "body": [
                {
                    "kind": "float",
                    "shape": "hull",
                    "file": "none.stl",
                    "vertical_centre_of_gravity": 0.0,
                    "radii_of_gyration": [1.0] * 3,
                }
            ]
        },
        "there is no file",
    ),
    "yaw of a round float": ({"body": [OUTLINE | {"motions": ["yaw"]}]}, "does not feel the yaw"),
    "unstable": ({"body": [CYLINDER | {"draught": 0.5, "vertical_centre_of_gravity": 3.0}]}, "unstable in"),
    "column in a float": (
        {"body": [CYLINDER | {"draught": 0.5}], "column": [{"radius": 0.5, "position": [6.0, 3.0]}]},
        "touches a column",
    ),
    "column outside": ({"column": [{"radius": 0.5, "position": [12.0, 3.0]}]}, "column does not lie inside"),
    "columns together": ({"column": [{"radius": 0.5}, {"size": [1.0, 1.0]}]}, "touches another one"),
    "two sections": ({"column": [{"radius": 0.5, "size": [1.0, 1.0]}]}, "two sections"),
    "baffle without end": ({"baffle": [{"start": [1.0, 0.0]}]}, 'key "end"'),
    "baffle of both kinds": ({"baffle": [{"start": [1.0, 0.0], "end": [1.0, 2.0], "radius": 1.0}]}, "vertical baffle"),
    "baffle above the water": ({"baffle": [{"level": 0.5, "radius": 1.0}]}, "not below the still surface"),
    "baffle upside down": (
        {"baffle": [{"start": [1.0, 0.0], "end": [1.0, 2.0], "bottom": -0.5, "top": -1.0}]},
        "does not reach into the liquid",
    ),
    "heavy liquid above": ({"liquid": [WATER, {"density": 1100.0, "depth": 1.0}]}, "not lighter than the lower one"),
    "float through the interface": (
        {"liquid": [{"density": 1025.0, "depth": 2.0}, {"density": 1000.0, "depth": 0.5}], "body": [OUTLINE]},
        "no liquid of the upper one below",
    ),
    "bed on a line": (
        {
            "tank": {
                "length": 10.0,
                "width": 6.0,
                "bed": {"points": [[0.0, 0.0, 0.0], [5.0, 1.0, 0.5], [10.0, 2.0, 0.2]]},
            }
        },
        "lie on a line",
    ),
    "bed with a point twice": (
        {
            "tank": {
                "length": 10.0,
                "width": 6.0,
                "bed": {"points": [[0.0, 0.0, 0.0], [0.0, 0.0, 0.5], [10.0, 2.0, 0.2], [2.0, 6.0, 0.1]]},
            }
        },
        "in one place",
    ),
    "baffle over a surveyed bed": (
        {
            "tank": {
                "length": 10.0,
                "width": 6.0,
                "bed": {"points": [[0.0, 0.0, 0.0], [10.0, 0.0, 0.5], [0.0, 6.0, 0.2]]},
            },
            "baffle": [{"level": -0.3, "radius": 1.0}],
        },
        "would stretch the baffle too",
    ),
}


@pytest.mark.parametrize("case", BAD)
def test_what_does_not_fit_is_refused(case: str) -> None:
    changes, said = BAD[case]
    given: dict[str, Any] = {"tank": {"length": 10.0, "width": 6.0}, "liquid": [WATER]}
    with pytest.raises((SceneError, ValueError), match=said):
        LevelTankScene(**(given | changes))


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"baffle": [{"start": [12.0, 0.0], "end": [12.0, 6.0]}]}, "a baffle does not lie in the liquid"),
        (
            {"body": [CYLINDER | {"draught": 0.5}], "baffle": [{"start": [5.0, 0.0], "end": [5.0, 6.0]}]},
            "a baffle meets a float",
        ),
    ],
)
def test_what_only_its_volume_shows_is_an_error_of_the_scene(changes: dict[str, Any], said: str) -> None:
    """With the exit code of one: nothing can be solved until the scene is mended."""
    scene = LevelTankScene(**({"tank": {"length": 10.0, "width": 6.0}, "liquid": [WATER]} | changes))
    with pytest.raises(SceneError, match=said):
        list(check_level_tank(scene))
    with pytest.raises(SceneError, match=said):
        solve_level_scene(scene, MPI.COMM_SELF, lambda _message: None)


@pytest.mark.parametrize("x", [9.0, 0.5])
def test_a_float_beside_a_solid_of_cad_or_at_its_wall_is_refused(x: float, tmp_path: Path) -> None:
    with gmsh_model():
        gmsh.model.occ.addBox(0.0, 0.0, 0.0, 4.0, 3.0, 2.0)
        gmsh.model.occ.synchronize()
        gmsh.option.setString("Geometry.OCCTargetUnit", "M")
        gmsh.write(str(tmp_path / "tank.step"))
    body = CYLINDER | {"radius": 0.5, "draught": 0.4, "position": [x, 1.5], "vertical_centre_of_gravity": -0.1}
    scene = LevelTankScene(tank={"shape": str(tmp_path / "tank.step")}, liquid=[WATER], body=[body])
    with pytest.raises(SceneError, match="body 1 does not lie in the liquid, or touches the tank"):
        list(check_level_tank(scene))
    inside = scene.model_copy(update={"body": (scene.body[0].model_copy(update={"position": (2.0, 1.5)}),)})
    assert any("tetrahedra" in line for line in list(check_level_tank(inside))[-1].lines)


def test_a_hull_with_a_hole_is_refused_with_file_and_place(tmp_path: Path) -> None:
    import hydroelastic.scenes.read as reading

    folder = reading.SHIPPED_FOLDER
    head, _, *facets = (folder / "scow.stl").read_text(encoding="ascii").split("facet normal")
    (tmp_path / "scow.stl").write_text("facet normal".join([head, *facets]), encoding="ascii")
    (tmp_path / "scow.toml").write_text((folder / f"{SCOW}.toml").read_text(encoding="utf-8"), encoding="utf-8")
    with pytest.raises(SceneError, match=r'(?s)key "file".*scow.stl is not closed'):
        read_scene(tmp_path / "scow.toml")


def test_a_hull_that_crosses_itself_is_refused_with_the_place(tmp_path: Path) -> None:
    """Each of two scows is closed; gmsh would end in the middle of the mesh."""
    import hydroelastic.scenes.read as reading

    folder = reading.SHIPPED_FOLDER
    hull = (folder / "scow.stl").read_text(encoding="ascii")
    scene = (folder / f"{SCOW}.toml").read_text(encoding="utf-8").replace("mass = 2500.0", "draught = 0.4")
    (tmp_path / "scow.toml").write_text(scene, encoding="utf-8")
    for shift, crosses in ((0.3, True), (1.7, False)):
        moved = "\n".join(
            f"vertex {x} {float(y) + shift} {z}" if word == "vertex" else line
            for line in hull.splitlines()
            for word, x, y, z in [(*line.split(), "", "", "")[:4] if "vertex" in line else ("", "", "", "")]
        )
        (tmp_path / "scow.stl").write_text(hull + moved, encoding="ascii")
        if crosses:
            with pytest.raises(SceneError, match=r"(?s)scow.stl crosses itself near x = "):
                read_scene(tmp_path / "scow.toml")
        else:
            assert isinstance(read_scene(tmp_path / "scow.toml"), LevelTankScene)


def test_a_bed_that_is_too_rough_is_an_error_of_the_scene() -> None:
    points = [[0.0, 0.0, 0.0], [10.0, 0.0, 0.0], [0.0, 6.0, 0.0], [10.0, 6.0, 0.0], [5.0, 3.0, 1.5], [5.5, 3.0, 0.0]]
    given = {"tank": {"length": 10.0, "width": 6.0, "bed": {"points": points}}, "liquid": [WATER]}
    with pytest.raises(SceneError, match="bed through the points is too steep"):
        list(check_level_tank(LevelTankScene(**given)))


def test_a_volume_of_too_many_cells_is_told_before_it_is_meshed() -> None:
    """Two liquids 2.6 m deep in a tank 9 km wide: gmsh alone makes a mesh that is cut at an interface."""
    two = ({"density": 1000.0, "depth": 2.5}, {"density": 800.0, "depth": 0.1})
    scene = LevelTankScene(tank={"radius": 9281.0, "model": "volume"}, liquid=two)
    with pytest.raises(
        SceneError, match=r"cannot be meshed: about 1e\+07 tetrahedra would be needed, and 3e\+06 can be"
    ):
        list(check_level_tank(scene))


def test_a_liquid_much_thinner_than_the_cells_is_refused_before_gmsh_begins() -> None:
    two = ({"density": 1000.0, "depth": 1e-9}, {"density": 800.0, "depth": 2.0})
    scene = LevelTankScene(tank={"length": 10.0, "width": 6.0, "model": "volume"}, liquid=two)
    with pytest.raises(SceneError, match="so thin that its cells would be flat"):
        list(check_level_tank(scene))
