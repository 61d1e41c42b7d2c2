"""Runs of hanging strings: numbers against references, fronts, files, pictures, sequences, the command."""

import csv
import json
import xml.etree.ElementTree as ElementTree
from pathlib import Path
from typing import Any

import meshio
import numpy as np
import pytest
from click.testing import CliRunner
from mpi4py import MPI
from PIL import Image

from hydroelastic.modal.string.solution import StringSolution
from hydroelastic.scenes.command_line import main
from hydroelastic.scenes.models.string import StringScene
from hydroelastic.scenes.read import read_scene
from hydroelastic.scenes.string.run import run_string
from hydroelastic.scenes.string.solve import solve_string

REFERENCES = Path(__file__).parent / "reference" / "string_and_roll.json"
CASES = [case for case in json.loads(REFERENCES.read_text(encoding="utf-8"))["cases"] if case["kind"] != "roll"]


def string_scene(name: str, *overrides: str) -> StringScene:
    scene = read_scene(name, overrides)
    assert isinstance(scene, StringScene)
    return scene


def solve(name: str, *overrides: str) -> StringSolution:
    return solve_string(string_scene(name, *overrides), MPI.COMM_SELF).solution


def test_liquid_around_a_string_is_another_gravity_and_damping() -> None:
    wet = solve("string_smooth", "string.added_mass=0.02", "string.displaced_mass=0.01")
    gravity, resistance = 9.81 * 0.04 / 0.07, 0.225 * 0.05 / 0.07
    dry = solve("string_smooth", f"string.gravity={gravity!r}", f"string.resistance={resistance!r}")
    assert wet.displacement == pytest.approx(dry.displacement, abs=1e-12)
    assert wet.free_motions.frequencies == pytest.approx(dry.free_motions.frequencies, rel=1e-14)


@pytest.mark.slow
def test_metres_and_millimetres_give_the_same_digits() -> None:
    times = "output.times={start=0, stop=8, number=9}"
    metres = solve("string_sine", times)
    small = solve("string_sine", times, "string.length=1e-3", "string.gravity=9.81e-3", "motion.amplitude=2e-5")
    assert 1e3 * small.displacement == pytest.approx(metres.displacement, abs=1e-12 * metres.largest)


def test_nothing_moves_before_the_front() -> None:
    solution = solve("string_step")
    arrival = solution.string.arrival_times(solution.positions)
    before = solution.times[None, :] < arrival[:, None] * (1.0 - 1e-12)
    assert before.sum() > 1000
    assert np.all(solution.displacement[before] == 0.0)


def test_values_beside_fronts_are_told_apart() -> None:
    summary = run_string(string_scene("string_step")).summary
    beside = summary["response"]["beside_fronts"]
    assert summary["status"] == "ok"
    assert 0 < beside["points"] < 0.06 * summary["response"]["points"]
    # What is said to be certain is; and the step, which jumps, is not near its fronts.
    assert summary["response"]["relative_error"] < 1e-6
    assert beside["absolute_error"] > 1e-3


def test_the_criterion_of_oscillation() -> None:
    viscous = run_string(string_scene("string_smooth")).summary
    assert viscous["string"]["first_oscillating_mode"] == 2
    # The slow root, the fast one, and the second mode.
    assert [mode["kind"] for mode in viscous["modes"][:3]] == ["aperiodic", "aperiodic", "oscillating"]
    assert viscous["modes"][0]["decay"] * viscous["modes"][1]["decay"] == pytest.approx(3.76606738842**2, rel=1e-11)
    assert viscous["modes"][2]["omega"] == pytest.approx(8.64469611368, rel=1e-11)
    assert viscous["string"]["critical_resistance"] == pytest.approx(0.05 * 1.2024127788 * np.sqrt(9.81), rel=1e-9)
    # Just below the critical resistance all oscillate, just above one does not, with the mass of the liquid too.
    carried = "string.added_mass=0.02"
    critical = run_string(string_scene("string_smooth", carried)).summary["string"]["critical_resistance"]
    for factor, first in ((0.999999, 1), (1.000001, 2)):
        resistance = f"string.resistance={factor * critical!r}"
        summary = run_string(string_scene("string_smooth", carried, resistance)).summary
        assert summary["string"]["first_oscillating_mode"] == first


def test_the_steady_amplitude_is_that_of_late_times() -> None:
    late = solve("string_sine", "output.positions=[0.1]", "output.times={start=60.0, stop=62.0, number=2001}")
    summary = run_string(string_scene("string_sine", "output.positions=[0.1]", "output.times=[60.0]")).summary
    # e^{−0.5·60} of the free motion is left, and 2000 points of a period miss its top by 1e-6 of it.
    assert np.abs(late.displacement).max() == pytest.approx(summary["steady"]["amplitude"][0], rel=3e-6)


@pytest.mark.slow
def test_files_tell_one_motion(tmp_path: Path) -> None:
    scene = string_scene("string_table", "output.frames=5", "output.times={start=0, stop=8, number=33}")
    outcome = run_string(scene, out=tmp_path / "result")
    folder = tmp_path / "result"
    solution = solve("string_table", "output.frames=5", "output.times={start=0, stop=8, number=33}")
    names = {
        "manifest.json",
        "summary.json",
        "summary.md",
        "response.csv",
        "modes.csv",
        "dataset.nc",
        "fields",
        "images",
    }
    assert {path.name for path in folder.iterdir()} == names
    assert json.loads((folder / "summary.json").read_text(encoding="utf-8")) == outcome.summary
    with (folder / "response.csv").open(encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert [float(row["displacement"]) for row in rows] == solution.displacement.T.ravel().tolist()
    import xarray

    with xarray.open_dataset(folder / "dataset.nc") as dataset:
        assert dataset.displacement.dims == ("position", "time")
        assert np.array_equal(dataset.displacement.values, solution.displacement)
        assert dataset.root.sel(complex="re").values.tolist() == solution.free_motions.roots.real.tolist()
    # What ParaView plays: times, and the string where it is then.
    entries = ElementTree.parse(folder / "fields" / "string.pvd").findall("Collection/DataSet")
    assert [float(entry.attrib["timestep"]) for entry in entries] == [0.0, 2.0, 4.0, 6.0, 8.0]
    last = meshio.read(folder / "fields" / entries[-1].attrib["file"])
    assert last.points[:, 0].tolist() == solution.displacement[:, -1].tolist()
    pictures = {path.name for path in (folder / "images").iterdir()}
    assert pictures == {"space_time.png", "shapes.png", "modes.png", "frames"}
    frames = sorted((folder / "images" / "frames").iterdir())
    assert [frame.name for frame in frames] == [f"frame_{number:04d}.png" for number in range(5)]
    sizes = set()
    for frame in frames:
        with Image.open(frame) as picture:
            sizes.add(picture.size)
    assert len(sizes) == 1


@pytest.mark.slow
def test_a_single_place_and_time_are_enough(tmp_path: Path) -> None:
    scene = string_scene("string_ramp", "output.positions=[0.3]", "output.times=[0.9]")
    outcome = run_string(scene, out=tmp_path / "one")
    assert outcome.status == "ok"
    assert (tmp_path / "one" / "images" / "shapes.png").is_file()


@pytest.mark.slow_but("ramp-undamped", "ramp-crit", "ramp-over-big")
@pytest.mark.parametrize("case", CASES, ids=lambda case: case["id"])
def test_references_through_a_scene(case: dict[str, Any], tmp_path: Path) -> None:
    given = case["inputs"]
    values = {"ramp": {"speed": "amp"}, "step": {"amplitude": "amp"}, "sine": {"amplitude": "amp", "omega": "omega"}}
    keys = values.get(case["kind"], {"amplitude": "amp", "rate": "beta"})
    motion = "\n".join(f"{key} = {float(given[name])!r}" for key, name in keys.items())
    file = tmp_path / "case.toml"
    file.write_text(
        f'kind = "string"\n[string]\nlength = {float(given["l"])}\nlinear_density = 2.0\n'
        f"gravity = {float(given['g'])}\nresistance = {2.0 * float(given['alpha'])!r}\n"
        f'[motion]\nkind = "{case["kind"]}"\n{motion}\n'
        f"[output]\npositions = [{float(given['x'])!r}]\ntimes = [{float(given['t'])!r}]\n"
        "[accuracy]\ntolerance = 1e-11\n",
        encoding="utf-8",
    )
    solution = solve(str(file))
    # The references have 20 digits; 1e-11 of the largest |f| is asked.
    assert solution.displacement[0, 0] == pytest.approx(float(case["value"]), abs=1e-10)
    assert solution.converged


def test_the_command_runs_and_checks(tmp_path: Path) -> None:
    ran = CliRunner().invoke(main, ["run", "string_ramp", "--out", str(tmp_path / "out"), "--no-images"])
    assert ran.exit_code == 0
    assert "All modes oscillate" in ran.output
    checked = CliRunner().invoke(main, ["check", "string_with_load"])
    assert checked.exit_code == 0
    assert "A body of M = 2 kg less 0.7 kg displaced" in checked.output
    studied = CliRunner().invoke(main, ["study", "string_ramp"])
    assert studied.exit_code == 2
    assert '"tank"' in studied.output
