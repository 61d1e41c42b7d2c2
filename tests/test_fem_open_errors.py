"""Errors of what follows from motions in waves: loads along beams, pressures, drift, motions over time, statistics."""

from typing import Any

import numpy as np
import pytest
from float_scenes import BARGE
from mpi4py import MPI

from hydroelastic.scenes.models import SeaScene
from hydroelastic.scenes.open_water.solve import solve_open

PLATE = {"length": 20.0, "flexural_rigidity": 1e8, "mass_per_length": 500.0}
SPRINGS = {
    "attachment": [
        {"at": [4.0, 0.0], "stiffness": [5e4, 0.0, 0.0], "damping": [2e4, 0.0, 0.0]},
        {"at": [13.3, 0.0], "stiffness": [0.0, 0.0, 1e5]},
    ]
}
# Largest part of an estimate that may be beyond the true error: an estimate is of all frequencies and points together.
MOST = 30.0


def solved(body: dict[str, Any], analysis: dict[str, Any], tolerance: float, **keys: Any) -> Any:
    scene = SeaScene(
        liquid=[{"density": 1025.0, "depth": float("inf")}],
        body=[body],
        analysis=[analysis],
        accuracy={"tolerance": tolerance},
        **keys,
    )
    return solve_open(scene, MPI.COMM_WORLD, lambda _message: None)


def ratio(estimate: np.ndarray, found: np.ndarray, reference: np.ndarray) -> float:
    return float(np.max(estimate) / np.abs(found - reference).max())


def jump_at(loads: np.ndarray, place: int) -> np.ndarray:
    """Return the jump of loads, shape (n, points), at a point, but for their slope before and after."""
    before, after = loads[:, place - 1] - loads[:, place - 3], loads[:, place + 3] - loads[:, place + 1]
    jump: np.ndarray = loads[:, place + 1] - loads[:, place - 1] - 0.5 * (before + after)
    return jump


def test_loads_are_in_balance_at_the_free_ends_and_across_springs() -> None:
    asked = {"kind": "response", "omega": [1.0, 2.0], "positions": 401}
    (table,) = solved(PLATE, asked, 1e-2, **SPRINGS).response
    (plate,) = table.plates
    # Heave and pitch of the beam are in balance to rounding: so are both loads at the right end.
    for loads in (plate.shear_force, plate.bending_moment):
        assert np.abs(loads[:, :, [0, -1]]).max() < 1e-10 * np.abs(loads).max()
    # The force −(k − iωb) w jumps at the first spring, M by the moment kθ w′ at the second; x is 0.05 m apart.
    x, omega = plate.positions - plate.positions[0], table.omega
    spring, hinge = int(np.searchsorted(x, 4.0)), int(np.searchsorted(x, 13.3))
    jump = jump_at(plate.shear_force[:, 0], spring)
    assert jump == pytest.approx(-(5e4 - 2e4j * omega) * plate.deflection[:, 0, spring], rel=1e-3)
    slope = (plate.deflection[:, 0, hinge + 1] - plate.deflection[:, 0, hinge - 1]) / 0.1
    assert jump_at(plate.bending_moment[:, 0], hinge) == pytest.approx(1e5 * slope, rel=0.02)
    # EI w″ by differences; modes smooth the jump over their wavelength.
    bent = 1e8 * np.diff(plate.deflection[:, 0], 2, axis=1) / 0.05**2
    inner = plate.bending_moment[:, 0, 1:-1]
    assert np.linalg.norm(bent - inner) < 0.2 * np.linalg.norm(inner)


@pytest.mark.slow
@pytest.mark.parametrize("tolerance", [1e-2, 1e-3])
def test_errors_of_loads_are_not_too_small_and_not_far_too_large(tolerance: float) -> None:
    asked = {"kind": "response", "omega": [1.5, 3.0], "positions": 101}
    reference, found = (solved(PLATE, asked, one, **SPRINGS).response[0] for one in (1e-5, tolerance))
    (exact,), (plate,) = reference.plates, found.plates
    for name in ("deflection", "bending_moment", "shear_force"):
        estimate = getattr(plate, f"{name}_error")
        assert 1.0 < ratio(estimate, getattr(plate, name), getattr(exact, name)) < MOST, name


@pytest.mark.slow
def test_errors_of_drift_and_pressures_are_not_too_small_and_not_far_too_large() -> None:
    body = BARGE | {"half_width": 10.0, "half_height": 4.0, "draught": 4.0} if "half_width" in BARGE else BARGE
    asked = {"kind": "response", "omega": [0.6, 0.9, 1.2], "hull_pressures": True}
    damper = {"attachment": [{"damping": [1e3, 1e3, 1e5]}]}
    reference, found = (solved(body, asked, one, **damper).response[0] for one in (1e-6, 1e-3))
    assert 1.0 < ratio(found.drift_error, found.drift_force, reference.drift_force) < MOST
    # The same corners of both meshes: the contact points and the corners of the hull.
    (hull,), (exact,) = found.hulls, reference.hulls
    apart = np.linalg.norm(hull.points[:, None] - exact.points[None], axis=2)
    here, there = np.nonzero(apart < 1e-9)
    assert len(here) > 4
    pairs = hull.pressure[:, :, here], exact.pressure[:, :, there]
    assert 1.0 < ratio(hull.pressure_error, *pairs) < MOST
    # Far field and near field, cornered hull, loose tolerance.
    assert found.near_field_drift == pytest.approx(found.drift_force, rel=1e-3)


def test_waves_that_are_left_out_make_a_spectrum_unconverged() -> None:
    waves = {"kind": "spectrum", "significant_height": 2.0, "peak_period": 8.0, "highest_omega": 0.9}
    barge = {"kind": "float", "shape": "rectangle", "half_width": 10.0, "half_height": 4.0, "draught": 4.0}
    solution = solved(
        barge | {"vertical_centre_of_gravity": 1.0, "radius_of_gyration": 7.0, "motions": ["heave"]}, waves, 1e-2
    )
    assert solution.status == "unconverged"
    assert any("raise highest_omega" in reason for reason in solution.reasons)
    (table,) = solution.spectrum
    # ∫S above 0.9 rad/s with the transfer function at the end, over twice the energy.
    spectrum = table.responses[0]
    beyond = np.abs(table.transfer[-1, 0]) ** 2
    assert spectrum.truncation_error > 0.2 * beyond * 0.25 / spectrum.significant_amplitude**2 * 2.0
