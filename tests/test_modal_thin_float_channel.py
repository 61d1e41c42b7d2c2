"""Thin float in an open channel, in SI units, and what is refused."""

from __future__ import annotations

import math

import numpy as np
import pytest
from thin_floats import CASES, CHANNEL, number, thin

from hydroelastic.modal.floats.open_float import open_float_estimate, released_float
from hydroelastic.modal.floats.thin_float_decay import crossover_time
from hydroelastic.modal.liquid.two_layer import TwoLayers
from hydroelastic.physics.profiles import float_profile


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
