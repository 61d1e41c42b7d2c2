"""Runs of ships on a swell: numbers against the paper's corrected example, files, pictures, sections, the command."""

import csv
import json
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner
from mpi4py import MPI
from PIL import Image
from scene_files import CIRCLE_IN_OPEN_WATER, read_written

from hydroelastic.fem.open_water.problem import OpenWaterProblem
from hydroelastic.fem.open_water.requests import ResonanceRequest
from hydroelastic.fem.open_water.resonance import solve_resonance
from hydroelastic.fem.section_roll import SectionRoll, section_roll
from hydroelastic.fem.stopwatch import Stopwatch
from hydroelastic.scenes.command_line import main
from hydroelastic.scenes.errors import SceneError
from hydroelastic.scenes.kinds import checker_of
from hydroelastic.scenes.models.roll import RollScene
from hydroelastic.scenes.models.tank import TankScene
from hydroelastic.scenes.open_water.physics import open_water_problem
from hydroelastic.scenes.read import read_scene
from hydroelastic.scenes.roll.run import run_roll
from hydroelastic.scenes.roll.solve import solve_roll
from hydroelastic.scenes.run import run_scene


def roll_scene(name: str, *overrides: str) -> RollScene:
    scene = read_scene(name, overrides)
    assert isinstance(scene, RollScene)
    return scene


def solve(name: str, *overrides: str):  # type: ignore[no-untyped-def]
    return solve_roll(roll_scene(name, *overrides), MPI.COMM_SELF)


@pytest.mark.parametrize(
    ("name", "angles", "peak", "when"),
    [
        # Independent values for slopes of 1, to the digits printed: Duhamel's integral and a Taylor integrator.
        ("swell", [0.57251262, -0.36259389, -0.06776846, 0.37308760], 0.60995, 4.45),
        ("swell_heavily_damped", [0.42495310, -0.16291029, -0.11596702, 0.28292540], 0.46450, 4.34),
    ],
)
def test_the_example_of_the_paper(name: str, angles: list[float], peak: float, when: float) -> None:
    result = solve(name, "output.times=[5.0, 10.0, 15.0, 20.0, 60.0]")
    assert result.solution.motion.angle[:4] == pytest.approx(0.1 * np.array(angles), abs=0.6e-9)
    # The largest angle lies between the times of the output.
    assert result.solution.statistics.largest_angle == pytest.approx(0.1 * peak, abs=0.6e-6)
    assert result.solution.statistics.largest_time == pytest.approx(when, abs=0.006)
    assert result.reasons == ()


def test_angles_beyond_linear_restoring_are_said(tmp_path: Path) -> None:
    # Slopes of 0.1 rad roll it to 0.061 rad, and four times as steep, in resonance and nearly undamped, beyond 0.5 rad.
    assert "BEYOND THE THEORY" not in run_roll(roll_scene("swell")).tables
    steep = ("wave=[{period=12.0, slope=0.4}, {period=12.0, slope=0.4}]", "roll.damping_ratio=0.01")
    outcome = run_roll(roll_scene("swell", *steep), out=tmp_path / "result", images=None)
    assert outcome.status == "ok"
    assert outcome.summary["response"]["restoring_is_linear"] is False
    for text in (outcome.tables, (tmp_path / "result" / "summary.md").read_text(encoding="utf-8")):
        assert "BEYOND THE THEORY" in text


def test_one_wave_is_one(tmp_path: Path) -> None:
    one = ("wave=[{period=7.0, slope=0.1}]", "output.levels=[]")
    assert "Motion on 1 wave," in run_roll(roll_scene("swell", *one)).tables
    checked = CliRunner().invoke(main, ["check", "swell", "--set", one[0]])
    assert "1 wave: period 7 s, slope 0.1 rad." in checked.output


def test_exceedances_count_swings_above_levels() -> None:
    result = solve("swell")
    swings = np.abs(result.solution.statistics.swing_angles)
    summary = run_roll(roll_scene("swell")).summary
    counted = [row["swings"] for row in summary["response"]["exceedances"]]
    assert counted == [int(np.sum(swings > level)) for level in (0.02, 0.04, 0.06)]
    # Beside it, from a fine table of the motion: one stretch between zeros is above 0.06 rad, three are below 0.02.
    fine = solve("swell", "output.times={start=0, stop=60, number=60001}").solution.motion.angle
    pieces = np.split(np.abs(fine), np.flatnonzero(np.diff(np.sign(fine)) != 0) + 1)
    assert counted == [sum(piece.max() > level for piece in pieces) for level in (0.02, 0.04, 0.06)]


def test_damping_given_as_rate_or_ratio_is_one() -> None:
    ratio = solve("swell").solution.motion.angle
    rate = solve(
        "swell", "roll={natural_frequency = 0.5235987755982988, damping = 0.3141592653589793}"
    ).solution.motion.angle
    assert rate == pytest.approx(ratio, abs=1e-15)


def test_quadratic_damping_tends_to_none() -> None:
    without = solve("swell").solution.motion.angle
    little = solve("swell", "roll.quadratic_damping=1e-9").solution.motion.angle
    # d φ'² is about 1e-9 × 4e-3 of what moves the ship; the integrator keeps the tolerance 1e-8.
    assert little == pytest.approx(without, abs=1.1e-8 * 0.061)
    more = solve("swell", "roll.quadratic_damping=5.0")
    # It takes as much energy as 4/(3π) d k A = 0.07 1/s more of n = 0.31 1/s would.
    assert np.abs(more.solution.motion.angle).max() < 0.95 * np.abs(without).max()
    assert more.solution.angle_error < 1e-8 * 0.061


def test_a_release_without_waves() -> None:
    overrides = ("wave=[]", "roll.angle=0.1", "roll.damping_ratio=0.1", "output.levels=[]")
    result = solve("swell", *overrides)
    swings = np.abs(result.solution.statistics.swing_angles)
    # The exact decrement, to rounding of the extremes.
    ratio = np.exp(-np.pi * 0.1 / np.sqrt(1.0 - 0.01))
    assert swings[1:5] / swings[:4] == pytest.approx(ratio, rel=1e-12)
    decay = run_roll(roll_scene("swell", *overrides)).summary["free_decay"]
    assert decay["ratio_of_swings"] == pytest.approx(ratio, rel=1e-14)


def test_files_tell_one_motion(tmp_path: Path) -> None:
    outcome = run_roll(roll_scene("swell"), out=tmp_path / "result")
    folder = tmp_path / "result"
    result = solve("swell")
    assert {path.name for path in folder.iterdir()} == {
        "manifest.json",
        "summary.json",
        "summary.md",
        "response.csv",
        "dataset.nc",
        "images",
    }
    with (folder / "response.csv").open(encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert [float(row["angle"]) for row in rows] == result.solution.motion.angle.tolist()
    assert json.loads((folder / "summary.json").read_text(encoding="utf-8")) == outcome.summary
    import xarray

    with xarray.open_dataset(folder / "dataset.nc") as dataset:
        assert dataset.angle.values.tolist() == result.solution.motion.angle.tolist()
        assert dataset.acceleration.attrs["units"] == "rad/s^2"
    with Image.open(folder / "images" / "roll.png") as picture:
        assert picture.width > 1000
    assert "largest angle, rad" in (folder / "summary.md").read_text(encoding="utf-8")


def test_the_command_runs_and_checks(tmp_path: Path) -> None:
    ran = CliRunner().invoke(main, ["run", "swell", "--out", str(tmp_path / "out"), "--no-images"])
    assert ran.exit_code == 0
    assert "largest angle, degrees" in ran.output
    assert not (tmp_path / "out" / "images").exists()
    checked = CliRunner().invoke(main, ["check", "swell_record"])
    assert checked.exit_code == 0
    assert "150 waves" in checked.output
    compared = CliRunner().invoke(main, ["compare", "swell"])
    assert compared.exit_code == 2
    assert "no field solution" in compared.output


def test_an_error_above_the_tolerance_is_said(tmp_path: Path) -> None:
    # Rounding of 1e4 radians of free motion is above 1e-12 of the angle.
    times = "output.times={start=0, stop=60000, number=3}"
    ran = CliRunner().invoke(
        main, ["run", "swell", "--set", "roll.damping_ratio=0", "--set", times, "--set", "accuracy.tolerance=1e-12",
               "--out", str(tmp_path / "out"), "--no-images"]
    )  # fmt: skip
    assert ran.exit_code == 3
    assert "NOT CONVERGED" in ran.output


def test_a_section_in_a_tank_gives_its_natural_frequency() -> None:
    swell = "roll={section = 'ship_section', damping_ratio = 0.6}"
    result = solve("swell", swell, "accuracy.tolerance=1e-6", "output.times={start=0, stop=60, number=61}")
    section = result.section
    assert section is not None
    # The mode of roll of results/shipped/ship_section, and its added inertia with a stated error of 5e-10.
    assert section.natural_frequency == pytest.approx(0.41225772491, rel=1e-9)
    assert section.added_inertia == pytest.approx(2338528.6244, rel=2e-9)
    assert section.inertia == pytest.approx(9370997.4525, rel=1e-10)
    assert section.stiffness == pytest.approx(0.41225772491**2 * (9370997.4525 + 2338528.6244), rel=1e-9)
    assert section.damping is None
    assert result.solution.ship_error > 0.0
    assert result.solution.ship.damping == pytest.approx(0.6 * section.natural_frequency, rel=1e-15)
    same = solve(
        "swell", f"roll={{natural_frequency = {section.natural_frequency!r}, damping_ratio = 0.6}}",
        "output.times={start=0, stop=60, number=61}",
    )  # fmt: skip
    assert same.solution.motion.angle.tolist() == result.solution.motion.angle.tolist()


@pytest.mark.parametrize(
    ("section", "words"),
    [
        ("swell", ['kind = "roll"', 'kind = "tank"']),
        ("aquarium", ["cannot be the section", '"roll" among its motions']),
        ("nothing.toml", ["there is no such file"]),
    ],
)
def test_a_section_that_does_not_roll_is_refused(section: str, words: list[str]) -> None:
    with pytest.raises(SceneError) as error:
        solve("swell", f"roll={{section = '{section}'}}")
    assert all(word in str(error.value) for word in words)
    # The check says the same, before anything is solved, and both name the ship's file and key.
    assert f'[roll], key "section" = "{section}"' in str(error.value)
    checked = CliRunner().invoke(main, ["check", "swell", "--set", f"roll={{section = '{section}'}}"])
    assert checked.exit_code == 2
    assert checked.output == f"Error: {error.value}\n"
    assert "swell.toml with --set" in checked.output


@pytest.mark.slow
def test_an_error_of_the_section_is_carried_to_the_angle() -> None:
    result = solve("swell", "roll={section = 'ship_section', damping_ratio = 0.01}", "accuracy.tolerance=1e-12")
    assert result.solution.ship_error > 0.0
    assert any("section" in reason for reason in result.reasons)


@pytest.mark.slow
def test_that_error_does_not_depend_on_the_times_of_the_output() -> None:
    given = ("roll={section = 'ship_section', damping_ratio = 0.01}", "accuracy.tolerance=1e-3")
    many = solve("swell", *given, "output.times={start=0, stop=60, number=601}")
    few = solve("swell", *given, "output.times=[0.0, 0.001, 60.0]")
    assert few.solution.ship_error == pytest.approx(many.solution.ship_error, rel=1e-12)


@pytest.mark.slow
def test_what_a_section_makes_impossible_is_refused() -> None:
    with pytest.raises(SceneError, match="natural periods"):
        solve("swell", "roll={section = 'ship_section'}", "accuracy.tolerance=1e-2", "output.times=[1e8]")


def test_heavy_damping_keeps_the_default_tolerance() -> None:
    result = solve("swell", "roll.damping_ratio=1e6")
    assert result.reasons == ()
    # φ ≈ k a (1 − cos ωt)/(2 (n/k) ω): the slowest wave, but the first ones have not yet died away.
    assert abs(result.solution.statistics.largest_angle) < 2e-6 * 0.1


def rolling_rectangle(tolerance: float) -> tuple[OpenWaterProblem, SectionRoll]:
    """A rectangle in open water, whose roll makes waves: damping by waves of a per cent."""
    scene = read_scene(
        "open_ship_section",
        [
            "body.1={kind='float', shape='rectangle', position=30.0, half_width=6.0, half_height=3.0, "
            "radius_of_gyration=4.0, centre_of_mass=0.5, motions=['roll']}",
            f"accuracy.tolerance={tolerance}",
        ],
    )
    assert isinstance(scene, TankScene)
    problem = open_water_problem(scene, MPI.COMM_WORLD, Stopwatch())
    return problem, section_roll(problem.tank, tolerance=tolerance, modes=1, comm=MPI.COMM_WORLD)


def test_the_damping_of_a_section_is_that_of_the_equation_of_roll() -> None:
    """(I + a) φ'' + bφ' + Cφ = 0 is φ'' + 2nφ' + k²φ = 0."""
    _, found = rolling_rectangle(3e-2)
    assert found.damping is not None
    whole = found.inertia + found.added_inertia
    assert 2.0 * found.damping * whole == pytest.approx(found.wave_damping, rel=1e-12)
    assert found.natural_frequency**2 * whole == pytest.approx(found.stiffness, rel=1e-12)


@pytest.mark.slow
@pytest.mark.mpi
def test_a_section_in_open_water_rolls_as_its_resonance_says() -> None:
    problem, found = rolling_rectangle(1e-3)
    omega = solve_resonance(problem, ResonanceRequest(count=1)).table.omega[0]
    assert found.damping is not None
    ratio = found.damping / found.natural_frequency
    assert ratio > 1e-3
    # Z is real at k and zero at the complex frequency: both differ by the square of the damping ratio, times what
    # added mass changes over the width of the resonance.
    assert omega.real == pytest.approx(found.natural_frequency, rel=10 * ratio**2 + 1e-3)
    assert -omega.imag == pytest.approx(found.damping, rel=10 * ratio + 1e-2)


def test_a_section_that_nothing_restores_is_refused_before_anything_is_solved(tmp_path: Path) -> None:
    """A circle that rolls about its centre is neutral."""
    (tmp_path / "circle.toml").write_text(f'{CIRCLE_IN_OPEN_WATER}motions = ["roll"]\n', encoding="utf-8")
    ship = read_written(tmp_path, 'kind = "roll"\n[roll]\nsection = "circle.toml"\nangle = 0.1\n')
    for use in (run_scene, lambda scene: tuple(checker_of(scene)(scene))):
        with pytest.raises(SceneError, match="the roll of that section has no restoring moment"):
            use(ship)
