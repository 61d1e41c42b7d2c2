"""Shipped scenes of boxes and plans: their model, their numbers, and what they write."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from plan_tanks import frequencies

from hydroelastic.scenes.kinds import checker_of, runner_of
from hydroelastic.scenes.read import read_scene

MODELS = {
    "rectangular_cover": "products of two intervals",
    "ice_in_a_triangle": "triangles on the plan",
    "two_plates": "triangles on the plan",
}


@pytest.mark.parametrize("name", MODELS)
def test_check_tells_the_smallest_model(name: str) -> None:
    asked = read_scene(name)
    text = "\n".join(line for section in checker_of(asked)(asked) for line in section.lines)
    assert MODELS[name] in text
    assert "no volume mesh" in text
    assert "polynomials along each direction" in text


def test_a_rectangular_cover_has_the_modes_of_its_reference() -> None:
    asked = read_scene("rectangular_cover")
    summary = runner_of(asked)(asked).summary
    omega = [mode["omega"] for mode in summary["modes"]]
    assert omega == pytest.approx(frequencies("rectangle_base_s0")[:12], rel=1e-6)
    assert summary["status"] == "ok"
    assert summary["size"]["problems"] == 4


def test_an_ice_sheet_in_a_triangle_has_double_tones() -> None:
    asked = read_scene("ice_in_a_triangle")
    summary = runner_of(asked)(asked).summary
    modes = summary["modes"]
    # The group of the triangle: pairs of two-dimensional representations are equal to the tolerance.
    for first, second in ((0, 1), (3, 4), (5, 6)):
        assert modes[first]["omega"] == pytest.approx(modes[second]["omega"], rel=1e-6)
    # Tilting is slower than sloshing without ice only by the ice's mass: ω² = g k tanh kH without it, k = 4π/(3·6 m).
    free = frequencies("slosh_triangle")[0]
    assert 0.99 * free < modes[0]["omega"] < free
    assert summary["status"] == "ok"


@pytest.mark.slow
def test_two_plates_are_written_and_drawn(tmp_path: Path) -> None:
    from click.testing import CliRunner

    from hydroelastic.scenes.command_line import main

    folder = tmp_path / "results"
    ended = CliRunner().invoke(main, ["run", "two_plates", "--out", str(folder), "--no-images", "--quiet"])
    assert ended.exit_code == 0, ended.output
    summary = json.loads((folder / "summary.json").read_text())
    # Converged to 1e-7 by another refinement.
    assert [mode["omega"] for mode in summary["modes"][:2]] == pytest.approx([1.30905794, 2.00166244], rel=1e-6)
    assert {path.name for path in (folder / "fields").iterdir()} == {"surface.vtu", "volume.vtu"}


def test_orders_and_boxes_import_no_mesher_and_no_dolfinx() -> None:
    import subprocess
    import sys

    program = (
        "import sys; from mpi4py import MPI; from hydroelastic.scenes.read import read_scene;"
        "from hydroelastic.scenes.level_tank.solve import solve_level_scene;"
        "scene = read_scene('rectangular_cover', ('accuracy.tolerance=1e-2', 'accuracy.modes=1'));"
        "solve_level_scene(scene, MPI.COMM_SELF, lambda _: None);"
        "print([name for name in ('dolfinx', 'ufl', 'basix', 'gmsh') if name in sys.modules])"
    )
    ended = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True)
    assert ended.stdout.strip() == "[]"


def test_a_study_asks_each_model_for_tolerances(tmp_path: Path) -> None:
    from click.testing import CliRunner

    from hydroelastic.scenes.command_line import main

    folder = tmp_path / "study"
    arguments = ["study", "rectangular_cover", "--out", str(folder), "--tolerances", "1e-2,1e-3"]
    ended = CliRunner().invoke(main, [*arguments, "--set", "accuracy.modes=3"])
    assert ended.exit_code == 0, ended.output
    rows = json.loads((folder / "summary.json").read_text(encoding="utf-8"))["rows"]
    assert [(row["model"], row["tolerance"]) for row in rows] == [
        (model, tolerance) for model in ("box", "plan") for tolerance in (1e-2, 1e-3)
    ]
    for row in rows:
        assert max(map(abs, row["errors"])) <= row["estimate"] <= row["tolerance"]
    assert (folder / "study.csv").is_file()
    assert (folder / "study.png").is_file()
    refused = CliRunner().invoke(main, [*arguments, "--families", "uniform"])
    assert refused.exit_code == 2
    assert "tolerance" in refused.output
