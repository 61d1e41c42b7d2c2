"""Studies: measured rates are those of theory, tolerances are kept by honest estimates, files hold what was found."""

from __future__ import annotations

import csv
import io
import json
from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

from hydroelastic.fem.study import steady
from hydroelastic.fem.study.meshes import full_order
from hydroelastic.fem.study.rates import Rate
from hydroelastic.fem.study.row import Family
from hydroelastic.fem.study.singular_points import sharpest_of
from hydroelastic.fem.study.theory import expected_order
from hydroelastic.scenes.errors import SceneError
from hydroelastic.scenes.models import Accuracy, Beam, Liquid, MeshFile, Tank, TankScene
from hydroelastic.scenes.models.physical import physical_tank
from hydroelastic.scenes.study.report import csv_columns, study_csv, study_table, write_study
from hydroelastic.scenes.study.run import Study, StudyPlan, study_scene

WATER = TankScene(
    title="water alone",
    tank=Tank(length=2.0),
    liquid=(Liquid(density=1000.0, depth=0.8),),
    accuracy=Accuracy(modes=3),
)
BEAM = WATER.model_copy(
    update={"body": (Beam(start=0.7, length=0.6, flexural_rigidity=2.5, mass_per_length=7.5, hydrostatic=False),)}
)
RELEASED = BEAM.model_copy(update={"tank": Tank(length=2.0, top="pressure_release")})
PLAN = StudyPlan(degrees=(1, 2), geometric_degrees=(5, 6, 7), tolerances=(1e-3, 1e-6), most_unknowns=6000)
MESHES: tuple[Family, ...] = ("uniform", "algebraic", "geometric")


@pytest.fixture(scope="module", autouse=True)
def _solved_once() -> Iterator[None]:
    """Short solutions are not repeated for their seconds."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(steady, "_REPEATS", 0)
        yield


@pytest.fixture(scope="module")
def water() -> Study:
    return study_scene(WATER, PLAN)


@pytest.fixture(scope="module")
def beam() -> Study:
    return study_scene(BEAM, PLAN)


@pytest.fixture(scope="module")
def graded() -> Study:
    return study_scene(BEAM, StudyPlan(families=("uniform", "algebraic"), degrees=(2, 3), most_unknowns=60_000))


@pytest.fixture(scope="module")
def released() -> Study:
    return study_scene(RELEASED, StudyPlan(families=MESHES, degrees=(2,), geometric_degrees=(5, 6, 7, 8)))


def rates(study: Study, family: Family) -> dict[int, Rate]:
    return {rate.degree: rate for rate in study.rates if rate.family == family}


@pytest.mark.slow
def test_water_alone_converges_with_twice_the_degree(water: Study) -> None:
    assert water.reference.name.startswith("ω²")
    found = rates(water, "uniform")
    assert {degree: rate.expected for degree, rate in found.items()} == {1: 2.0, 2: 4.0}
    for rate in found.values():
        # Exactly halved elements: measured 1.997 and 3.98.
        assert rate.observed == pytest.approx(rate.expected, abs=0.1)
        assert len(rate.sizes) == 3
        assert rate.agrees
    # Without a singularity nothing is graded, and no factor is expected of a degree.
    assert not any(row.family == "algebraic" for row in water.rows)
    assert water.gain is None or water.gain.expected is None


@pytest.mark.slow
def test_a_beam_limits_uniform_meshes_to_order_two(beam: Study) -> None:
    found = rates(beam, "uniform")
    assert {degree: rate.expected for degree, rate in found.items()} == {1: 2.0, 2: 2.0}
    # r ln r at the tips. The logarithm bends the slope of degree 1: measured 1.88; of degree 2 2.09.
    assert found[1].observed == pytest.approx(2.0, abs=0.15)
    assert found[2].observed == pytest.approx(2.0, abs=0.15)


def test_graded_meshes_of_degree_one_have_the_full_order(beam: Study) -> None:
    rate = rates(beam, "algebraic")[1]
    assert (rate.grading, rate.expected) == (2.0, 2.0)
    # The first rings count less and less: measured 1.96 on elements of L/16 to L/64.
    assert rate.observed == pytest.approx(2.0, abs=0.1)
    assert rate.agrees


@pytest.mark.slow
def test_algebraic_meshes_have_the_full_order(graded: Study) -> None:
    uniform, found = rates(graded, "uniform"), rates(graded, "algebraic")
    assert {degree: rate.expected for degree, rate in uniform.items()} == {2: 2.0, 3: 2.0}
    for rate in uniform.values():
        assert rate.observed == pytest.approx(2.0, abs=0.05)
    assert {degree: (rate.grading, rate.expected) for degree, rate in found.items()} == {2: (3.0, 4.0), 3: (4.0, 6.0)}
    # Measured 3.88 on elements of L/32 to L/128.
    assert found[2].observed == pytest.approx(4.0, abs=0.2)
    assert found[2].agrees
    # Measured on L/16 to L/64, where the local order still rises: 4.9, 5.6, and 5.9 on the next mesh.
    assert found[3].observed == pytest.approx(5.3, abs=0.15)
    assert not found[3].agrees
    # On the same triangles of degree 3, elements of L/32: measured 11 times better than the uniform mesh.
    one, other = (row for row in graded.rows if (row.degree, row.element_size) == (3, 1 / 32))
    assert (one.family, other.family) == ("uniform", "algebraic")
    assert one.unknowns == other.unknowns
    assert other.lowest_error < 0.2 * one.lowest_error


@pytest.mark.slow
def test_pressure_release_halves_the_exponent(released: Study) -> None:
    # r^{1/2}: order 1 on uniform meshes, and 2p = 4 with β = 2p + 1.
    uniform, algebraic = rates(released, "uniform")[2], rates(released, "algebraic")[2]
    assert (uniform.expected, algebraic.expected, algebraic.grading) == (1.0, 4.0, 5.0)
    # Measured 1.03 and 3.63; the last two meshes alone give 3.75.
    assert uniform.observed == pytest.approx(1.0, abs=0.1)
    assert algebraic.observed == pytest.approx(4.0, abs=0.4)
    # Where the tips alone count the gain is theirs; measured 8.0 for 7.5 to 7.7.
    assert released.gain is not None
    assert released.gain.expected == pytest.approx(7.7, abs=0.6)
    assert released.gain.observed == pytest.approx(released.gain.expected, rel=0.15)
    assert released.gain.agrees
    assert all(min(row.errors) > -row.floor for row in released.rows)


def test_each_degree_gains_on_geometric_rings_what_their_triangles_allow(beam: Study) -> None:
    assert beam.gain is not None
    assert beam.gain.along_a_ray == pytest.approx(11.71, abs=0.01)
    # Computed for the degrees of the fit, which gmsh of another version may shift by one.
    assert beam.gain.expected == pytest.approx(9.7, abs=0.6)
    assert beam.gain.agrees


@pytest.mark.slow
def test_errors_are_positive_until_they_are_rounding(water: Study, beam: Study) -> None:
    for study in (water, beam):
        for row in study.rows:
            if row.family != "tolerance":
                assert min(row.errors) > -row.floor


@pytest.mark.slow_but("beam")
@pytest.mark.parametrize("name", ["water", "beam"])
def test_tolerances_are_kept_and_estimates_are_honest(name: str, request: pytest.FixtureRequest) -> None:
    study: Study = request.getfixturevalue(name)
    rows = [row for row in study.rows if row.family == "tolerance"]
    assert [row.tolerance for row in rows] == [1e-3, 1e-6]
    for row in rows:
        assert row.estimate is not None
        assert row.tolerance is not None
        assert row.error <= row.tolerance
        assert row.estimate <= row.tolerance
        if row.error > row.floor:
            assert row.error / 3.0 <= row.estimate <= 30.0 * row.error
        assert not row.reasons
        assert row.attempts >= 1
    assert study.reasons == ()


def test_the_reference_is_finer_than_what_it_judges(beam: Study) -> None:
    assert 0.0 < beam.reference.uncertainty < 1e-10
    assert all(row.floor >= beam.reference.uncertainty for row in beam.rows)
    for rate in beam.rates:
        used = [row for row in beam.rows if (row.family, row.degree) == (rate.family, rate.degree)]
        used = [row for row in used if row.element_size in rate.sizes]
        assert all(abs(row.errors[rate.mode - 1]) > row.floor for row in used)


def test_meshes_stay_within_the_unknowns_of_the_plan(beam: Study) -> None:
    nested = [row for row in beam.rows if row.family in ("uniform", "algebraic")]
    # The plan counts those of ψ in both halves; a row those of the surfaces and the beam's shapes besides.
    assert 0.5 * PLAN.most_unknowns < max(row.unknowns for row in nested) < 1.05 * PLAN.most_unknowns
    assert [row.element_size for row in nested[:4]] == [0.125 / 2**k for k in range(4)]


@pytest.mark.slow
def test_a_tank_is_solved_as_halves_in_every_family_or_in_none(beam: Study) -> None:
    assert beam.halves
    assert "as two halves" in study_table(beam)
    moved = BEAM.body[0].model_copy(update={"start": 0.5})
    plan = StudyPlan(families=("uniform",), degrees=(1,), halvings=2)
    whole = study_scene(BEAM.model_copy(update={"body": (moved,)}), plan)
    assert not whole.halves
    assert "not its own mirror image" in study_table(whole)


@pytest.mark.parametrize(
    ("changes", "uniform", "beta"),
    [
        ({}, 2.0, 5.0),
        ({"tank": Tank(length=2.0, top="pressure_release")}, 1.0, 9.0),
        ({"body": (Beam(start=0.0, length=2.0, flexural_rigidity=50.0, mass_per_length=5.0),)}, 4.0, 3.0),
        ({"body": (Beam(start=0.0, length=2.0, flexural_rigidity=50.0, mass_per_length=5.0, ends="guided"),)}, 8.0, 0),
        ({"body": ()}, 8.0, 0),
    ],
)
def test_expected_orders_follow_the_singularity(changes: dict[str, object], uniform: float, beta: float) -> None:
    tank = physical_tank(BEAM.model_copy(update=changes)).scaled()
    exponent = sharpest_of(tank)
    assert expected_order(tank, 4) == uniform
    if beta:
        assert exponent is not None
        assert full_order(4, exponent) == beta
        assert expected_order(tank, 4, beta) == 8.0
        # Half the exponent of the singularity is not enough: min(2p, 2αβ).
        assert expected_order(tank, 4, 1.5) == 1.5 * uniform
    else:
        assert exponent is None


def test_the_csv_holds_every_row_at_full_precision(beam: Study) -> None:
    rows = list(csv.DictReader(io.StringIO(study_csv(beam))))
    assert tuple(rows[0]) == csv_columns(beam)
    assert len(rows) == len(beam.rows)
    for written, row in zip(rows, beam.rows, strict=True):
        assert written["family"] == row.family
        assert int(written["unknowns"]) == row.unknowns
        assert float(written["error"]) == row.error
        assert float(written["lowest_error"]) == row.lowest_error
        assert written["halves"] == "1"
        stages = [float(value) for name, value in written.items() if name.endswith("_seconds")]
        assert sum(stages) == pytest.approx(float(written["seconds"]), rel=1e-12)
        assert (written["tolerance"] == "") == (row.family != "tolerance")
        assert (written["estimate"] == "") == (row.estimate is None)
    assert {"mesh_seconds", "assemble_seconds", "solve_seconds", "errors_seconds"} <= set(rows[0])


@pytest.mark.slow
def test_larger_models_take_more_memory(graded: Study) -> None:
    series = [row.memory for row in graded.rows if row.family == "uniform" and row.degree == 3]
    if None in series:
        pytest.skip("this system does not tell")
    memory = np.array(series, dtype=float)
    # Measured 14 and 37 MB: factors of n log n unknowns, and not the peak of the rows before.
    assert 2.0 < memory[-1] / memory[-2] < 8.0


def test_the_table_sets_observed_rates_beside_those_of_theory(beam: Study) -> None:
    text = study_table(beam)
    assert "observed" in text
    assert "expected" in text
    assert max(map(len, text.splitlines())) <= 120
    for rate in beam.rates:
        assert f"{rate.observed:.3f} ± {rate.deviation:.3f}" in text
    assert "along a ray" in text
    assert "Tolerances: all kept" in text


def test_a_rate_that_differs_is_flagged(beam: Study) -> None:
    # Degree 2 on coarse meshes: 3.0, far from its order of 4.
    assert not rates(beam, "algebraic")[2].agrees
    assert "not yet asymptotic" in study_table(beam)


def test_write_study_leaves_a_result_folder(beam: Study, tmp_path: Path) -> None:
    write_study(beam, tmp_path / "out")
    assert {path.name for path in (tmp_path / "out").iterdir()} == {
        "study.csv",
        "study.txt",
        "study.png",
        "summary.json",
        "manifest.json",
    }
    assert (tmp_path / "out" / "study.png").stat().st_size > 20_000
    summary = json.loads((tmp_path / "out" / "summary.json").read_text(encoding="utf-8"))
    assert summary["status"] == "ok"
    assert summary["halves"] is True
    assert len(summary["rows"]) == len(beam.rows)
    assert summary["rates"][0]["observed"] == beam.rates[0].observed
    assert summary["gain"]["expected"] == beam.gain.expected if beam.gain else False


def test_a_scene_with_a_mesh_of_its_own_is_refused() -> None:
    scene = WATER.model_copy(update={"mesh": MeshFile(file=Path("mine.msh"))})
    with pytest.raises(SceneError, match="makes its own meshes"):
        study_scene(scene)
