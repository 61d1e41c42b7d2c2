"""Added mass and damping of a thin float in open water, and the integral behind them."""

from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.integrate import quad
from thin_floats import CASES, CHANNEL, EPS, SHAPES, UNIT, gauss, thin

from hydroelastic.modal.floats.complex_moments import complex_wave_moment
from hydroelastic.modal.floats.open_float import open_float_estimate
from hydroelastic.modal.floats.thin_float_radiation import complex_added_mass, thin_float_radiation
from hydroelastic.modal.floats.thin_shapes import inertia_factor, wave_moment
from hydroelastic.modal.floats.wave_integral import wave_integral
from hydroelastic.modal.liquid.two_layer import TwoLayers
from hydroelastic.physics.profiles import FloatShape, Profile, float_profile


@pytest.mark.parametrize("name", ["ab_exponential", "ab_parabola"])
def test_reference_added_mass_and_damping(name: str) -> None:
    inputs, values = CASES[name]["inputs"], CASES[name]["values"]
    kappa = np.array([float(k) for k in inputs["kappa0"]])
    profile = thin(inputs["shape"], 0.1)
    radiation = thin_float_radiation(profile, UNIT, np.sqrt(kappa))
    added_mass = [float(a) for a in values["a_hat"]]
    # a crosses zero at κ = 1 for the exponential, and is a difference of terms of the size of J: absolute.
    np.testing.assert_allclose(radiation.added_mass / 0.1**2, added_mass, rtol=8 * EPS, atol=8 * EPS)
    np.testing.assert_allclose(
        radiation.damping / np.sqrt(kappa) / 0.1**2, [float(b) for b in values["b_hat"]], rtol=16 * EPS
    )
    assert radiation.infinite_added_mass == pytest.approx(0.1**2 * float(values["a_hat_inf"]), rel=4 * EPS, abs=0)


def test_reference_channel() -> None:
    case = CASES["open_parabola_rho0.8"]
    omega = np.array([float(w) for w in case["inputs"]["omega"]])
    radiation = thin_float_radiation(thin("parabola", 0.1), CHANNEL, omega)
    # The two methods behind the reference agree to 9e-14.
    np.testing.assert_allclose(radiation.added_mass, [float(a) for a in case["values"]["a"]], rtol=2e-13)
    np.testing.assert_allclose(radiation.damping, [float(b) for b in case["values"]["b"]], rtol=2e-14)


@pytest.mark.parametrize("shape", SHAPES)
def test_limits_of_added_mass_and_damping(shape: FloatShape) -> None:
    profile = thin(shape, 0.1)
    kappa = np.array([1e-12, 1e-10, 1e6, 4e6])
    radiation = thin_float_radiation(profile, UNIT, np.sqrt(kappa))
    added_mass, damping = radiation.added_mass / 0.01, radiation.damping / np.sqrt(kappa) / 0.01
    # a ~ −(4/π) ln κ and b → 4 up to O(κ ln κ) and O(κ).
    assert added_mass[0] - added_mass[1] == pytest.approx(4 / math.pi * math.log(100), rel=1e-8, abs=0)
    assert damping[0] == pytest.approx(4, rel=1e-11, abs=0)
    # a ~ a_∞ − (4/π) ∫R² dκ/κ₀, next term O(ln κ/κ²).
    whole = quad(lambda u: float(wave_moment(profile, math.exp(u))) ** 2 * math.exp(u), -40, 40, limit=400)[0]
    missing = 2 / math.pi * inertia_factor(profile) - added_mass[2:]
    np.testing.assert_allclose(missing * kappa[2:], 4 / math.pi * whole, rtol=5e-5)
    # R ~ 1/κ where the slope is −b/h at y = 0, 2/κ² or 1/κ² where it is −2by/h² or −by/h².
    moment = {"exponential": 1 / kappa, "wedge": 1 / kappa, "parabola": 2 / kappa**2, "ellipse": 1 / kappa**2}[shape]
    np.testing.assert_allclose(damping[2:], 4 * moment[2:] ** 2, rtol=1e-5)


@pytest.mark.slow_but("deep-*")
@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize("layers", [UNIT, CHANNEL], ids=["deep", "channel"])
def test_added_mass_and_damping_are_a_hilbert_pair(shape: FloatShape, layers: TwoLayers) -> None:
    """a − a_∞ = (2/π) PV∫ b dω'/(ω'² − ω²), with the pole midway between nodes of the trapezoidal rule in ln ω'."""
    profile = thin(shape, 0.1, tail=0.3)
    for omega in (0.2, 1.0, 3.0):
        nodes = omega * np.exp(0.1 * (np.arange(-360, 360) + 0.5))
        # b falls at least like 1/ω³, and does not grow towards ω = 0: 1e-12/ω² is left there.
        damping = np.zeros_like(nodes)
        felt = (nodes < 1e6) & (nodes > 1e-12)
        damping[felt] = thin_float_radiation(profile, layers, nodes[felt]).damping
        integral = 0.1 * np.sum(nodes * damping / (nodes**2 - omega**2))
        radiation = thin_float_radiation(profile, layers, omega)
        difference = radiation.added_mass - radiation.infinite_added_mass
        assert difference == pytest.approx(2 / math.pi * integral, abs=1e-8 * radiation.infinite_added_mass)


def test_channel_tends_to_deep_water_and_to_long_waves() -> None:
    profile = thin("parabola", 0.1)
    omega = np.array([0.5, 1.3, 5.0])
    deep = TwoLayers(density_below=1.0, density_above=0.8, depth_below=math.inf, gravity=9.81)
    far = thin_float_radiation(profile, deep, omega)
    for below, above in ((1e4, 1e4), (math.inf, 1e4), (1e4, math.inf)):
        layers = TwoLayers(density_below=1.0, density_above=0.8, depth_below=below, depth_above=above, gravity=9.81)
        near = thin_float_radiation(profile, layers, omega)
        # The bottom is felt as (h/depth)²/κ.
        np.testing.assert_allclose(near.added_mass, far.added_mass, rtol=1e-6)
        np.testing.assert_allclose(near.damping, far.damping, rtol=1e-13)
    slow = thin_float_radiation(profile, CHANNEL, [1e-6, 1e-5])
    speed = math.sqrt(0.2 * 9.81 / (0.8 / 1.5 + 1 / 2))
    np.testing.assert_allclose(slow.damping, 2 * 0.1**2 * 0.2 * 9.81 / speed, rtol=1e-9)
    assert slow.added_mass[0] == pytest.approx(slow.added_mass[1], rel=1e-8, abs=0)


def test_complex_added_mass_is_that_of_real_frequencies_and_vanishes_with_the_stiffness_at_resonance() -> None:
    layers = TwoLayers(density_below=1000.0, density_above=850.0, depth_below=math.inf, gravity=9.81)
    for shape in SHAPES:
        profile = float_profile(shape, 0.3, 2.0, tail=0.0)
        omega = np.array([0.1, 1.0, 4.0])
        radiation = thin_float_radiation(profile, layers, omega)
        expected = radiation.added_mass + 1j * radiation.damping / omega
        # Rounding of the complex value, whose real part is not small beside a_∞.
        scale = radiation.infinite_added_mass
        np.testing.assert_allclose(
            complex_added_mass(profile, layers, -1j * omega), expected, rtol=0, atol=1e-14 * scale
        )
        estimate = open_float_estimate(profile, layers, omega)
        assert estimate.resonance is not None
        rate = -1j * estimate.resonance
        force = (estimate.mass + complex_added_mass(profile, layers, rate)) * rate**2 + estimate.stiffness
        assert abs(force) < 1e-13 * estimate.stiffness


@pytest.mark.parametrize("shape", SHAPES)
def test_wave_integral_is_analytic(shape: FloatShape) -> None:
    """No jump on the imaginary axis, where ln z² for 2 Ln z would have one; Cauchy's integral around a point on it."""
    profile = thin(shape, 0.1)
    for centre in (1j, 1e-3j, 30j):
        around = centre * (1 + 0.4 * np.exp(2j * math.pi * np.arange(64) / 64))
        here = complex(wave_integral(profile, centre))
        assert np.mean(wave_integral(profile, around)) == pytest.approx(here, rel=4e-15, abs=0)
    # On the axis Im G = −πR².
    z = 1j * np.geomspace(1e-3, 5, 7)
    waves = -math.pi * wave_moment(profile, np.abs(z) ** 2) ** 2
    np.testing.assert_allclose(wave_integral(profile, z).imag, waves, rtol=0, atol=1e-14)
    assert complex(wave_integral(profile, 0.3 - 2j)) == complex(wave_integral(profile, 0.3 + 2j)).conjugate()
    with pytest.raises(ValueError, match="must not be 0"):
        wave_integral(profile, 0.0)
    if shape != "exponential":
        with pytest.raises(ValueError, match="angle"):
            wave_integral(profile, -1.0 + 0.1j)


@pytest.mark.parametrize("profile", [thin(shape, 0.1, tail=0.2) for shape in SHAPES], ids=SHAPES)
def test_complex_moment_against_adaptive_quadrature(profile: Profile) -> None:
    """|κ| on both sides of every change of formula."""
    for size in (1e-6, 0.5, 1.999, 2.001, 30.0, 199.0, 201.0, 1e3):
        for angle in (0.0, 0.7, -1.3):
            kappa = size * np.exp(1j * angle)
            y, weights = gauss(np.concatenate([[0.0], np.geomspace(1e-6, 1, 400)]))
            if profile.shape == "ellipse":
                height = np.sin(math.pi / 2 * y)
                value = np.sum(math.pi / 2 * weights * height * np.exp(-kappa * height))
            else:
                y, weights = profile.extent * y, profile.extent * weights
                value = np.sum(-profile.slope_at(y) / 0.1 * weights * np.exp(-kappa * y))
            assert complex(complex_wave_moment(profile, kappa)) == pytest.approx(complex(value), abs=1e-14, rel=1e-11)
