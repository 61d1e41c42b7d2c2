"""Constants of the thin float: references, quadrature, limits."""

from __future__ import annotations

import json
import math
from pathlib import Path

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.special import iv, modstruve

from hydroelastic.modal.floats.thin_float import (
    thin_constants,
    thin_float_added_mass,
    thin_float_mass,
    thin_float_stiffness,
)
from hydroelastic.modal.floats.thin_shapes import (
    LARGE_ARGUMENT,
    area_factor,
    end_wave_moment,
    flux_rule,
    inertia_factor,
    sine_moment,
    wave_moment,
    wave_moment_series,
)
from hydroelastic.physics.profiles import Profile, float_profile

REFERENCE = json.loads((Path(__file__).parent / "reference" / "two_fluid_float.json").read_text(encoding="utf-8"))
CASES = {case["id"]: case for case in REFERENCE["cases"]}
EPS = np.finfo(float).eps
PROFILES = [
    float_profile("wedge", 1.0, 1.0),
    float_profile("parabola", 1.0, 1.0),
    float_profile("ellipse", 1.0, 1.0),
    float_profile("exponential", 1.0, 1.0, tail=0.0),
    float_profile("exponential", 1.0, 1.0),
    float_profile("exponential", 1.0, 1.0, tail=0.5),
    float_profile("exponential", 1.0, 1.0, tail=1 - 1e-6),
    float_profile("exponential", 1.0, 1.0, tail=1e-40),
]


def label(profile: Profile) -> str:
    return f"{profile.shape}-{profile.tail}"


def flux_integral(profile: Profile, f: object) -> float:
    """∫ q f dy over the upper half by adaptive quadrature, the ellipse by its angle."""
    if profile.shape == "ellipse":
        return quad(lambda t: math.sin(t) * f(math.sin(t)), 0, math.pi / 2, epsabs=1e-14, epsrel=1e-12, limit=200)[0]
    end = min(profile.extent, 60.0)
    return quad(
        lambda y: -float(profile.slope_at(y)) * f(y), 0, end, epsabs=1e-14, epsrel=1e-12, limit=400, points=[end / 9]
    )[0]


@pytest.mark.parametrize("profile", PROFILES, ids=label)
def test_moments_against_adaptive_quadrature(profile: Profile) -> None:
    for kappa in (1e-4, 0.3, 2.0, 19.9, 20.1, 49.0, 51.0, 120.0):
        wave = flux_integral(profile, lambda y, k=kappa: math.exp(-k * y))
        assert float(wave_moment(profile, kappa)) == pytest.approx(wave, rel=1e-11, abs=3e-14)
    for kappa in (1e-4, 0.3, 2.0, 19.0):
        sine = flux_integral(profile, lambda y, k=kappa: math.sin(k * y))
        assert sine_moment(profile, np.array([kappa]))[0] == pytest.approx(sine, rel=1e-11, abs=1e-14)
    if profile.extent < 10:
        for kappa in (1e-4, 0.3, 4.0):
            image = flux_integral(profile, lambda y, k=kappa: math.exp(-k * (profile.extent - y)))
            assert end_wave_moment(profile, np.array([kappa]))[0] == pytest.approx(image, rel=1e-11)
    assert area_factor(profile) == pytest.approx(flux_integral(profile, lambda y: y), rel=1e-11)
    assert float(wave_moment(profile, 0.0)) == pytest.approx(1, rel=4 * EPS)


def test_closed_forms_of_the_wave_moment() -> None:
    kappa = np.array([0.01, 0.5, 3.0, 8.0])
    wedge, parabola, ellipse = PROFILES[:3]
    np.testing.assert_allclose(wave_moment(wedge, kappa), -np.expm1(-kappa) / kappa, rtol=1e-14)
    # The closed forms lose 1/κ² and e^{2κ} of their digits.
    np.testing.assert_allclose(
        wave_moment(parabola, kappa[1:]), 2 * (1 - (1 + kappa[1:]) * np.exp(-kappa[1:])) / kappa[1:] ** 2, rtol=1e-14
    )
    struve = np.pi / 2 * (modstruve(-1, kappa[:3]) - iv(1, kappa[:3]))
    np.testing.assert_allclose(wave_moment(ellipse, kappa[:3]), struve, rtol=1e-12)
    for profile in PROFILES:
        # Beside the series that takes over at LARGE_ARGUMENT, and that the tails of box sums rest on.
        powers, coefficients = wave_moment_series(profile)
        for kappa_large in (1.0001 * LARGE_ARGUMENT, 1000.0):
            short = min(1.0, profile.extent)
            series = np.sum(coefficients * (kappa_large / short) ** -powers)
            assert float(wave_moment(profile, kappa_large / short)) == pytest.approx(series, rel=1e-14)
    y, _, weights = flux_rule(ellipse)
    below = np.sum(weights * np.exp(-LARGE_ARGUMENT * y))
    assert float(wave_moment(ellipse, LARGE_ARGUMENT * (1 + 1e-12))) == pytest.approx(below, rel=1e-11)


@pytest.mark.parametrize("profile", PROFILES, ids=label)
def test_inertia_is_that_of_the_cosine_transform(profile: Profile) -> None:
    """J = 2 ∫ k C² dk = 2 ∫ Q_s²/k dk, an integral over wavenumbers instead of the double one with a logarithm."""
    # The integrand falls like k⁻³ (k⁻² for the ellipse): over 4000 π, in steps of π, the rest is known to 1e-9 (1e-8).
    nodes, weights = np.polynomial.legendre.leggauss(16)
    scale = 1 / min(profile.extent, 1e2)
    edges = scale * np.pi * np.concatenate([0.5 ** np.arange(30, 0, -1), np.arange(1, 4001)])
    edges = np.concatenate([[0.0], edges])
    k = (edges[:-1, None] + np.diff(edges)[:, None] * (nodes + 1) / 2).ravel()
    w = (np.diff(edges)[:, None] * weights / 2).ravel()
    total = 2 * np.sum(w * sine_moment(profile, k) ** 2 / k)
    end = edges[-1]
    # Means of sin², cos² and J₁² over a period give the rest.
    jump = 1 - profile.tail if profile.shape == "exponential" else 1.0
    rest = {
        "wedge": 3 / 2 / end**2,
        "parabola": 2 / end**2,
        "ellipse": np.pi / 2 / end,
        "exponential": (1 + profile.tail**2 / 2) / jump**2 / end**2,
    }
    assert total + rest[profile.shape] == pytest.approx(inertia_factor(profile), rel=3e-8)


def test_the_tail_interpolates_between_exponential_and_wedge() -> None:
    # tail → 0 is e^{−y}, tail → 1 is linear.
    assert inertia_factor(float_profile("exponential", 1.0, 1.0, tail=1e-12)) == pytest.approx(1, abs=1e-9)
    assert inertia_factor(float_profile("exponential", 1.0, 1.0, tail=1 - 1e-9)) == pytest.approx(
        2 * math.log(2), rel=1e-8
    )
    nearly_wedge = float_profile("exponential", 1.0, 1.0, tail=1 - 1e-9)
    assert area_factor(nearly_wedge) / nearly_wedge.extent == pytest.approx(0.5, rel=1e-8)


@pytest.mark.parametrize("name", ["f_wedge_tau0.1", "f_parabola_tau0.01", "f_parabola_tau0.1", "f_ellipse_tau0.1"])
def test_reference_constants(name: str) -> None:
    inputs, values = CASES[name]["inputs"], CASES[name]["values"]
    constants = thin_constants(float_profile(inputs["shape"], 2.5 * float(inputs["tau"]), 2.5))
    assert constants.slenderness == pytest.approx(float(inputs["tau"]), rel=2 * EPS)
    assert constants.frequency_squared == pytest.approx(float(values["Om2"]), rel=4 * EPS)
    assert constants.coupling == pytest.approx(float(values["eps"]), rel=8 * EPS)


@pytest.mark.parametrize("name", ["f_exp_eps0.0001", "f_exp_eps0.01", "f_exp_eps0.1", "f_exp_eps0.5", "pole_exp_eps1"])
def test_reference_coupling_of_the_exponential(name: str) -> None:
    inputs = CASES[name]["inputs"]
    constants = thin_constants(float_profile("exponential", float(inputs["tau"]), 1.0, tail=0.0))
    assert constants.coupling == pytest.approx(float(inputs["eps_star"]), rel=8 * EPS)
    assert constants.frequency_squared == pytest.approx(1 - constants.coupling / 2, rel=4 * EPS)


@pytest.mark.parametrize("name", ["ab_exponential", "ab_parabola"])
def test_reference_factors(name: str) -> None:
    values = CASES[name]["values"]
    profile = float_profile(CASES[name]["inputs"]["shape"], 0.3, 2.0, tail=0.0)
    assert area_factor(profile) == pytest.approx(float(values["S"]), rel=2 * EPS)
    assert inertia_factor(profile) == pytest.approx(float(values["J"]), rel=2 * EPS)
    expected = (1.0 + 0.8) * 0.3**2 * float(values["a_hat_inf"])
    assert thin_float_added_mass(profile, 1.0, 0.8) == pytest.approx(expected, rel=8 * EPS)


def test_frequency_is_that_of_stiffness_and_masses() -> None:
    for shape in ("wedge", "parabola", "ellipse", "exponential"):
        profile = float_profile(shape, 0.3, 2.0)
        y, step = np.linspace(-profile.extent, profile.extent, 2_000_001, retstep=True)
        area = 2 * step * profile.half_width_at(y).sum()
        mass = thin_float_mass(profile, 1.0, 0.8)
        # Trapezoidal rule, ω = 0 at the ends: 1e-9 where the ellipse has vertical ends, less elsewhere.
        assert mass == pytest.approx(1.8 / 2 * area, rel=3e-9)
        stiffness = thin_float_stiffness(profile, 1.0, 0.8, 9.81)
        assert stiffness == pytest.approx(0.2 * 9.81 * 0.6, rel=4 * EPS)
        # With Ω² = c/(m + a_∞) of the displaced mass.
        squared = thin_constants(profile).frequency_squared * 9.81 * 0.2 / 1.8 / profile.half_height
        total = mass + thin_float_added_mass(profile, 1.0, 0.8)
        assert squared == pytest.approx(stiffness / total, rel=16 * EPS)
