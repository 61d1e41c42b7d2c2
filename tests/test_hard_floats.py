"""The solver on the catalogue of tanks with floats and on such tanks drawn at random, against another method."""

from __future__ import annotations

import functools
import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from random_floats import draw_floats

from hydroelastic.fem.bodies.rigid_float import principal_motions
from hydroelastic.fem.tank.solve import TankSolution
from hydroelastic.physics.rigid_motions import zero_mode_count
from hydroelastic.scenes.models.physical import physical_tank
from hydroelastic.scenes.models.tank import TankScene
from hydroelastic.scenes.tank.solve import solve_scene

FOLDER = Path(__file__).parent / "reference"
CASES: dict[str, dict[str, Any]] = json.loads((FOLDER / "floats.json").read_text(encoding="utf-8"))["cases"]
RANDOM: list[dict[str, Any]] = json.loads((FOLDER / "random_floats.json").read_text(encoding="utf-8"))["tanks"]

LEAST_ESTIMATE = 1.0 / 3.0
"""Smallest estimate over true error."""
LARGE_ESTIMATE = 100.0
"""An estimate above this multiple of the true error is needlessly large."""
ROUNDING = 1e-9
"""Estimates below this may tell what rounding could do: no ratio to what it did is asked of them."""

THIN_ELLIPSE = 1e-9
"""What is lost of the volume of a thin ellipse at its ends, where the root of rounding remains; measured 3e-10."""

WIDE_SEED, WIDE_FAST, WIDE_COUNT, WIDE_PARTS = 5, 6, 80, 8


@dataclass(frozen=True, kw_only=True)
class Found:
    """Numbers of a solution.

    Attributes:
        omega: rad/s.
        estimates: of their relative errors.
        growing: growth rates with their estimates, shape (2, growing modes).
        amplitudes: of heave, sway and roll of the floats at unit generalized mass, over √kg, (motions, modes).
        reasons, counted, zero_modes, attempts: what it says of itself.
    """

    omega: np.ndarray
    estimates: np.ndarray
    growing: np.ndarray
    amplitudes: np.ndarray
    reasons: tuple[str, ...]
    counted: bool
    zero_modes: int
    attempts: int


@functools.cache
def found(scene: TankScene) -> Found:
    """Solve a scene, once in this process."""
    solution = solve_scene(scene)
    return Found(
        omega=np.array([solution.omega(mode.eigenvalue) for mode in solution.asked]),
        estimates=solution.relative_errors[: len(solution.asked)],
        growing=np.array(
            [[solution.omega(-mode.eigenvalue) for mode in solution.modes.growing], solution.growing_errors]
        ),
        amplitudes=_amplitudes(solution),
        reasons=solution.reasons,
        counted=solution.counted,
        zero_modes=solution.modes.zero_modes,
        attempts=solution.attempts,
    )


def _amplitudes(solution: TankSolution) -> np.ndarray:
    """The motions of floats themselves, from their principal ones."""
    units, rows = solution.units, []
    unknowns = sum(body.size for body in solution.field.bodies)
    # Under a lid there may be no mode at all.
    own = np.array([mode.body_amplitudes for mode in solution.asked]).reshape(-1, unknowns).T
    offsets = np.cumsum([0, *(body.size for body in solution.field.bodies)])
    for index, body in solution.tank.floats.items():
        turn, _, _ = principal_motions(body, body.motions)
        lengths = np.array([1.0 if motion == "roll" else 0.0 for motion in body.motions])
        scale = 1.0 / (np.sqrt(units.density) * units.length ** (1.0 + lengths))
        rows.append(scale[:, None] * (turn @ own[offsets[index] : offsets[index + 1]]))
    return np.concatenate(rows)


def asked(keys: dict[str, Any], tolerance: float, modes: int) -> TankScene:
    return TankScene.model_validate(keys | {"accuracy": {"tolerance": tolerance, "modes": modes}})


def printed_rounding(texts: list[str]) -> np.ndarray:
    """Half a unit of the last digit, relative."""
    return np.array([0.5 * 10.0 ** (1.0 - len(text.replace(".", "").lstrip("0"))) for text in texts])


def complaint(scene: TankScene, reference: np.ndarray, rounding: np.ndarray | float) -> str:
    """What is wrong with the answer to a scene, or ""."""
    answer, tolerance = found(scene), scene.accuracy.tolerance
    if answer.reasons:
        return f"refused: {answer.reasons}"
    zero_modes = zero_mode_count(physical_tank(scene))
    if not answer.counted or answer.zero_modes != zero_modes:
        return f"{answer.zero_modes} zero modes instead of {zero_modes}, counted: {answer.counted}"
    if len(answer.omega) < len(reference):
        return f"{len(answer.omega)} modes instead of {len(reference)}"
    errors = np.abs(answer.omega / reference - 1.0)
    if np.any(errors > tolerance + rounding):
        return f"error {errors.max():.1e} above the tolerance {tolerance:.0e}"
    if np.any(answer.estimates < LEAST_ESTIMATE * (errors - rounding)):
        worst = int(np.argmin(answer.estimates / errors))
        return f"estimate {answer.estimates[worst]:.1e} for an error of {errors[worst]:.1e}"
    return ""


FAST = ("circle_all_motions", "ship", "two_floats", "two_liquids_wedge", "thin_wedge")


@pytest.mark.slow_but(*(f"{name}-1e-03" for name in FAST), "circle_all_motions-1e-08", "thin_wedge-1e-08")
@pytest.mark.parametrize(
    ("name", "tolerance"),
    [
        pytest.param(name, tolerance, id=f"{name}-{tolerance:.0e}")
        for name in CASES
        for tolerance in (1e-3, 1e-4, 1e-6, 1e-8)
    ],
)
def test_each_frequency_keeps_the_tolerance(name: str, tolerance: float) -> None:
    case = CASES[name]
    scene = asked(case["scene"], tolerance, len(case["omega"]))
    omega = np.array([float(text) for text in case["omega"]])
    assert complaint(scene, omega, printed_rounding(case["omega"]) + case["self_convergence"]) == ""
    assert found(scene).attempts == 1


@pytest.mark.slow_but("circle_all_motions", "thin_wedge")
@pytest.mark.parametrize("name", CASES)
def test_motions_of_floats_have_their_modal_masses(name: str) -> None:
    """1/a² of each motion; a errs in parts of the largest by about the root of what the frequency does."""
    case = CASES[name]
    amplitudes = found(asked(case["scene"], 1e-8, len(case["omega"]))).amplitudes
    assert len(amplitudes) == len(case["modal_masses"])
    for own, masses in zip(np.abs(amplitudes), case["modal_masses"], strict=True):
        expected = np.array([0.0 if text is None else float(text) ** -0.5 for text in masses])
        stored = expected > 0.0
        # Measured 3e-7; the reference keeps four digits at the least of those that hardly move.
        assert own[stored] == pytest.approx(expected[stored], rel=1e-5, abs=1e-6 * expected.max())


@pytest.mark.slow
def test_estimates_are_rarely_needlessly_large() -> None:
    """Over all modes of the catalogue and of the stored random tanks that are solved daily."""
    ratios = []
    for name, case in CASES.items():
        answer = found(asked(case["scene"], 1e-3, len(case["omega"])))
        ratios += _ratios(answer, np.array([float(text) for text in case["omega"]]), name)
    assert len(ratios) >= 50
    assert np.mean(np.array(ratios) > LARGE_ESTIMATE) <= 0.1


def _ratios(answer: Found, omega: np.ndarray, _name: str) -> list[float]:
    errors = np.abs(answer.omega / omega - 1.0)
    told = answer.estimates > ROUNDING
    return list(answer.estimates[told] / np.maximum(errors[told], 1e-11))


@pytest.mark.slow_but("5", "9")
@pytest.mark.parametrize("entry", RANDOM, ids=lambda entry: str(entry["number"]))
def test_tanks_at_random_keep_their_tolerance(entry: dict[str, Any]) -> None:
    scene = TankScene.model_validate(entry["scene"])
    assert complaint(scene, np.array(entry["omega"]), entry["self_convergence"] + 1e-12) == ""


def strict_complaint(scene: TankScene) -> str:
    """What is wrong with the answer to a scene, judged by the same solver on much finer meshes, or ""."""
    accuracy = scene.accuracy.model_copy(update={"tolerance": 1e-10})
    strict = found.__wrapped__(scene.model_copy(update={"accuracy": accuracy}))
    allowed = float(max(strict.estimates.max(initial=0.0), strict.growing[1].max(initial=0.0)))
    if any(body.boundary == "thin" and body.shape == "ellipse" for _, body in scene.floats):
        allowed += THIN_ELLIPSE
    if allowed > 0.1 * scene.accuracy.tolerance + THIN_ELLIPSE:
        return f"no reference: {strict.reasons}"
    if said := complaint(scene, strict.omega, allowed):
        return said
    answer = found(scene)
    if answer.growing.shape != strict.growing.shape:
        return "another number of growing modes"
    errors = np.abs(np.sort(answer.growing[0]) / np.sort(strict.growing[0]) - 1.0)
    if np.any(errors > scene.accuracy.tolerance):
        return f"error {errors.max():.1e} of a growth rate"
    return ""


@pytest.mark.slow
@pytest.mark.parametrize("number", range(WIDE_FAST))
def test_all_kinds_of_floats_at_random_keep_their_tolerance(number: int) -> None:
    scene = draw_floats(WIDE_SEED, WIDE_FAST, wide=True)[number]
    assert strict_complaint(scene) == ""


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
