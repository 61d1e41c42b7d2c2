"""Spectra of waves, their sums, and statistics of responses, against closed forms."""

from math import gamma, log, pi, sqrt

import numpy as np
import pytest
from scipy.integrate import quad

from hydroelastic.physics.irregular_waves import moments, statistics, wave_components
from hydroelastic.physics.wave_spectrum import PeakedSpectrum, TabulatedSpectrum

PM = PeakedSpectrum(height=3.0, period=9.0)
JONSWAP = PeakedSpectrum(height=3.0, period=9.0, enhancement=3.3)


@pytest.mark.parametrize("enhancement", [1.0, 3.3, 7.0])
def test_the_energy_is_that_of_the_significant_height(enhancement: float) -> None:
    spectrum = PeakedSpectrum(height=3.0, period=9.0, enhancement=enhancement)
    parts = [(0.2, 0.6), (0.6, spectrum.peak), (spectrum.peak, 1.0), (1.0, 30.0)]
    energy = sum(quad(lambda x: float(spectrum.density(np.array([x]))[0]), *part)[0] for part in parts)
    assert energy + spectrum.tail(30.0, 0) == pytest.approx(9.0 / 16.0, rel=1e-9)


def test_a_constant_transfer_function_has_the_moments_of_pierson_and_moskowitz() -> None:
    omegas = np.geomspace(0.3, 60.0, 400)
    found = moments(PM, omegas, np.full((400, 1), 2.0 + 0.0j))[:, 0]
    # mₙ = (Hs²/16) (5/4)^{n/4} Γ(1 − n/4) ωₚⁿ for all frequencies.
    exact = [4.0 * 9.0 / 16.0 * 1.25 ** (n / 4) * gamma(1 - n / 4) * PM.peak**n for n in (0, 1, 2)]
    tails = [4.0 * PM.tail(60.0, n) for n in (0, 1, 2)]
    assert found + tails == pytest.approx(exact, rel=1e-6)
    told = statistics(PM, omegas, np.full((400, 1), 2.0 + 0.0j), np.zeros((400, 1)), 10800.0)
    assert told.significant_amplitude[0] == pytest.approx(2.0 * 3.0 / 2.0, rel=1e-6)
    period = 2.0 * pi * sqrt(exact[0] / exact[2])
    assert told.zero_crossing_period[0] == pytest.approx(period, rel=1e-3)
    assert told.largest_amplitude[0] == pytest.approx(sqrt(2.0 * exact[0] * log(10800.0 / period)), rel=1e-4)


def test_a_narrow_band_is_a_harmonic_motion() -> None:
    centre, width = 0.8, 1e-4
    spectrum = TabulatedSpectrum(omega=(centre - width, centre, centre + width), values=(0.0, 1.0 / width, 0.0))
    omegas = np.linspace(centre - width, centre + width, 11)
    transfer = (1.0 / (1.0 - omegas**2 - 0.2j * omegas))[:, None]
    told = statistics(spectrum, omegas, transfer, np.zeros((11, 1)), 3600.0)
    assert told.significant_amplitude[0] == pytest.approx(2.0 * abs(1.0 / (1.0 - 0.64 - 0.16j)), rel=1e-6)
    assert told.zero_crossing_period[0] == pytest.approx(2.0 * pi / centre, rel=1e-6)


def test_a_resonance_is_integrated_to_the_error_that_is_told() -> None:
    natural, damping = 0.75, 0.05

    def transfer(omega: np.ndarray) -> np.ndarray:
        return 1.0 / (natural**2 - omega**2 - 2.0j * damping * natural * omega)

    exact = moments(JONSWAP, np.linspace(0.33, 2.8, 8001), transfer(np.linspace(0.33, 2.8, 8001))[:, None], (0,))[0, 0]
    for count in (30, 60, 120):
        omegas = np.linspace(0.33, 2.8, count)
        told = statistics(JONSWAP, omegas, transfer(omegas)[:, None], np.zeros((count, 1)), 3600.0)
        error = abs(told.significant_amplitude[0] / (2.0 * sqrt(exact)) - 1.0)
        assert error <= told.sampling_error[0] <= 300.0 * error + 1e-9


def test_errors_of_transfer_functions_and_missing_waves_are_told() -> None:
    omegas = np.linspace(0.4, 1.5, 200)
    told = statistics(PM, omegas, np.ones((200, 1), dtype=complex), np.full((200, 1), 1e-3), 3600.0)
    assert told.transfer_error[0] == pytest.approx(1e-3, rel=1e-2)
    missing = 1.0 - told.moments[0, 0] / (9.0 / 16.0)
    assert 0.5 * missing <= told.truncation_error[0] <= 0.7 * missing


SUMMED = PeakedSpectrum(height=2.0, period=8.0, enhancement=3.3)


def test_components_have_the_energy_of_the_spectrum() -> None:
    omega, amplitude, _ = wave_components(SUMMED, 200, 1)
    # Beyond its band the spectrum has 0.3 % of its energy, Hs²/16.
    assert (0.5 * amplitude**2).sum() == pytest.approx(SUMMED.significant_height**2 / 16.0, rel=4e-3)
    # Of the second moment, whose tail is longer, the middles of 200 parts miss a little more.
    fine = np.linspace(*SUMMED.band, 20001)
    second = np.trapezoid(SUMMED.density(fine) * fine**2, fine)
    assert (0.5 * amplitude**2 * omega**2).sum() == pytest.approx(second, rel=5e-3)
    assert np.all(np.diff(omega) > 0.0)


def test_a_seed_tells_the_phases() -> None:
    one, same, other = (wave_components(SUMMED, 50, seed)[2] for seed in (3, 3, 4))
    np.testing.assert_array_equal(one, same)
    assert np.abs(one - other).max() > 1.0
    # Uniform from 0 to 2π: the mean of 50 lies within four standard deviations, 1.8/√50.
    assert abs(one.mean() - np.pi) < 4.0 * 1.8 / np.sqrt(50.0)
