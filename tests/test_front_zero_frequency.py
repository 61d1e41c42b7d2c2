"""The limit of zero frequency: added mass of sections to the tolerance, forces of a level that rises evenly."""

from __future__ import annotations

from math import inf, pi, sqrt
from typing import Any

import numpy as np
import pytest

import hydroelastic as he

DENSITY, GRAVITY = 1000.0, 9.81


def solved(body: dict[str, Any], depth: float, tolerance: float) -> tuple[str, dict[str, Any]]:
    """Return the status, and the radiation analysis as arrays."""
    summary = he.solve(
        {
            "kind": "sea",
            "liquid": [{"density": DENSITY, "depth": depth}],
            "body": [{"kind": "float", "unstable": "solve"} | body],
            "analysis": [{"kind": "radiation", "omega": [0.0]}],
            "accuracy": {"tolerance": tolerance},
        }
    ).summary
    keys = ("added_mass", "radiation_damping", "relative_error")
    found = {key: np.array(summary["radiation"][0][key], dtype=float)[0] for key in keys}
    force = np.array(summary["radiation"][0]["excitation_force"])[0, 0, 0] @ [1.0, 1j]
    return summary["status"], found | {"force": force}


@pytest.mark.slow
def test_a_deep_section_keeps_a_tight_tolerance_at_zero_frequency() -> None:
    ellipse = {"shape": "ellipse", "half_width": 1.0, "half_height": 0.25, "motions": ["heave", "sway"]}
    status, found = solved(ellipse, inf, 1e-6)
    assert status == "ok"
    heave, sway = np.diag(found["added_mass"])
    assert heave == inf
    # Half of an ellipse below a fixed level in sway: ρπb²/2. Measured: 2e-9, stated 1.3e-7; a at the lowest frequency
    # solved differs from its limit by 2e-7.
    assert abs(sway / (DENSITY * pi * 0.25**2 / 2.0) - 1.0) < 2e-8 < found["relative_error"]
    assert not found["radiation_damping"].any()
    np.testing.assert_allclose(found["force"], [2.0 * DENSITY * GRAVITY, 0.0], rtol=1e-12, atol=1e-9)


def test_a_section_over_a_bed_has_damping_in_the_longest_waves() -> None:
    depth = 2.0
    box = {"shape": "rectangle", "half_width": 0.5, "half_height": 0.5, "motions": ["heave", "sway"]}
    status, found = solved(box, depth, 1e-3)
    assert status == "ok"
    # The volume that heave displaces flows to both sides in shallow water of speed c: b = ρgB²/(2c), of B = 1 m.
    expected = DENSITY * GRAVITY / (2.0 * sqrt(GRAVITY * depth))
    np.testing.assert_allclose(found["radiation_damping"], [[expected, 0.0], [0.0, 0.0]], rtol=1e-12, atol=1e-9)
    np.testing.assert_allclose(found["force"], [DENSITY * GRAVITY, 0.0], rtol=1e-12, atol=1e-9)
    # By tolerances of 1e-6 and 1e-8, which differ by 2e-7. At the lowest frequency solved |a + ib/ω| is 70 times a.
    np.testing.assert_allclose(np.diag(found["added_mass"]), [362.1617, 677.31382], rtol=found["relative_error"])


@pytest.mark.parametrize("depth", [30.0, inf])
def test_the_longest_waves_lift_a_solid_by_its_hydrostatic_stiffness(depth: float) -> None:
    body = {"shape": "cylinder", "radius": 5.0, "draught": 4.0, "motions": ["heave", "surge"]}
    _, found = solved(body | {"vertical_centre_of_gravity": -2.0}, depth, 1e-2)
    np.testing.assert_allclose(found["force"], [DENSITY * GRAVITY * pi * 25.0, 0.0], rtol=1e-12, atol=1e-6)
    assert not found["radiation_damping"].any()
