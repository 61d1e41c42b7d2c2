"""Modes, roots, fronts and steady motion of a hanging string."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.special import iv, j0, jn_zeros
from uniform_strings import uniform_string

from hydroelastic.modal.bessel_zeros import bessel_zeros
from hydroelastic.modal.string.closed_form import (
    first_oscillating_mode,
    free_roots,
    mode_shape,
    natural_frequencies,
    natural_frequency,
    relative_roots,
    steady_amplitude,
    transfer,
)
from hydroelastic.modal.string.resonance import nearest_resonance, string_resonance

STRING = uniform_string(damping=0.5)
S0 = math.sqrt(9.81)


def test_zeros() -> None:
    assert bessel_zeros(300) == pytest.approx(jn_zeros(0, 300), rel=1e-14)
    # |J₁| at zero k is √(2/πμ): a zero off by a rounding of itself gives J₀ as much.
    late = bessel_zeros(60000)[-1000:]
    assert np.abs(j0(late)).max() < np.finfo(float).eps * late[-1] * math.sqrt(2 / (math.pi * late[0]))
    assert bessel_zeros(0).shape == (0,)


def test_frequencies_of_the_first_modes() -> None:
    # The numbers of the corrected criterion.
    assert natural_frequencies(STRING, 4) / S0 == pytest.approx([1.2024, 2.7600, 4.3269, 5.8958], abs=1e-4)
    assert STRING.travel_time == pytest.approx(0.63855, abs=5e-6)


@pytest.mark.parametrize("damping", [0.0, 0.5, 3.766067388420842, 5.0, 1e9])
def test_roots_are_roots(damping: float) -> None:
    string = uniform_string(damping=damping)
    roots, squares = free_roots(string, 6), natural_frequencies(string, 6) ** 2
    # Vieta's formulas, which hold relatively however far the roots are apart.
    assert roots.prod(axis=1) == pytest.approx(squares, rel=1e-14)
    assert roots.sum(axis=1) == pytest.approx(-2 * damping, rel=1e-14)
    assert (roots.real <= 0).all()


@pytest.mark.parametrize(
    ("damping", "mode"), [(0.0, 1), (1.15, 1), (1.2024, 1), (1.2025, 2), (2.75, 2), (2.77, 3), (5.9, 5)]
)
def test_lowest_mode_that_oscillates(damping: float, mode: int) -> None:
    string = uniform_string(damping=damping * S0)
    assert first_oscillating_mode(string) == mode
    assert (free_roots(string, mode)[mode - 1].imag != 0).all()
    assert (free_roots(string, mode)[: mode - 1].imag == 0).all()


def test_at_its_frequency_damping_is_critical() -> None:
    critical = natural_frequency(STRING, 3)
    assert critical == natural_frequencies(STRING, 3)[2]
    string = uniform_string(damping=critical)
    assert first_oscillating_mode(string) == 4
    assert free_roots(string, 3)[2] == pytest.approx([-critical, -critical])


def test_shapes_are_held_at_the_upper_end() -> None:
    assert mode_shape(STRING, 3, [0.0, 1.0]) == pytest.approx([1.0, 0.0], abs=1e-15)
    # The second mode has one node below, where √x = μ₁/μ₂.
    assert mode_shape(STRING, 2, (2.404825557695773 / 5.520078110286311) ** 2) == pytest.approx(0, abs=1e-15)


def test_transfer_function() -> None:
    exponents = np.array([0.7, -0.2, 0.3 + 2.0j, 5j])
    z = STRING.travel_time * np.sqrt(exponents * (exponents + 1.0))
    expected = iv(0, np.outer(np.sqrt([0.0, 0.3, 1.0]), z)) / iv(0, z)
    assert transfer(STRING, exponents, [0.0, 0.3, 1.0]) == pytest.approx(expected, rel=1e-13)
    # Unscaled functions overflow from |z| = 700.
    assert np.abs(transfer(STRING, 1e6, [0.999, 1.0])[:, 0]) == pytest.approx([0.0, 1.0], abs=1e-100)


def test_amplitude_of_the_steady_motion() -> None:
    # Largest displacements of the late motion: the printed square of the paper gives 0.580 and 0.597.
    assert steady_amplitude(STRING, 5.0, 0.1) == pytest.approx(2.15973, abs=5e-6)
    assert steady_amplitude(uniform_string(damping=2.0), 5.0, 0.1) == pytest.approx(1.05889, abs=5e-6)
    assert steady_amplitude(STRING, 0.0, [0.0, 0.5]) == pytest.approx([1.0, 1.0])
    assert steady_amplitude(STRING, 7.0, 1.0) == pytest.approx(1.0)


def test_amplitude_grows_for_ever_at_an_undamped_resonance() -> None:
    string = uniform_string()
    second = natural_frequency(string, 2)
    assert steady_amplitude(string, second, [0.0, 0.5, 1.0]).tolist() == [math.inf, math.inf, 1.0]
    assert np.isfinite(steady_amplitude(string, second * (1 + 1e-9), 0.0)).all()


@pytest.mark.parametrize(("damping", "place", "height"), [(0.5, 3.76562, 6.0193), (2.0, 3.55431, None)])
def test_resonance_is_at_the_undamped_frequency(damping: float, place: float, height: float | None) -> None:
    found = string_resonance(uniform_string(damping=damping), 1)
    # Numbers of the theory, found by a search on a grid.
    assert found.peak_frequency == pytest.approx(place, abs=6e-6)
    assert abs(found.peak_frequency - found.natural_frequency) < abs(found.peak_frequency - found.free_frequency)
    if height:
        assert found.peak_amplitude == pytest.approx(height, abs=6e-5)
        assert found.estimate == pytest.approx(6.0331, abs=6e-5)


def test_resonances_without_and_with_much_damping() -> None:
    assert string_resonance(uniform_string(), 1).peak_amplitude == math.inf
    faint = string_resonance(uniform_string(damping=1e-7), 3)
    # The correction is of the order (α/Ω)².
    assert faint.peak_amplitude == pytest.approx(faint.estimate, rel=1e-8)
    heavy = string_resonance(uniform_string(damping=10.0), 1)
    assert heavy.free_frequency == 0
    assert math.isnan(heavy.peak_frequency)
    assert nearest_resonance(STRING, 9.0).mode == 2


def test_refuses_places_off_the_string() -> None:
    with pytest.raises(ValueError, match=r"positions has 1\.1"):
        relative_roots(STRING, [0.5, 1.1])
    with pytest.raises(ValueError, match="omega is -1"):
        steady_amplitude(STRING, -1.0, 0.5)
    with pytest.raises(ValueError, match="number is 0"):
        mode_shape(STRING, 0, 0.5)
