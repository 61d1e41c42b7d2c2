"""The printed formulas of the paper on a string fail, by as much as theory says; the corrected ones do not."""

from __future__ import annotations

import json
import math
from pathlib import Path

import numpy as np
import pytest
from scipy.special import iv
from uniform_strings import uniform_string

from hydroelastic.modal.estimate import NoEstimateError
from hydroelastic.modal.string import paper as paper
from hydroelastic.modal.string.closed_form import free_roots
from hydroelastic.modal.string.paper import STRING_ERRATA
from hydroelastic.modal.string.partial_sum import partial_sum
from hydroelastic.modal.string.response import string_response
from hydroelastic.physics.string import HangingString
from hydroelastic.physics.string_motions import Ramp, Sine, Smooth

REFERENCE = json.loads((Path(__file__).parent / "reference" / "string_and_roll.json").read_text(encoding="utf-8"))
PRINTED = {case["id"]: case for case in REFERENCE["cases"] if case["paper"] == "000" and "as_printed" in case}
S0 = math.sqrt(9.81)


def _string(damping: float) -> HangingString:
    return uniform_string(damping=damping)


def test_errata_are_numbered_and_complete() -> None:
    assert [erratum.number for erratum in STRING_ERRATA] == list(range(1, 17))
    for erratum in STRING_ERRATA:
        assert erratum.printed
        assert erratum.corrected
        assert erratum.consequence


def test_stored_values_of_what_is_printed() -> None:
    for name in ("smooth-under", "smooth-beta<alpha/2", "step-undamped"):
        case = PRINTED[name]
        inputs = {key: float(value) for key, value in case["inputs"].items()}
        string = _string(inputs["alpha"])
        if case["kind"] == "step":
            value = paper.step_motion(string, 1.0, inputs["x"], inputs["t"])
        else:
            value = paper.smooth_motion(string, Smooth(amplitude=1.0, rate=inputs["beta"]), inputs["x"], inputs["t"])
        assert value.printed == pytest.approx(float(case["as_printed"]), abs=6e-9)
        assert value.corrected == pytest.approx(float(case["value"]), abs=1e-12)


def test_criterion() -> None:
    value = paper.critical_damping(_string(0.0))
    assert value.printed / S0 == pytest.approx(1.0965, abs=6e-5)
    assert value.corrected / S0 == pytest.approx(1.202413, abs=6e-7)
    between = _string(1.15 * S0)
    assert free_roots(between, 1)[0, 0].imag == pytest.approx(1.100, abs=6e-4)
    # Mode 1 still oscillates there; by the printed criterion mode 2 is the lowest.
    assert paper.lowest_oscillating_mode(between) == paper.PrintedAndCorrected(printed=2, corrected=1)
    heavy = paper.lowest_oscillating_mode(_string(10 * S0))
    assert heavy.printed > 9 * heavy.corrected


def test_static_series() -> None:
    string = uniform_string(damping=0.4)
    position, exponent = 0.05 * 9.81, 0.7

    def exact(p: float) -> float:
        return float(iv(0, 2 * math.sqrt(0.05 * (p**2 + 0.8 * p))))

    series = paper.static_series(string, exponent, position)
    # The next terms are y³/36 = 4e-6, and its derivative.
    assert series.corrected == pytest.approx(exact(exponent), abs=6e-6)
    assert series.printed == pytest.approx(0.94819, abs=2e-3)
    assert abs(series.printed - exact(exponent)) > 0.1
    slope = paper.static_slope(string, exponent, position)
    assert slope.corrected == pytest.approx((exact(exponent + 1e-5) - exact(exponent - 1e-5)) / 2e-5, abs=3e-5)
    assert slope.printed < 0 < slope.corrected


def _largest(values: list[paper.PrintedAndCorrected]) -> float:
    return max(abs(value.printed - value.corrected) for value in values)


POINTS = [(x, t) for x in np.linspace(0.03, 0.95, 7) for t in np.linspace(0.01, 3, 40)]


@pytest.mark.slow_but("0.5-*")
@pytest.mark.parametrize(("damping", "difference"), [(0.05, 1.8e-3), (0.5, 1.3e-2), (1.5, 1.8e-2), (3.0, 8.8e-2)])
def test_ramp(damping: float, difference: float) -> None:
    found = _largest([paper.ramp_motion(_string(damping), 1.0, x, t) for x, t in POINTS])
    # The theory's largest difference on other points of the same window.
    assert found == pytest.approx(difference, rel=0.25)


def test_ramp_of_a_long_string_has_no_real_root() -> None:
    with pytest.raises(NoEstimateError, match="root of mode 1"):
        paper.ramp_motion(uniform_string(length=100.0, damping=0.1), 1.0, 30.0, 9.0)
    with pytest.raises(NoEstimateError, match="aperiodic"):
        paper.ramp_motion(_string(5.0), 1.0, 0.3, 1.0)


@pytest.mark.parametrize(("damping", "printed", "corrected"), [(0.5, 0.580, 2.15973), (2.0, 0.597, 1.05889)])
def test_amplitude(damping: float, printed: float, corrected: float) -> None:
    string = _string(damping)
    value = paper.sine_amplitude(string, 5.0, 0.1)
    assert value.printed == pytest.approx(printed, abs=6e-4)
    assert value.corrected == pytest.approx(corrected, abs=6e-6)
    late = string_response(
        string, Sine(amplitude=1.0, omega=5.0), 0.1, 40 + np.linspace(0, 2 * math.pi / 5, 400)
    ).values
    # Between 400 instants of a period the maximum is missed by (π/400)²/2; what is free has fallen to e^{−20}.
    assert np.abs(late).max() == pytest.approx(value.corrected, rel=4e-5)


def test_resonance() -> None:
    value = paper.resonance_frequency(_string(2.0), 1)
    assert value.printed == pytest.approx(3.1911, abs=6e-5)
    assert value.corrected == pytest.approx(3.55431, abs=6e-6)
    with pytest.raises(NoEstimateError, match="mode 1"):
        paper.resonance_frequency(_string(5.0), 1)


@pytest.mark.slow_but("0.3-*")
@pytest.mark.parametrize(
    ("damping", "rate", "difference"),
    [(0.3, 4.0, 0.015), (1.0, 4.0, 0.078), (1.0, 1.2, 0.59), (2.0, 2.5, 25), (1.0, 0.7, None), (3.5, 3.0, None)],
)
def test_smooth_motion(damping: float, rate: float, difference: float | None) -> None:
    found = _largest([paper.smooth_motion(_string(damping), Smooth(amplitude=1.0, rate=rate), x, t) for x, t in POINTS])
    if difference:
        # The theory's largest difference, of z₂ alone for b > a, on other points of the same window.
        assert found == pytest.approx(difference, rel=0.3)
    else:
        assert found > 0.2


@pytest.mark.slow
def test_smooth_motion_without_damping_is_right() -> None:
    assert (
        _largest([paper.smooth_motion(_string(0.0), Smooth(amplitude=1.0, rate=4.0), x, t) for x, t in POINTS]) < 1e-12
    )


def test_smooth_motion_divides_by_nothing() -> None:
    with pytest.raises(NoEstimateError, match="b − a"):
        paper.smooth_motion(_string(1.5), Smooth(amplitude=1.0, rate=1.5), 0.3, 1.2)


def test_step_is_half_there_before_its_front() -> None:
    value = paper.step_motion(_string(0.3), 1.0, 0.04, 0.4)
    assert value == paper.PrintedAndCorrected(printed=0.5, corrected=0.0)


@pytest.mark.slow_but("motion3-*")
@pytest.mark.parametrize(
    ("motion", "damping", "terms", "error"),
    [
        (Ramp(speed=1.0), 0.0, 2, 0.103),
        (Ramp(speed=1.0), 1.0, 3, 0.013),
        (Smooth(amplitude=1.0, rate=S0), 0.0, 2, 0.109),
        (Smooth(amplitude=1.0, rate=3 * S0), 0.3, 3, 0.242),
        (Sine(amplitude=1.0, omega=2 * S0), 0.0, 2, 0.343),
        (Sine(amplitude=1.0, omega=1.1 * S0), 0.3, 3, 0.164),
    ],
)
def test_few_terms(motion: Ramp | Smooth | Sine, damping: float, terms: int, error: float) -> None:
    value = paper.few_terms_error(_string(damping * S0), motion, terms)
    # The theory's numbers, on another grid.
    assert value.corrected == pytest.approx(error, rel=0.05, abs=2e-3)


def test_partial_sums_converge_to_the_motion() -> None:
    string, motion = _string(0.4), Smooth(amplitude=1.0, rate=4.0)
    exact = string_response(string, motion, [0.2, 0.7], [0.9, 1.7]).values
    errors = [np.abs(partial_sum(string, motion, [0.2, 0.7], [0.9, 1.7], n) - exact).max() for n in (30, 300, 3000)]
    # As N⁻³ once the frequency of mode N is far above b.
    assert np.log10(errors[1] / errors[2]) == pytest.approx(3, abs=0.3)
    with pytest.raises(ValueError, match="terms is 0"):
        partial_sum(string, motion, 0.5, 1.0, 0)
