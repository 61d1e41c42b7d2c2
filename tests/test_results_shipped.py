"""The shipped results are those of the shipped scenes as they stand."""

import json
from pathlib import Path

import numpy as np
import pytest

from hydroelastic.output.csv_files import write_csv
from hydroelastic.output.sections import markdown_sections
from hydroelastic.output.tank.tables import mode_columns, tank_cost, tank_sections
from hydroelastic.scenes.kinds import runner_of
from hydroelastic.scenes.models.level_tank import LevelTankScene
from hydroelastic.scenes.models.tank import TankScene
from hydroelastic.scenes.read import read_scene, shipped_scenes
from hydroelastic.scenes.run import run_scene
from hydroelastic.scenes.tank.run import run_tank

SHIPPED = Path(__file__).parent.parent / "results" / "shipped"
ALL_NAMES = [scene.name for scene in shipped_scenes()]
OF_KIND = {
    kind: [name for name in ALL_NAMES if read_scene(name).kind == kind]
    for kind in ("tank", "sea", "string", "thread", "roll")
}
LEVEL_NAMES = [name for name in OF_KIND["tank"] if isinstance(read_scene(name), LevelTankScene)]
SECTIONS = [(name, scene) for name in OF_KIND["tank"] if isinstance(scene := read_scene(name), TankScene)]
OPEN_NAMES = [*(name for name, scene in SECTIONS if scene.is_open), *OF_KIND["sea"]]
NAMES = [name for name, scene in SECTIONS if not scene.is_open]


def test_every_shipped_scene_has_its_results_and_no_other() -> None:
    assert sorted(path.name for path in SHIPPED.iterdir() if path.is_dir()) == sorted(ALL_NAMES)


@pytest.mark.parametrize("name", ALL_NAMES)
def test_results_are_of_the_scene_as_it_stands(name: str) -> None:
    stored = json.loads((SHIPPED / name / "summary.json").read_text(encoding="utf-8"))
    assert stored["scene"] == read_scene(name).model_dump(mode="json")
    assert stored["status"] == "ok"


@pytest.mark.slow_but("aquarium", "float_parabola", "interface_beam")
@pytest.mark.parametrize("name", NAMES)
def test_results_are_true(name: str) -> None:
    stored = json.loads((SHIPPED / name / "summary.json").read_text(encoding="utf-8"))
    scene = read_scene(name)
    summary = run_scene(scene).summary
    for old, new in zip(stored["modes"], summary["modes"], strict=True):
        # Both carry an estimated error; gmsh of another version may mesh otherwise.
        allowed = old["relative_error"] + new["relative_error"]
        assert old["omega"] == pytest.approx(new["omega"], rel=allowed)
        assert old["kind"] == new["kind"]
    assert stored["zero_modes"] == summary["zero_modes"]
    for old, new in zip(stored["first_elastic_by_body"], summary["first_elastic_by_body"], strict=True):
        assert old["index"] == new["index"]
        for value, error in (
            ("omega", "relative_error"),
            ("added_mass_per_length", "added_mass_relative_error"),
            ("pressure_release_omega", "pressure_release_relative_error"),
        ):
            if old[value] is not None:
                assert old[value] == pytest.approx(new[value], rel=old[error] + new[error])
    for method, old in stored["estimates"].items():
        new = summary["estimates"][method]
        assert (old["omega"] is None) == (new["omega"] is None)
        if old["omega"] is not None:
            # Closed forms and dense solutions: rounding alone may differ.
            assert old["omega"] == pytest.approx(new["omega"], rel=1e-8)


@pytest.mark.slow_but("ring_pontoon")
@pytest.mark.parametrize("name", LEVEL_NAMES)
def test_results_in_three_dimensions_are_true(name: str) -> None:
    stored = json.loads((SHIPPED / name / "summary.json").read_text(encoding="utf-8"))
    summary = run_scene(read_scene(name)).summary
    for old, new in zip(stored["modes"], summary["modes"], strict=True):
        assert old["omega"] == pytest.approx(new["omega"], rel=old["relative_error"] + new["relative_error"])
        assert (old["order"], old["multiplicity"], old["kind"]) == (new["order"], new["multiplicity"], new["kind"])
    tone, again = stored["first_elastic"], summary["first_elastic"]
    assert (tone is None) == (again is None)
    if tone is not None and tone["added_mass_per_area"] is not None:
        assert tone["added_mass_per_area"] == pytest.approx(
            again["added_mass_per_area"], rel=tone["added_mass_relative_error"] + again["added_mass_relative_error"]
        )


@pytest.mark.parametrize("name", NAMES)
def test_tables_tell_what_the_summary_holds(name: str, tmp_path: Path) -> None:
    stored = json.loads((SHIPPED / name / "summary.json").read_text(encoding="utf-8"))
    told = run_tank.read(stored)
    write_csv(tmp_path / "modes.csv", mode_columns(told))
    assert (SHIPPED / name / "modes.csv").read_bytes() == (tmp_path / "modes.csv").read_bytes()
    assert (SHIPPED / name / "summary.md").read_text(encoding="utf-8") == markdown_sections(
        stored, tank_sections(told), tank_cost(told)
    )


@pytest.mark.parametrize("name", NAMES)
def test_tables_and_pictures_are_there(name: str) -> None:
    files = {path.name for path in (SHIPPED / name).iterdir()}
    assert {"summary.json", "summary.md", "modes.csv", "overview.png"} <= files
    assert all((SHIPPED / name / file).stat().st_size > 100 for file in files)


@pytest.mark.slow
@pytest.mark.parametrize("name", OPEN_NAMES)
def test_results_of_open_water_are_true(name: str) -> None:
    stored = json.loads((SHIPPED / name / "summary.json").read_text(encoding="utf-8"))
    scene = read_scene(name)
    summary = run_scene(scene).summary
    # Both carry an estimated error below the tolerance asked for.
    allowed = 2.0 * scene.accuracy.tolerance
    for analysis, keys in (
        ("radiation", ("added_mass", "radiation_damping", "excitation_force")),
        ("response", ("amplitudes", "reflection", "transmission")),
        ("resonance", ("omega",)),
        ("decay", ("displacement",)),
    ):
        for old, new in zip(stored[analysis], summary[analysis], strict=True):
            for key in keys:
                assert (old[key] is None) == (new[key] is None), key
                if new[key] is None:  # waves around solids are not reflected to one side
                    continue
                values = np.array(new[key])
                assert np.array(old[key]) == pytest.approx(values, rel=0.0, abs=allowed * np.abs(values).max()), key


@pytest.mark.parametrize("name", OPEN_NAMES)
def test_pictures_of_open_water_are_there(name: str) -> None:
    files = {path.name for path in (SHIPPED / name).iterdir()}
    assert {"summary.json", "summary.md"} <= files
    assert {f"{analysis.kind}_1.png" for analysis in read_scene(name).analyses} <= files


@pytest.mark.slow_but("string_smooth", "swell")
@pytest.mark.parametrize("name", OF_KIND["string"] + OF_KIND["roll"])
def test_results_of_strings_and_ships_are_true(name: str) -> None:
    stored = json.loads((SHIPPED / name / "summary.json").read_text(encoding="utf-8"))
    scene = read_scene(name)
    summary = runner_of(scene)(scene).summary
    old, new = stored["response"], summary["response"]
    value = "largest_displacement" if scene.kind == "string" else "largest_angle"
    # Both carry an estimated error.
    assert old[value] == pytest.approx(new[value], rel=old["relative_error"] + new["relative_error"] + 1e-13)
    for before, after in zip(stored.get("modes", []), summary.get("modes", []), strict=True):
        assert before["omega"] == pytest.approx(
            after["omega"], rel=before["relative_error"] + after["relative_error"] + 1e-13
        )
        assert before["kind"] == after["kind"]
    assert old.get("exceedances") == new.get("exceedances")


@pytest.mark.parametrize("name", OF_KIND["string"] + OF_KIND["roll"])
def test_pictures_of_strings_and_ships_are_there(name: str) -> None:
    files = {path.name for path in (SHIPPED / name).iterdir()}
    pictures = {"space_time.png", "shapes.png", "modes.png"} if name in OF_KIND["string"] else {"roll.png"}
    assert files == {"summary.json", "summary.md"} | pictures


@pytest.mark.slow_but("catenary")
@pytest.mark.parametrize("name", OF_KIND["thread"])
def test_results_of_threads_are_true(name: str) -> None:
    stored = json.loads((SHIPPED / name / "summary.json").read_text(encoding="utf-8"))
    scene = read_scene(name)
    summary = runner_of(scene)(scene).summary
    old, new = stored["equilibrium"], summary["equilibrium"]
    # Both carry estimated errors; the second terms are rounding.
    length = scene.thread.length
    allowed = old["position_error"] + new["position_error"] + 1e-12 * length
    assert np.array(old["end_positions"]) == pytest.approx(np.array(new["end_positions"]), abs=allowed)
    allowed = old["tension_error"] + new["tension_error"] + 1e-12 * max(abs(old["largest_tension"]), 1.0)
    assert old["end_tensions"] == pytest.approx(new["end_tensions"], abs=allowed)
    for before, after in zip(stored["modes"], summary["modes"], strict=True):
        for one, other in zip(before["oscillating"], after["oscillating"], strict=True):
            allowed = one["relative_error"] + other["relative_error"] + 1e-12
            assert one["damped_omega"] == pytest.approx(other["damped_omega"], abs=allowed * other["omega"])
    for before, after in zip(stored["stability"], summary["stability"], strict=True):
        for one, other in zip(before["thresholds"], after["thresholds"], strict=True):
            assert one["kind"] == other["kind"]
            assert one["factor"] == pytest.approx(other["factor"], rel=one["relative_error"] + other["relative_error"])
    for before, after in zip(stored["motion"], summary["motion"], strict=True):
        allowed = before["extreme_tension_error"] + after["extreme_tension_error"]
        assert before["largest_tension"] == pytest.approx(after["largest_tension"], abs=allowed)


@pytest.mark.parametrize("name", OF_KIND["thread"])
def test_pictures_of_threads_are_there(name: str) -> None:
    files = {path.name for path in (SHIPPED / name).iterdir()}
    pictures = {"equilibrium.png", "tension.png"}
    for analysis in read_scene(name).analysis:
        pictures |= {"motion.png", "tension_in_time.png"} if analysis.kind == "motion" else {f"{analysis.kind}.png"}
    assert files == {"summary.json", "summary.md"} | pictures
