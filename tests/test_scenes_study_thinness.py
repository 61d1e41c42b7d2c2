"""Thinness: the difference between thin and exact boundary falls with the powers of the thinness that theory gives."""

from __future__ import annotations

import csv
import io
import json
from pathlib import Path
from typing import Any

import pytest
from click.testing import CliRunner

from hydroelastic.fem.study.thinness import QUANTITIES, fitted_thinness
from hydroelastic.scenes.command_line import main
from hydroelastic.scenes.errors import SceneError
from hydroelastic.scenes.models.tank import TankScene
from hydroelastic.scenes.read import read_scene
from hydroelastic.scenes.study.report import study_table, write_study
from hydroelastic.scenes.study.run import Study, StudyPlan, study_scene
from hydroelastic.scenes.study.thinness import check_thinness
from hydroelastic.scenes.study.thinness_report import thinness_csv

FLOAT = {
    "kind": "float",
    "shape": "parabola",
    "position": 0.5,
    "half_width": 0.005,
    "half_height": 0.3,
}
PLAN = StudyPlan(families=("thinness",), width_halvings=2)


def scene(**changes: Any) -> TankScene:
    # Heave lies well below the first wave that it moves: no resonance is shared with waves.
    return TankScene.model_validate(
        {
            "kind": "tank",
            "tank": {"length": 1.0, "top": "rigid"},
            "liquid": [{"density": 1000.0, "depth": 0.6}, {"density": 800.0, "depth": 0.5}],
            "body": [FLOAT | changes],
            "accuracy": {"modes": 4},
        }
    )


@pytest.fixture(scope="module")
def study() -> Study:
    return study_scene(scene(), PLAN)


@pytest.mark.slow
def test_differences_fall_as_theory_says(study: Study) -> None:
    assert [row.half_width for row in study.thinness] == [0.005, 0.0025, 0.00125]
    assert [row.thinness for row in study.thinness] == pytest.approx([0.005 / 0.3 / 2**k for k in range(3)])
    assert [row.breadth for row in study.thinness] == pytest.approx([0.005 / 2**k for k in range(3)])
    found = {rate.quantity: rate for rate in fitted_thinness(study.thinness)}
    assert found.keys() == QUANTITIES.keys()
    # Measured 1.89, 1.83, 1.00, 1.00 and 0.99, with terms of the next order.
    for quantity, power in (("heave", 2.0), ("modal mass", 2.0), ("added mass", 1.0), ("wave 1", 1.0), ("wave 2", 1.0)):
        assert found[quantity].expected == power
        assert found[quantity].observed == pytest.approx(power, abs=0.1 * power)
        assert found[quantity].agrees
        assert not found[quantity].shared


@pytest.mark.slow
def test_differences_are_those_of_the_boundary(study: Study) -> None:
    for row in study.thinness:
        for found in row.compared.values():
            assert found.is_clear
            assert found.uncertainty < 1e-7
    first = study.thinness[0].compared
    # The thin float is too heavy in heave by an added mass that is too small: it is about 2 τ of that.
    assert -1e-3 < first["heave"].difference < -1e-5
    assert first["added mass"].difference == pytest.approx(-0.5 * 0.005 / 0.3, rel=0.2)


@pytest.mark.slow
def test_a_given_mass_goes_with_the_width() -> None:
    # It floats deeper than with the 3.6 kg/m that keep its widest section at the interface.
    heavier = study_scene(scene(mass=3.7), PLAN).thinness
    assert len(heavier) == 3
    for row in heavier:
        assert row.compared["heave"].is_clear


@pytest.mark.slow
def test_heave_that_is_shared_with_waves_is_said_to_be() -> None:
    rows = study_scene(
        read_scene("float_ellipse", ['body.1.motions=["heave"]', "body.1.half_width=0.2"]),
        PLAN,
    ).thinness
    found = {rate.quantity: rate for rate in fitted_thinness(rows)}
    assert found["heave"].shared
    assert not found["heave"].agrees
    # What shifts the waves, in proportion to the width, shifts heave with them: measured 1.03.
    assert found["heave"].observed == pytest.approx(1.0, abs=0.2)
    assert not found["added mass"].shared


@pytest.mark.slow
def test_table_csv_and_figure_tell_the_same(study: Study, tmp_path: Path) -> None:
    text = study_table(study)
    assert "Thin against exact boundary" in text
    assert "error against cost" not in text
    assert max(map(len, text.splitlines())) <= 120
    rows = list(csv.DictReader(io.StringIO(thinness_csv(study.thinness))))
    for written, row in zip(rows, study.thinness, strict=True):
        assert float(written["half_width"]) == row.half_width
        for name, found in row.compared.items():
            column = name.replace(" ", "_")
            assert float(written[f"{column}_thin"]) == found.thin
            assert float(written[f"{column}_exact"]) == found.exact
            assert float(written[f"{column}_difference"]) == found.difference
            assert f"{found.difference:+.2e}" in text
    write_study(study, tmp_path / "out")
    names = {path.name for path in (tmp_path / "out").iterdir()}
    assert names == {"study.txt", "thinness.csv", "thinness.png", "summary.json", "manifest.json"}
    assert (tmp_path / "out" / "thinness.png").stat().st_size > 20_000
    summary = json.loads((tmp_path / "out" / "summary.json").read_text(encoding="utf-8"))
    assert summary["status"] == "ok"
    assert len(summary["thinness"]) == len(study.thinness)
    assert {rate["quantity"] for rate in summary["thinness_rates"]} == set(QUANTITIES)


def test_it_is_not_made_unless_asked_for() -> None:
    assert "thinness" not in StudyPlan().families


@pytest.mark.parametrize(
    ("name", "changes"),
    [
        ("aquarium", ()),
        ("float_ellipse", ()),
        ("float_ellipse", ('body.1.motions=["heave"]', 'body.1.shape="rectangle"')),
    ],
)
def test_scenes_without_a_float_that_both_know_are_refused(name: str, changes: tuple[str, ...]) -> None:
    with pytest.raises(SceneError, match="thinness"):
        check_thinness(read_scene(name, changes))
    arguments = ["study", name, "--families", "thinness"]
    result = CliRunner().invoke(main, [*arguments, *(part for change in changes for part in ("--set", change))])
    assert result.exit_code == 2
    assert "that heaves alone" in result.stderr


def test_the_shipped_study_is_that_of_the_shipped_scene() -> None:
    shipped = Path(__file__).parent.parent / "results" / "shipped" / "float_parabola" / "thinness.csv"
    rows = list(csv.DictReader(io.StringIO(shipped.read_text(encoding="utf-8"))))
    body = read_scene("float_parabola").floats[0][1]
    assert float(rows[0]["half_width"]) == body.half_width
    # Known from a series, see the scene.
    assert float(rows[0]["heave_thin"]) == pytest.approx(1.23460582741446, rel=1e-8)
    for column in ("added_mass", "wave_1", "wave_2"):
        first, last = (abs(float(row[f"{column}_difference"])) for row in (rows[0], rows[-1]))
        # In proportion to the width, from 1 to 1/64 of it: measured 60, 70 and 63.
        assert first / last == pytest.approx(2 ** (len(rows) - 1), rel=0.15)
