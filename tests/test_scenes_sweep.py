"""Sweeps: points are those of single solutions, modes are followed, what fails is kept, what is done is not done
again."""

import csv
import json
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import xarray
from click.testing import Result
from command import run_command
from scene_files import BEAM_IN_TANK

import hydroelastic as he

RIGIDITY = "body.1.flexural_rigidity"
RIGIDITIES = (500.0, 700.0, 900.0, 1100.0)
# Half a digit below the errors that the solver estimates of itself.
TOLERANCE = 1e-5


def base(start: float = 3.0, **changes: Any) -> Any:
    """The base case, a beam in a tank, with its four lowest modes."""
    asked = {"body.1.start": start, "accuracy.modes": 4, "accuracy.tolerance": TOLERANCE}
    return he.read("aquarium", asked | changes)


@pytest.fixture(scope="module")
def centred() -> he.Sweep:
    """Over flexural rigidities at which the tone of the beam meets the first antisymmetric wave."""
    return he.sweep(base(), {RIGIDITY: RIGIDITIES})


@pytest.fixture(scope="module")
def off_centre() -> he.Sweep:
    return he.sweep(base(3.001), {RIGIDITY: RIGIDITIES})


@cache
def lowest(start: float, rigidity: float) -> Any:
    """Modes of a single solution, whose liquid is its own."""
    return he.solve(base(start, **{RIGIDITY: rigidity})).modes


def test_points_that_share_their_liquid_are_those_of_single_solutions(centred: he.Sweep) -> None:
    # Of the first point the liquid is made, the last one takes it over; within the errors of both.
    for number in (0, -1):
        row = centred.dataset["omega"].values[number]
        assert row == pytest.approx(lowest(3.0, RIGIDITIES[number]).omega, rel=2 * TOLERANCE)


TWO_BEAMS = {
    "kind": "tank",
    "tank": {"length": 10.0},
    "liquid": [{"density": 1000.0, "depth": 5.0}],
    "body": [
        {"start": 0.8, "length": 3.2, "flexural_rigidity": 5e3, "mass_per_length": 50.0},
        {"start": 5.5, "length": 2.5, "flexural_rigidity": 2e3, "mass_per_length": 50.0},
    ],
}


@pytest.mark.parametrize(
    ("name", "changes", "key", "values"),
    [
        (TWO_BEAMS, {}, "body.2.flexural_rigidity", (5e2, 2e3, 8e3, 3e4)),
        pytest.param(TWO_BEAMS, {}, "body.1.mass_per_length", (10.0, 30.0, 90.0, 270.0), marks=pytest.mark.slow),
        ("interface_beam", {}, RIGIDITY, (1e3, 3e3, 9e3, 2.7e4)),
        # Without a surface that moves by itself.
        ("aquarium", {"tank.top": "rigid"}, RIGIDITY, RIGIDITIES),
        # A heavier float lies deeper: its liquid is another one.
        pytest.param("float_in_two_liquids", {}, "body.1.mass", (62.0, 64.0, 66.0, 68.0), marks=pytest.mark.slow),
        ("aquarium", {}, "tank.gravity", (3.7, 5.0, 9.81, 20.0)),
        pytest.param("aquarium", {}, "body.1.hydrostatic", (False, True, False, True), marks=pytest.mark.slow),
        pytest.param("aquarium", {}, "body.1.length", (3.0, 3.5, 4.0, 4.5), marks=pytest.mark.slow),
        pytest.param("aquarium", {}, "liquid.1.depth", (3.0, 4.0, 5.0, 6.0), marks=pytest.mark.slow),
        pytest.param("aquarium", {}, "accuracy.tolerance", (1e-3, 1e-4, 1e-5, 1e-6), marks=pytest.mark.slow),
    ],
)
def test_points_of_each_kind_of_tank_are_those_of_single_solutions(
    name: Any, changes: dict[str, Any], key: str, values: tuple[float, ...]
) -> None:
    scene = he.read(he.read(name), {"accuracy": {"modes": 3, "tolerance": TOLERANCE}, **changes})
    found = he.sweep(scene, {key: values}, follow=False)
    assert found.status == "ok"
    for number in (1, 3):
        alone = he.solve(he.read(scene, {key: values[number]})).modes
        errors = alone.relative_error + found.dataset["relative_error"].values[number]
        assert np.all(np.abs(found.dataset["omega"].values[number] / alone.omega - 1.0) <= errors)


def test_mass_gravity_and_restoring_are_those_of_the_point() -> None:
    changes = {"body.1.mass_per_length": [20.0, 400.0], "tank.gravity": [3.7], "body.1.hydrostatic": [True]}
    scene = base(**{"accuracy.modes": 3})
    found = he.sweep(scene, changes)
    heavy = he.solve(he.read(scene, {key: values[-1] for key, values in changes.items()}))
    assert found.dataset["omega"].values[1, 0, 0] == pytest.approx(heavy.modes.omega, rel=2 * TOLERANCE)


def test_modes_of_opposite_symmetry_cross(centred: he.Sweep) -> None:
    (crossing,) = [row for row in centred.encounters.to_dict("records") if row["kind"] == "crossing"]
    assert crossing["reason"] == "opposite symmetry"
    # Independent of all that follows modes: where it says so, single solutions of both symmetries have one frequency.
    modes = lowest(3.0, crossing[RIGIDITY])
    second, first = (
        modes.omega[modes.symmetry == symmetry][place] for symmetry, place in (("symmetric", 1), ("antisymmetric", 0))
    )
    assert second == pytest.approx(first, rel=2e-5)
    assert crossing["omega"] == pytest.approx(first, rel=2e-5)


def test_a_small_asymmetry_turns_the_crossing_into_a_narrow_veering(off_centre: he.Sweep) -> None:
    (veering,) = [row for row in off_centre.encounters.to_dict("records") if row["gap"] < 0.01]
    assert veering["kind"] == "veering"
    assert veering["gap"] > 3 * veering["gap_error"]
    # The gap of single solutions, three of them across the veering, with no following.
    gaps = [np.diff(lowest(3.001, veering[RIGIDITY] + shift).omega[1:3])[0] for shift in (-0.4, 0.0, 0.4)]
    # Between them it is up to 5 % smaller.
    assert min(gaps) == pytest.approx(veering["gap"], rel=0.05)
    assert int(np.argmin(gaps)) == 1


@pytest.mark.only_on_ranks
@pytest.mark.mpi
def test_ranks_solve_the_points_together() -> None:
    scene = base(**{"accuracy.modes": 1, "accuracy.tolerance": 1e-3})
    found = he.sweep(scene, {RIGIDITY: [5e3, 6e3]})
    assert found.dataset["omega"].values[0] == pytest.approx(he.solve(scene).modes.omega, rel=2e-3)
    assert found.status == "ok"


def test_other_kinds_of_scenes_are_swept_over_several_keys() -> None:
    found = he.sweep("swell", {"roll.damping_ratio": [0.2, 0.4], "roll.natural_period": [9.0, 12.0, 15.0]})
    assert found.dataset["response_largest_angle"].sizes == {"roll_damping_ratio": 2, "roll_natural_period": 3}
    alone = he.solve(he.read("swell", {"roll.damping_ratio": 0.4, "roll.natural_period": 9.0}))
    expected = alone.summary["response"]["largest_angle"]
    assert found.dataset["response_largest_angle"].values[1, 0] == expected
    assert found.table["response_largest_angle"].tolist()[3] == expected
    assert found.plot("response_largest_angle").width > 500


def test_estimates_are_made_where_asked_for() -> None:
    scene = base(**{"accuracy.modes": 3, "accuracy.tolerance": 1e-3})
    made = [he.sweep(scene, {RIGIDITY: [5e3]}, estimates=asked, follow=False) for asked in (False, True)]
    assert ["estimate_omega" in one.dataset for one in made] == [False, True]


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "scene.toml").write_text(BEAM_IN_TANK + "[accuracy]\ntolerance = 1e-3\nmodes = 2\n", encoding="utf-8")
    return tmp_path / "found"


def invoke(*arguments: str) -> Result:
    return run_command("sweep", *arguments)


def test_a_point_that_fails_is_a_row_with_its_reason(folder: Path) -> None:
    found = invoke("scene.toml", "--vary", "body.1.start=1,2,9", "--out", str(folder), "--no-images")
    assert found.exit_code == 3
    assert "1 of 3 points are not ok" in found.stderr
    with (folder / "sweep.csv").open(encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert [row["status"] for row in rows] == ["ok", "ok", "failed"]
    assert "outside the tank" in rows[2]["reason"]
    assert np.isnan(float(rows[2]["omega_1"]))
    summary = json.loads((folder / "summary.json").read_text(encoding="utf-8"))
    assert summary["points"] == {"ok": 2, "unconverged": 0, "failed": 1}


@pytest.mark.parametrize(
    ("scene", "vary"),
    # Points of the second one share their liquid.
    [("swell", "roll.damping_ratio=0.2:0.6:3"), ("scene.toml", "body.1.flexural_rigidity=500:1100:4")],
)
def test_an_interrupted_sweep_goes_on_and_gives_the_same_files(folder: Path, scene: str, vary: str) -> None:
    arguments = (scene, "--vary", vary, "--no-follow", "--out", str(folder), "--quiet")
    assert invoke(*arguments).exit_code == 0
    files = ("dataset.nc", "sweep.csv", "sweep.png", "summary.json", "summary.md")
    whole = {name: (folder / name).read_bytes() for name in files}
    journal = folder / "sweep.journal"
    # The process was killed while it wrote the last point.
    kept = journal.read_bytes()[:-200]
    journal.write_bytes(kept)
    assert invoke(*arguments).exit_code == 0
    # What was solved before is not solved again.
    lines = kept.splitlines()[:-1]
    assert journal.read_bytes().splitlines()[: len(lines)] == lines
    assert {name: (folder / name).read_bytes() for name in files} == whole


@pytest.mark.slow
def test_processes_find_what_one_finds(folder: Path) -> None:
    found = []
    for jobs in ("1", "2"):
        out = folder.with_name(jobs)
        given = ("scene.toml", "--vary", "body.1.start=1:3:5", "--out", str(out), "--jobs", jobs, "--no-images")
        assert invoke(*given).exit_code == 0
        found.append(read_dataset_bytes(out))
    assert found[0] == found[1]


def read_dataset_bytes(folder: Path) -> dict[str, bytes]:
    return {name: (folder / name).read_bytes() for name in ("dataset.nc", "sweep.csv", "branches.csv", "summary.md")}


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (("--vary", "body.1.strat=0:6:3"), 'Did you mean "start"?'),
        (("--vary", "body.2.start=0:6:3"), '"2" is not an entry of the list'),
        (("--vary", "body.1.start"), '--vary = "body.1.start": it is not of the form KEY=start:stop:number'),
        (("--vary", "body.1.start=0:6"), "a range is start:stop:number"),
        (("--vary", "body.1.start=0:x:3"), '"x" is not a finite number'),
        (("--vary", "body.1.start=0:6:0"), 'the number of values, "0", is not a whole number from 1'),
        (("--vary", "body.1.start=0:6:3:log"), "equal ratios need positive ends"),
        (("--vary", "body.1.start=1,,2"), "an entry is empty"),
        (("--vary", "body.1.start=1", "--vary", "body.1.start=2"), "the key stands twice"),
        (("--vary", "body.1.start=1,2", "--show", "first_elastic_omga"), 'Did you mean "first_elastic_omega"?'),
        (("--vary", "body.1.start=1,2", "--show", "kind_1"), '--show = "kind_1": it holds no numbers'),
        (("--vary", "body.1.start=1,2", "--out", "/proc/sweep"), "Name another folder (--out)."),
    ],
)
def test_bad_input_is_one_clear_message(folder: Path, arguments: tuple[str, ...], said: str) -> None:
    found = invoke("scene.toml", "--out", str(folder), *arguments)
    assert (found.exit_code, found.stderr.count("\n")) == (2, 1)
    assert said in found.stderr


def test_values_of_a_range_are_those_that_were_meant(folder: Path) -> None:
    vary = ("--vary", "roll.damping_ratio=0:0.6:7", "--vary", "roll.natural_period=1e1:1e3:3:log")
    assert invoke("swell", *vary, "--out", str(folder), "--no-images", "--no-follow").exit_code == 0
    with (folder / "sweep.csv").open(encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == 21
    # 0.1 × 3 is 0.3 exactly, so that a beam in the middle is in the middle.
    assert [float(row["roll.damping_ratio"]) for row in rows[::3]] == [0.0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6]
    assert [float(row["roll.natural_period"]) for row in rows[:3]] == [10.0, 100.0, 1000.0]
    assert len({row["response_largest_angle"] for row in rows}) == 21


def test_the_dataset_is_read_as_it_was_made(folder: Path) -> None:
    found = he.sweep("swell", {"roll.damping_ratio": [0.2, 0.4]})
    found.save(folder, images=None)
    read = xarray.load_dataset(folder / "dataset.nc", engine="scipy")
    assert read["ship_damping_ratio"].values.tolist() == [0.2, 0.4]
    assert read["ship_damping_ratio"].attrs["units"] == "1"
    assert set(read.data_vars) == set(found.dataset.data_vars)
    assert read["roll_damping_ratio"].attrs["key"] == "roll.damping_ratio"
