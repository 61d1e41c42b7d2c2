"""Thin float in an open channel, in SI units, and what is refused."""

from __future__ import annotations

import math

import numpy as np
import pytest
from thin_floats import CASES, CHANNEL, SHAPES, UNIT, number, thin

from hydroelastic.modal.estimate import NoEstimateError
from hydroelastic.modal.floats.box import box_modes
from hydroelastic.modal.floats.channel_motion import channel_free_motion, channel_resonance
from hydroelastic.modal.floats.in_tank import FloatInTank
from hydroelastic.modal.floats.open_float import open_float_estimate, released_float
from hydroelastic.modal.floats.thin_float import thin_float_mass, thin_float_stiffness
from hydroelastic.modal.floats.thin_float_decay import crossover_time, free_motion
from hydroelastic.modal.floats.thin_float_radiation import natural_rate, thin_float_radiation
from hydroelastic.modal.floats.thin_float_resonance import heave_pole, pole_count
from hydroelastic.modal.floats.wave_integral import wave_integral
from hydroelastic.modal.liquid.two_layer import TwoLayers
from hydroelastic.physics.profiles import FloatShape, float_profile


@pytest.mark.slow
@pytest.mark.parametrize("shape", SHAPES)
def test_motion_in_a_channel_is_that_in_a_long_box_before_waves_return(shape: FloatShape) -> None:
    """Modes of a closed box of length L: no wave is back before L/c₀, and up to then box and channel cannot differ."""
    profile = thin(shape, 0.1, tail=0.3)
    length = 100.0
    body = FloatInTank(
        layers=CHANNEL,
        tank_length=length,
        position=length / 2,
        mass=thin_float_mass(profile, 1.0, 0.8),
        stiffness=thin_float_stiffness(profile, 1.0, 0.8, 9.81),
        profile=profile,
    )
    modes = box_modes(body, 1200)
    rise = 2 * 0.1 / length
    weights = modes.participation / (1 + rise)
    time = np.array([0.0, 0.5, 2.0, 5.0, 12.0, 20.0, 30.0])
    assert time[-1] < 0.5 * length / math.sqrt(0.2 * 9.81 / (0.8 / 1.5 + 1 / 2))
    box = rise / (1 + rise) + np.cos(np.multiply.outer(time, modes.omega)) @ weights
    motion = released_float(profile, CHANNEL, time)
    # What the first modes leave out, from their sum at t = 0: 4e-11 for the parabola, 4e-7 for the exponential.
    assert abs(box[0] - 1) < 1e-6
    np.testing.assert_allclose(motion.heave, box, rtol=0, atol=2 * abs(box[0] - 1) + 1e-10)
    assert motion.error.max() < 1e-11


@pytest.mark.slow
def test_channel_motion_and_resonance_tend_to_those_of_deep_water() -> None:
    profile = thin("ellipse", 0.1)
    deep = TwoLayers(density_below=1.0, density_above=0.8, depth_below=math.inf, gravity=9.81)
    far = TwoLayers(density_below=1.0, density_above=0.8, depth_below=1e3, depth_above=1e3, gravity=9.81)
    time = np.array([0.0, 3.0, 10.0, 30.0])
    reference = released_float(profile, deep, time).heave
    np.testing.assert_array_equal(reference, free_motion(profile, time * natural_rate(profile, deep)).heave)
    # The bottom acts at the order (h/depth)², and later.
    np.testing.assert_allclose(released_float(profile, far, time).heave, reference, rtol=0, atol=2e-5)
    assert channel_resonance(profile, far) == pytest.approx(
        open_float_estimate(profile, deep, 1.0).resonance, rel=1e-7, abs=0
    )


@pytest.mark.slow
def test_equal_depths_are_one_liquid_with_reduced_gravity() -> None:
    """Heave between equal layers is odd in y: density ρ₁ + ρ₂ and gravity g* under a free surface."""
    profile = thin("wedge", 0.1)
    two = TwoLayers(density_below=1.0, density_above=0.8, depth_below=1.5, depth_above=1.5, gravity=9.0)
    one = TwoLayers(density_below=1.8, depth_below=1.5, gravity=9.0 * 0.2 / 1.8)
    omega = np.array([0.2, 1.0, 4.0])
    double, single = (open_float_estimate(profile, layers, omega) for layers in (two, one))
    np.testing.assert_allclose(double.radiation.added_mass, single.radiation.added_mass, rtol=1e-12)
    np.testing.assert_allclose(double.radiation.damping, single.radiation.damping, rtol=1e-13)
    assert double.resonance == pytest.approx(single.resonance, rel=1e-11, abs=0)
    time = np.array([0.0, 2.0, 9.0])
    motions = [released_float(profile, layers, time).heave for layers in (two, one)]
    np.testing.assert_allclose(*motions, rtol=0, atol=1e-11)


@pytest.mark.slow
def test_channel_resonance_is_the_late_motion() -> None:
    """Two late values of f fall as e^{−iωt} does: without a tail it is all that is left."""
    profile = thin("parabola", 0.1)
    resonance = channel_resonance(profile, CHANNEL)
    time = np.linspace(60, 100, 81)
    basis = np.exp(-1j * resonance * time)
    design = np.stack([basis.real, basis.imag], axis=1)
    motion = channel_free_motion(profile, CHANNEL, time).heave
    fit, *_ = np.linalg.lstsq(design, motion, rcond=None)
    assert np.linalg.norm(design @ fit - motion) < 1e-4 * np.linalg.norm(motion)
    for offset in (1e-3, 1e-3j):
        other = np.exp(-1j * (resonance + offset) * time)
        wrong = np.stack([other.real, other.imag], axis=1)
        fit, *_ = np.linalg.lstsq(wrong, motion, rcond=None)
        assert np.linalg.norm(wrong @ fit - motion) > 1e-3 * np.linalg.norm(motion)


def test_estimate_in_si_units() -> None:
    """Densities enter by their sum and by g*, lengths by the half-height."""
    profile = float_profile("wedge", 0.4, 4.0)
    layers = TwoLayers(density_below=1025.0, density_above=900.0, depth_below=math.inf, gravity=9.81)
    rate = math.sqrt(9.81 * 125 / 1925 / 4)
    estimate = open_float_estimate(profile, layers, [])
    assert estimate.radiation.added_mass.shape == (0,)
    z = number(CASES["f_wedge_tau0.1"]["values"]["z1"])
    assert estimate.resonance == pytest.approx(complex(z.imag, z.real) * rate, rel=1e-14, abs=0)
    assert estimate.crossover_time == pytest.approx(crossover_time(thin("wedge", 0.1)) / rate, rel=1e-12, abs=0)
    motion = released_float(profile, layers, 3.0 / rate)
    assert motion.heave == pytest.approx(float(CASES["f_wedge_tau0.1"]["values"]["f"][2]), abs=1e-14)
    assert open_float_estimate(thin("parabola", 0.1), CHANNEL, [1.0]).crossover_time is None


@pytest.mark.slow
def test_channel_resonance_of_wide_floats() -> None:
    """In a deep channel that of deep water, as far from the real axis as the series reach; then none."""
    far = TwoLayers(density_below=1.0, depth_below=1e5, gravity=9.81)
    deep = TwoLayers(density_below=1.0, depth_below=math.inf, gravity=9.81)
    for shape in ("wedge", "ellipse"):
        profile = thin(shape, 1.0)
        expected = open_float_estimate(profile, deep, []).resonance
        assert channel_resonance(profile, far) == pytest.approx(expected, rel=1e-9, abs=0)
    estimate = open_float_estimate(thin("wedge", 20.0), far, [1.0])
    assert estimate.resonance is None
    assert "wide" in estimate.note


@pytest.mark.slow
def test_refusals() -> None:
    blunt = float_profile("rectangle", 0.1, 1.0)
    for refused in (
        lambda: thin_float_radiation(blunt, UNIT, 1.0),
        lambda: free_motion(blunt, 1.0),
        lambda: heave_pole(blunt),
        lambda: wave_integral(blunt, 1j),
        lambda: open_float_estimate(blunt, CHANNEL, 1.0),
    ):
        with pytest.raises(NoEstimateError, match="flat edges"):
            refused()
    with pytest.raises(NoEstimateError, match="reaches"):
        released_float(thin("exponential", 0.1), CHANNEL, 1.0)
    free = TwoLayers(density_below=1.0, density_above=0.8, depth_below=2.0, depth_above=2.0, gravity=9.81, top="free")
    with pytest.raises(NoEstimateError, match="rigid lid"):
        thin_float_radiation(thin("wedge", 0.1), free, 1.0)
    with pytest.raises(NoEstimateError, match="too many"):
        channel_free_motion(thin("wedge", 0.1), CHANNEL, 1e7)
    with pytest.raises(NoEstimateError, match="so wide"):
        free_motion(thin("wedge", 1e4), 1.0)
    for time in (-1.0, math.nan, math.inf):
        with pytest.raises(ValueError, match="times"):
            free_motion(thin("wedge", 0.1), time)
        with pytest.raises(ValueError, match="times"):
            channel_free_motion(thin("wedge", 0.1), CHANNEL, time)
    for omega in (0.0, -1.0, math.nan):
        with pytest.raises(ValueError, match="frequencies"):
            thin_float_radiation(thin("wedge", 0.1), UNIT, omega)
    with pytest.raises(ValueError, match="angle"):
        pole_count(thin("wedge", 0.1), 3.0)
