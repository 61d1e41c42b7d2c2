"""Sweeps: points are those of single solutions, modes are followed, what fails is kept, what is done is not done
again."""

import csv
import json
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from click.testing import CliRunner, Result
from scene_files import BEAM_IN_TANK
from tanks import Tanks

import hydroelastic.scenes.sweep.workers as workers
from hydroelastic.fem.sweep.encounters import Encounter
from hydroelastic.fem.tank.liquids import liquid_key
from hydroelastic.fem.tank.mode_vectors import mode_vectors
from hydroelastic.scenes.command_line import main
from hydroelastic.scenes.errors import SceneError
from hydroelastic.scenes.models.physical import physical_tank
from hydroelastic.scenes.models.tank import TankScene
from hydroelastic.scenes.read import closed_tank, read_scene, scene_source
from hydroelastic.scenes.result import solve
from hydroelastic.scenes.sweep.axes import grid_from_texts
from hydroelastic.scenes.sweep.families import families, last_liquids
from hydroelastic.scenes.sweep.journal import JOURNAL, open_journal
from hydroelastic.scenes.sweep.result import Sweep, sweep

RIGIDITY = "body.1.flexural_rigidity"
RIGIDITIES = (500.0, 700.0, 900.0, 1100.0)
# Half a digit below the errors that the solver estimates of itself.
TOLERANCE = 1e-5


def over_rigidity(tanks: Tanks, start: float) -> Sweep:
    """A beam of the base case over flexural rigidities at which its tone meets the first antisymmetric wave."""
    return sweep(tanks.scene(tanks.beam(start=start), modes=4, tolerance=TOLERANCE), {RIGIDITY: RIGIDITIES})


@pytest.fixture(scope="module")
def centred(tanks: Tanks) -> Sweep:
    return over_rigidity(tanks, 3.0)


@pytest.fixture(scope="module")
def off_centre(tanks: Tanks) -> Sweep:
    return over_rigidity(tanks, 3.001)


def lowest(tanks: Tanks, start: float, rigidity: float, *, symmetry: str | None = None) -> np.ndarray:
    """Frequencies of a single solution, whose liquid is its own, of one symmetry if that is given."""
    modes = solve(tanks.scene(tanks.beam(start=start, flexural_rigidity=rigidity), modes=4, tolerance=TOLERANCE)).modes
    return np.asarray(modes.omega if symmetry is None else modes.omega[modes.symmetry == symmetry])


def test_points_that_share_their_liquid_are_those_of_single_solutions(centred: Sweep, tanks: Tanks) -> None:
    # Of the first point the liquid is made, the last one takes it over; within the errors of both.
    for number in (0, -1):
        row = centred.dataset["omega"].values[number]
        assert row == pytest.approx(lowest(tanks, 3.0, RIGIDITIES[number]), rel=2 * TOLERANCE)


def two_beams(tanks: Tanks) -> TankScene:
    """Beams that are no mirror images of each other."""
    beams = tanks.beam(start=0.8, length=3.2), tanks.beam(start=5.5, length=2.5, flexural_rigidity=2e3)
    return tanks.scene(*beams, modes=4, tolerance=TOLERANCE)


def shipped(name: str, **changes: Any) -> Callable[[Tanks], TankScene]:
    """A shipped scene."""
    asked = {"accuracy.modes": 3, "accuracy.tolerance": TOLERANCE} | changes
    return lambda _tanks: closed_tank(read_scene(name, asked), "")


@pytest.mark.parametrize(
    ("made", "key", "values", "shared"),
    [
        (two_beams, "body.2.flexural_rigidity", (5e2, 2e3, 8e3, 3e4), True),
        pytest.param(two_beams, "body.1.mass_per_length", (10.0, 30.0, 90.0, 270.0), True, marks=pytest.mark.slow),
        (shipped("interface_beam"), RIGIDITY, (1e3, 3e3, 9e3, 2.7e4), True),
        # Without a surface that moves by itself.
        (shipped("aquarium", **{"tank.top": "rigid"}), RIGIDITY, RIGIDITIES, True),
        # A heavier float lies deeper: its liquid is another one.
        pytest.param(
            shipped("float_in_two_liquids"), "body.1.mass", (62.0, 64.0, 66.0, 68.0), False, marks=pytest.mark.slow
        ),
    ],
)
def test_points_of_each_kind_of_tank_are_those_of_single_solutions(
    tanks: Tanks, made: Callable[[Tanks], TankScene], key: str, values: tuple[float, ...], shared: bool
) -> None:
    scene = made(tanks)
    source = scene_source(scene)
    assert bool(families([source.scene((), {key: value}) for value in values]).known) is shared
    found = sweep(scene, {key: values}, follow=False)
    assert found.status == "ok"
    for number in (1, 3):
        # A point alone shares its liquid with no other.
        alone = sweep(scene, {key: values[number : number + 1]}, follow=False)
        # Within the errors of both; what is not shared is the same computation.
        within = 2 * TOLERANCE if shared else 1e-13
        assert found.dataset["omega"].values[number] == pytest.approx(alone.dataset["omega"].values[0], rel=within)


@pytest.mark.parametrize(
    ("key", "values"), [("accuracy.modes", (2, 3, 4, 5)), ("accuracy.tolerance", (1e-3, 1e-4, 1e-5, 1e-6))]
)
def test_points_of_other_accuracies_share_no_liquid(key: str, values: tuple[float, ...]) -> None:
    source = scene_source("aquarium")
    assert not families([source.scene((), {key: value}) for value in values]).known


@pytest.mark.parametrize(
    ("key", "value", "shared"),
    [
        ("body.1.flexural_rigidity", 1e4, True),
        ("body.1.mass_per_length", 400.0, True),
        ("body.1.hydrostatic", True, True),
        ("tank.gravity", 3.7, True),
        ("body.1.start", 2.9, False),
        ("body.1.length", 3.9, False),
        ("liquid.1.depth", 4.0, False),
    ],
)
def test_only_what_does_not_touch_the_liquid_shares_it(key: str, value: float | str | bool, shared: bool) -> None:
    one, other = (physical_tank(closed_tank(read_scene("aquarium", change), "")) for change in ({}, {key: value}))
    assert (liquid_key(one.scaled()) == liquid_key(other.scaled())) is shared


def test_mass_gravity_and_restoring_are_those_of_the_point(tanks: Tanks) -> None:
    scene = tanks.scene(tanks.beam(), modes=3, tolerance=TOLERANCE)
    changes = {"body.1.mass_per_length": [20.0, 400.0], "tank.gravity": [3.7], "body.1.hydrostatic": [True]}
    found = sweep(scene, changes)
    heavy = tanks.scene(tanks.beam(mass_per_length=400.0, hydrostatic=True), gravity=3.7, modes=3, tolerance=TOLERANCE)
    assert found.dataset["omega"].values[1, 0, 0] == pytest.approx(solve(heavy).modes.omega, rel=2 * TOLERANCE)
    # With the mass of another point the errors would be too large, and another attempt would follow.
    assert np.all(found.dataset["solver_attempts"].values == 1)


def test_modes_of_opposite_symmetry_cross(centred: Sweep, tanks: Tanks) -> None:
    (crossing,) = [row for row in centred.encounters.to_dict("records") if row["kind"] == "crossing"]
    assert crossing["reason"] == "opposite symmetry"
    # Independent of all that follows modes: where it says so, single solutions of both symmetries have one frequency.
    second, first = (
        lowest(tanks, 3.0, crossing[RIGIDITY], symmetry=symmetry)[place]
        for symmetry, place in (("symmetric", 1), ("antisymmetric", 0))
    )
    assert second == pytest.approx(first, rel=2e-5)
    assert crossing["omega"] == pytest.approx(first, rel=2e-5)


def test_a_small_asymmetry_turns_the_crossing_into_a_narrow_veering(off_centre: Sweep, tanks: Tanks) -> None:
    (veering,) = [row for row in off_centre.encounters.to_dict("records") if row["gap"] < 0.01]
    assert veering["kind"] == "veering"
    assert veering["gap"] > 3 * veering["gap_error"]
    # The gap of single solutions, three of them across the veering, with no following.
    gaps = [np.diff(lowest(tanks, 3.001, veering[RIGIDITY] + shift)[1:3])[0] for shift in (-0.4, 0.0, 0.4)]
    # Between them it is up to 5 % smaller.
    assert min(gaps) == pytest.approx(veering["gap"], rel=0.05)
    assert int(np.argmin(gaps)) == 1


def test_modes_of_halves_are_those_of_the_whole_tank(tanks: Tanks) -> None:
    scene = tanks.scene(tanks.beam(), modes=4, tolerance=TOLERANCE)
    halves, whole = (mode_vectors(tanks.solve(scene, halves=halves)) for halves in (True, False))
    products = halves.overlaps(whole)[:8, :8]
    # K-orthonormal, up to the interpolation of the elevations between the unknowns of the two meshes.
    assert products**2 == pytest.approx(np.eye(8), abs=1e-2)


@pytest.mark.parametrize("name", ["centred", "off_centre"])
def test_branches_are_continuous_and_hold_the_elastic_tone(name: str, request: pytest.FixtureRequest) -> None:
    found: Sweep = request.getfixturevalue(name)
    (line,) = found.solved.lines
    assert not line.followed.exhausted
    omega, values = line.followed.of_branches("omega")[:, :4], np.array(line.values)
    slopes = np.gradient(omega, values, axis=0)
    largest = np.maximum(np.abs(slopes[1:]), np.abs(slopes[:-1])) * np.diff(values)[:, None]
    assert np.all(np.abs(np.diff(omega, axis=0)) <= 10.0 * largest)
    # Participations of all modes add up to one; those kept are the lowest 13.
    assert found.dataset["participation_sum"].values == pytest.approx(1.0, abs=0.02)


@pytest.mark.only_on_ranks
@pytest.mark.mpi
def test_ranks_solve_the_points_together(tanks: Tanks) -> None:
    scene = tanks.scene(tanks.beam(), modes=1, tolerance=1e-3)
    found = sweep(scene, {RIGIDITY: [5e3, 6e3]})
    assert found.dataset["omega"].values[0] == pytest.approx(solve(scene).modes.omega, rel=2e-3)
    assert found.status == "ok"


def test_other_kinds_of_scenes_are_swept_over_several_keys() -> None:
    found = sweep("swell", {"roll.damping_ratio": [0.2, 0.4], "roll.natural_period": [9.0, 12.0, 15.0]})
    assert found.dataset["response_largest_angle"].sizes == {"roll_damping_ratio": 2, "roll_natural_period": 3}
    alone = solve(read_scene("swell", {"roll.damping_ratio": 0.4, "roll.natural_period": 9.0}))
    expected = alone.summary["response"]["largest_angle"]
    assert found.dataset["response_largest_angle"].values[1, 0] == expected
    assert found.table["response_largest_angle"].tolist()[3] == expected
    assert found.plot("response_largest_angle").width > 500


def test_estimates_are_made_where_asked_for(tanks: Tanks) -> None:
    scene = tanks.scene(tanks.beam(), modes=3, tolerance=1e-3)
    made = [sweep(scene, {RIGIDITY: [5e3]}, estimates=asked, follow=False) for asked in (False, True)]
    assert ["estimate_omega" in one.dataset for one in made] == [False, True]


@pytest.mark.parametrize(
    ("name", "changes"),
    [
        ("float_in_two_liquids", {"accuracy.modes": 2, "accuracy.tolerance": 1e-2}),
        ("open_plate", {"analysis": [{"kind": "response", "omega": [2.5, 3.0]}], "accuracy.tolerance": 1e-2}),
        ("string_smooth", {"output.times": [0.5, 1.0]}),
        ("catenary", {"analysis": [{"kind": "modes", "count": 2}]}),
        ("swell", {}),
    ],
)
def test_a_point_read_from_the_journal_has_the_summary_that_was_solved(name: str, changes: dict[str, Any]) -> None:
    (point,) = sweep(read_scene(name, changes), {"title": ["a point"]}, follow=False).solved.points
    assert point.summary is not None
    assert json.loads(json.dumps(point.summary, allow_nan=False)) == point.summary


def test_modes_that_are_not_resolved_are_told_like_a_missed_tolerance() -> None:
    solved = sweep("swell", {"roll.damping_ratio": [0.2, 0.4]}).solved
    assert (solved.status, solved.reasons) == ("ok", [])
    meeting = Encounter(
        kind="unresolved", at=0.3, omega=2.5, gap=0.1, gap_error=0.0, branches=(0, 1), reason="the shape changes"
    )
    line: Any = SimpleNamespace(others={}, encounters=(meeting,), followed=SimpleNamespace(exhausted=True))
    doubtful = replace(solved, lines=(line,))
    assert doubtful.status == "unconverged"
    assert doubtful.reasons == [
        "roll.damping_ratio = 0.3: modes not resolved at ω = 2.5: the shape changes",
        "following the modes needs more points than were allowed",
    ]
    crossing: Any = SimpleNamespace(
        others={}, encounters=(replace(meeting, kind="crossing"),), followed=SimpleNamespace(exhausted=False)
    )
    assert replace(solved, lines=(crossing,)).status == "ok"


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "scene.toml").write_text(BEAM_IN_TANK + "[accuracy]\ntolerance = 1e-3\nmodes = 2\n", encoding="utf-8")
    return tmp_path / "found"


def invoke(*arguments: str) -> Result:
    return CliRunner().invoke(main, ["sweep", *arguments])


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
    # Points of the second one share their liquid, of which the others must have left nothing.
    [("swell", "roll.damping_ratio=0.2:0.6:3"), ("scene.toml", "body.1.flexural_rigidity=500:1100:4")],
)
def test_an_interrupted_sweep_goes_on_and_gives_the_same_files(
    folder: Path, monkeypatch: pytest.MonkeyPatch, scene: str, vary: str
) -> None:
    arguments = (scene, "--vary", vary, "--no-follow", "--out", str(folder), "--quiet")
    assert invoke(*arguments).exit_code == 0
    files = ("dataset.nc", "sweep.csv", "sweep.png", "summary.json", "summary.md")
    whole = {name: (folder / name).read_bytes() for name in files}
    journal = folder / JOURNAL
    # The process was killed while it wrote the last point.
    journal.write_bytes(journal.read_bytes()[:-200])
    last_liquids.clear()
    solved = []
    alone = workers.solve_point
    monkeypatch.setattr(workers, "solve_point", lambda *given: solved.append(given[0]) or alone(*given))
    assert invoke(*arguments).exit_code == 0
    assert len(solved) == 1
    assert {name: (folder / name).read_bytes() for name in files} == whole


def test_two_sweeps_do_not_write_into_one_folder(folder: Path) -> None:
    with (
        open_journal(folder, scene_file=None),
        pytest.raises(SceneError, match="another sweep is writing into it"),
        open_journal(folder, scene_file=None),
    ):
        pass


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


def test_values_of_a_range_are_those_that_were_meant() -> None:
    grid = grid_from_texts(["a.1.b=0:6:21", "c=1e2:1e4:3:log", 'd=1,"x",y'])
    # 0.3 × 10 is 3 exactly, so that a beam in the middle is in the middle.
    assert grid.axes[0].values[10] == 3.0
    assert grid.axes[1].values == (100.0, 1000.0, 10000.0)
    assert grid.axes[2].values == (1, "x", "y")
    assert (len(grid), grid.points[1]) == (189, {"a.1.b": 0.0, "c": 100.0, "d": "x"})


def test_the_dataset_is_read_as_it_was_made(folder: Path) -> None:
    found = sweep("swell", {"roll.damping_ratio": [0.2, 0.4]})
    found.save(folder, images=None)
    import xarray

    read = xarray.load_dataset(folder / "dataset.nc", engine="scipy")
    assert read["ship_damping_ratio"].values.tolist() == [0.2, 0.4]
    assert read["ship_damping_ratio"].attrs["units"] == "1"
    assert set(read.data_vars) == set(found.dataset.data_vars)
    assert read["roll_damping_ratio"].attrs["key"] == "roll.damping_ratio"
