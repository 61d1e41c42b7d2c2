"""Ships on a swell: the paper's corrected example, decrements, sections solved as fields, what is said and refused."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from command import run_command
from scene_files import CIRCLE_IN_OPEN_WATER, read_written
from scipy.integrate import solve_ivp

import hydroelastic as he


def rolled(**changes: Any) -> tuple[dict[str, Any], Any]:
    """Summary and angles of the shipped swell with changes; keys are parted by double underscores."""
    result = he.solve(he.read("swell", {key.replace("__", "."): value for key, value in changes.items()}))
    return result.summary, result.dataset.angle.values


@pytest.mark.parametrize(
    ("name", "angles", "peak", "when"),
    [
        # Independent values for slopes of 1, to the digits printed: Duhamel's integral and a Taylor integrator.
        ("swell", [0.57251262, -0.36259389, -0.06776846, 0.37308760], 0.60995, 4.45),
        ("swell_heavily_damped", [0.42495310, -0.16291029, -0.11596702, 0.28292540], 0.46450, 4.34),
    ],
)
def test_the_example_of_the_paper(name: str, angles: list[float], peak: float, when: float) -> None:
    result = he.solve(he.read(name, {"output.times": [5.0, 10.0, 15.0, 20.0, 60.0]}))
    assert result.dataset.angle.values[:4] == pytest.approx(0.1 * np.array(angles), abs=0.6e-9)
    response = result.summary["response"]
    # The largest angle lies between the times of the output.
    assert abs(response["largest_angle"]) == pytest.approx(0.1 * peak, abs=0.6e-6)
    assert response["time_of_largest_angle"] == pytest.approx(when, abs=0.006)
    assert result.summary["status"] == "ok"


def test_a_release_without_waves() -> None:
    summary, _ = rolled(wave=[], roll__angle=0.1, roll__damping_ratio=0.1, output__levels=[0.01, 0.05])
    decrement = np.pi * 0.1 / np.sqrt(1.0 - 0.01)
    assert summary["free_decay"]["ratio_of_swings"] == pytest.approx(np.exp(-decrement), rel=1e-14)
    # 0.1 e^(−jδ) above a level.
    counted = [row["swings"] for row in summary["response"]["exceedances"]]
    assert counted == [int(np.log(0.1 / level) / decrement) + 1 for level in (0.01, 0.05)]


def test_exceedances_are_those_of_a_fine_table_of_the_motion() -> None:
    summary, angle = rolled(output__times={"start": 0.0, "stop": 60.0, "number": 60001})
    pieces = np.split(np.abs(angle), np.flatnonzero(np.diff(np.sign(angle)) != 0) + 1)
    counted = [row["swings"] for row in summary["response"]["exceedances"]]
    assert counted == [sum(piece.max() > level for piece in pieces) for level in (0.02, 0.04, 0.06)]
    assert summary["response"]["root_mean_square"] == pytest.approx(np.sqrt(np.mean(angle**2)), rel=1e-4)


def test_both_dampings_beside_another_integration() -> None:
    """φ'' + 2nφ' + d|φ'|φ' + k²φ = k²α of the slopes, by SciPy; d → 0 is the closed form."""
    _, without = rolled()
    _, little = rolled(roll__quadratic_damping=1e-9)
    # d φ'² is about 1e-9 × 4e-3 of what moves the ship; the integrator keeps the tolerance 1e-8.
    assert little == pytest.approx(without, abs=1.1e-8 * 0.061)
    result = he.solve(he.read("swell", {"roll.quadratic_damping": 5.0, "output.times": [5.0, 10.0, 20.0, 30.0]}))
    slopes = he.solve(he.read("swell", {"output.times": [5.0, 10.0, 20.0, 30.0]})).dataset.wave_slope.values
    periods, k = np.array([8.2, 7.7, 7.5, 8.5, 7.7]), 2.0 * np.pi / 12.0
    starts = np.concatenate([[0.0], np.cumsum(periods)])

    def slope(time: float) -> float:
        number = int(np.searchsorted(starts, time, side="right")) - 1
        return 0.1 * np.sin(2.0 * np.pi * (time - starts[number]) / periods[number]) if number < 5 else 0.0

    assert slopes == pytest.approx([slope(time) for time in (5.0, 10.0, 20.0, 30.0)], abs=1e-14)

    def rates(time: float, y: Any) -> list[float]:
        return [y[1], k**2 * (slope(time) - y[0]) - 2.0 * 0.6 * k * y[1] - 5.0 * abs(y[1]) * y[1]]

    found = solve_ivp(
        rates, (0.0, 30.0), [0.0, 0.0], t_eval=[5.0, 10.0, 20.0, 30.0], rtol=1e-11, atol=1e-13, max_step=0.05
    )
    assert result.dataset.angle.values == pytest.approx(found.y[0], abs=1e-8)


def test_damping_given_as_rate_or_ratio_is_one() -> None:
    _, ratio = rolled()
    _, rate = rolled(roll={"natural_frequency": 0.5235987755982988, "damping": 0.3141592653589793})
    assert rate == pytest.approx(ratio, abs=1e-15)


def test_heavy_damping_keeps_the_default_tolerance() -> None:
    summary, _ = rolled(roll__damping_ratio=1e6)
    assert summary["status"] == "ok"
    # φ ≈ k a (1 − cos ωt)/(2 (n/k) ω): the slowest wave, but the first ones have not yet died away.
    assert abs(summary["response"]["largest_angle"]) < 2e-6 * 0.1


def test_angles_beyond_linear_restoring_and_errors_above_the_tolerance_are_said(tmp_path: Path) -> None:
    # Slopes of 0.1 rad roll it to 0.061 rad, and four times as steep, in resonance and nearly undamped, beyond 0.5 rad.
    steep = {"wave": [{"period": 12.0, "slope": 0.4}] * 2, "roll.damping_ratio": 0.01}
    outcome = he.solve(he.read("swell", steep))
    assert outcome.summary["response"]["restoring_is_linear"] is False
    assert "BEYOND THE THEORY" in str(outcome)
    assert "BEYOND THE THEORY" not in str(he.solve("swell"))
    # Rounding of 1e4 radians of free motion is above 1e-12 of the angle.
    late = ["output.times={start=0, stop=60000, number=3}", "roll.damping_ratio=0", "accuracy.tolerance=1e-12"]
    sets = [part for change in late for part in ("--set", change)]
    ran = run_command("run", "swell", *sets, "--out", str(tmp_path / "out"), "--no-images")
    assert ran.exit_code == 3
    assert "NOT CONVERGED" in ran.output
    assert json.loads((tmp_path / "out" / "summary.json").read_text(encoding="utf-8"))["status"] == "unconverged"


def test_a_section_in_a_tank_gives_its_natural_frequency() -> None:
    asked = {"accuracy__tolerance": 1e-6, "output__times": {"start": 0.0, "stop": 60.0, "number": 61}}
    summary, angle = rolled(roll={"section": "ship_section", "damping_ratio": 0.6}, **asked)
    section = summary["section"]
    # The mode of roll of results/shipped/ship_section, and its added inertia with a stated error of 5e-10.
    assert section["natural_frequency"] == pytest.approx(0.41225772491, rel=1e-9)
    assert section["added_inertia"] == pytest.approx(2338528.6244, rel=2e-9)
    assert section["inertia"] == pytest.approx(9370997.4525, rel=1e-10)
    assert section["stiffness"] == pytest.approx(0.41225772491**2 * (9370997.4525 + 2338528.6244), rel=1e-9)
    assert section["damping"] is None
    assert summary["ship"]["damping"] == pytest.approx(0.6 * section["natural_frequency"], rel=1e-15)
    _, same = rolled(roll={"natural_frequency": section["natural_frequency"], "damping_ratio": 0.6}, **asked)
    assert same == pytest.approx(angle, rel=1e-14)


RECTANGLE = """
kind = "tank"
tank = { length = 60.0, ends = "open" }
liquid = [{ density = 1025.0, depth = 30.0 }]
accuracy = { tolerance = TOLERANCE }
[[body]]
kind = "float"
shape = "rectangle"
position = 30.0
half_width = 6.0
half_height = 3.0
radius_of_gyration = 4.0
centre_of_mass = 0.5
motions = ["roll"]
[[analysis]]
kind = "resonance"
count = 1
"""


def section_in_open_water(folder: Path, tolerance: float) -> tuple[Any, dict[str, Any]]:
    """A rectangle in open water, whose roll makes waves, and the summary of a ship of that section."""
    section = read_written(folder, RECTANGLE.replace("TOLERANCE", str(tolerance)))
    (folder / "section.toml").write_text((folder / "scene.toml").read_text(encoding="utf-8"), encoding="utf-8")
    ship = (
        f'kind = "roll"\nroll = {{ section = "section.toml", angle = 0.1 }}\naccuracy = {{ tolerance = {tolerance} }}\n'
    )
    return section, he.solve(read_written(folder, ship)).summary


def test_a_section_in_open_water_is_the_equation_of_roll(tmp_path: Path) -> None:
    """(I + a) φ'' + bφ' + Cφ = 0 is φ'' + 2nφ' + k²φ = 0."""
    _, summary = section_in_open_water(tmp_path, 3e-2)
    section = summary["section"]
    whole = section["inertia"] + section["added_inertia"]
    assert 2.0 * section["damping"] * whole == pytest.approx(section["wave_damping"], rel=1e-12)
    assert section["natural_frequency"] ** 2 * whole == pytest.approx(section["stiffness"], rel=1e-12)
    assert summary["ship"]["damping"] == pytest.approx(section["damping"], rel=1e-12)
    # Displaced mass by the square of the radius of gyration.
    assert section["inertia"] == pytest.approx(1025.0 * 12.0 * 3.0 * 16.0, rel=1e-10)


@pytest.mark.slow
@pytest.mark.mpi
def test_a_section_in_open_water_rolls_as_its_resonance_says(tmp_path: Path) -> None:
    section, summary = section_in_open_water(tmp_path, 1e-3)
    omega = he.solve(section).modes.omega[0]
    found = summary["section"]
    ratio = found["damping"] / found["natural_frequency"]
    assert ratio > 1e-3
    # Z is real at k and zero at the complex frequency: both differ by the square of the damping ratio, times what
    # added mass changes over the width of the resonance.
    assert omega.real == pytest.approx(found["natural_frequency"], rel=10 * ratio**2 + 1e-3)
    assert -omega.imag == pytest.approx(found["damping"], rel=10 * ratio + 1e-2)


def test_an_error_of_the_section_is_carried_to_the_angle() -> None:
    summary, _ = rolled(roll={"section": "ship_section", "damping_ratio": 0.01}, accuracy__tolerance=1e-12)
    assert summary["status"] == "unconverged"
    assert any("section" in reason for reason in summary["reasons"])
    asked = {"roll": {"section": "ship_section", "damping_ratio": 0.01}, "accuracy__tolerance": 1e-3}
    many, _ = rolled(**asked, output__times={"start": 0.0, "stop": 60.0, "number": 601})
    few, _ = rolled(**asked, output__times=[0.0, 0.001, 60.0])
    assert few["response"]["absolute_error"] == pytest.approx(many["response"]["absolute_error"], rel=1e-9)


@pytest.mark.parametrize(
    ("section", "words"),
    [
        ("swell", ['kind = "roll"', 'kind = "tank"']),
        ("aquarium", ["cannot be the section", '"roll" among its motions']),
        ("nothing.toml", ["there is no such file"]),
    ],
)
def test_a_section_that_does_not_roll_is_refused(section: str, words: list[str]) -> None:
    # Run and check say the same, and name the ship's file and key.
    for command in (("check", "swell"), ("run", "swell", "--no-images")):
        ran = run_command(*command, "--set", f"roll={{section = '{section}'}}")
        assert ran.exit_code == 2
        assert all(word in ran.output for word in [*words, f'[roll], key "section" = "{section}"', "swell.toml"])


def test_a_section_that_nothing_restores_is_refused(tmp_path: Path) -> None:
    """A circle that rolls about its centre is neutral."""
    (tmp_path / "circle.toml").write_text(f'{CIRCLE_IN_OPEN_WATER}motions = ["roll"]\n', encoding="utf-8")
    ship = read_written(tmp_path, 'kind = "roll"\n[roll]\nsection = "circle.toml"\nangle = 0.1\n')
    with pytest.raises(he.SceneError, match="the roll of that section has no restoring moment"):
        he.solve(ship)


def test_there_is_no_field_solution_of_a_ship_to_compare_with() -> None:
    ran = run_command("compare", "swell")
    assert ran.exit_code == 2
    assert "no field solution" in ran.output
