"""Motions of a hanging string, against stored values and a numerical Bromwich integral."""

from __future__ import annotations

import json
from pathlib import Path

import pytest
from string_cases import CASES, StringCase
from uniform_strings import uniform_string

from hydroelastic.modal.string.response import string_response
from hydroelastic.physics.string_motions import Ramp, Sine, Smooth, Step

REFERENCE = json.loads((Path(__file__).parent / "reference" / "string_and_roll.json").read_text(encoding="utf-8"))
STORED = {case["id"]: case for case in REFERENCE["cases"] if case["paper"] == "000"}


def _stored_case(name: str) -> StringCase:
    case = STORED[name]
    inputs = {key: float(value) for key, value in case["inputs"].items()}
    amplitude = inputs["amp"]
    motion: Ramp | Sine | Smooth | Step
    match case["kind"]:
        case "ramp":
            motion = Ramp(speed=amplitude)
        case "sine":
            motion = Sine(amplitude=amplitude, omega=inputs["omega"])
        case "smooth":
            motion = Smooth(amplitude=amplitude, rate=inputs["beta"])
        case _:
            motion = Step(amplitude=amplitude)
    string = uniform_string(length=inputs["l"], damping=inputs["alpha"], gravity=inputs["g"])
    return StringCase(string=string, motion=motion, position=inputs["x"], time=inputs["t"])


def _response(case: StringCase) -> tuple[float, float]:
    found = string_response(case.string, case.motion, case.position, case.time)
    return float(found.values[0, 0]), float(found.errors[0, 0])


@pytest.mark.parametrize("name", STORED)
def test_stored_values(name: str) -> None:
    value, error = _response(_stored_case(name))
    # Measured: 1e-14 and less, relative to 26 m for the heaviest damping.
    assert value == pytest.approx(float(STORED[name]["value"]), rel=1e-14, abs=3e-14)
    assert abs(value - float(STORED[name]["value"])) <= error
    assert error < 1e-12


@pytest.mark.parametrize("name", STORED)
def test_the_integral_has_the_stored_values(name: str) -> None:
    if name == "ramp-before-front":
        pytest.skip("the integral is for times after the front")
    # e^{9…3} of the rounding of its terms.
    assert _stored_case(name).by_integral() == pytest.approx(float(STORED[name]["value"]), rel=1e-14, abs=3e-14)


@pytest.mark.parametrize("name", CASES)
def test_hard_cases(name: str) -> None:
    case = CASES[name]
    value, error = _response(case)
    expected = case.by_integral()
    assert value == pytest.approx(expected, rel=1e-13, abs=1e-12)
    assert error < 1e-11 * max(1.0, abs(expected))
