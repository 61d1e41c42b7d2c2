"""The estimates stand beside the field solution of a tank, and their bounds hold."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner
from scene_files import BEAM_IN_TANK

from hydroelastic.modal.estimate import Estimate
from hydroelastic.output.sections import markdown_sections
from hydroelastic.output.tank.tables import tank_sections
from hydroelastic.scenes.command_line import main
from hydroelastic.scenes.tank.run import compare_tank, run_tank
from hydroelastic.scenes.tank.solve import EstimatedTank


def test_compare_says_which_bounds_hold(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "scene.toml").write_text(
        BEAM_IN_TANK + "hydrostatic = false\n[accuracy]\ntolerance = 1e-4\nmodes = 6\n", encoding="utf-8"
    )
    result = CliRunner().invoke(main, ["compare", "scene.toml"])
    assert result.exit_code == 0, result.output
    assert "≥ mode 5: holds" in result.output
    assert "ψ = 0: holds" in result.output
    assert "VIOLATED" not in result.output
    # The comparison comes first, the list of all modes is for the command run.
    assert "Estimates of the first elastic tone" in result.output.splitlines()[1]
    assert "First elastic tone: mode" in result.output
    assert "Natural modes" not in result.output
    # It writes nothing.
    assert [path.name for path in tmp_path.iterdir()] == ["scene.toml"]


@pytest.mark.parametrize("name", ["base_s0", "narrow_s1", "wide_0.9_s1", "soft_s0"])
def test_every_bound_that_is_promised_holds(tanks: Any, name: str) -> None:
    estimates = compare_tank(tanks.case_scene(name)).summary["estimates"]
    promised = {key: row["bound_holds"] for key, row in estimates.items() if row["bound"] != "none"}
    assert True in promised.values()
    assert False not in promised.values(), promised


def test_a_broken_bound_is_said_loudly(tanks: Any) -> None:
    scene = tanks.case_scene("base_s0")
    solution = tanks.solve(scene)
    lowest = float(solution.omega(solution.modes.eigenvalues[0]))
    low = Estimate(
        omega=0.99 * lowest, added_mass_per_length=1.0, bound="above_mode_index", mode_index=1, note="made up"
    )
    summary = run_tank.summarized(scene, EstimatedTank(scene=scene, tank=solution, beam={"low": low}))
    assert summary["estimates"]["low"]["bound_holds"] is False
    assert "VIOLATED" in markdown_sections(summary, tank_sections(run_tank.read(summary)), "")


def test_the_gap_to_the_field_solution_is_the_references(tanks: Any) -> None:
    """Rayleigh's quotient with its rigid recoil: 4.231516 against 4.230524, +0.02 %."""
    summary = compare_tank(tanks.case_scene("base_s0")).summary
    expected = tanks.cases["base_s0"]["rayleigh"]["gravity_rigid"]["omega"] / 4.230523984246685 - 1.0
    assert summary["estimates"]["rayleigh"]["difference"] == pytest.approx(expected, abs=1e-7)
