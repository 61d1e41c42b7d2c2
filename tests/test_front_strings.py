"""Hanging strings: series of twenty digits, both methods side by side, Bessel's functions, other discretizations."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from command import run_command
from numpy.polynomial import chebyshev, legendre
from scipy.linalg import eigvals
from scipy.special import j0, jn_zeros
from string_closed_forms import FREQUENCIES, tip_frequencies

import hydroelastic as he

REFERENCES = Path(__file__).parent / "reference" / "string_and_roll.json"
CASES = [case for case in json.loads(REFERENCES.read_text(encoding="utf-8"))["cases"] if case["kind"] != "roll"]
# Of free motions alone.
STILL = {"times": [0.0, 0.01], "positions": [0.0, 0.25, 1.0], "frames": 0}
SHORT: dict[str, Any] = {
    "positions": [0.0, 0.09, 0.36, 0.81, 1.0],
    "times": {"start": 0.0, "stop": 1.5, "number": 16},
    "frames": 0,
}


def hung(string: dict[str, Any], motion: dict[str, Any] | None = None, **parts: Any) -> dict[str, Any]:
    """A string whose units are those of its dimensions, unless it is given others."""
    lead = motion or {"kind": "step", "amplitude": 1.0}
    given = {"length": 1.0, "linear_density": 1.0, "gravity": 1.0} | string
    return {"kind": "string", "string": given, "motion": lead, **parts}


def free_motions(string: dict[str, Any], count: int, **accuracy: Any) -> tuple[Any, Any]:
    """Roots of the free motions, and their stated relative errors, by elements."""
    asked = {"tolerance": 1e-2, "method": "field", "modes": count} | accuracy
    modes = he.solve(hung(string, output=STILL, accuracy=asked)).modes
    return -modes.decay + 1j * modes.damped_omega, modes.relative_error


def displacement(scene: Any) -> Any:
    return he.solve(scene).dataset.displacement.values


@pytest.mark.slow_but("ramp-undamped", "ramp-crit", "ramp-over-big")
@pytest.mark.parametrize("case", CASES, ids=lambda case: case["id"])
def test_references_of_twenty_digits(case: dict[str, Any]) -> None:
    given = case["inputs"]
    values = {"ramp": {"speed": "amp"}, "step": {"amplitude": "amp"}, "sine": {"amplitude": "amp", "omega": "omega"}}
    keys = values.get(case["kind"], {"amplitude": "amp", "rate": "beta"})
    string = {"length": float(given["l"]), "linear_density": 2.0, "gravity": float(given["g"])}
    document = hung(
        string | {"resistance": 2.0 * float(given["alpha"])},
        {"kind": case["kind"]} | {key: float(given[name]) for key, name in keys.items()},
        output={"positions": [float(given["x"])], "times": [float(given["t"])]},
        accuracy={"tolerance": 1e-11},
    )
    result = he.solve(document)
    # 1e-11 of the largest |f| is asked.
    assert result.dataset.displacement.values[0, 0] == pytest.approx(float(case["value"]), abs=1e-10)
    assert result.summary["status"] == "ok"


@pytest.mark.slow_but("string_ramp-0.001", "string_smooth-1e-05")
@pytest.mark.parametrize("tolerance", [1e-3, 1e-5])
@pytest.mark.parametrize("name", ["string_smooth", "string_ramp", "string_sine", "string_step", "string_table"])
def test_field_and_series_agree_within_the_estimate(name: str, tolerance: float) -> None:
    asked = {"tolerance": tolerance, "method": "field"}
    # The scenes are 1 to 25 m long; waves run along a length l in 2 √(l/g).
    length = he.read(name).string.length
    times = SHORT["times"] | {"stop": 1.5 * np.sqrt(length)}
    output = SHORT | {"positions": [length * part for part in SHORT["positions"]], "times": times}
    result = he.solve(he.read(name, {"output": output, "accuracy": asked}))
    exact = displacement(he.read(name, {"output": output, "accuracy.tolerance": 1e-12}))
    apart = ~result.dataset.beside_front.values.astype(bool)
    error = np.abs(result.dataset.displacement.values - exact)
    assert result.summary["method"] == "field"
    assert result.summary["status"] == "ok"
    assert error[apart].max() < tolerance * np.abs(exact).max()
    # An estimate is never below a third of the true error.
    assert np.all(error[apart] <= 3.0 * result.dataset.absolute_error.values[apart] + 1e-13)


@pytest.mark.slow_on_ranks_but
@pytest.mark.mpi
def test_free_motions_of_both_methods_are_one_list() -> None:
    # Heavy damping: two aperiodic modes, both of whose roots count.
    changes = {"string.resistance": 0.5, "output": STILL, "accuracy.tolerance": 1e-3, "accuracy.modes": 8}
    by_field, by_series = (
        he.solve(he.read("string_smooth", changes | {"accuracy.method": method})) for method in ("field", "series")
    )
    exact = by_series.dataset.root.values
    assert np.sum(by_series.dataset.root.sel(complex="im").values == 0.0) == 4
    assert by_field.dataset.root.values == pytest.approx(exact, rel=1e-11, abs=1e-10)
    # Up to their size: 1 at the free end, where all are largest.
    assert by_field.dataset.mode_shape.values == pytest.approx(by_series.dataset.mode_shape.values, abs=1e-9)


@pytest.mark.slow_on_ranks_but("0.1")
@pytest.mark.mpi
@pytest.mark.parametrize("tip", [1e-6, 1e-3, 0.1, 1.0, 30.0])
def test_a_body_at_the_end_beside_its_characteristic_equation(tip: float) -> None:
    found, errors = free_motions({"tip_mass": tip}, 8)
    exact = tip_frequencies(8, tip=tip, hung=tip)
    assert found.real == pytest.approx(0.0, abs=1e-12)
    # Measured 1e-12, from rounding of the graded elements.
    assert found.imag == pytest.approx(exact, rel=1e-10)
    assert np.all(np.abs(found.imag - exact) <= 3.0 * errors * exact)


def test_a_string_with_a_body_in_a_liquid() -> None:
    found, _ = free_motions({"tip_mass": 0.5, "tip_displaced_mass": 0.2, "displaced_mass": 0.4, "added_mass": 0.25}, 6)
    assert found.imag == pytest.approx(tip_frequencies(6, tip=0.5, hung=0.3, mass=1.25, slope=0.6), rel=1e-11)


def test_added_and_displaced_mass_are_another_gravity_by_elements_and_series() -> None:
    """g(ρ − ρ_d)/(ρ + m_a), and the drag of the whole mass."""
    string = {"linear_density": 2.0, "added_mass": 0.5, "displaced_mass": 0.3, "resistance": 0.4}
    exact, damping = FREQUENCIES[:8] * np.sqrt(1.7 / 2.5), 0.4 / 2.5
    for method in ("field", "series"):
        found, _ = free_motions(string, 8, method=method)
        assert found == pytest.approx(-damping + 1j * np.sqrt(exact**2 - damping**2), rel=2e-12)
    wet = {"string.added_mass": 0.02, "string.displaced_mass": 0.01}
    dry = {"string.gravity": 9.81 * 0.04 / 0.07, "string.resistance": 0.225 * 0.05 / 0.07}
    both = [displacement(he.read("string_smooth", {"output": SHORT, **change})) for change in (wet, dry)]
    assert both[0] == pytest.approx(both[1], abs=1e-12)


def legendre_roots(resistance: Any, tip: float, hung: float, slope: float, size: int = 60) -> Any:
    """p of one polynomial P_n(2x − 1) − 1 after another over the whole string, by its companion matrix."""
    points, weights = legendre.leggauss(size + 10)
    x, weights = 0.5 * (points + 1.0), 0.5 * weights
    unit = np.eye(size + 1)[1:]
    values = np.array([legendre.legval(points, row) - 1.0 for row in unit])
    slopes = np.array([2.0 * legendre.legval(points, legendre.legder(row)) for row in unit])
    ends = np.array([legendre.legval(-1.0, row) - 1.0 for row in unit])
    mass = (values * weights) @ values.T + tip * np.outer(ends, ends)
    drag = (values * weights * 2.0 * (resistance[0] + (resistance[1] - resistance[0]) * x)) @ values.T
    stiffness = (slopes * weights * (hung + slope * x)) @ slopes.T
    zero, one = np.zeros_like(mass), np.eye(size)
    roots = eigvals(np.block([[zero, one], [-stiffness, -drag]]), np.block([[one, zero], [zero, mass]]))
    roots = roots[roots.imag >= 0.0]
    return roots[np.argsort(np.abs(roots))]


@pytest.mark.slow_on_ranks_but("resistance0*")
@pytest.mark.mpi
@pytest.mark.parametrize("displaced", [0.0, 0.6])
@pytest.mark.parametrize("resistance", [(0.0, 0.5), (0.6, 0.1), (4.0, 1.0), (0.2, 9.0)])
def test_resistance_that_varies_beside_legendre_polynomials(resistance: Any, displaced: float) -> None:
    """With a body, also where the liquid carries more than half of the string."""
    string = {"resistance": {"bottom": resistance[0], "top": resistance[1]}, "tip_mass": 0.2}
    found, errors = free_motions(string | {"displaced_mass": displaced}, 10)
    exact = legendre_roots(resistance, 0.2, 0.2, 1.0 - displaced)[:10]
    # The dense companion matrix is good for 1e-10 only.
    assert found == pytest.approx(exact, rel=1e-9)
    assert np.all(np.diff(np.abs(found)) >= 0.0)
    assert errors.max() < 1e-9


@pytest.mark.parametrize("damping", [0.3, 2.0, 20.0])
def test_a_uniform_resistance_by_elements(damping: float) -> None:
    squares = FREQUENCIES[:60] ** 2
    root = np.sqrt(damping**2 - squares + 0j)
    over = root.imag == 0.0
    exact = np.concatenate([np.where(over, -squares / (damping + root.real), -damping + root), (-damping - root)[over]])
    exact = exact[np.argsort(np.abs(exact))][:12]
    found, errors = free_motions({"resistance": damping}, 12)
    count = min(len(found), 12)
    assert found[:count] == pytest.approx(exact[:count], rel=1e-11)
    assert np.all(np.abs(found[:count] - exact[:count]) <= 3.0 * errors[:count] * np.abs(exact[:count]))


def test_next_to_a_double_root_sum_and_product_are_kept() -> None:
    damping = float(FREQUENCIES[0])
    for method in ("field", "series"):
        found, _ = free_motions({"resistance": damping}, 4, method=method)
        first = found[:2] if found[0].imag == 0.0 else np.array([found[0], found[0].conj()])
        # p itself to the root of rounding only.
        assert first.sum() == pytest.approx(-2.0 * damping, rel=1e-11)
        assert first.prod() == pytest.approx(damping**2, rel=1e-11)


def test_weaker_resistance_below_shifts_frequencies_to_first_order() -> None:
    """δp = −φᵀCφ/(2φᵀMφ) of real shapes: no change of the frequency, and ∫2λφ²/2∫φ² of the decay."""
    found, _ = free_motions({"resistance": {"bottom": 0.0, "top": 1e-5}}, 5)
    x, weights = legendre.leggauss(80)
    x, weights = 0.5 * (x + 1.0), 0.5 * weights
    for root, zero in zip(found, jn_zeros(0, 5), strict=True):
        square = j0(zero * np.sqrt(x)) ** 2 * weights
        assert root.real == pytest.approx(-1e-5 * (square @ x) / square.sum(), rel=1e-5)
        assert root.imag == pytest.approx(0.5 * zero, rel=1e-9)


def steady(string: dict[str, Any], omega: float, positions: Any, tip: float | None = None) -> Any:
    """U e^{−iωt} of U(l) = e^{iωt} by Chebyshev's polynomials at points: (TU')' = (−mω² + 2iωλ)U, TU'(0) = −Mω²U(0)."""
    size, length = 40, string["length"]
    points = -np.cos(np.pi * np.arange(size + 1) / size)
    x, unit, scale = 0.5 * length * (points + 1.0), np.eye(size + 1), 2.0 / length
    values = np.array([chebyshev.chebval(points, row) for row in unit]).T
    first = scale * np.array([chebyshev.chebval(points, chebyshev.chebder(row)) for row in unit]).T
    second = scale**2 * np.array([chebyshev.chebval(points, chebyshev.chebder(row, 2)) for row in unit]).T
    slope = 9.81 * (string["linear_density"] - string["displaced_mass"])
    bottom = 9.81 * (string["tip_mass"] - string["tip_displaced_mass"])
    low, high = string["resistance"]["bottom"], string["resistance"]["top"]
    drag = low + (high - low) * x / length
    inertia = -(omega**2) * (string["linear_density"] + string["added_mass"]) + 2j * omega * drag
    system = (bottom + slope * x)[:, None] * second + slope * first - inertia[:, None] * values
    system[0] = bottom * first[0] + omega**2 * (string["tip_mass"] if tip is None else tip) * values[0]
    system[-1] = values[-1]
    coefficients = np.linalg.solve(system, np.append(np.zeros(size), 1.0))
    return np.asarray(chebyshev.chebval(2.0 * positions / length - 1.0, coefficients))


def test_a_steady_oscillation_with_all_options() -> None:
    string = {"length": 2.0, "linear_density": 0.8, "gravity": 9.81, "resistance": {"bottom": 3.0, "top": 1.8}}
    string |= {"tip_mass": 0.6, "tip_displaced_mass": 0.1, "added_mass": 0.3, "displaced_mass": 0.2}
    omega, positions = 5.0, np.array([0.0, 0.3, 1.1, 1.8])
    # Free motions decay like e^{−1.6t} at the least, so that 1e-8 of them is left.
    times = np.array([12.0, 12.3])
    motion = {"kind": "sine", "amplitude": 1.0, "omega": omega}
    output = {"positions": positions.tolist(), "times": times.tolist()}
    result = he.solve(hung(string, motion, output=output, accuracy={"tolerance": 1e-4}))
    amplitude = steady(string, omega, positions)
    assert result.summary["status"] == "ok"
    exact = np.imag(amplitude[:, None] * np.exp(1j * omega * times))
    assert result.dataset.displacement.values == pytest.approx(exact, abs=1e-4 * np.abs(exact).max() + 1e-7)
    # Without the inertia of the body, or with its weight alone, it would be another motion.
    assert np.abs(amplitude - steady(string, omega, positions, tip=0.0)).max() > 0.05


@pytest.mark.slow
def test_a_heavy_load_swings_like_a_pendulum() -> None:
    found, _ = free_motions({"tip_mass": 1e5, "gravity": 9.81}, 1)
    assert found[0].imag == pytest.approx(np.sqrt(9.81), rel=1e-5)


@pytest.mark.slow
def test_metres_and_millimetres_give_the_same_digits() -> None:
    changes: dict[str, Any] = {"output.times": {"start": 0.0, "stop": 8.0, "number": 9}}
    metres = displacement(he.read("string_sine", changes))
    changes |= {"string.length": 1e-3, "string.gravity": 9.81e-3, "motion.amplitude": 2e-5}
    assert 1e3 * displacement(he.read("string_sine", changes)) == pytest.approx(
        metres, abs=1e-12 * np.abs(metres).max()
    )


def test_nothing_moves_before_the_front_and_what_is_beside_it_is_told_apart() -> None:
    result = he.solve("string_step")
    data, told = result.dataset, result.summary["response"]
    # A wave takes 2(√l − √x)/√g.
    arrival = (
        2.0
        * (1.0 - np.sqrt(data.position.values / data.position.values[-1]))
        * np.sqrt(data.position.values[-1] / 9.81)
    )
    before = data.time.values[None, :] < arrival[:, None] * (1.0 - 1e-12)
    assert before.sum() > 1000
    assert np.all(data.displacement.values[before] == 0.0)
    assert result.summary["status"] == "ok"
    assert 0 < told["beside_fronts"]["points"] < 0.06 * told["points"]
    # What is said to be certain is; and the step, which jumps, is not near its fronts.
    assert told["relative_error"] < 1e-6
    assert told["beside_fronts"]["absolute_error"] > 1e-3


@pytest.mark.slow
def test_values_in_a_front_are_not_claimed_by_a_field() -> None:
    """At x = 0.25 the front of a step passes at t = 1: given is the mean of both sides, off by half the jump."""
    output = {"positions": [0.25], "times": [1.0]}
    asked = {"tolerance": 1e-3, "method": "field"}
    data = he.solve(hung({"resistance": 0.2}, output=output, accuracy=asked)).dataset
    jump = 0.25**-0.25 * np.exp(-0.2)
    assert bool(data.beside_front.values.all())
    assert data.displacement.values[0, 0] == pytest.approx(0.5 * jump, abs=0.02)
    assert data.absolute_error.values[0, 0] > 0.5 * jump


def test_the_criterion_of_oscillation() -> None:
    viscous = he.solve(he.read("string_smooth", {"output": STILL})).summary
    assert viscous["string"]["first_oscillating_mode"] == 2
    # The slow root, the fast one, and the second mode.
    assert [mode["kind"] for mode in viscous["modes"][:3]] == ["aperiodic", "aperiodic", "oscillating"]
    assert viscous["modes"][0]["decay"] * viscous["modes"][1]["decay"] == pytest.approx(3.76606738842**2, rel=1e-11)
    assert viscous["modes"][2]["omega"] == pytest.approx(8.64469611368, rel=1e-11)
    assert viscous["string"]["critical_resistance"] == pytest.approx(0.05 * 1.2024127788 * np.sqrt(9.81), rel=1e-9)
    # Just below the critical resistance all oscillate, just above one does not, with the mass of the liquid too.
    carried = {"output": STILL, "string.added_mass": 0.02}
    critical = he.solve(he.read("string_smooth", carried)).summary["string"]["critical_resistance"]
    for factor, first in ((0.999999, 1), (1.000001, 2)):
        summary = he.solve(he.read("string_smooth", carried | {"string.resistance": factor * critical})).summary
        assert summary["string"]["first_oscillating_mode"] == first


def test_the_steady_amplitude_is_that_of_late_times() -> None:
    late = displacement(
        he.read("string_sine", {"output": {"positions": [0.1], "times": {"start": 60.0, "stop": 62.0, "number": 2001}}})
    )
    summary = he.solve(he.read("string_sine", {"output": {"positions": [0.1], "times": [60.0]}})).summary
    # e^{−0.5·60} of the free motion is left, and 2000 points of a period miss its top by 1e-6 of it.
    assert np.abs(late).max() == pytest.approx(summary["steady"]["amplitude"][0], rel=3e-6)


def test_compare_sets_both_methods_side_by_side_where_both_are() -> None:
    ran = run_command(
        "compare",
        "string_smooth",
        "--set",
        "output={positions=[0.0, 0.5], times=[0.5]}",
        "--set",
        "accuracy.tolerance=1e-4",
    )
    assert ran.exit_code == 0
    assert ran.output.splitlines()[1] == "The field solution beside the series"
    refused = run_command("compare", "string_with_load")
    assert refused.exit_code == 2
    assert "no series to compare with" in refused.output
    refused = run_command("compare", "string_ramp", "--set", "output.times=[6000.0]")
    assert refused.exit_code == 2
    assert "travel times of a wave" in refused.output
