"""Bodies in irregular waves: no resonance is missed; drag, loads, air gaps; motions simulated and linearised."""

from __future__ import annotations

import math
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from open_cases import GRAVITY, answer, curves, sea
from scipy.special import h1vp, hankel1, jvp

import hydroelastic as he

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


def solved(
    body: dict[str, Any], *analyses: dict[str, Any], tolerance: float = 1e-3, depth: float = math.inf, **keys: Any
) -> SimpleNamespace:
    found = answer(sea(body, depth=depth, tolerance=tolerance, **{"density": 1025.0} | keys), *analyses)
    assert found.status == "ok", found.summary["reasons"]
    return found


def significant(found: SimpleNamespace, quantity: str) -> float:
    (value,) = (one.significant_amplitude for one in found.spectrum[0].responses if one.quantity == quantity)
    return float(value)


@pytest.mark.slow
def test_a_narrow_resonance_is_not_missed() -> None:
    body = BARGE | {"motions": ["heave", "sway", "roll"]}
    asked = {"kind": "response", "omega": np.linspace(0.7, 1.0, 601).tolist()}
    solution = solved(body, WAVES, asked)
    irregular, (regular,) = curves(solution.result), solution.response
    # The half width of the resonance is 0.0016 rad/s; the first frequencies are 0.06 apart.
    largest = np.abs(regular.amplitudes[:, 0, 2]).max()
    assert np.abs(irregular.transfer["roll"]).max() == pytest.approx(largest, rel=2e-2)
    assert 0.0 < solution.spectrum[0].responses[2].relative_error < 1e-2
    again = np.trapezoid(irregular.density["roll"], irregular.omega)
    assert significant(solution, "roll") == pytest.approx(2.0 * np.sqrt(again), rel=5e-3)


def test_points_move_with_their_body() -> None:
    body = BARGE | {"motions": ["heave", "roll"]}
    points = [{"at": [10.0, 4.0]}, {"at": [0.0, 1.0]}]
    found = curves(solved(body, WAVES | {"points": points}, tolerance=1e-2).result)
    moved = found.transfer
    expected = moved["heave"] + 10.0 * moved["roll"]
    assert moved["point 1 up"] == pytest.approx(expected, rel=1e-9)
    assert moved["point 1 sideways"] == pytest.approx(-3.0 * moved["roll"], rel=1e-9)
    assert moved["point 1 acceleration up"] == pytest.approx(-(found.omega**2) * expected, rel=1e-9)
    assert moved["point 2 up"] == pytest.approx(moved["heave"], rel=1e-9)


def test_drag_in_irregular_waves_takes_the_power_of_its_linear_damping() -> None:
    body = BARGE | {"motions": ["roll"]}
    drag = {"attachment": [{"quadratic_damping": [0.0, 0.0, 5e6]}]}
    high, low, free = (
        solved(body, WAVES | {"significant_height": height}, tolerance=1e-2, **held)
        for height, held in ((4.0, drag), (0.01, drag), (0.01, {}))
    )
    # σ of the velocity and the damping b = √(8/π) β σ that belongs to it agree, but for the trapezoidal rule.
    curve = curves(high.result)
    speed = np.trapezoid(curve.omega**2 * curve.density["roll"], curve.omega)
    expected = np.sqrt(8.0 / np.pi) * 5e6 * np.sqrt(speed)
    assert high.spectrum[0].equivalent_damping[0, 0] == pytest.approx(expected, rel=1e-2)
    # In low waves drag vanishes like their height.
    assert significant(high, "roll") < 0.5 * 400.0 * significant(free, "roll")
    assert significant(low, "roll") == pytest.approx(significant(free, "roll"), rel=0.1)


def test_dampers_and_drag_take_power_of_a_whole_solid() -> None:
    """The same in N and W, of which the basin has units of its own."""
    body = {"kind": "float", "shape": "cylinder", "radius": 3.0, "draught": 3.0, "motions": ["heave"]}
    held = {"damping": [2e4, 0.0, 0.0], "quadratic_damping": [5e4, 0.0, 0.0]}
    found = solved(body, WAVES, tolerance=3e-2, attachment=[held])
    (table,), curve = found.spectrum, curves(found.result)
    variance = np.trapezoid(curve.omega**2 * curve.density["heave"], curve.omega)
    # But for the trapezoidal rule, measured 2e-5.
    assert table.equivalent_damping[0, 0] == pytest.approx(np.sqrt(8.0 / np.pi) * 5e4 * np.sqrt(variance), rel=1e-3)
    assert table.mean_absorbed_power == pytest.approx(2e4 * variance, rel=1e-3)


def test_a_narrow_band_drifts_as_a_regular_wave() -> None:
    body = BARGE | {"motions": ["heave"]}
    band = {"kind": "spectrum", "waves": "table", "omega": [0.899, 0.9, 0.901], "density": [0.0, 50.0, 0.0]}
    regular = {"kind": "response", "omega": [0.9]}
    # Waves from the right push to the left.
    solution = solved(body, *(one | {"waves_from": "right"} for one in (band, regular)))
    assert solution.response[0].drift_force[0, 0] < 0.0
    # 2 (F/A²) m₀ with m₀ = ½ · 0.002 · 50; F/A² changes by less than 1 % in the band.
    expected = 2.0 * solution.response[0].drift_force[0, 0] * 0.05
    assert solution.spectrum[0].mean_drift_force == pytest.approx(expected, rel=1e-2)


def test_loads_along_a_plate_follow_from_those_in_regular_waves() -> None:
    plate = {"length": 20.0, "flexural_rigidity": 1e8, "mass_per_length": 500.0}
    band = {"kind": "spectrum", "waves": "table", "omega": [1.49, 1.5, 1.51], "density": [0.0, 50.0, 0.0]}
    regular = {"kind": "response", "omega": [1.5], "positions": 31}
    found = solved(plate, band | {"thickness": 1.0, "positions": 31}, regular, tolerance=1e-2)
    (loads,), (along,) = found.spectrum[0].plates, found.response[0].plates
    # m₀ = ½ · 0.02 · 50; loads change by about the width of the band.
    for name in ("bending_moment", "shear_force", "deflection"):
        expected = 2.0 * np.sqrt(0.5) * np.abs(getattr(along, name)).max()
        assert getattr(loads, f"significant_{name}") == pytest.approx(expected, rel=2e-2)
    assert loads.largest_stress == pytest.approx(6.0 * loads.largest_bending_moment)
    assert 1.5 < loads.largest_bending_moment / loads.significant_bending_moment < 2.5


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
    with pytest.raises(he.SceneError, match=message):
        he.read(sea(BARGE, tolerance=1e-2, analysis=[given]))


def test_points_off_their_body_are_refused() -> None:
    plate = {"length": 60.0, "flexural_rigidity": 2e9, "mass_per_length": 500.0}
    with pytest.raises(he.SceneError, match="does not lie on the beam"):
        solved(plate, WAVES | {"points": [{"at": [61.0, 0.0]}]})
    with pytest.raises(he.SceneError, match="there is no body of that number"):
        solved(plate, WAVES | {"points": [{"body": 2, "at": [6.0, 0.0]}]})


SECTION: dict[str, Any] = {"kind": "float", "shape": "rectangle", "half_width": 2.0, "half_height": 1.0, "draught": 1.0}
FAR, EDGE = 14.0, 2.0


def gapped(body: dict[str, Any], depth: float, *analyses: dict[str, Any]) -> SimpleNamespace:
    return solved(body, *analyses, depth=depth, tolerance=1e-2, density=1000.0, sea={"drawn": [-15.0, 15.0]})


def band(omega: float, *points: dict[str, Any]) -> dict[str, Any]:
    """Waves of unit variance about a frequency."""
    frequencies = [omega - 0.02, omega, omega + 0.02]
    return {
        "kind": "spectrum",
        "waves": "table",
        "omega": frequencies,
        "density": [0.0, 50.0, 0.0],
        "air_gaps": list(points),
    }


@pytest.mark.mpi
def test_water_rises_as_far_waves_and_the_motion_of_the_point_say() -> None:
    """Far from a section over a bed waves are e^{ikx} + R e^{−ikx} and T e^{ikx}; at its edge it moves with them."""
    # The middle of frequencies in a geometric series.
    omega, depth = math.sqrt(1.98 * 2.02), 4.0
    body = SECTION | {"motions": ["heave", "roll"], "vertical_centre_of_gravity": 0.0, "radius_of_gyration": 1.2}
    points = [{"at": [-FAR, 2.0]}, {"at": [FAR, 2.0]}, {"at": [EDGE, 1.0]}, {"at": [EDGE, 1.0], "body": 1}]
    solution = gapped(body, depth, band(2.0, *points), {"kind": "response", "omega": [omega]})
    (table,), (regular,), curve = solution.spectrum, solution.response, curves(solution.result)
    place = int(np.argmin(np.abs(curve.omega - omega)))
    assert curve.omega[place] == pytest.approx(omega, abs=1e-9)
    found = {name: values[place] for name, values in curve.transfer.items()}
    phase = np.exp(1j * regular.wavenumbers[0, 0] * FAR)
    reflected, passed = regular.reflection[0, 0, 0], regular.transmission[0, 0, 0]
    assert 0.2 < abs(reflected) < 0.98
    # Evanescent waves have decayed to e^{−9}; R, T and the elevation have errors of their own.
    assert found["relative elevation 1"] == pytest.approx(1.0 / phase + reflected * phase, abs=1e-2)
    assert found["relative elevation 2"] == pytest.approx(passed * phase, abs=1e-2)
    edge = found["heave"] + EDGE * found["roll"]
    assert abs(edge) > 0.3
    assert found["relative elevation 4"] == pytest.approx(found["relative elevation 3"] - edge, abs=1e-9)
    gap = table.air_gaps[1]
    assert gap.smallest_air_gap == pytest.approx(2.0 - gap.largest_relative_elevation)
    # m₀ of the waves is 1, and hardly any of T changes in the band.
    assert gap.significant_relative_elevation == pytest.approx(2.0 * abs(passed), rel=3e-2)


@pytest.mark.slow_but("left-*")
@pytest.mark.parametrize(("waves_from", "towards"), [("left", 1.0), ("right", -1.0)])
def test_the_free_top_of_two_liquids_rises_less_than_the_interface(waves_from: str, towards: float) -> None:
    """η/ζ = ω²/(ω² cosh kh − gk sinh kh) of the top at h above an interface on which a wave ζ travels.

    The body is 2e-4 m wide, and what it scatters falls like the square of its width.
    """
    # The middle of frequencies in a geometric series.
    omega, height, x = math.sqrt(0.98 * 1.02), 1.0, 2.0
    body = {"kind": "float", "shape": "rectangle", "half_width": 1e-4, "half_height": 1e-4, "at": "interface"}
    liquids = [{"density": 1000.0, "depth": 4.0}, {"density": 800.0, "depth": height}]
    waves = band(1.0, {"at": [x, 3.0]}) | {"waves_from": waves_from}
    found = answer(
        sea(body, liquid=liquids, tolerance=1e-2, sea={"phase_at": 0.5, "drawn": [-15.0, 15.0]}),
        waves,
        {"kind": "response", "omega": [omega]},
    )
    k = found.response[0].wavenumbers[0].max()
    curve = curves(found.result)
    place = int(np.argmin(np.abs(curve.omega - omega)))
    assert curve.omega[place] == pytest.approx(omega, abs=1e-9)
    ratio = omega**2 / (omega**2 * math.cosh(k * height) - GRAVITY * k * math.sinh(k * height))
    assert -0.2 < ratio < 0.0
    found_ratio = curve.transfer["relative elevation 1"][place]
    # Measured 3.5e-8; ten times as wide, 3.5e-6.
    assert found_ratio == pytest.approx(ratio * np.exp(1j * towards * k * (x - 0.5)), rel=1e-7)


def test_the_edge_of_a_limp_plate_stays_on_the_water() -> None:
    plate = {"kind": "plate", "outline": "disc", "radius": 1.0, "mass_per_area": 1.0, "flexural_rigidity": 10.0}
    edge = {"at": [1.0, 1.0]}
    waves = band(2.0, edge, edge | {"body": 1}) | {"points": [edge | {"at": [1.0, 0.0]}]}
    table = curves(gapped(plate | {"poisson_ratio": 0.3}, math.inf, waves).result)
    # At a free edge there is no moment, whose relative error would be infinite.
    assert {one for one in table.transfer if "point" in one} == {"point 1 up", "point 1 acceleration up"}
    fixed, moving = (np.abs(table.transfer[f"relative elevation {number}"]) for number in (1, 2))
    # Its mass and its bending are a hundredth of the water's; it follows a wave of nearly unit height.
    assert np.abs(fixed - 1.0).max() < 2e-2
    assert moving.max() < 2e-2


@pytest.mark.slow
def test_water_around_a_deep_cylinder_rises_as_around_one_on_the_bed() -> None:
    """e^{ikx} − Σ εₙ iⁿ Jₙ′(ka)/Hₙ′(ka) Hₙ(kr) cos nθ of MacCamy and Fuchs, up to e^{−kd} = 6e-6."""
    wavenumber = 2.0
    omega = math.sqrt(GRAVITY * wavenumber)
    places = [(-1.0, 0.0), (1.0, 0.0), (0.0, 1.5), (-0.5, -1.5)]
    points = [{"at": [x, 4.0], "across": y} for x, y in places]
    body = {"kind": "float", "shape": "cylinder", "radius": 1.0, "draught": 6.0, "motions": ["heave"]}
    table = curves(gapped(body | {"vertical_centre_of_gravity": -4.0}, math.inf, band(omega, *points)).result)
    place = int(np.argmin(np.abs(table.omega - omega)))
    orders = np.arange(30)
    parts = np.where(orders, 2.0, 1.0) * 1j**orders * jvp(orders, wavenumber) / h1vp(orders, wavenumber)
    for number, (x, y) in enumerate(places, 1):
        found = table.transfer[f"relative elevation {number}"][place]
        around = hankel1(orders, wavenumber * math.hypot(x, y)) * np.cos(orders * math.atan2(y, x))
        assert found == pytest.approx(np.exp(1j * wavenumber * x) - parts @ around, abs=1e-2)


@pytest.mark.parametrize(
    ("gap", "message"),
    [
        ({"at": [0.5, 2.0]}, "below it there is .*body.* number 1, which reaches from -2 to 2 m"),
        ({"at": [3.0, -0.5]}, "is not above the still water"),
        ({"at": [16.0, 2.0]}, "outside what is drawn"),
        ({"at": [3.0, 2.0], "across": 1.0}, "a section is the same at any distance across"),
        ({"at": [3.0, 2.0], "body": 2}, "there is no body of that number"),
    ],
)
def test_points_without_water_below_are_refused(gap: dict[str, Any], message: str) -> None:
    with pytest.raises(he.SceneError, match=message):
        gapped(SECTION | {"motions": ["heave"]}, 4.0, band(2.0, gap))


@pytest.mark.slow
def test_simulated_motions_have_the_standard_deviation_of_stochastic_linearisation() -> None:
    """With 99 % confidence, of sway with strong drag and of heave without.

    The variance of a sample of duration T of a Gaussian response with the spectrum S has the variance (2π/T) ∫S² dω
    (J. S. Bendat and A. G. Piersol, Random Data, 2010, § 8.2).
    """
    # Standard deviations of the sample variance within which 99 % of samples lie.
    ramp, duration, confidence, height = 30.0, 400.0, 2.58, 1.5
    body = {"kind": "float", "shape": "ellipse", "half_width": 2.0, "half_height": 2.0, "motions": ["heave", "sway"]}
    mooring = {"stiffness": [0.0, 1.5e4, 0.0], "quadratic_damping": [0.0, 2e4, 0.0]}
    waves = {"significant_height": height, "peak_period": 5.0}
    times = np.arange(0.0, ramp + duration, 0.5)
    asked = {"kind": "motion", "times": times.tolist(), "ramp": ramp}
    motions = [asked | {"random_waves": waves | {"seed": seed, "number": 200}} for seed in (1, 2)]
    spectrum = {"kind": "spectrum"} | waves
    dragged = solved(body, spectrum, *motions, depth=20.0, tolerance=1e-2, attachment=[mooring])
    held = [{"stiffness": mooring["stiffness"]}]
    without = solved(body, spectrum, depth=20.0, tolerance=1e-2, attachment=held)
    curve = curves(dragged.result)
    samples = np.concatenate([one.displacement[times >= ramp] for one in dragged.motion])
    for place, name in enumerate(("heave", "sway")):
        expected = 0.5 * significant(dragged, name)
        spread = np.trapezoid(curve.density[name] ** 2, curve.omega) * 2.0 * np.pi / (2.0 * duration)
        # Relative, of the standard deviation half of that of the variance; beside it the tolerance of both solutions.
        certain = 0.5 * confidence * np.sqrt(spread) / expected**2 + 2e-2
        assert certain < 0.2
        assert abs(np.sqrt((samples[:, place] ** 2).mean()) / expected - 1.0) < certain
    # Drag matters far more than that.
    assert significant(without, "sway") > 1.3 * significant(dragged, "sway")


@pytest.mark.slow
def test_frequencies_of_a_spectrum_reach_as_far_as_the_drift_has_weight() -> None:
    body = BARGE | {"motions": ["heave", "sway", "roll"]}
    found, further = (
        solved(body, WAVES | more, tolerance=1e-4, density=1000.0) for more in ({}, {"highest_omega": 5.0})
    )
    # Four times the frequency of the peak leaves 6e-5 of the force of waves that are reflected in full.
    assert curves(found.result).omega[-1] > 1.1 * 8.0 * np.pi / 8.0
    (one,), (other,) = found.spectrum, further.spectrum
    assert abs(one.mean_drift_force - other.mean_drift_force) < one.mean_drift_error
    assert one.mean_drift_error < 1e-4 * 1000.0 * 9.81 * 0.25
