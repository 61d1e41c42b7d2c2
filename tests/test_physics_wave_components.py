"""Irregular waves as sums of regular ones."""

import numpy as np
import pytest

from hydroelastic.physics.wave_components import wave_components
from hydroelastic.physics.wave_spectrum import PeakedSpectrum

SPECTRUM = PeakedSpectrum(height=2.0, period=8.0, enhancement=3.3)


def test_components_have_the_energy_of_the_spectrum() -> None:
    omega, amplitude, _ = wave_components(SPECTRUM, 200, 1)
    # Beyond its band the spectrum has 0.3 % of its energy, Hs²/16.
    assert (0.5 * amplitude**2).sum() == pytest.approx(SPECTRUM.significant_height**2 / 16.0, rel=4e-3)
    # Of the second moment, whose tail is longer, the middles of 200 parts miss a little more.
    fine = np.linspace(*SPECTRUM.band, 20001)
    second = np.trapezoid(SPECTRUM.density(fine) * fine**2, fine)
    assert (0.5 * amplitude**2 * omega**2).sum() == pytest.approx(second, rel=5e-3)
    assert np.all(np.diff(omega) > 0.0)


def test_a_seed_tells_the_phases() -> None:
    one, same, other = (wave_components(SPECTRUM, 50, seed)[2] for seed in (3, 3, 4))
    np.testing.assert_array_equal(one, same)
    assert np.abs(one - other).max() > 1.0
    # Uniform from 0 to 2π: the mean of 50 lies within four standard deviations, 1.8/√50.
    assert abs(one.mean() - np.pi) < 4.0 * 1.8 / np.sqrt(50.0)
