"""Scenes of tanks in three dimensions: keys, messages, results."""

from __future__ import annotations

import csv
import json
from pathlib import Path
from typing import Any

import meshio
import numpy as np
import pytest
from level_tanks import CASES

from hydroelastic.output.dataset import read_dataset
from hydroelastic.scenes.errors import SceneError
from hydroelastic.scenes.kinds import checker_of, runner_of
from hydroelastic.scenes.models.level_tank import LevelTankScene
from hydroelastic.scenes.models.level_tank_physics import physical_level_tank
from hydroelastic.scenes.models.tank import TankScene
from hydroelastic.scenes.read import read_scene
from hydroelastic.scenes.report.write import write_report
from hydroelastic.scenes.result import solve

DISC = {"outline": "disc", "radius": 2.0, "flexural_rigidity": 5e3, "mass_per_area": 50.0, "hydrostatic": False}
BEAM = {"kind": "beam", "start": 3.0, "length": 4.0, "flexural_rigidity": 5e3, "mass_per_length": 50.0}
LIQUID = [{"density": 1000.0, "depth": 3.0}]


def scene(**changes: Any) -> LevelTankScene:
    given: dict[str, Any] = {"tank": {"radius": 5.0}, "liquid": LIQUID, "body": [DISC]}
    return LevelTankScene(**(given | changes))


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    out = tmp_path_factory.mktemp("level") / "disc"
    asked = scene(accuracy={"tolerance": 1e-6, "modes": 3}, title="Disc")
    runner_of(asked)(asked, out=out, images=None, page=lambda outcome, folder: write_report(asked, outcome, folder))
    return out


def test_summary_has_the_frequencies_with_order_and_multiplicity(folder: Path) -> None:
    summary = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
    case = CASES["disc_base_s0"]
    modes = summary["modes"]
    assert [mode["omega"] for mode in modes] == pytest.approx(case["omega"][:3], rel=1e-6)
    assert [(f"n{mode['order']}", mode["multiplicity"]) for mode in modes] == list(
        zip(case["label"][:3], case["multiplicity"][:3], strict=True)
    )
    # Pitch about x and about y has no stiffness, and heave displaces the water in the ring.
    assert summary["zero_modes"] == 2
    assert summary["status"] == "ok"
    assert summary["first_elastic"]["order"] == 2


def test_a_report_has_the_modes_their_estimates_and_the_model(folder: Path) -> None:
    page = (folder / "report.html").read_text(encoding="utf-8")
    for said in (
        "ω of mode 3 (",
        "ω of the first elastic tone of plate 1",
        "rayleigh_lid",
        "One attempt",
        "radial problem",
    ):
        assert said in page, said


def test_files_hold_the_shapes_of_both_modes_of_a_pair(folder: Path) -> None:
    surface, volume = (meshio.read(folder / "fields" / f"{name}.vtu") for name in ("surface", "volume"))
    assert set(surface.point_data) == {
        f"displacement_{name}" for name in ("001", "002_cos", "002_sin", "003_cos", "003_sin")
    }
    even, odd = (surface.point_data[f"displacement_002_{name}"][:, 2] for name in ("cos", "sin"))
    x, y = surface.points[:, 0], surface.points[:, 1]
    # f(r) cos θ and f(r) sin θ; values are written with 16 digits.
    assert even * y == pytest.approx(odd * x, abs=1e-12 * np.abs(even).max() * 5.0)
    dataset, _ = read_dataset(folder / "dataset.nc")
    assert dataset["elevation"].dims == ("shape", "point")
    with (folder / "modes.csv").open(encoding="utf-8") as file:
        assert [row["multiplicity"] for row in csv.DictReader(file)] == ["1", "2", "2"]
    # On the water gη = ω²ψ, in the surface and in the volume.
    water = dataset["plate"].values == 0
    psi, eta = volume.point_data["potential_001"][: len(x)], surface.point_data["displacement_001"][:, 2]
    omega = CASES["disc_base_s0"]["omega"][0]
    assert 9.81 * eta[water] == pytest.approx(omega**2 * psi[water], rel=1e-4, abs=1e-4 * np.abs(eta).max() * 9.81)


def test_keys_of_a_plan_make_a_scene_three_dimensional(tmp_path: Path) -> None:
    assert isinstance(read_scene("floating_roof"), LevelTankScene)
    assert isinstance(read_scene("aquarium"), TankScene)
    text = 'kind = "tank"\n[tank]\nlength = 2.0\n[[liquid]]\ndensity = 1.0\ndepth = 1.0\n'
    (tmp_path / "flat.toml").write_text(text, encoding="utf-8")
    assert isinstance(read_scene(tmp_path / "flat.toml"), TankScene)
    assert isinstance(read_scene(tmp_path / "flat.toml", {"tank.width": 1.0}), LevelTankScene)


def test_rigidity_and_mass_follow_from_the_material() -> None:
    material = {"youngs_modulus": 2.1e11, "thickness": 0.01, "density": 7850.0}
    (plate,) = physical_level_tank(scene(body=[{"outline": "disc", "radius": 2.0, **material}])).plates
    assert plate.flexural_rigidity == pytest.approx(2.1e11 * 1e-6 / (12.0 * 0.91), rel=1e-14)
    assert plate.mass_per_area == pytest.approx(78.5, rel=1e-14)


def test_a_beam_in_a_box_is_a_cover_of_slats() -> None:
    """Shown, compared and reported: the tone is that of order 0, the beam of a tank per metre of width."""
    asked = read_scene("aquarium", {"tank.width": 4.0, "accuracy.modes": 2, "accuracy.tolerance": 1e-4})
    assert isinstance(asked, LevelTankScene)
    (slats,) = physical_level_tank(asked).plates
    assert slats.slats
    assert not slats.hydrostatic
    result = solve(asked)
    # The shipped result of aquarium; 1e-4 is asked for.
    assert result.summary["modes"][0]["omega"] == pytest.approx(1.64970432, rel=1e-4)
    assert result.summary["first_elastic"]["omega"] == pytest.approx(4.23052401, rel=1e-4)
    assert "4.23" in result._repr_html_()


BAD: dict[str, tuple[dict[str, Any], str]] = {
    "two plans": ({"tank": {"radius": 5.0, "width": 2.0}}, "different plans"),
    "no plan": ({"tank": {"length": 5.0}}, 'no plan. Did you mean "beam"'),
    "varying beam": ({"body": [{"kind": "varying_beam", "start": 0.0}]}, "bodies are plates"),
    "beams in a cylinder": ({"body": [BEAM]}, "side to side of a box"),
    "beam with a key of a plate": ({"body": [BEAM | {"mass_per_area": 1.0}]}, "not known here"),
    "beam too heavy": (
        {"tank": {"length": 10.0, "width": 4.0}, "body": [BEAM | {"mass_per_length": 1e20}]},
        'key "mass_per_length"',
    ),
    "outside": ({"body": [DISC | {"radius": 6.0}]}, "does not lie inside"),
    "strip in a cylinder": (
        {"body": [{"outline": "strip", "start": 1.0, "length": 2.0, "rigid": True, "mass_per_area": 1.0}]},
        "side to side of a box",
    ),
    "overlap": ({"body": [DISC, DISC | {"radius": 1.0}]}, "overlaps or touches"),
    "stiffness twice": ({"body": [DISC | {"rigid": True}]}, "given twice"),
    "key of another outline": ({"body": [DISC | {"size": [1.0, 1.0]}]}, "does not belong to outline"),
    "nothing moves": ({"body": [], "tank": {"radius": 5.0, "top": "rigid"}}, "nothing moves"),
    "two liquids": ({"liquid": LIQUID * 2}, "liquid"),
    "a polygon held at a wall": (
        {
            "tank": {"length": 10.0, "width": 8.0, "model": "volume"},
            "body": [
                {
                    "outline": "polygon",
                    "points": [[0.0, 2.0], [4.0, 2.0], [0.0, 6.0]],
                    "rigid": True,
                    "mass_per_area": 1.0,
                    "edge": "clamped",
                }
            ],
        },
        "walls hold edges of rectangles and strips in a box",
    ),
    "too thin": ({"liquid": [{"density": 1.0, "depth": 1e-5}]}, "too thin"),
}


@pytest.mark.parametrize("case", BAD)
def test_what_does_not_fit_is_refused(case: str) -> None:
    changes, said = BAD[case]
    with pytest.raises(SceneError, match=said):
        scene(**changes)


RING = {**DISC, "outline": "ring", "radius": 4.0, "inner_radius": 2.5}
TRIANGLE = {**{key: value for key, value in DISC.items() if key != "radius"}, "outline": "polygon"}
FITTING: dict[str, dict[str, Any]] = {
    "a ring askew about an inner cylinder": {
        "tank": {"radius": 5.0, "inner_radius": 1.0},
        "body": [{**RING, "position": [0.3, 0.0]}],
    },
    "a disc beside an inner cylinder": {
        "tank": {"radius": 5.0, "inner_radius": 1.0},
        "body": [{**DISC, "radius": 1.0, "position": [3.0, 0.0]}],
    },
    "a disc askew in a ring": {"body": [RING, {**DISC, "position": [0.3, 0.0]}]},
    "two triangles with boxes around them that overlap": {
        "body": [
            {**TRIANGLE, "points": [[-3.0, -3.0], [2.0, -3.0], [-3.0, 2.0]]},
            {**TRIANGLE, "points": [[2.2, -2.8], [2.2, 2.2], [-2.8, 2.2]]},
        ]
    },
}


@pytest.mark.parametrize("case", FITTING)
def test_what_keeps_apart_is_taken(case: str) -> None:
    checker_of(scene(**FITTING[case]))


CROSSING = [[2.0, 2.0], [6.0, 6.0], [6.0, 2.0], [2.0, 6.0]]


@pytest.mark.parametrize(
    ("said", "changes"),
    [
        ("folds back on itself near \\(6, 6\\)", {"tank": {"plan": CROSSING}, "body": []}),
        ("folds back on itself near \\(6, 6\\)", {"body": [{**TRIANGLE, "points": CROSSING}]}),
        ("first vertex is not repeated", {"tank": {"plan": [*CROSSING[::2], CROSSING[0]]}, "body": []}),
        (
            "overlaps or touches",
            {
                "body": [
                    {**TRIANGLE, "points": [[-3.0, -0.5], [3.0, -0.5], [0.0, 0.5]]},
                    {**TRIANGLE, "points": [[-0.5, -3.0], [0.5, 0.0], [-0.5, 3.0]]},
                ]
            },
        ),
    ],
)
def test_polygons_that_cross_are_refused(said: str, changes: dict[str, Any]) -> None:
    with pytest.raises((SceneError, ValueError), match=said):
        scene(**changes)


def test_a_cover_in_which_nothing_oscillates_is_refused() -> None:
    cover = {"outline": "rectangle", "position": [5.0, 2.5], "size": [10.0, 5.0], "rigid": True, "mass_per_area": 10.0}
    stiff = scene(tank={"length": 10.0, "width": 5.0}, body=[cover | {"edge": "sliding"}])
    with pytest.raises(SceneError, match="nothing oscillates"):
        solve(stiff)


def test_what_no_solver_takes_is_refused_by_check_and_run() -> None:
    touching = scene(tank={"radius": 5.0}, body=[DISC | {"radius": 2.0, "position": [3.0, 0.0]}])
    for use in (lambda: list(checker_of(touching)(touching)), lambda: runner_of(touching)(touching)):
        with pytest.raises(SceneError, match="touches a wall"):
            use()


def test_check_tells_the_model_and_its_size() -> None:
    asked = read_scene("ring_pontoon")
    text = "\n".join(line for section in checker_of(asked)(asked) for line in section.lines)
    assert "one problem for each order n" in text
    assert "no volume mesh" in text


BASIN = {"length": 10.0, "width": 6.0}
SLOPE = {"slope": [0.2, 0.0]}


def test_a_sloping_bed_is_solved_in_its_volume_and_sampled_on_its_mesh(tmp_path: Path) -> None:
    asked = scene(tank=BASIN | {"bed": SLOPE}, body=[], accuracy={"tolerance": 1e-3, "modes": 3})
    runner_of(asked)(asked, out=tmp_path / "basin", images=None)
    summary = json.loads((tmp_path / "basin" / "summary.json").read_text(encoding="utf-8"))
    assert summary["status"] == "ok"
    assert summary["solver"]["model"].startswith("volume")
    assert summary["exact"] == []
    surface, volume = (meshio.read(tmp_path / "basin" / "fields" / f"{name}.vtu") for name in ("surface", "volume"))
    # Both halves beside the plane of symmetry y = 3, and the bed from 4 m to 2 m.
    assert np.ptp(surface.points, axis=0) == pytest.approx([10.0, 6.0, 0.0], abs=1e-9)
    assert volume.points[:, 2].min() == pytest.approx(-4.0, abs=1e-9)
    assert volume.points[np.argmin(volume.points[:, 2]), 0] == pytest.approx(0.0, abs=1e-9)
    corners = np.array([[0.0, 0.0], [0.0, 6.0], [10.0, 0.0]])
    eta = [
        surface.point_data["displacement_002"][np.argmin(np.linalg.norm(surface.points[:, :2] - c, axis=1)), 2]
        for c in corners
    ]
    # The second mode is the first across: odd about y = 3, higher over the shallow end than over the deep one or alike.
    assert eta[0] == pytest.approx(-eta[1], rel=1e-9)
    assert summary["modes"][1]["symmetry"] == "yA"
    # On the water gη = ω²ψ, of a corner in both files.
    place = np.argmin(np.linalg.norm(volume.points, axis=1))
    omega = summary["modes"][1]["omega"]
    assert 9.81 * eta[0] == pytest.approx(omega**2 * volume.point_data["potential_002"][place], rel=1e-9)


def test_check_tells_the_volume_its_unknowns_and_memory() -> None:
    asked = scene(tank=BASIN | {"bed": SLOPE}, body=[], accuracy={"tolerance": 1e-3, "modes": 3})
    text = " ".join(line for section in checker_of(asked)(asked) for line in section.lines)
    for said in ("tetrahedra in all of the liquid", "unknowns", "GiB", "a half of the tank"):
        assert said in text, said


BAD_VOLUMES: dict[str, tuple[dict[str, Any], str]] = {
    "beams": ({"tank": BASIN | {"bed": SLOPE}, "body": [BEAM]}, "need a tank with a level bed"),
    "beach": ({"tank": BASIN | {"bed": {"slope": [0.7, 0.0]}}, "body": []}, "A beach is drawn"),
    "two beds": ({"tank": BASIN | {"bed": SLOPE | {"points": [[0.0, 0.0, 0.0]] * 3}}, "body": []}, "given together"),
    "no bed": ({"tank": BASIN | {"bed": {}}, "body": []}, "its shape is missing"),
    "no file": ({"tank": {"shape": "none.step"}, "body": []}, "there is no file"),
    "format": ({"tank": {"shape": "tank.dwg"}, "body": []}, "not a known format"),
    "bed table": ({"tank": BASIN | {"bed": {"file": "none.csv"}}, "body": []}, "none.csv"),
}


@pytest.mark.parametrize("case", BAD_VOLUMES)
def test_bad_volumes_are_refused_with_the_reason(case: str) -> None:
    changes, said = BAD_VOLUMES[case]
    with pytest.raises(SceneError, match=said):
        scene(**changes)
