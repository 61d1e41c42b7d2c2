"""Bodies in irregular waves: frequencies that miss no resonance, drag, loads along plates."""

from typing import Any

import numpy as np
import pytest
from mpi4py import MPI

from hydroelastic.fem.open_water.irregular_results import SpectrumTable
from hydroelastic.scenes.errors import SceneError
from hydroelastic.scenes.models import SeaScene, Spectrum
from hydroelastic.scenes.open_water.solve import solve_open

BARGE: dict[str, Any] = {
    "kind": "float",
    "shape": "rectangle",
    "half_width": 10.0,
    "half_height": 4.0,
    "draught": 4.0,
    "vertical_centre_of_gravity": 1.0,
    "radius_of_gyration": 7.0,
}
WAVES = {"kind": "spectrum", "significant_height": 2.0, "peak_period": 8.0}


def solved(body: dict[str, Any], analyses: list[dict[str, Any]], tolerance: float = 1e-3, **keys: Any) -> Any:
    scene = SeaScene(
        liquid=[{"density": 1025.0, "depth": float("inf")}],
        body=[body],
        analysis=analyses,
        accuracy={"tolerance": tolerance},
        **keys,
    )
    solution = solve_open(scene, MPI.COMM_WORLD, lambda _message: None)
    assert solution.status == "ok", solution.reasons
    return solution


def amplitudes(table: SpectrumTable) -> dict[str, float]:
    return {one.quantity: one.significant_amplitude for one in table.responses}


@pytest.mark.slow
def test_a_narrow_resonance_is_not_missed() -> None:
    body = BARGE | {"motions": ["heave", "sway", "roll"]}
    asked = {"kind": "response", "omega": np.linspace(0.7, 1.0, 601).tolist()}
    solution = solved(body, [WAVES, asked])
    (irregular,), (regular,) = solution.spectrum, solution.response
    roll = irregular.transfer[:, irregular.quantities.index("roll")]
    # The half width of the resonance is 0.0016 rad/s; the first frequencies are 0.06 apart.
    assert np.abs(roll).max() == pytest.approx(np.abs(regular.amplitudes[:, 0, 2]).max(), rel=2e-2)
    assert 0.0 < irregular.responses[2].relative_error < 1e-2
    again = np.trapezoid(irregular.response_density[:, 2], irregular.omega)
    assert irregular.responses[2].significant_amplitude == pytest.approx(2.0 * np.sqrt(again), rel=5e-3)


def test_points_move_with_their_body() -> None:
    body = BARGE | {"motions": ["heave", "roll"]}
    points = [{"at": [10.0, 4.0]}, {"at": [0.0, 1.0]}]
    (table,) = solved(body, [WAVES | {"points": points}], 1e-2).spectrum
    by_name = dict(zip(table.quantities, table.transfer.T, strict=True))
    expected = by_name["heave"] + 10.0 * by_name["roll"]
    assert by_name["point 1 up"] == pytest.approx(expected, rel=1e-9)
    assert by_name["point 1 sideways"] == pytest.approx(-3.0 * by_name["roll"], rel=1e-9)
    assert by_name["point 1 acceleration up"] == pytest.approx(-(table.omega**2) * expected, rel=1e-9)
    assert by_name["point 2 up"] == pytest.approx(by_name["heave"], rel=1e-9)


def test_drag_in_irregular_waves_takes_the_power_of_its_linear_damping() -> None:
    body = BARGE | {"motions": ["roll"]}
    drag = {"quadratic_damping": [0.0, 0.0, 5e6]}
    high, low = (
        solved(body, [WAVES | {"significant_height": height}], 1e-2, attachment=[drag]).spectrum[0]
        for height in (4.0, 0.01)
    )
    free = solved(body, [WAVES | {"significant_height": 0.01}], 1e-2).spectrum[0]
    # σ of the velocity and the damping b = √(8/π) β σ that belongs to it agree, but for the trapezoidal rule.
    speed = np.trapezoid(high.omega**2 * high.response_density[:, 0], high.omega)
    expected = np.sqrt(8.0 / np.pi) * 5e6 * np.sqrt(speed)
    assert high.equivalent_damping[0, 0] == pytest.approx(expected, rel=1e-2)
    # In low waves drag vanishes like their height.
    assert amplitudes(high)["roll"] < 0.5 * 400.0 * amplitudes(free)["roll"]
    assert amplitudes(low)["roll"] == pytest.approx(amplitudes(free)["roll"], rel=0.1)


def test_dampers_and_drag_take_power_of_a_whole_solid() -> None:
    """The same in N and W, of which the basin has units of its own."""
    body = {"kind": "float", "shape": "cylinder", "radius": 3.0, "draught": 3.0, "motions": ["heave"]}
    held = {"damping": [2e4, 0.0, 0.0], "quadratic_damping": [5e4, 0.0, 0.0]}
    (table,) = solved(body, [WAVES], 3e-2, attachment=[held]).spectrum
    variance = np.trapezoid(table.omega**2 * table.response_density[:, 0], table.omega)
    # But for the trapezoidal rule, measured 2e-5.
    assert table.equivalent_damping[0, 0] == pytest.approx(np.sqrt(8.0 / np.pi) * 5e4 * np.sqrt(variance), rel=1e-3)
    assert table.mean_absorbed_power == pytest.approx(2e4 * variance, rel=1e-3)


def test_a_narrow_band_drifts_as_a_regular_wave() -> None:
    body = BARGE | {"motions": ["heave"]}
    band = {"kind": "spectrum", "waves": "table", "omega": [0.899, 0.9, 0.901], "density": [0.0, 50.0, 0.0]}
    regular = {"kind": "response", "omega": [0.9]}
    # Waves from the right push to the left.
    solution = solved(body, [one | {"waves_from": "right"} for one in (band, regular)])
    assert solution.response[0].drift_force[0, 0] < 0.0
    # 2 (F/A²) m₀ with m₀ = ½ · 0.002 · 50; F/A² changes by less than 1 % in the band.
    expected = 2.0 * solution.response[0].drift_force[0, 0] * 0.05
    assert solution.spectrum[0].mean_drift_force == pytest.approx(expected, rel=1e-2)


def test_loads_along_a_plate() -> None:
    plate = {"length": 20.0, "flexural_rigidity": 1e8, "mass_per_length": 500.0}
    (table,) = solved(plate, [WAVES | {"thickness": 1.0, "positions": 31}], 1e-2).spectrum
    (loads,) = table.plates
    # Short waves bend a plate: beyond four times the peak of the spectrum they matter to the loads.
    assert table.omega[-1] > 4.0 * 2.0 * np.pi / 8.0
    # Free ends.
    assert loads.significant_bending_moment[[0, -1]] == pytest.approx(
        0.0, abs=1e-6 * loads.largest_bending_moment.max()
    )
    middle = 0.5 * (loads.significant_bending_moment[1:] + loads.significant_bending_moment[:-1])
    assert middle.max() > 0.0
    assert loads.largest_stress == pytest.approx(6.0 * loads.largest_bending_moment)
    assert 1.5 < (loads.largest_bending_moment / np.maximum(loads.significant_bending_moment, 1e-9))[15] < 2.0


@pytest.mark.parametrize(
    ("keys", "message"),
    [
        ({"peak_period": None}, "it is missing"),
        ({"waves": "table", "omega": [1.0, 2.0]}, "it is missing, and waves = .table. need it"),
        ({"density": [1.0]}, "does not belong to waves"),
        ({"waves": "pierson_moskowitz", "peak_enhancement": 7.0}, "does not belong to waves"),
    ],
)
def test_incomplete_seas_are_refused(keys: dict[str, Any], message: str) -> None:
    given = {key: value for key, value in (WAVES | keys).items() if value is not None}
    with pytest.raises(SceneError, match=message):
        Spectrum(**given)


def test_points_off_their_body_are_refused() -> None:
    plate = {"length": 60.0, "flexural_rigidity": 2e9, "mass_per_length": 500.0}
    with pytest.raises(SceneError, match="does not lie on the beam"):
        solved(plate, [WAVES | {"points": [{"at": [61.0, 0.0]}]}])
    with pytest.raises(SceneError, match="there is no body of that number"):
        solved(plate, [WAVES | {"points": [{"body": 2, "at": [6.0, 0.0]}]}])
