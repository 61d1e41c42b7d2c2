"""The solver on the catalogue of tanks with floats and on such tanks drawn at random, against another method."""

from __future__ import annotations

import json
from typing import Any

import numpy as np
import pytest
from answers import Answer, answer
from random_floats import draw_floats
from section_tanks import REFERENCES

import hydroelastic as he

CASES: dict[str, dict[str, Any]] = json.loads((REFERENCES / "floats.json").read_text(encoding="utf-8"))["cases"]
RANDOM: list[dict[str, Any]] = json.loads((REFERENCES / "random_floats.json").read_text(encoding="utf-8"))["tanks"]

LEAST_ESTIMATE = 1.0 / 3.0
"""Smallest estimate over true error."""
LARGE_ESTIMATE = 100.0
"""An estimate above this multiple of the true error is needlessly large."""
ROUNDING = 1e-9
"""Estimates below this may tell what rounding could do: no ratio to what it did is asked of them."""
THIN_ELLIPSE = 1e-9
"""What is lost of the volume of a thin ellipse at its ends, where the root of rounding remains; measured 3e-10."""

WIDE_SEED, WIDE_COUNT, WIDE_PARTS = 5, 80, 8


def asked(keys: dict[str, Any], tolerance: float, modes: int) -> he.TankScene:
    return he.TankScene(**keys | {"accuracy": {"tolerance": tolerance, "modes": modes}})


def case_at(name: str, tolerance: float) -> he.TankScene:
    return asked(CASES[name]["scene"], tolerance, len(CASES[name]["omega"]))


def numbers(texts: list[str]) -> np.ndarray:
    return np.array(texts, dtype=float)


def printed_rounding(texts: list[str]) -> np.ndarray:
    """Half a unit of the last digit, relative."""
    return np.array([0.5 * 10.0 ** (1.0 - len(text.replace(".", "").lstrip("0"))) for text in texts])


def complaint(scene: he.TankScene, found: Answer, reference: np.ndarray, rounding: Any) -> str:
    """What is wrong with the answer to a scene, or ""."""
    tolerance = scene.accuracy.tolerance
    if found.reasons:
        return f"refused: {found.reasons}"
    if not found.summary["solver"]["count_confirmed_by_inertia"]:
        return "the number of modes is not confirmed"
    if len(found.omega) < len(reference):
        return f"{len(found.omega)} modes instead of {len(reference)}"
    errors = np.abs(found.errors(reference))
    if np.any(errors > tolerance + rounding):
        return f"error {errors.max():.1e} above the tolerance {tolerance:.0e}"
    if np.any(found.estimates < LEAST_ESTIMATE * (errors - rounding)):
        worst = int(np.argmin(found.estimates / errors))
        return f"estimate {found.estimates[worst]:.1e} for an error of {errors[worst]:.1e}"
    return ""


FAST = ("circle_all_motions", "ship", "two_floats", "two_liquids_wedge", "thin_wedge")


@pytest.mark.slow_but(*(f"{name}-1e-03" for name in FAST), "circle_off_centre-1e-08", "thin_wedge-1e-08")
@pytest.mark.slow_on_ranks_but("two_floats-1e-03", "two_liquids_wedge-1e-03")
@pytest.mark.mpi
@pytest.mark.parametrize(
    ("name", "tolerance"),
    [
        pytest.param(name, tolerance, id=f"{name}-{tolerance:.0e}")
        for name in CASES
        for tolerance in (1e-3, 1e-4, 1e-6, 1e-8)
    ],
)
def test_each_frequency_keeps_the_tolerance(name: str, tolerance: float) -> None:
    scene, case = case_at(name, tolerance), CASES[name]
    rounding = printed_rounding(case["omega"]) + case["self_convergence"]
    assert complaint(scene, answer(scene), numbers(case["omega"]), rounding) == ""


@pytest.mark.slow_but(*FAST)
@pytest.mark.parametrize("name", CASES)
def test_floats_rest_and_push_the_liquid_as_in_the_references(name: str) -> None:
    """Hydrostatics about the centre of mass, to rounding; added mass far above the waves."""
    floats = answer(case_at(name, 1e-3)).summary["floats"]
    for found, expected in zip(floats, CASES[name]["floats"], strict=True):
        assert found["mass"] == pytest.approx(expected["mass"], rel=1e-12)
        assert found["moment_of_inertia"] == pytest.approx(expected["inertia"], rel=1e-12)
        assert found["centre_of_mass"] == pytest.approx(expected["centre"], rel=1e-12, abs=1e-13)
        if found["boundary"] == "exact":
            assert found["waterplane"] == pytest.approx(expected["ends"], rel=1e-12)
        stiffness = np.array(expected["stiffness"])
        own = [found[f"{motion}_stiffness"] for motion in ("heave", "coupling", "roll")]
        assert own == pytest.approx(stiffness[[0, 0, 2], [0, 2, 2]], rel=1e-11, abs=1e-11 * np.abs(stiffness).max())
    if len(floats) == 1 and CASES[name]["added_mass"]:
        high = floats[0]["high_frequency"]
        expected = np.array(CASES[name]["added_mass"], dtype=float)
        size = np.sqrt(np.outer(expected.diagonal(), expected.diagonal()))
        allowed = max(1e-3, high["relative_error"])
        assert np.abs((np.array(high["added_mass"]) - expected) / size).max() <= allowed


def motions_of(data: Any, body: int, found: dict[str, Any]) -> np.ndarray:
    """Amplitudes of heave, sway and roll about the centre of mass in each mode, of the contour's displacement."""
    contour, moved = data[f"contour_of_body_{body}"].values, data[f"displacement_of_body_{body}"].values
    x, y = (contour - found["centre_of_mass"]).T
    ones, zeros = np.ones_like(x), np.zeros_like(x)
    matrix = np.vstack([np.column_stack([zeros, ones, -y]), np.column_stack([ones, zeros, x])])
    flat = moved.transpose(0, 2, 1).reshape(len(moved), -1).T
    motions = np.linalg.lstsq(matrix, flat)[0]
    # The section stays rigid.
    assert matrix @ motions == pytest.approx(flat, abs=1e-10 * np.abs(flat).max())
    return motions


@pytest.mark.slow_but("circle_all_motions", "thin_wedge", "ship")
@pytest.mark.parametrize("name", CASES)
def test_motions_of_floats_have_their_modal_masses(name: str) -> None:
    """1/a² of each motion; a errs in parts of the largest by about the root of what the frequency does."""
    case, result = CASES[name], he.solve(case_at(name, 1e-8))
    amplitudes = []
    for found in result.summary["floats"]:
        moved = motions_of(result.dataset, found["body"], found)
        amplitudes += [moved[("heave", "sway", "roll").index(motion)] for motion in found["motions"]]
    assert len(amplitudes) == len(case["modal_masses"])
    for own, masses in zip(np.abs(amplitudes), case["modal_masses"], strict=True):
        expected = np.array([0.0 if text is None else float(text) ** -0.5 for text in masses])
        stored = expected > 0.0
        # Measured 3e-7; the reference keeps four digits at the least of those that hardly move.
        assert own[stored] == pytest.approx(expected[stored], rel=1e-5, abs=1e-6 * expected.max())


@pytest.mark.slow
def test_estimates_are_rarely_needlessly_large() -> None:
    """Over all modes of the catalogue."""
    ratios: list[float] = []
    for name, case in CASES.items():
        found = answer(case_at(name, 1e-3))
        told = found.estimates > ROUNDING
        errors = np.abs(found.errors(numbers(case["omega"])))
        ratios += list(found.estimates[told] / np.maximum(errors[told], 1e-11))
    assert len(ratios) >= 50
    assert np.mean(np.array(ratios) > LARGE_ESTIMATE) <= 0.1


@pytest.mark.slow_but("5", "9")
@pytest.mark.parametrize("entry", RANDOM, ids=lambda entry: str(entry["number"]))
def test_tanks_at_random_keep_their_tolerance(entry: dict[str, Any]) -> None:
    scene = he.TankScene(**entry["scene"])
    assert complaint(scene, answer(scene), np.array(entry["omega"]), entry["self_convergence"] + 1e-12) == ""


def strict_complaint(scene: he.TankScene) -> str:
    """What is wrong with the answer to a scene, judged by the same solver on much finer meshes, or ""."""
    accuracy = scene.accuracy.model_copy(update={"tolerance": 1e-10})
    strict, found = answer.__wrapped__(scene.model_copy(update={"accuracy": accuracy})), answer(scene)
    growing = [one.summary["growing"] for one in (strict, found)]
    allowed = max([*strict.estimates, *(mode["relative_error"] for mode in growing[0])], default=0.0)
    if any(body.boundary == "thin" and body.shape == "ellipse" for _, body in scene.floats):
        allowed += THIN_ELLIPSE
    if allowed > 0.1 * scene.accuracy.tolerance + THIN_ELLIPSE:
        return f"no reference: {strict.reasons}"
    if said := complaint(scene, found, strict.omega, allowed):
        return said
    rates = [np.sort([mode["growth_rate"] for mode in modes]) for modes in growing]
    if rates[0].shape != rates[1].shape:
        return "another number of growing modes"
    if np.any(np.abs(rates[1] / rates[0] - 1.0) > scene.accuracy.tolerance):
        return "a growth rate is off"
    return ""


@pytest.mark.slow
@pytest.mark.parametrize("part", range(WIDE_PARTS))
def test_many_kinds_of_floats_at_random_keep_their_tolerance(part: int) -> None:
    scenes = list(enumerate(draw_floats(WIDE_SEED, WIDE_COUNT, wide=True)))[part::WIDE_PARTS]
    wrong = {number: said for number, scene in scenes if (said := strict_complaint(scene))}
    assert wrong == {}


@pytest.mark.slow
def test_stored_random_tanks_are_those_that_are_drawn() -> None:
    scenes = draw_floats(1, 1 + max(entry["number"] for entry in RANDOM))
    for entry in RANDOM:
        # Rounding of the random numbers' logarithms may differ between systems.
        drawn = scenes[entry["number"]].model_dump(mode="json", exclude_none=True)
        assert json.dumps(drawn)[:40] == json.dumps(entry["scene"])[:40]
