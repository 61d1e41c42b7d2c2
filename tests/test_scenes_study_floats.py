"""Studies of two liquids and of floats: orders are those of the sharpest corner that modes of a symmetry meet."""

from __future__ import annotations

from typing import Any

import pytest

from hydroelastic.fem.study.meshes import full_order
from hydroelastic.fem.study.rates import Rate
from hydroelastic.fem.study.row import Family
from hydroelastic.fem.study.singular_points import sharpest_of, singular_exponents, symmetries_apart
from hydroelastic.fem.study.theory import expected_order
from hydroelastic.physics.symmetry import Parity
from hydroelastic.scenes.models.physical import physical_tank
from hydroelastic.scenes.models.tank import TankScene
from hydroelastic.scenes.study.report import study_table
from hydroelastic.scenes.study.run import Study, StudyPlan, study_scene

WATER = {"density": 1000.0, "depth": 0.6}
OIL = {"density": 800.0, "depth": 0.5}
BEAM = {"kind": "beam", "start": 0.6, "length": 0.8, "flexural_rigidity": 20.0, "mass_per_length": 5.0}
THIN = {
    "kind": "float",
    "shape": "parabola",
    "position": 1.0,
    "half_width": 0.03,
    "half_height": 0.3,
    "boundary": "thin",
}
BOX = {
    "kind": "float",
    "shape": "rectangle",
    "position": 1.0,
    "half_width": 0.3,
    "half_height": 0.2,
    "motions": ["heave", "roll"],
}
ELLIPSE = {"kind": "float", "shape": "ellipse", "position": 0.8, "half_width": 0.3, "half_height": 0.2}
PLAN = StudyPlan(families=("uniform", "algebraic"), degrees=(1, 3), most_unknowns=40_000)
COARSE = StudyPlan(families=("uniform",), degrees=(1,), most_unknowns=8000)


def scene(
    *bodies: dict[str, Any], liquids: tuple[dict[str, float], ...] = (WATER, OIL), top: str = "rigid"
) -> TankScene:
    return TankScene.model_validate(
        {
            "kind": "tank",
            "tank": {"length": 2.0, "top": top},
            "liquid": liquids,
            "body": bodies,
            "accuracy": {"modes": 3},
        }
    )


@pytest.fixture(scope="module")
def beam() -> Study:
    return study_scene(scene(BEAM), PLAN)


@pytest.fixture(scope="module")
def thin() -> Study:
    return study_scene(scene(THIN), PLAN)


@pytest.fixture(scope="module")
def graded() -> Study:
    return study_scene(scene(THIN), StudyPlan(families=("algebraic",), degrees=(2,), most_unknowns=120_000))


@pytest.fixture(scope="module")
def box() -> Study:
    return study_scene(scene(BOX, liquids=(WATER,), top="free"), PLAN)


def rates(study: Study, family: Family, symmetry: Parity | None = None) -> dict[int, Rate]:
    return {rate.degree: rate for rate in study.rates if (rate.family, rate.symmetry) == (family, symmetry)}


@pytest.mark.parametrize(
    ("bodies", "more", "all_modes", "symmetric", "antisymmetric"),
    [
        ((BEAM,), {}, 1.0, 1.0, 1.0),
        ((BEAM | {"at": "surface"},), {"top": "pressure_release"}, 0.5, 0.5, 0.5),
        ((BEAM | {"start": 0.0, "length": 2.0},), {}, 2.0, 2.0, 2.0),
        ((BEAM | {"start": 0.0, "length": 2.0, "ends": "guided"},), {}, None, None, None),
        # A slit in the middle: a straight angle with a step of the flux, or one with ψ = 0 on a side.
        ((THIN,), {}, 0.5, 1.0, 0.5),
        ((THIN | {"shape": "wedge"},), {}, 0.5, 1.0, 0.5),
        # The flux at its ends is itself infinite.
        ((THIN | {"shape": "ellipse"},), {}, 0.5, 0.5, 0.5),
        # The angle outside a right angle.
        ((BOX,), {"liquids": (WATER,), "top": "free"}, 2.0 / 3.0, 2.0 / 3.0, 2.0 / 3.0),
        ((ELLIPSE | {"position": 1.0},), {}, 2.0, 2.0, 2.0),
    ],
)
def test_the_sharpest_corner_counts_for_each_symmetry(
    bodies: tuple[dict[str, Any], ...],
    more: dict[str, Any],
    all_modes: float | None,
    symmetric: float | None,
    antisymmetric: float | None,
) -> None:
    tank = physical_tank(scene(*bodies, **more)).scaled()
    found = [sharpest_of(tank, parity) for parity in (None, "symmetric", "antisymmetric")]
    # Directions of curved contours are differences of neighbouring points.
    for exponent, expected in zip(found, (all_modes, symmetric, antisymmetric), strict=True):
        assert exponent == (None if expected is None else pytest.approx(expected, rel=1e-6))
    assert bool(symmetries_apart(tank)) == (symmetric != antisymmetric)


def test_beside_the_middle_all_modes_meet_the_end_of_a_slit() -> None:
    tank = physical_tank(scene(THIN | {"position": 0.7})).scaled()
    assert symmetries_apart(tank) == ()
    assert sharpest_of(tank) == 0.5
    # Its two ends, and right angles where it passes the interface.
    assert sorted(singular_exponents(tank).values()) == pytest.approx([0.5, 0.5, 2.0])


def test_orders_are_those_of_each_symmetry() -> None:
    tank = physical_tank(scene(THIN)).scaled()
    assert expected_order(tank, 3) == 1.0
    assert expected_order(tank, 3, parity="symmetric") == 2.0
    assert expected_order(tank, 3, parity="antisymmetric") == 1.0
    # Graded for the sharper, all have the full order.
    exponent = sharpest_of(tank)
    assert exponent is not None
    assert full_order(3, exponent) == 7.0
    assert expected_order(tank, 3, 7.0, "symmetric") == 6.0


@pytest.mark.slow
def test_a_beam_at_an_interface_limits_uniform_meshes_to_order_two(beam: Study) -> None:
    found = rates(beam, "uniform")
    assert {degree: rate.expected for degree, rate in found.items()} == {1: 2.0, 3: 2.0}
    for rate in found.values():
        assert rate.observed == pytest.approx(2.0, abs=0.1)
    graded = rates(beam, "algebraic")
    assert {degree: (rate.grading, rate.expected) for degree, rate in graded.items()} == {1: (2.0, 2.0), 3: (4.0, 6.0)}
    assert graded[1].observed == pytest.approx(2.0, abs=0.1)
    assert graded[3].observed == pytest.approx(5.6, abs=0.5)


@pytest.mark.slow
def test_a_thin_float_in_the_middle_has_two_orders() -> None:
    study = study_scene(scene(THIN), COARSE)
    # Measured 1.99 and 1.04.
    assert rates(study, "uniform", "symmetric")[1].observed == pytest.approx(2.0, abs=0.1)
    assert rates(study, "uniform", "antisymmetric")[1].observed == pytest.approx(1.0, abs=0.1)
    text = study_table(study)
    assert "α = 1 (symmetric modes) or 0.5 (antisymmetric modes): the error of all follows the smaller." in text
    assert max(map(len, text.splitlines())) <= 120
    assert "antisym." in text


@pytest.mark.slow
def test_finer_meshes_of_a_thin_float_have_the_same_orders(thin: Study, graded: Study) -> None:
    symmetric, antisymmetric = (rates(thin, "uniform", parity) for parity in ("symmetric", "antisymmetric"))
    assert symmetric[3].expected == 2.0
    assert antisymmetric[3].expected == 1.0
    assert symmetric[3].observed == pytest.approx(2.0, abs=0.1)
    assert antisymmetric[3].observed == pytest.approx(1.0, abs=0.05)
    assert antisymmetric[1].observed == pytest.approx(1.0, abs=0.15)
    for parity in ("symmetric", "antisymmetric"):
        assert rates(thin, "algebraic", parity)[1].observed == pytest.approx(2.0, abs=0.2)
        # On the way to 4: measured 3.9 and 3.6 on elements of L/32 to L/128.
        assert rates(graded, "algebraic", parity)[2].expected == 4.0
        assert rates(graded, "algebraic", parity)[2].observed == pytest.approx(3.8, abs=0.4)


@pytest.mark.slow
def test_right_angles_of_a_float_limit_uniform_meshes_to_order_four_thirds(box: Study) -> None:
    assert "α =" not in study_table(box)
    found = rates(box, "uniform")[3]
    assert found.expected == pytest.approx(4.0 / 3.0)
    assert found.observed == pytest.approx(4.0 / 3.0, abs=0.08)
    graded = rates(box, "algebraic")
    # Both still rise: measured 1.84, and 4.80 on the way to 6.
    assert graded[1].observed == pytest.approx(2.0, abs=0.25)
    assert graded[3].observed == pytest.approx(5.2, abs=0.8)


@pytest.mark.slow
def test_curved_contours_have_no_uniform_meshes_but_all_else() -> None:
    plan = StudyPlan(geometric_degrees=(4, 5, 6), degrees=(2,), tolerances=(1e-4,))
    study = study_scene(scene(ELLIPSE), plan)
    assert {row.family for row in study.rows} == {"geometric", "tolerance"}
    assert study_table(study).count("None: the contour of a float is curved") == 2
    assert study.reasons == ()
    for row in study.rows:
        # Honest estimates: neither below the error nor thirty times above.
        assert row.estimate is not None
        assert row.error <= row.estimate <= 30.0 * row.error
    assert study.gain is not None
    assert study.gain.observed > 9.0
