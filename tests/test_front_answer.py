"""The report's "Answer": the largest values of curves, with the units of what they are."""

import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from reports import parsed

import hydroelastic as he

CYLINDER = {
    "kind": "sea",
    "liquid": [{"density": 1000.0, "depth": 4.0}],
    "body": [
        {
            "kind": "float",
            "shape": "cylinder",
            "radius": 1.0,
            "draught": 1.0,
            "motions": ["heave", "surge", "pitch"],
            "vertical_centre_of_gravity": -0.6,
            "radius_of_gyration": 0.6,
        }
    ],
    "accuracy": {"tolerance": 1e-2},
}
CIRCLE = {
    "kind": "sea",
    "liquid": [{"density": 1000.0, "depth": 4.0}],
    "body": [
        {
            "kind": "float",
            "shape": "ellipse",
            "position": 0.0,
            "half_width": 1.0,
            "half_height": 1.0,
            "centre_of_mass": -0.6,
            "radius_of_gyration": 0.6,
            "motions": ["heave"],
        }
    ],
    "accuracy": {"tolerance": 1e-3},
}


def response(scene: dict[str, Any], omega: Any) -> dict[str, Any]:
    found: dict[str, Any] = he.solve(he.read(scene | {"analysis": [{"kind": "response", "omega": omega}]})).summary
    return dict(found["response"][0])


def test_the_largest_motion_is_that_of_the_curve_and_not_of_its_samples() -> None:
    heaving = CYLINDER["body"][0] | {"motions": ["heave"]}
    scene = CYLINDER | {"body": [heaving], "accuracy": {"tolerance": 1e-3}}
    found = response(scene, {"start": 1.5, "stop": 3.5, "number": 7})
    (value, *_), (omega, *_), (error, *_) = (found["largest"][key][0] for key in ("value", "omega", "error"))
    samples = np.hypot(*np.moveaxis(np.array(found["amplitudes"])[:, 0, 0], -1, 0))
    # The resonance of heave lies between two of seven frequencies.
    assert value > 1.02 * samples.max()
    near = response(scene, [omega * factor for factor in (0.98, 0.998, 1.0, 1.002, 1.02)])
    around = np.hypot(*np.moveaxis(np.array(near["amplitudes"])[:, 0, 0], -1, 0))
    # Both solutions have their own mesh, of the same tolerance, and an estimate of its error.
    assert abs(around[2] - value) < 2.0 * error < 4e-3 * value
    assert around[2] >= around.max()
    assert around[2] > around[[0, 4]].max() + 2.0 * error


def test_the_largest_reflection_is_that_of_the_curve() -> None:
    found = response(CIRCLE, {"start": 1.5, "stop": 2.6, "number": 7})
    samples = np.hypot(*np.moveaxis(np.array(found["reflection"])[:, 0, 0], -1, 0))
    (value,), (omega,), (error,) = (found["largest_reflection"][key] for key in ("value", "omega", "error"))
    assert value > samples.max() + error
    near = response(CIRCLE, [0.98 * omega, omega, 1.02 * omega])
    below, at, above = np.hypot(*np.moveaxis(np.array(near["reflection"])[:, 0, 0], -1, 0))
    # As above.
    assert abs(at - value) < 2.0 * error < 1e-3
    assert at > max(below, above)


def rows_of_answer(scene: dict[str, Any], folder: Path) -> str:
    he.solve(he.read(scene)).save(folder / "out", images=None, report=True)
    page = parsed((folder / "out" / "report.html").read_text(encoding="utf-8"))
    return " ".join(page.text.split())


def test_units_of_the_answer_are_those_of_rotations_and_of_whole_solids(tmp_path: Path) -> None:
    analyses = [
        {"kind": "radiation", "omega": [2.0]},
        {"kind": "response", "omega": [2.0]},
    ]
    text = rows_of_answer(CYLINDER | {"analysis": analyses}, tmp_path)
    for words in (
        "largest radiation damping of heave, of the requested ω at 2 rad/s, kg/s",
        "largest radiation damping of pitch, of the requested ω at 2 rad/s, kg·m²/s",
        "largest heave in waves, at ω = 2 rad/s, m/m",
        "largest pitch in waves, at ω = 2 rad/s, rad/m",
    ):
        assert words in text


@pytest.mark.slow
def test_units_over_time_are_those_of_rotations_and_of_whole_solids(tmp_path: Path) -> None:
    analyses = [{"kind": "impulse_response", "times": [0.0, 1.0]}]
    text = rows_of_answer(CYLINDER | {"analysis": analyses}, tmp_path)
    assert "added mass of heave at infinite frequency, kg " in text
    assert "added mass of pitch at infinite frequency, kg·m² " in text


@pytest.mark.slow
def test_a_release_in_pitch_is_an_angle(tmp_path: Path) -> None:
    body = CYLINDER["body"][0] | {"motions": ["pitch"]}
    analyses = [{"kind": "decay", "times": [0.0, 0.5, 1.0, 1.5], "displacement": {"pitch": 0.1}}]
    text = rows_of_answer(CYLINDER | {"body": [body], "analysis": analyses}, tmp_path)
    assert re.search(r"pitch largest swing to the other side after release, at t = \S+ s, rad", text)
