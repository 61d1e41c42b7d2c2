"""Small motions beside large ones, and waves that hardly scatter: within errors of their own."""

from __future__ import annotations

from functools import cache
from math import sqrt
from typing import Any

import numpy as np
import pytest

import hydroelastic as he

SPAR = {"kind": "float", "shape": "cylinder", "radius": 0.5, "draught": 2.5, "vertical_centre_of_gravity": -1.5}


@cache
def response(wavenumber: float, motions: tuple[str, ...], tolerance: float) -> dict[str, Any]:
    """Return the response of the spar at a wavenumber ω²/g, 1/m, as arrays."""
    summary = he.solve(
        {
            "kind": "sea",
            "liquid": [{"density": 1000.0, "depth": 4.0}],
            "body": [SPAR | {"motions": list(motions)}],
            "analysis": [{"kind": "response", "omega": [sqrt(9.81 * wavenumber)]}],
            "accuracy": {"tolerance": tolerance},
        }
    ).summary["response"][0]
    keys = ("amplitudes", "amplitude_error", "scattering_width", "scattering_width_error", "relative_error")
    found = {key: np.array(summary[key])[0] for key in keys}
    return found | {"amplitudes": found["amplitudes"] @ [1.0, 1j]}


def true_errors(wavenumber: float, motions: tuple[str, ...], key: str) -> tuple[np.ndarray, dict[str, Any]]:
    """Return errors at a tolerance of 1e-3, by one of 1e-6, whose errors are smaller by three digits."""
    coarse, fine = (response(wavenumber, motions, tolerance) for tolerance in (1e-3, 1e-6))
    return np.abs(coarse[key] - fine[key]), coarse


# Heave is 1.14, 0.09 and 2e-4 of the wave.
@pytest.mark.slow_but("0.8", "2.4")
@pytest.mark.parametrize("wavenumber", [0.1, 0.8, 2.4])
def test_each_motion_is_within_its_own_error(wavenumber: float) -> None:
    errors, found = true_errors(wavenumber, ("heave", "surge", "pitch"), "amplitudes")
    # Measured: at most 0.85; relative to heave itself the error at 0.8 is 7.5 times `relative_error`, which is relative
    # to the elevation.
    assert np.all(errors < found["amplitude_error"])
    assert found["amplitude_error"].max() < 2.0 * found["relative_error"] * max(1.0, np.abs(found["amplitudes"]).max())


@pytest.mark.xfail(
    strict=True, reason="errors of all motions are that of the largest, until each has a dual of its own"
)
def test_the_error_of_a_motion_far_smaller_than_the_wave_is_of_its_size() -> None:
    errors, found = true_errors(2.4, ("heave", "surge", "pitch"), "amplitudes")
    # Stated today: 840 times the error of heave.
    assert found["amplitude_error"][0, 0] < 100.0 * errors[0, 0]


def test_a_float_that_follows_long_waves_scatters_in_the_first_order() -> None:
    # Order 0 scatters 4e-4 of the wave there, below the tolerance, order 1 more than eight times as much.
    errors, found = true_errors(0.1, ("heave",), "scattering_width")
    assert errors < found["scattering_width_error"]
    assert found["scattering_width_error"] < 0.01 * found["scattering_width"]


@pytest.mark.slow
@pytest.mark.xfail(strict=True, reason="the equations of motion take damping from a + ib/ω, whose rest it is here")
def test_the_resonance_of_a_spar_that_hardly_radiates_is_within_its_error() -> None:
    # A spring tunes it to its wave: a heave of 72 times the elevation, as large as the damping of 2e-4 ωa lets it be.
    body = {"kind": "float", "shape": "cylinder", "radius": 1.0, "draught": 4.0, "motions": ["heave"]}
    scene = {
        "kind": "sea",
        "liquid": [{"density": 1000.0, "depth": 20.0}],
        "body": [body | {"unstable": "solve"}],
        "attachment": [{"body": 1, "stiffness": [111679.09, 0.0, 0.0]}],
        "analysis": [{"kind": "response", "omega": [sqrt(9.81)]}],
    }
    coarse, fine = (
        he.solve(scene | {"accuracy": {"tolerance": tolerance}}).summary["response"][0] for tolerance in (1e-3, 1e-6)
    )
    heave, expected = (abs(complex(*one["amplitudes"][0][0][0])) for one in (coarse, fine))
    # Measured: 0.095, stated 0.017.
    assert abs(heave - expected) < coarse["amplitude_error"][0][0][0]
