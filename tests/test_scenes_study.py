"""Studies: measured errors fall as theory says, the certified series keeps what it was asked, and files are written."""

import csv
import io
from collections.abc import Iterator
from pathlib import Path

import pytest
from click.testing import CliRunner

from hydroelastic.scenes import study
from hydroelastic.scenes.command_line import main
from hydroelastic.scenes.models import Accuracy, Beam, Liquid, Tank, TankScene
from hydroelastic.scenes.study_report import COLUMNS, study_csv, study_table

SLOSHING = TankScene(
    title="water alone",
    tank=Tank(length=2.0),
    liquid=(Liquid(density=1000.0, depth=0.8),),
    accuracy=Accuracy(modes=3),
)
BEAM = SLOSHING.model_copy(
    update={"body": (Beam(start=0.7, length=0.6, flexural_rigidity=50.0, mass_per_length=5.0, hydrostatic=False),)}
)


@pytest.fixture(scope="module", autouse=True)
def _short() -> Iterator[None]:
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(study, "TOLERANCES", (1e-3, 1e-6))
        patch.setattr(study, "GRADED_DEGREES", (3, 5, 7))
        patch.setattr(study, "UNIFORM_REFINEMENTS", 4)
        yield


@pytest.fixture(scope="module")
def water() -> study.Study:
    return study.study_scene(SLOSHING)


@pytest.fixture(scope="module")
def beam() -> study.Study:
    return study.study_scene(BEAM)


def test_water_alone_converges_with_twice_the_degree(water: study.Study) -> None:
    assert water.reference.startswith("ω²")
    assert {rate.degree: rate.expected for rate in water.rates} == {1: 2.0, 2: 4.0, 3: 6.0}
    for rate in water.rates:
        # Measured 1.97, 3.87 and 5.74: the unstructured meshes of a series are not exactly similar.
        assert rate.observed == pytest.approx(rate.expected, abs=0.4)


def test_a_beam_limits_uniform_meshes_and_not_graded_ones(beam: study.Study) -> None:
    orders = {rate.degree: rate for rate in beam.rates}
    for degree in (2, 3):
        assert orders[degree].expected == 2.0
        # r ln r at the tips: order 2 whatever the degree; measured 1.9 to 2.1 on the finer meshes.
        assert orders[degree].observed == pytest.approx(2.0, abs=0.3)
    graded = [row.error for row in beam.rows if row.family == "graded"]
    best_uniform = min(row.error for row in beam.rows if row.family == "uniform")
    # Two degrees more gain a factor of 25 at the least (measured 5 to 10 for each degree).
    assert graded[1] < graded[0] / 25
    assert graded[2] < min(graded[1] / 25, best_uniform / 100)


def test_the_certified_series_keeps_its_tolerance(beam: study.Study) -> None:
    rows = [row for row in beam.rows if row.family == "tolerance"]
    assert [row.tolerance for row in rows] == [1e-3, 1e-6]
    for row in rows:
        assert row.estimate is not None
        assert row.tolerance is not None
        assert row.error <= row.estimate <= row.tolerance


@pytest.mark.parametrize(
    ("changes", "expected"),
    [
        ({}, 2.0),
        ({"tank": Tank(length=2.0, top="pressure_release")}, 1.0),
        ({"body": (Beam(start=0.0, length=2.0, flexural_rigidity=50.0, mass_per_length=5.0),)}, 4.0),
        ({"body": (Beam(start=0.0, length=2.0, flexural_rigidity=50.0, mass_per_length=5.0, ends="guided"),)}, 8.0),
        ({"body": ()}, 8.0),
    ],
)
def test_the_expected_order_follows_the_singularity(changes: dict[str, object], expected: float) -> None:
    assert study.expected_order(BEAM.model_copy(update=changes), 4) == expected


def test_the_csv_holds_every_row(water: study.Study) -> None:
    rows = list(csv.DictReader(io.StringIO(study_csv(water))))
    assert tuple(rows[0]) == COLUMNS
    assert [float(row["error"]) for row in rows] == [row.error for row in water.rows]
    assert "theory: 4" in study_table(water)


def test_the_command_writes_table_rows_and_figure(tmp_path: Path) -> None:
    folder = tmp_path / "out"
    result = CliRunner().invoke(main, ["study", "sloshing", "--set", "accuracy.modes=2", "--out", str(folder)])
    assert result.exit_code == 0, result.output
    assert "order" in result.stdout
    assert {path.name for path in folder.iterdir()} == {"study.csv", "study.txt", "study.png", "summary.json"}
    assert (folder / "study.png").stat().st_size > 20_000
